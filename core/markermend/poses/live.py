"""Clean poses while they come: one in, one out, nothing held back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.errors import DataError
from markermend.poses.normal import bone_lengths
from markermend.poses.nuitrack import MIRROR, mirrored
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior, bending_of, fitting
from markermend.poses.streaming.doubting import Doubting
from markermend.poses.streaming.following import Following
from markermend.poses.streaming.steadying import Steadying

# After so many poses that did not come nothing is left of how things moved.
_LONG = 1_000_000


class Live:
    """Fills joints that are not seen, once each has been seen, and takes noise out of the others.

    Joints that are wrong without a word about it count as not seen, and left and right that changed
    places are put back (:class:`markermend.poses.streaming.doubting.Doubting`). It begins with the
    first pose that shows the root and a bone. A joint that was never seen is passed on as it comes;
    once it is seen, it joins in.

    Parameters
    ----------
    first : one pose, of which anything may be unseen; a joint may have no rotation
    prior : how bodies move; used where its joints are among these, which ``by_prior`` tells

    Attributes
    ----------
    joined : (joints,) bool, that are filled when they are not seen
    by_prior : the prior is used
    wrong : (joints,) bool, of the last pose, those that the sensor said it saw, and did not
    own : (joints,) of the last pose, at which joint each one's values came: the other side's where
        these had changed places

    Raises
    ------
    DataError
        when there is not one pose
    """

    def __init__(self, first: Pose, prior: Prior | None = None) -> None:
        if first.frames != 1:
            raise DataError(f"Live filling starts from one pose, not {first.frames}.")
        self._body, self._prior, self._root = first, prior, first.order[0]
        self._following: Following | None = None
        self._doubting = Doubting(first.joints, first.parents, first.rate)
        self._steadying = Steadying(first.parents, first.rate)
        self.joined: BoolArray = np.zeros(len(first.joints), dtype=bool)
        self.by_prior = self._left_handed = False
        given = self._doubting(first.positions[0], first.rotations[0], first.seen[0])
        self._doubting.keep(given[0], given[2])
        self._join(*given)

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on, which was not known before."""
        self._body = replace(self._body, rate=rate)
        self._doubting.come_at(rate)
        self._steadying.come_at(rate)
        if self._following is not None:
            self._following.come_at(rate)

    @property
    def wrong(self) -> BoolArray:
        """Joints of the last pose that were taken for not seen."""
        return self._doubting.wrong

    @property
    def own(self) -> IntArray:
        """Where the values of each joint of the last pose came."""
        return self._doubting.own

    @property
    def begun(self) -> bool:
        """Whether a pose has shown the root and a bone."""
        return self._following is not None

    def __call__(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, missed: int = 0
    ) -> tuple[FloatArray, FloatArray]:
        """Clean one pose.

        Parameters
        ----------
        positions : (joints, 3) mm; anything where not seen
        rotations : (joints, 4) unit quaternions x, y, z, w; 0 or NaN of a joint that has none
        seen : (joints,) bool
        missed : poses that should have come since the last, and did not: much may have happened
            meanwhile, so less of this one is taken for wrong; what was learnt stays

        Returns
        -------
        positions and rotations, whole but for what never joined, which is as it came; so are
        rotations of a joint that never had one, or on which one hangs that never joined
        """
        steps = 1.0 + min(max(missed, 0), _LONG)
        positions, rotations, seen = self._doubting(positions, rotations, seen, steps)
        positions, rotations = self._steadying(positions, rotations, seen, steps)
        places, turns = self._filled(positions, rotations, seen, steps)
        self._doubting.keep(places, seen | self.joined)
        if not self.joined.all():
            new = seen & ~self.joined
            if new.any():
                self._join(places, turns, new)
        return places, turns

    def _filled(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, steps: float
    ) -> tuple[FloatArray, FloatArray]:
        """One pose, with the joints that joined so far filled."""
        if self._following is None:
            return positions, rotations
        if not self._left_handed:
            return self._following(positions, rotations, seen, steps)
        # Priors are of right-handed axes, many sensors are not.
        places, turns = self._following(positions * MIRROR[:3], rotations * MIRROR[3:], seen, steps)
        return places * MIRROR[:3], turns * MIRROR[3:]

    def _join(self, positions: FloatArray, rotations: FloatArray, new: BoolArray) -> None:
        """Go on with some joints more, from a pose in which all that join have their place."""
        joined = self.joined | new
        told = new if self._following is None else new | self._following.ever_turned
        pose = self._body.with_samples(
            positions[None],
            np.where(told[:, None], rotations, np.nan)[None],
            joined[None].astype(np.float64),
        )
        bones = np.nan_to_num(bone_lengths(pose.positions, pose.parents))
        if not (joined[self._root] and bones.any()):
            return
        fit = fitting(pose, self._prior) if self._prior is not None else None
        way = fit is not None, fit is not None and fit[1]
        # What was learnt in other axes, or beside another prior, is not what is learnt now.
        before = self._following if way == (self.by_prior, self._left_handed) else None
        self.by_prior, self._left_handed = way
        pose = mirrored(pose) if self._left_handed else pose
        moments, bending = None, None
        if fit is not None and self._prior is not None:
            moments, bending = fit[0], bending_of(pose, self._prior)
        self._following = Following(pose, moments, before, bending)
        self.joined = joined
