"""How a body's joints hang on their parents, learnt as poses come; hidden ones settle by it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.body.bending import OthersBends
from markermend.poses.filling.sides import both_sides, mirror_signs
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import (
    NO_TURN,
    by_left,
    by_turning,
    cross_matrices,
    inverse,
    matrices,
    unit,
)
from markermend.poses.solving import add_to_diagonal, average_in, inverted, solved
from markermend.poses.streaming.joining import JOINING, Kept, widened

FAR = 1e3
"""Mean bone lengths; no joint of a body is further from another."""

# Poses that count at all, and poses that what is taken for granted at first counts for.
_MEMORY, _FIRST = 3000.0, 20.0
# Poses that how others bend counts for instead, where that is known.
_OTHERS = 300.0
# Variances at first: joints nearly keep their place, and turn in any direction.
_BONE, _TURN = 1e-3, 0.1
# Added to variances.
_RIDGE = 1e-5
# Poses for which what was learnt is used before it is looked at anew.
_KEPT = 8
# How far off a filled feature is, as a share of how far it usually strays: at first, in a second
# more, and at most; and what it strays at least.
_AT_FIRST, _MORE_IN_1_S, _MOST = 0.02, 1.0, 1.2
_STRAYS = 0.003
# A small turn changes a quaternion by half of it.
_HALF = 0.5
_PLACE, _MOVES = 3, 6
_ROOT = np.array([0.0, 0.0, 0.0, *NO_TURN])
# Means over the features of a place, and over those of a turn.
_MEANS = np.repeat([[1.0 / 3.0, 0.0], [0.0, 0.25]], [_PLACE, FEATURES - _PLACE], axis=0)


class Articulation:
    """Settles hidden joints where filling and the way a body is built agree.

    In its parent's axes a joint keeps its place and turns about few axes, an elbow about one. The
    mean and covariance of places and rotations there, all joints together, is what poses have told
    so far; a hidden joint's place and rotation are as filled, but for an error that grows with
    time, faster where it strays far. One least-squares step, linear about what was filled, finds
    the most probable pose.

    Parameters
    ----------
    first : (joints · 7,) features of a whole pose in the root's axes, without the root
    parents : of each joint, -1 for the root
    rate : poses per second
    twins : (joints · 7,) each column's counterpart on the other side of the body, where known
    others : how others bend, of these joints in this order, in these units
    """

    def __init__(
        self,
        first: FloatArray,
        parents: Sequence[int],
        rate: float,
        twins: IntArray | None = None,
        others: OthersBends | None = None,
    ) -> None:
        self._parents: IntArray = np.array(parents)
        self._root = _ROOT
        joints = len(parents)
        self._mean = np.zeros((joints, FEATURES))
        self._mean[:] = self._hung(first.reshape(-1, FEATURES)).local
        self._weight = 1.0
        self._covariance = np.zeros((joints * FEATURES, joints * FEATURES))
        self._others = others
        self._at_first = np.tile(np.where(np.arange(FEATURES) < _PLACE, _BONE, _TURN), joints)
        self._precision: FloatArray = np.empty_like(self._covariance)
        self._age = 2 * _KEPT
        self._twins = twins
        self._gone = np.zeros((joints, 2))
        self.come_at(rate)
        self._usual = first.reshape(-1, FEATURES).copy()
        self._variance = np.full(self._usual.shape, _TURN)

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._frame_s = 1.0 / rate

    def go_on(self, before: Articulation, kept: Kept) -> None:
        """Take over what was learnt of some joints, which hang where they did, all their columns.

        Parameters
        ----------
        before : with rotations of the same signs
        kept : columns of these joints
        """
        joints, theirs = kept.now[::FEATURES] // FEATURES, kept.before[::FEATURES] // FEATURES
        self._mean[joints], self._usual[joints] = before._mean[theirs], before._usual[theirs]
        self._variance[joints], self._gone[joints] = before._variance[theirs], before._gone[theirs]
        usual = np.diag(self._at_first)
        usual[kept.now, kept.now] = 0.0
        self._covariance = widened(before._covariance, usual, kept, _RIDGE)
        self._weight = min(before._weight, JOINING)

    def follow(
        self,
        values: FloatArray,
        known: BoolArray,
        root: FloatArray,
        counts: int = 1,
        steps: float = 1.0,
    ) -> FloatArray:
        """Let settle what is hidden in the next pose, and learn from what comes out.

        Parameters
        ----------
        values : (joints · 7,) without NaN, hidden features filled, rotations of unit length
        known : (joints · 7,) bool
        root : (4,) how the root, which is at 0, is turned in the same axes
        counts : for how many poses it counts, 0 to learn nothing from it
        steps : poses from the last to this one; those between did not come

        Returns
        -------
        (joints · 7,) known features as they were; all of them, and nothing is learnt, where bones
        are :data:`FAR` longer than a body's
        """
        self._root = np.append(np.zeros(_PLACE), root)
        hung = self._hung(values.reshape(-1, FEATURES))
        hidden = ~known.reshape(-1, FEATURES)[:, [0, _PLACE]]
        # Whoever fills has more to do where other joints are hidden than before.
        busy = bool((hidden != (self._gone > 0)).any())
        self._gone = np.where(hidden, self._gone + steps * self._frame_s, 0.0)
        if not (np.abs(hung.local) < FAR).all():
            return values
        if hidden.any():
            if self._age >= (2 * _KEPT if busy else _KEPT):
                self._precision, self._age = self._inverse_covariance(), 0
            settled = self._settled(values.reshape(-1, FEATURES), hung, hidden)
            values = np.where(known, values, settled.ravel())
        if counts:
            hung = self._hung(values.reshape(-1, FEATURES)) if hidden.any() else hung
            self._learn(values, hung.local, counts)
        self._age += 1
        return values

    def _hung(self, poses: FloatArray) -> _Hung:
        """How joints (joints, 7) hang on their parents."""
        above = np.concatenate([poses, self._root[None]]).take(self._parents, axis=0)
        down = inverse(above[:, _PLACE:])
        back, bones = matrices(down), poses[:, :_PLACE] - above[:, :_PLACE]
        local = np.empty(poses.shape)
        local[:, :_PLACE] = (back @ bones[:, :, None])[:, :, 0]
        turned = (by_left(down) @ poses[:, _PLACE:, None])[:, :, 0]
        other = np.einsum("jq,jq->j", turned, self._mean[:, _PLACE:]) < 0
        local[:, _PLACE:] = np.where(other[:, None], -turned, turned)
        return _Hung(back, bones, local)

    def _learn(self, values: FloatArray, local: FloatArray, counts: int) -> None:
        """Add a pose to means, covariance and how far features stray."""
        self._weight = min(self._weight + counts, _MEMORY)
        share, away = counts / self._weight, local - self._mean
        self._mean += share * away
        average_in(self._covariance, away.reshape(1, -1), share)
        strays = values.reshape(-1, FEATURES) - self._usual
        self._usual += share * strays
        self._variance += (strays**2 - self._variance) * (counts / (_FIRST + self._weight))

    def _settled(self, poses: FloatArray, hung: _Hung, hidden: BoolArray) -> FloatArray:
        """(joints, 7) poses after one step."""
        free = np.repeat(hidden, _PLACE, axis=1)
        rows, slopes = self._slopes(hung, free)
        weighed = slopes.T @ self._precision.take(rows, axis=0)
        among = weighed.take(rows, axis=1) @ slopes
        add_to_diagonal(among, np.repeat(self._off() ** -2.0, _PLACE, axis=1)[free])
        step = np.zeros(free.shape)
        step[free] = solved(among, (weighed @ (self._mean - hung.local).ravel())[:, None])[:, 0]
        turned = np.ones((len(poses), FEATURES - _PLACE))
        turned[:, :_PLACE] = _HALF * step[:, _PLACE:]
        settled = np.empty(poses.shape)
        settled[:, :_PLACE] = poses[:, :_PLACE] + step[:, :_PLACE]
        settled[:, _PLACE:] = (by_left(unit(turned)) @ poses[:, _PLACE:, None])[:, :, 0]
        return settled

    def _off(self) -> FloatArray:
        """(joints, 2) how far off filled places and turns are expected to be."""
        strays = self._variance @ _MEANS
        share = np.minimum(_AT_FIRST + _MORE_IN_1_S * self._gone, _MOST)
        return np.asarray(share * np.maximum(np.sqrt(strays), _STRAYS) * [1.0, 1.0 / _HALF])

    def _inverse_covariance(self) -> FloatArray:
        """(joints · 7, joints · 7) inverse covariance: what was learnt, beside what is granted."""
        counts = _FIRST if self._others is None else _OTHERS
        learnt, share = self._covariance, counts / (counts + self._weight)
        if self._twins is not None:
            signs = mirror_signs(self._mean.ravel(), self._twins)
            learnt = both_sides(learnt, self._twins, signs)
        covariance, granted = (1.0 - share) * learnt, self._at_first
        if self._others is not None:
            covariance += share * self._as_others(self._others)
            granted = np.where(self._told(self._others), 0.0, granted)
        add_to_diagonal(covariance, share * granted + _RIDGE)
        return inverted(covariance)

    def _told(self, others: OthersBends) -> BoolArray:
        """(joints · 7,) bool, features that others tell of."""
        turns, places = others.told.reshape(-1, 2, _PLACE)[:, :, 0].T
        counts = _PLACE, FEATURES - _PLACE
        return np.asarray(np.repeat([places, turns], counts, axis=0).T.ravel())

    def _as_others(self, others: OthersBends) -> FloatArray:
        """(joints · 7, joints · 7) others' covariance of places and rotations about the mean."""
        joints = len(self._mean)
        bent = others.covariance.reshape(joints, 2, _PLACE, joints, 2, _PLACE)
        # Of each joint they have three numbers for its turn, then three for its place.
        out = np.empty((joints, FEATURES, joints, FEATURES))
        turning = by_turning(self._mean[:, _PLACE:])
        turned = np.einsum("jqt,jtkcx->jqkcx", turning, bent[:, 0])
        out[:, :_PLACE, :, :_PLACE] = bent[:, 1, :, :, 1]
        out[:, _PLACE:, :, :_PLACE] = turned[:, :, :, 1]
        out[:, _PLACE:, :, _PLACE:] = np.einsum("jqkx,krx->jqkr", turned[:, :, :, 0], turning)
        out[:, :_PLACE, :, _PLACE:] = out[:, _PLACE:, :, :_PLACE].transpose(2, 3, 0, 1)
        return out.reshape(joints * FEATURES, -1)

    def _slopes(self, hung: _Hung, free: BoolArray) -> tuple[IntArray, FloatArray]:
        """How local features change as free joints move and turn, and which features do.

        Parameters
        ----------
        hung : the pose
        free : (joints, 6) bool; of each joint three directions to move in and three to turn about,
            in the axes of the pose
        """
        moves = np.flatnonzero(free[:, 0] | free[:, _PLACE])
        # What does not move, the root among it, shares the last place.
        place = np.full(len(free) + 1, len(moves))
        place[moves] = np.arange(len(moves))
        own, above = place[:-1], place[self._parents]
        some = np.flatnonzero(np.minimum(own, above) < len(moves))
        own, above, n = own[some], above[some], np.arange(len(some))
        back, bones, local = hung.back[some], hung.bones[some], hung.local[some]
        moving, carried = np.zeros((2, len(some), FEATURES, _MOVES))
        moving[:, :_PLACE, :_PLACE] = back
        moving[:, _PLACE:, _PLACE:] = by_turning(local[:, _PLACE:]) @ back
        np.negative(moving, out=carried)
        carried[:, :_PLACE, _PLACE:] = back @ cross_matrices(bones)
        slopes = np.zeros((len(some), FEATURES, len(moves) + 1, _MOVES))
        slopes[n, :, own] = moving
        slopes[n, :, above] = carried
        rows: IntArray = (some[:, None] * FEATURES + np.arange(FEATURES)).ravel()
        columns = np.flatnonzero(free[moves])
        return rows, slopes.reshape(len(rows), -1).take(columns, axis=1)


@dataclass(frozen=True, eq=False)
class _Hung:
    """How the joints of a pose hang on their parents.

    Attributes
    ----------
    back : (joints, 3, 3) from the axes of the pose to those of each joint's parent
    bones : (joints, 3) from parents, in the axes of the pose
    local : (joints, 7) places and rotations in parents' axes, signs as in the mean
    """

    back: FloatArray
    bones: FloatArray
    local: FloatArray
