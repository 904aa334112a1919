"""Neighbour-based polynomial predictor, fitted by least squares (skurowski2022, 3.3.2)."""

from __future__ import annotations

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.predictors.inputs import gather, lagged_powers, neighbours_of, trusted_samples
from markermend.take import Take

# Directions weaker than this share of the strongest are noise: the Vandermonde columns of one
# body's markers are nearly collinear.
CONDITION = 1e-6


def predict_polynomial(
    take: Take,
    mesh: Mesh,
    marker: int,
    *,
    k: int = 3,
    order: int = 4,
    trusted: BoolArray | None = None,
) -> FloatArray:
    """Predict a marker from powers of its neighbours' present and former coordinates.

    Parameters
    ----------
    take : the recording
    mesh : the body's structure
    marker : column of the marker to predict
    k : number of former frames
    order : highest power, L in the paper
    trusted : (frames, markers, 3) bool, samples that may be believed; all seen ones by default

    Returns
    -------
    (frames, 3) mm; NaN where fewer than half of the neighbours are trusted

    Raises
    ------
    DataError
        when the marker has no neighbour or is never seen together with most of them

    Notes
    -----
    skurowski2022, equations 1 to 4, 8 and 9: ``P_k^L``. The normal equations (3) are not formed;
    columns are standardised and solved by singular values cut at 1e-6 of the largest.
    """
    known = trusted_samples(take, trusted)
    inputs = gather(take.positions, known, marker, neighbours_of(take, mesh, marker))
    if not inputs.fit.any():
        raise DataError(
            f"Marker “{take.labels[marker]}” cannot be predicted: it is never seen together with "
            "most of its neighbours."
        )
    design = lagged_powers(inputs.neighbours.reshape(take.frames, -1), k, order)
    design = np.concatenate([np.ones((take.frames, 1)), design], axis=1)
    with threadpool_limits(1):
        centre = inputs.own[inputs.fit].mean(axis=0)
        coefficients = np.linalg.lstsq(
            design[inputs.fit], inputs.own[inputs.fit] - centre, rcond=CONDITION
        )[0]
        predicted = design @ coefficients + centre
    predicted[~inputs.usable] = np.nan
    return np.asarray(predicted)
