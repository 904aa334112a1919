"""Go on from where something was last seen, or back from where it first was."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, Float32Array, FloatArray

# Ways to go on that are tried: of a movement little is left after so many seconds.
_OVER_S = (0.0, 0.05, 0.1, 0.2)
# So many frames ahead are tried, and in how many places at least.
_AHEAD, _PLACES = 6, 10


def gone_on(
    values: FloatArray,
    told: FloatArray | Float32Array | None,
    known: BoolArray,
    length: int,
    rate: float,
) -> tuple[FloatArray, FloatArray] | None:
    """Go on from the last frame in which values were known.

    Parameters
    ----------
    values : (frames, n) up to that frame, anything where not known
    told : (frames + length, n) the same as something else tells them, from which they stray slowly;
        None where nothing does
    known : (frames,) bool; the last one is
    length : frames to go on
    rate : frames per second

    Returns
    -------
    None where too little is known to try it, else (length, n) values and their mean squared errors

    Notes
    -----
    What is gone on with, values or by how much they stray from what is told, and how soon the speed
    that they have is lost, is what errs least where it is known, as far ahead.
    """
    ahead = np.unique(np.linspace(1, length, min(length, _AHEAD)).round().astype(int)).tolist()
    moves = np.append(False, known[1:] & known[:-1])
    places = [np.flatnonzero(moves[:-lag] & known[lag:]) for lag in ahead]
    if min(map(len, places)) < _PLACES:
        return None
    best, found = np.inf, None
    nothing = np.zeros((len(values) + length, values.shape[1]))
    for beside in (nothing,) if told is None else (told, nothing):
        left = values - beside[: len(values)]
        steps = np.diff(left, axis=0, prepend=left[:1])
        for over_s in _OVER_S:
            goes = _goes(length, over_s * rate)[:, None]
            missed = np.stack(
                [
                    np.mean((left[at + lag] - left[at] - goes[lag - 1] * steps[at]) ** 2, axis=0)
                    for lag, at in zip(ahead, places, strict=True)
                ]
            )
            if missed.mean() < best:
                best, found = float(missed.mean()), (beside, left[-1] + goes * steps[-1], missed)
    if found is None:
        return None
    beside, onwards, missed = found
    lags = np.arange(1, length + 1)
    error = np.stack([np.interp(lags, ahead, column) for column in missed.T], axis=1)
    return beside[len(values) :] + onwards, error


def _goes(length: int, over: float) -> FloatArray:
    """(length,) how many of the last step are made up to each frame, where it is soon over."""
    if not over:
        return np.zeros(length)
    return np.asarray(np.cumsum(np.exp(-np.arange(1, length + 1) / over)))
