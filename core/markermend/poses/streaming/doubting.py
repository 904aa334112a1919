"""Find joints that a sensor reports wrongly without saying so, as poses come."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.faults.misplacing import FASTEST_RAD_S, OFF, OFF_BONE
from markermend.poses.nuitrack import twins
from markermend.poses.pose import parents_first
from markermend.poses.quaternion import lengths_of
from markermend.poses.streaming.repeating import REPEATS, Repeating

# Poses that show a bone before it is asked at all, and closely; later one in so many as those is
# learnt from. The last of them count.
_FEWEST, _ENOUGH, _COUNT = 3, 12, 41
# A length may be off by so many times as far as it strays half of the time, beside what it may
# anyway.
_STRAYS = 8.0
# Other lengths that are the same within this share, and sides that stay exchanged, are how the body
# is seen now after so long; sooner, but not before these, where it was hardly seen otherwise.
_SAME, _BELIEVED_S, _LENGTHS_S, _SIDES_S = 0.1, 2.0, 0.5, 1.0
# So much of how they change is gone along with.
_DRIFT = 0.1
# Left and right are told apart where they are this far from where they were, in mean bones, and
# exchanged are at most by this share of it.
_CLEAR, _EXCHANGED = 0.6, 0.5
# No body is further out.
_FAR_MM = 1e6
# Having come far tells as much of who is wrong as so many bones.
_FURTHER = 3.0
# What has stayed for so many poses where it turned to too fast is there.
_STAYS = 3


class Doubting:
    """Says which joints are wrong, and puts back left and right that changed places.

    Wrong is a joint at exactly 0, 0, 0 that is not the root; one that repeats itself to the last
    digit (:class:`markermend.poses.streaming.repeating.Repeating`); and one that is where its
    bones, whose lengths are learnt, cannot reach, or which they cannot reach so fast, with what
    went along. Left and right changed places where both are nearer to where the other was. Other
    lengths and exchanged sides are believed when they last for 2 s, or less at the beginning; a
    joint that is at 0, 0, 0 or repeats itself never is. Where most bones are others, none is wrong:
    it is somebody else.

    Parameters
    ----------
    joints : names, that tell the sides
    parents : index of each joint's parent, -1 for the root
    rate : poses per second

    Attributes
    ----------
    wrong : (joints,) bool, of the last pose
    own : (joints,) of the last pose, at which joint each one's own values came
    """

    def __init__(self, joints: Sequence[str], parents: Sequence[int], rate: float) -> None:
        bones = [j for j in parents_first(tuple(parents), tuple(joints)) if parents[j] >= 0]
        count, self._rate, self._above = len(joints), rate, tuple(parents)
        self._joints: IntArray = np.array(bones, dtype=int)
        self._parents: IntArray = np.array([parents[j] for j in bones], dtype=int)
        self._bone_of = {joint: bone for bone, joint in enumerate(bones)}
        self._twins = twins(joints)
        self._sided = np.flatnonzero(np.array(self._twins) != np.arange(count))
        self._uppermost: BoolArray = np.array(parents) < 0
        self._pairs = [(j, self._twins[j]) for j in bones if j < self._twins[j]]
        self.wrong = np.zeros(count, dtype=bool)
        self.own = self._every = np.arange(count)
        self._at, self._was = np.full((2, count, 3), np.nan)
        self._lengths, self._strays = np.zeros((2, len(bones)))
        self._shown, self._poses = np.full((_COUNT, len(bones)), np.nan), np.zeros(len(bones), int)
        self._others, self._other_poses = np.zeros((2, len(bones)))
        self._bones_at, self._bones_before = np.full((2, len(bones), 3), np.nan)
        self._repeating = Repeating(self._joints, self._parents, count)
        self._bones, self._steady = np.full((len(bones), 3), np.nan), np.zeros(len(bones))
        self._exchanged_for, self._own_for = np.zeros((2, count), dtype=int)
        self._showed = np.zeros(count, dtype=bool)
        self._age = 0
        self._set_limits()

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._rate = rate
        self._set_limits()

    def __call__(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, steps: float = 1.0
    ) -> tuple[FloatArray, FloatArray, BoolArray]:
        """Look at one pose.

        Parameters
        ----------
        positions, rotations, seen : as :class:`markermend.poses.live.Live` takes them, mm
        steps : poses from the last to this one; those between did not come

        Returns
        -------
        positions, rotations and seen, with sides put back and without what is wrong
        """
        # NaN is not near either.
        there = seen & (np.abs(positions) < _FAR_MM).all(axis=1)
        there &= positions.any(axis=1) | self._uppermost
        places = np.where(there[:, None], positions, np.nan)
        bones = places[self._joints] - places[self._parents]
        lengths = lengths_of(bones)
        frozen = self._repeating.frozen_in(places, lengths, self._mean_bone, steps)
        places[frozen] = np.nan
        self.own = self._put_back(places)
        if self.own is not self._every:
            own = self.own
            positions, rotations, places = positions[own], rotations[own], places[own]
            seen = seen[own]
        if self.own is not self._every or frozen.any():
            bones = places[self._joints] - places[self._parents]
            lengths = lengths_of(bones)
        broken = np.abs(lengths - self._lengths) > self._limits
        broken |= self._too_fast(bones)
        minority = True
        if broken.any() or self._other_poses.any():
            self._believe(lengths, broken)
            minority = 2 * broken.sum() <= np.isfinite(lengths).sum()
            if minority and broken.any():
                places[self._out_of_reach(places, lengths, broken)] = np.nan
                lengths = np.where(broken, np.nan, lengths)
        self._age += 1
        # A pose that comes again has the noise of the first.
        if minority and not self._repeating.whole and (self._unsettled or self._age % _ENOUGH == 0):
            self._learn(lengths)
        self._showed = ~np.isnan(places[:, 0])
        self.wrong = seen & ~self._showed
        return positions, rotations, seen & self._showed

    def keep(self, positions: FloatArray, known: BoolArray) -> None:
        """Remember what has become of the pose.

        Parameters
        ----------
        positions : (joints, 3) mm
        known : (joints,) bool, joints that are seen or filled
        """
        self._was, self._at = self._at, np.where(known[:, None], positions, np.nan)
        self._bones_before = self._bones_at
        self._bones_at = self._at[self._joints] - self._at[self._parents]

    def _learn(self, lengths: FloatArray) -> None:
        """Have lengths that are possible tell how long bones are."""
        known = np.flatnonzero(~np.isnan(lengths))
        self._shown[self._poses[known] % _COUNT, known] = lengths[known]
        self._poses[known] += 1
        count = np.minimum(self._poses, _COUNT)
        self._lengths = _middle(self._shown, count)
        self._strays = _middle(np.abs(self._shown - self._lengths), count)
        self._set_limits()

    def _set_limits(self) -> None:
        """Have at hand how far off lengths may be, and how far bones turn from pose to pose."""
        known = self._poses > 0
        self._mean_bone = float(self._lengths[known].mean()) if known.any() else 0.0
        least, strays = OFF_BONE * self._mean_bone, _STRAYS * self._strays
        # Nobody knows yet how far something strays that was hardly seen.
        times = np.where(self._poses < _ENOUGH, 2.0, 1.0)
        # Where a bone's end is strays in three directions, how long it is in one.
        self._room = times * (least + 2.0 * strays)
        self._limits = times * (OFF * self._lengths + least + strays)
        self._turns = times * FASTEST_RAD_S / self._rate * self._lengths
        unasked = self._poses < _FEWEST
        self._limits[unasked] = self._turns[unasked] = np.inf
        # What is new, or was wrong at first, is soon known so.
        loose = strays > OFF * self._lengths + least
        self._unsettled = not known.any() or bool((loose | (self._poses < _COUNT))[known].any())

    def _believe(self, lengths: FloatArray, broken: BoolArray) -> None:
        """Take for right, in place, what is broken in the same way for long."""
        least = OFF_BONE * self._mean_bone + _STRAYS * self._strays
        alike = broken & (np.abs(lengths - self._others) < _SAME * self._others + least)
        shown = ~np.isnan(lengths)
        # Noise may let a pose or two look right, or yet another length.
        votes = self._other_poses + np.where(alike, 1.0, -1.0) * shown
        new = broken & ~alike & (votes <= 0.0)
        self._others = np.where(new, lengths, self._others)
        self._others += np.where(alike, _DRIFT * (lengths - self._others), 0.0)
        self._other_poses = np.where(new, 1.0, np.maximum(votes, 0.0))
        longest = np.clip(2.0 * self._poses, _LENGTHS_S * self._rate, _BELIEVED_S * self._rate)
        believed = self._other_poses > longest
        if believed.any():
            self._shown[:_FEWEST, believed] = self._lengths[believed] = self._others[believed]
            self._shown[_FEWEST:, believed] = np.nan
            self._poses[believed], self._other_poses[believed] = _FEWEST, 0.0
            self._set_limits()
            broken &= ~believed

    def _too_fast(self, bones: FloatArray) -> BoolArray:
        """(bones,) bool: it turned faster than a body can, and has not stayed there."""
        most = self._repeating.since * self._turns + self._room
        was, before = self._bones_at, self._bones_before
        fast = lengths_of(bones - was) > most
        if fast.any():
            # Whoever throws gathers speed; whoever jumps does not.
            fast &= ~(lengths_of(bones - 2.0 * was + before) < most)
            self._steady = np.where(lengths_of(bones - self._bones) < most, self._steady + 1, 0)
            # What was hidden before may be anywhere.
            fast &= ~np.isnan(self._bones[:, 0]) & (self._steady < _STAYS)
        else:
            self._steady[:] = 0
        self._bones = bones
        return fast

    def _put_back(self, places: FloatArray) -> IntArray:
        """(joints,) where each joint's own values are."""
        clear = _CLEAR * self._mean_bone
        far = lengths_of((places - self._at)[self._sided])
        # While a pose came again and again, legs have passed each other.
        if not (2.0 * far > clear).any() or self._repeating.since > REPEATS:
            self._own_for += 1
            if self.own is not self._every:
                self._exchanged_for[:] = 0
            return self._every
        own = self._every.copy()
        for pair in self._pairs:
            here, there = list(pair), list(pair[::-1])
            now = float(lengths_of(places[here] - self._at[here]).sum())
            then = float(lengths_of(places[there] - self._at[here]).sum())
            above = [self._above[joint] for joint in pair]
            carried = above[0] >= 0 and own[above[0]] == above[1] != above[0]
            # Limbs change places as a whole: what was hidden, or passes close by the other, goes
            # with what carries it.
            changed, tells = carried, max(now, then) > clear and self._showed[here].all()
            if tells and carried:
                changed = now >= _EXCHANGED * then
            elif tells and then < _EXCHANGED * now:
                bones = [self._bone_of[joint] for joint in pair]
                reach = lengths_of(places[there] - places[above])
                fits = not (np.abs(reach - self._lengths[bones]) > self._limits[bones]).any()
                # Who goes on as he went passes the other.
                ahead = 2.0 * self._at[here] - self._was[here]
                changed = fits and not lengths_of(places[here] - ahead).sum() < _EXCHANGED * now
            self._exchanged_for[here] = self._exchanged_for[here] + 1 if changed else 0
            self._own_for[here] += not changed
            longest = np.clip(
                2.0 * self._own_for[here[0]], _SIDES_S * self._rate, _BELIEVED_S * self._rate
            )
            if changed and self._exchanged_for[here[0]] <= longest:
                own[here] = there
        return own if (own != self._every).any() else self._every

    def _out_of_reach(
        self, places: FloatArray, lengths: FloatArray, broken: BoolArray
    ) -> BoolArray:
        """(joints,) bool: ends of broken bones that are at the wrong place, and what went along."""
        wrong = np.zeros(len(places), dtype=bool)
        goes = self._repeating.since * self._turns + self._room
        whole = np.isfinite(lengths) & ~broken
        far = np.nan_to_num(lengths_of(places - self._at))
        further = far / (far + self._mean_bone)
        left = broken.copy()
        while left.any():
            ends = np.zeros(len(places))
            # Of two ends the one that came further, and with fewer bones that are right.
            np.add.at(ends, self._joints, left * 1.0 - whole)
            np.add.at(ends, self._parents, left * 1.0 - whole)
            concerned = np.zeros(len(places), dtype=bool)
            concerned[self._joints[left]] = concerned[self._parents[left]] = True
            worst = int(np.argmax(np.where(concerned, ends + _FURTHER * further, -np.inf)))
            wrong[worst] = True
            left &= (self._joints != worst) & (self._parents != worst)
        for bone, (joint, parent) in enumerate(zip(self._joints, self._parents, strict=True)):
            if wrong[joint] or not wrong[parent] or np.isnan(lengths[bone]):
                continue
            length = self._lengths[bone]
            alike = abs(lengths[bone] - length) < OFF * length
            if alike and far[joint] > goes[bone]:
                wrong[joint] = True
                continue
            reach, above = length, int(parent)
            while wrong[above] and self._above[above] >= 0:
                reach += self._lengths[self._bone_of[above]]
                above = self._above[above]
            away = float(lengths_of(places[joint] - places[above]))
            wrong[joint] = not wrong[above] and away > (1.0 + OFF) * reach + self._room[bone]
        return wrong


def _middle(values: FloatArray, count: IntArray) -> FloatArray:
    """(columns,) medians of as many values (n, columns) as are not NaN, 0 of none."""
    rows = np.maximum(count - 1, 0) // 2
    middle: FloatArray = np.sort(values, axis=0)[rows, np.arange(len(rows))]
    return np.nan_to_num(middle)
