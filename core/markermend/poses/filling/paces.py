"""What moves faster than a moment tells something else than where a body is.

Where a limb is and how it follows a step that shakes all the body are two things: a regression on
where joints are lets the limb shake by far too much, or too little. So each pace has its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d

from markermend.arrays import Float32Array, IntArray
from markermend.poses.filling.covariance import Moments
from markermend.poses.filling.regressing import regress

# Each pace is what three running means leave, together a Gaussian of this width in seconds,
# less the paces before it; how it goes together is how channels stray from bridges over so many
# seconds.
_PACES = ((0.05, 0.067), (0.15, 0.25))
# Share of the mean variance that is added to variances.
_RIDGE = 0.1
_MEANS = 3


@dataclass(frozen=True, eq=False)
class Weights:
    """Regressions of hidden channels on seen ones.

    Attributes
    ----------
    by : (channels, hidden) on where these are; 0 for those that are hidden
    faster : (paces · channels, hidden) what is added to that for faster movement
    """

    by: Float32Array
    faster: Float32Array

    def tell(self, poses: Float32Array, moved: Float32Array) -> Float32Array:
        """(frames, hidden) of (frames, channels) poses and their rows of :attr:`Paces.moved`."""
        return np.asarray(poses @ self.by + moved @ self.faster)


@dataclass(frozen=True, eq=False)
class Paces:
    """A recording's faster movement.

    Attributes
    ----------
    moved : (frames, paces · channels) by pace
    covariances : of each pace, (channels, channels)
    """

    moved: Float32Array
    covariances: tuple[Float32Array, ...]

    def regressed(
        self, by: Float32Array, seen: IntArray, hidden: IntArray, doubt: Float32Array
    ) -> Weights:
        """Regress each pace by itself, beside a regression on all movement alike.

        Parameters
        ----------
        by : (channels, hidden) weights of that one
        seen, hidden : channels
        doubt : (seen,) share of their variance that is added
        """
        found = []
        for covariance in self.covariances:
            ridge = _RIDGE * float(np.trace(covariance)) / len(covariance)
            weights, _ = regress(covariance, seen, hidden, ridge, doubt)
            more = -by
            more[seen] += weights
            found.append(more)
        return Weights(by, np.vstack(found))


def lengths_of_paces(rate: float) -> set[int]:
    """Lengths in frames for which :func:`paces_of` needs moments."""
    return {max(round(seconds * rate), 1) for _, seconds in _PACES}


def paces_of(poses: Float32Array, rate: float, moments: Moments) -> Paces:
    """Split a recording's movement by pace.

    Parameters
    ----------
    poses : (frames, channels) without NaN
    rate : frames per second
    moments : of the same channels, for :func:`lengths_of_paces` too
    """
    moved, rest = [], poses
    for width, _ in _PACES:
        slower = poses
        for _ in range(_MEANS):
            slower = uniform_filter1d(slower, _frames(width * rate), axis=0, mode="nearest")
        moved.append(rest - slower)
        rest = slower
    covariances = (moments.within_s(seconds).astype(np.float32) for _, seconds in _PACES)
    return Paces(np.hstack(moved), tuple(covariances))


def _frames(width: float) -> int:
    """Frames of each running mean that together are as wide, an odd number."""
    return 2 * int(np.sqrt(12.0 * width**2 / _MEANS + 1.0) / 2.0) + 1
