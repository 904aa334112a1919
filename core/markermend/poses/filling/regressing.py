"""What seen channels tell of hidden ones, by how all vary together."""

from __future__ import annotations

import numpy as np

from markermend.arrays import Float32Array, IntArray
from markermend.poses.solving import add_to_diagonal, solved

# Share of the whole variance that is added where a ridge is not enough.
_ILL = 1e-6


def regress(
    covariance: Float32Array,
    inputs: IntArray,
    targets: IntArray,
    ridge: float,
    doubt: Float32Array,
) -> tuple[Float32Array, Float32Array]:
    """Regress some channels on others.

    Parameters
    ----------
    covariance : (channels, channels)
    inputs, targets : channels
    ridge : added to the variances of inputs
    doubt : (inputs,) share of their variance that is added besides

    Returns
    -------
    (inputs, targets) weights, and (targets,) the variance that they leave
    """
    rows = covariance.take(inputs, axis=0)
    among, across = rows.take(inputs, axis=1), rows.take(targets, axis=1)
    own = np.asarray(covariance[targets, targets])
    if not len(inputs):
        return across, own
    add_to_diagonal(among, np.diagonal(among) * doubt + np.float32(ridge))
    try:
        weights = solved(among, across)
    except np.linalg.LinAlgError:
        # Movement so large that single precision does not see the ridge beside it.
        more = ridge + _ILL * float(np.diagonal(covariance)[inputs].sum())
        return regress(covariance, inputs, targets, more, doubt)
    return weights, np.maximum(own - np.sum(across * weights, axis=0), 0)
