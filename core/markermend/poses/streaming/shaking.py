"""How noisy poses are, told as they come by what no movement changes: bones."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray

# Noise is told once so many poses have shown a bone, and anew after so many more.
ENOUGH, _ANEW = 24, 12
# Less noise than this share of a mean bone is none.
_LEAST = 2e-3
# Of third differences of white noise the sum of squared weights; the median of a normal
# distribution's size, and of the size of two together.
_SQUARES, _MEDIAN, _MEDIAN_OF_TWO = 20.0, 0.6745, 1.1774
# A median goes up where more was found and down where less, by this part; faster at first, and
# where more than this share of bones agree. It stays above this share of a bone.
_STEP, _FIRST_STEP, _AGREE, _FASTER, _FLOOR = 0.02, 2.0, 0.75, 1.0, 1e-3
# Noise of rotations is told where it shakes places by more than this times positions' variance.
_BESIDE = 0.7
_PLACE = 3


class Shaking:
    """Standard deviations of a sensor's noise.

    A bone keeps its length, and its place in the axes of the joint that carries it, so what these
    change from pose to pose by, beside what changes evenly, is noise.

    Parameters
    ----------
    bones : how many

    Attributes
    ----------
    noise_mm, noise_rad : of each coordinate, and of turns about each axis; 0 where there is none,
        or too little is known
    """

    def __init__(self, bones: int) -> None:
        self.noise_mm = self.noise_rad = 0.0
        self._unknown = np.full((bones, 1 + 2 * _PLACE), np.nan)
        self._past = self._unknown, self._unknown, self._unknown
        # Of each bone how much its length and its places in the axes of both ends shake; seen.
        self._shakes, self._seen = np.zeros((2, bones, 3))
        self._lengths = np.full(bones, np.nan)
        self._age = 0

    def look(self, lengths: FloatArray, by_child: FloatArray, by_parent: FloatArray) -> None:
        """Look at the bones of the next pose.

        Parameters
        ----------
        lengths : (bones,) mm, NaN where an end was not seen
        by_child, by_parent : (bones, 3) mm, bones in the axes of their ends, NaN where these are
            not turned
        """
        a, b, c = self._past
        d = np.column_stack([lengths, by_child, by_parent])
        self._past = b, c, d
        third = d - a + 3.0 * (b - c)
        way, across = (x[:, 1:].reshape(-1, 2, _PLACE) for x in (d, third))
        along = np.einsum("bex,bex->be", way, across) / lengths[:, None]
        aside = np.einsum("bex,bex->be", across, across) - along**2
        found = np.column_stack([np.abs(third[:, 0]), np.sqrt(np.maximum(aside, 0.0))])
        self._add(found, lengths)
        self._age += 1
        if self._age % _ANEW == 0:
            self._tell()

    def look_away(self) -> None:
        """What comes next does not follow what was looked at last."""
        self._past = self._unknown, self._unknown, self._unknown

    def _add(self, found: FloatArray, lengths: FloatArray) -> None:
        """Have medians go towards what was found, (bones, 3)."""
        known = ~np.isnan(found)
        first = known & (self._seen == 0)
        self._seen += known
        towards = np.where(known, np.sign(found - self._shakes), 0.0)
        agreed = np.abs(towards.sum(axis=0)) / np.maximum(known.sum(axis=0), 1)
        step = _STEP + _FASTER * np.maximum(agreed - _AGREE, 0.0)
        step = np.maximum(_FIRST_STEP / np.maximum(self._seen, 1.0), step)
        self._lengths = np.where(np.isnan(lengths), self._lengths, lengths)
        moved = np.where(first, found, self._shakes * np.exp(step * towards))
        self._shakes = np.maximum(moved, _FLOOR * np.nan_to_num(self._lengths)[:, None])

    def _tell(self) -> None:
        """Tell how noisy positions and rotations are."""
        often = self._seen >= ENOUGH
        known = often[:, 0]
        if not known.any():
            return
        far = self._lengths[known]
        noise = float(np.median(self._shakes[known, 0])) / _MEDIAN / np.sqrt(2.0 * _SQUARES)
        self.noise_mm = noise if noise > _LEAST * far.mean() else 0.0
        aside = np.where(often[known, 1:], self._shakes[known, 1:], np.inf)
        # Of a bone's two ends one carries it.
        turning = (aside.min(axis=1) / _MEDIAN_OF_TWO) ** 2 / _SQUARES - 2.0 * noise**2
        told = np.isfinite(turning)
        self.noise_rad = 0.0
        # Less than what positions make of it anyway cannot be told from that.
        if told.any() and np.median(turning[told]) > _BESIDE * noise**2:
            turned = float(np.median(turning[told] / far[told] ** 2))
            # Of bones that differ much in length the two medians are not of one bone.
            self.noise_rad = float(np.sqrt(max(turned, 0.0)))
