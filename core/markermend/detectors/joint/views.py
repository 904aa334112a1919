"""One marker seen four ways: against three predictions from its body, and by itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.detectors.joint.bands import BANDS, HALF, clipped, filter_matrix, split
from markermend.detectors.joint.bank import LONGEST
from markermend.detectors.joint.whiten import LAGS, body_motion, whiten
from markermend.predictors.cross_fit import predict_cross_fitted
from markermend.predictors.local import INPUT_MARKERS

BODY, EVEN, ODD, OWN = range(4)
VIEWS = 4


@dataclass(frozen=True, eq=False)
class Views:
    """Whitened residuals of one marker.

    Attributes
    ----------
    error : (views, 3, bands, frames) mm, innovations, clipped; 0 where unknown
    weight : (views, 3, bands, frames) their inverse noise power
    habit : (views, 3, frames, 9) the filters that whiten, see :class:`White`
    whole : (3, bands, frames) mm, those against the body as they are
    residual : (frames, 3) mm, measured minus predicted from the body
    body : (frames, 3) mm, predicted
    """

    error: FloatArray
    weight: FloatArray
    habit: FloatArray
    whole: FloatArray
    residual: FloatArray
    body: FloatArray


def look(
    positions: FloatArray,
    marker: int,
    known: BoolArray,
    trusted: BoolArray,
    spreads: FloatArray,
) -> Views | None:
    """Foretell a marker from its body thrice, and whiten what is left.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN only where the target is not ``known``
    marker : column
    known : (frames, 3) bool, samples of the target that are measured and not damaged
    trusted : (frames, markers) bool, samples that may be learned from
    spreads : (markers, markers) from :func:`markermend.predictors.cross_fit.distance_spreads`

    Returns
    -------
    Views against the nearest references, the even and the odd ones of twice as many, and
    against nothing; None where the body says too little
    """
    order = np.argsort(spreads[marker], kind="stable")
    order = order[np.isfinite(spreads[marker][order])]
    predicted = predict_cross_fitted(positions, marker, order[:INPUT_MARKERS], trusted)
    judged = known & ~np.isnan(predicted)
    if judged.all(axis=1).sum() < 3 * LONGEST:
        return None
    own, body = held(positions[:, marker], judged), held(predicted, judged)
    halves = []
    for first in (0, 1):
        half = order[first : 2 * INPUT_MARKERS : 2]
        p = predict_cross_fitted(positions, marker, half, trusted)
        halves.append(np.where(np.isnan(p), body, p))
    whites = []
    for axis in range(3):
        c, even, odd = body[:, axis], halves[0][:, axis], halves[1][:, axis]
        x, ok = own[:, axis], judged[:, axis]
        moves = body_motion(c, even, odd)
        whites.append(
            (
                whiten(x - c, moves, ok),
                whiten(x - even, body_motion(even), ok),
                whiten(x - odd, body_motion(odd), ok),
                whiten(x, np.zeros((len(x), 0)), ok),
            )
        )
    frames = len(own)
    error = np.empty((VIEWS, 3, BANDS, frames))
    weight, habit = np.empty_like(error), np.empty((VIEWS, 3, frames, LAGS + 1))
    whole = np.empty((3, BANDS, frames))
    touched = maximum_filter1d((~judged).view(np.uint8), 2 * LAGS + 1, axis=0).T > 0
    for axis in range(3):
        for view, white in enumerate(whites[axis]):
            innovation = np.where(touched[axis], 0.0, white.error)
            parts, weight[view, axis] = split(innovation)
            error[view, axis] = clipped(parts, weight[view, axis])
            if view == BODY:
                whole[axis] = parts
            habit[view, axis] = white.habit
    return Views(error, weight, habit, whole, own - body, body)


def held(values: FloatArray, judged: BoolArray) -> FloatArray:
    """Bridge samples that are not judged by straight lines, (frames, 3)."""
    frames = np.arange(len(values))
    return np.column_stack(
        [np.interp(frames, frames[ok], v[ok]) for v, ok in zip(values.T, judged.T, strict=True)]
    )


@dataclass(frozen=True, eq=False)
class Seen:
    """Shapes at their places, as one view sees them, from half a filter before they begin.

    Attributes
    ----------
    shape : (n, bands, frames) what the filters make of each shape
    error : (n, bands, frames) mm, innovations there
    weight : (n, bands, frames) their inverse noise power, 0 beyond the take
    """

    shape: FloatArray
    error: FloatArray
    weight: FloatArray

    @property
    def push(self) -> FloatArray:
        """(n, bands) the matched filter's output."""
        return np.asarray((self.shape * self.error * self.weight).sum(axis=2))

    @property
    def power(self) -> FloatArray:
        """(n, bands) its variance."""
        return np.asarray(np.maximum((self.shape**2 * self.weight).sum(axis=2), 1e-9))

    @property
    def score(self) -> FloatArray:
        """(n,) signal to noise."""
        return np.asarray(self.push.sum(axis=1) / np.sqrt(self.power.sum(axis=1)))

    @property
    def height(self) -> FloatArray:
        """(n,) mm, least squares."""
        return np.asarray(self.push.sum(axis=1) / self.power.sum(axis=1))


def see(views: Views, view: int, axis: IntArray, start: IntArray, shapes: FloatArray) -> Seen:
    """Send shapes through the filters where they stand.

    Parameters
    ----------
    views : the marker
    view : which of the four
    axis, start : (n,) where each shape begins
    shapes : (n, longest) each followed by zeros
    """
    frames = views.error.shape[3]
    width = shapes.shape[1] + LAGS + 2 * HALF
    at = start[:, None] - HALF + np.arange(width)
    inside = (at >= 0) & (at < frames)
    at = np.clip(at, 0, frames - 1)
    row = axis[:, None]
    padded = np.pad(shapes, ((0, 0), (HALF + LAGS, HALF + LAGS)))
    habit = views.habit[view, row, at]
    seen = np.zeros((len(start), width))
    for k in range(LAGS + 1):
        seen += habit[:, :, k] * padded[:, LAGS - k : LAGS - k + width]
    parts = (seen @ filter_matrix(width)).reshape(len(start), BANDS, width)
    band = np.arange(BANDS)[None, :, None]
    where = (view, row[:, :, None], band, at[:, None, :])
    return Seen(parts, views.error[where], views.weight[where] * inside[:, None, :])


def see_whole(views: Views, axis: IntArray, start: IntArray, seen: Seen) -> FloatArray:
    """Unclipped innovations against the body where shapes were seen, (n, bands, frames) mm."""
    at = start[:, None] - HALF + np.arange(seen.shape.shape[2])
    at = np.clip(at, 0, views.whole.shape[2] - 1)
    return np.asarray(views.whole[axis[:, None, None], np.arange(BANDS)[:, None], at[:, None, :]])
