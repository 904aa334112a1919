"""Joints that stand still to the last digit while the body goes on, noticed as poses come."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray

REPEATS = 2
"""Poses that repeat one before a joint counts as standing still."""

_SAME_MM = 1e-6
# What a joint is tied to moved when the bone to it became another by this share of the mean bone,
# and by so many of the digits that the recording has.
_CHANGED, _DIGITS = 0.01, 3.5


class Repeating:
    """Says which joints a sensor lost, and gives again as they were.

    A body may stand still, and numbers may be rounded; so what stands is held only if what it hangs
    on moves away from it, or two of those do that hang on it. A root that never moves is where
    others are measured from. It is noticed in the third pose.

    Parameters
    ----------
    joints, parents : (bones,) indices of each bone's ends, parents first
    count : of joints

    Attributes
    ----------
    whole : all that was seen of the last pose repeats the one before
    since : how many poses ago something moved last
    """

    def __init__(self, joints: IntArray, parents: IntArray, count: int) -> None:
        self._joints, self._parents = joints, parents
        self._tops: BoolArray = np.ones(count, dtype=bool)
        self._tops[joints] = False
        self.whole, self.since, self._digit = False, 1.0, np.inf
        self._came = np.full((count, 3), np.nan)
        # How long bones were when one of their ends began to stand.
        self._then = np.full(len(joints), np.nan)
        self._repeats = np.zeros(count, dtype=int)
        self._frozen, self._moved = np.zeros((2, count), dtype=bool)

    def frozen_in(
        self, places: FloatArray, lengths: FloatArray, mean_bone: float, steps: float = 1.0
    ) -> BoolArray:
        """Look at one pose.

        Parameters
        ----------
        places : (joints, 3) mm, NaN where not seen
        lengths : (bones,) mm, NaN where an end was not seen
        mean_bone : mm
        steps : poses from the last to this one; those between did not come

        Returns
        -------
        (joints,) bool: it stands still, and those that it is tied to have moved away from it
        """
        before, self._came = self._came, places.copy()
        ways = np.abs(places - before)
        same = (ways < _SAME_MM).all(axis=1)
        # Others may be measured from a root, which never moves then.
        self._moved |= (ways >= _SAME_MM).any(axis=1)
        self.since = self.since + steps if self.whole else steps
        if not same.any():
            self.whole, self._then = False, lengths
            self._repeats[:] = 0
            self._frozen[:] = False
            return self._frozen
        self.whole = bool((same | np.isnan(places[:, 0]) | np.isnan(before[:, 0])).all())
        self._then = np.where(same[self._joints] | same[self._parents], self._then, lengths)
        self._repeats = np.where(same, self._repeats + 1, 0)
        stands, self._frozen = self._repeats >= REPEATS, self._frozen & same
        # Numbers may be rounded: whoever moves a little stands then, too, and jumps.
        self._digit = min(self._digit, ways[ways >= _SAME_MM].min(initial=np.inf))
        least = max(_CHANGED * mean_bone, _DIGITS * self._digit)
        changed = np.abs(lengths - self._then) > least
        # Joints that stand still together, by the uppermost of them, and how many bones that tie
        # them to others tell that these moved; the one to what carries them does so alone.
        first, moved = np.arange(len(places)), np.zeros(len(places))
        for bone, (joint, parent) in enumerate(zip(self._joints, self._parents, strict=True)):
            if stands[joint] and stands[parent]:
                first[joint] = first[parent]
            elif changed[bone] and stands[joint] and not same[parent]:
                moved[joint] += 2
            elif changed[bone] and stands[parent] and not same[joint]:
                moved[first[parent]] += 1
        self._frozen |= stands & (moved[first] >= 2) & (self._moved | ~self._tops)
        return self._frozen
