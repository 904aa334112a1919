"""The individual models of tits2018: what each would put into the interval.

All take known rows to learn from and give values for wanted rows; the known rows include the
frames on either side of the interval, if they are there, to which the result is joined later.
"""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray

# Width at which a radial basis falls to one half, in standard deviations of an input.
GRNN_SMOOTHING = 0.3
FREEDOM_ROWS = 200


def thin(rows: IntArray, most: int) -> IntArray:
    """Keep every n-th row so that at least `most` are left, all when there are fewer twice over."""
    if len(rows) < 2 * most:
        return rows if len(rows) <= most else rows[np.linspace(0, len(rows) - 1, most).astype(int)]
    return rows[:: len(rows) // most]


def linear(known: FloatArray, target: FloatArray, wanted: FloatArray) -> FloatArray:
    """Least squares with an intercept (eq. 2, 3).

    Parameters
    ----------
    known : (rows, features)
    target : (rows, 3)
    wanted : (frames, features)

    Returns
    -------
    (frames, 3)
    """
    design = np.column_stack([np.ones(len(known)), known])
    weights, *_ = np.linalg.lstsq(design, target, rcond=None)
    return np.asarray(np.column_stack([np.ones(len(wanted)), wanted]) @ weights)


def polynomial(known: FloatArray, target: FloatArray, wanted: FloatArray) -> FloatArray:
    """Least squares on the inputs, their squares and products (eq. 12 to 14)."""
    return linear(*_alike(_quadratic(known), _quadratic(wanted), target))


def grnn(known: FloatArray, target: FloatArray, wanted: FloatArray) -> FloatArray:
    """Generalised regression network: average of what is known, weighted by likeness (eq. 15)."""
    inputs, values, asked = _alike(known, wanted, target)
    square = np.sum(asked**2, axis=1)[:, None] + np.sum(inputs**2, axis=1) - 2.0 * asked @ inputs.T
    square = np.maximum(square, 0.0)
    # Relative to the likest row, so that far from everything the weights do not all vanish.
    square -= square.min(axis=1, keepdims=True)
    weight = np.exp(-square * np.log(2.0) / GRNN_SMOOTHING**2)
    return np.asarray(weight @ values / weight.sum(axis=1, keepdims=True))


def _quadratic(inputs: FloatArray) -> FloatArray:
    """Inputs, squares and products: nine columns from three."""
    one, other = np.triu_indices(inputs.shape[1])
    return np.concatenate([inputs, inputs[:, one] * inputs[:, other]], axis=1)


def _alike(
    known: FloatArray, wanted: FloatArray, target: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Standardise both by the known rows; returns known, target, wanted."""
    mean, scale = known.mean(axis=0), known.std(axis=0)
    # What does not move but for rounding says nothing.
    scale = np.where(scale > 1e-6, scale, 1.0)
    return (known - mean) / scale, target, (wanted - mean) / scale


def coefficients(inputs: int) -> int:
    """How many numbers a linear regression of three coordinates learns, intercepts included."""
    return 3 * (inputs + 1)


def freedom(known: FloatArray) -> int:
    """Effective number of parameters of :func:`grnn`: the trace of its smoother, three times.

    Estimated on about 200 of the rows.

    Parameters
    ----------
    known : (rows, features) it learns from
    """
    inputs, _, _ = _alike(known, known[:1], known)
    some = inputs[:: max(1, len(inputs) // FREEDOM_ROWS)]
    square = np.sum(some**2, axis=1)[:, None] + np.sum(inputs**2, axis=1) - 2.0 * some @ inputs.T
    weight = np.exp(-np.maximum(square, 0.0) * np.log(2.0) / GRNN_SMOOTHING**2)
    return round(3 * len(inputs) * float(np.mean(1.0 / weight.sum(axis=1))))
