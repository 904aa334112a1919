"""How a body's joints hang on their parents, learnt as poses come; hidden ones settle by it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import (
    by_turning,
    cross_matrices,
    inverse,
    matrices,
    multiply,
    turn,
    unit,
)
from markermend.poses.sides import both_sides, mirror_signs
from markermend.poses.solving import inverted, solved

FAR = 1e3
"""Mean bone lengths; no joint of a body is further from another."""

# Poses that count at all, and poses that what is taken for granted at first counts for.
_MEMORY, _FIRST = 3000.0, 20.0
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


class Articulation:
    """Settles hidden joints where filling and the way a body is built agree.

    In its parent's axes a joint keeps its place and turns about few axes, an elbow about one. The
    mean and covariance of places and rotations there, all joints together, is what poses have told
    so far; a hidden joint's place and rotation are as filled, but for an error that grows with
    time, faster where it strays far. One least-squares step, linear about what was filled, finds
    the most probable pose.

    Parameters
    ----------
    first : (joints · 7,) features of a whole pose, without the root
    parents : of each joint, -1 for the root
    rate : poses per second
    twins : (joints · 7,) each column's counterpart on the other side of the body, where known
    """

    def __init__(
        self,
        first: FloatArray,
        parents: Sequence[int],
        rate: float,
        twins: IntArray | None = None,
    ) -> None:
        self._parents: IntArray = np.array(parents)
        joints = len(parents)
        self._mean = np.zeros((joints, FEATURES))
        self._mean[:] = self._local(first)
        self._weight = 1.0
        self._covariance = np.zeros((joints * FEATURES, joints * FEATURES))
        self._at_first = np.tile(np.where(np.arange(FEATURES) < _PLACE, _BONE, _TURN), joints)
        self._precision: FloatArray = np.empty_like(self._covariance)
        self._age = 2 * _KEPT
        self._twins = twins
        self._gone, self._frame_s = np.zeros((joints, 2)), 1.0 / rate
        self._usual = first.reshape(-1, FEATURES).copy()
        self._variance = np.full(self._usual.shape, _TURN)

    def follow(self, values: FloatArray, known: BoolArray) -> FloatArray:
        """Let settle what is hidden in the next pose, and learn from what comes out.

        Parameters
        ----------
        values : (joints · 7,) without NaN, hidden features filled, rotations of unit length
        known : (joints · 7,) bool

        Returns
        -------
        (joints · 7,) known features as they were; all of them, and nothing is learnt, where bones
        are :data:`FAR` longer than a body's
        """
        local = self._local(values)
        hidden = ~known.reshape(-1, FEATURES)[:, [0, _PLACE]]
        # Whoever fills has more to do where other joints are hidden than before.
        busy = bool((hidden != (self._gone > 0)).any())
        self._gone = np.where(hidden, self._gone + self._frame_s, 0.0)
        if not (np.abs(local) < FAR).all():
            return values
        if hidden.any():
            if self._age >= (2 * _KEPT if busy else _KEPT):
                self._precision, self._age = self._inverse_covariance(), 0
            settled = self._settled(values.reshape(-1, FEATURES), local, hidden)
            values = np.where(known, values, settled.ravel())
            local = self._local(values)
        self._learn(values, local)
        return values

    def _local(self, values: FloatArray) -> FloatArray:
        """(joints, 7) places and rotations in parents' axes, signs as in the mean."""
        own, above = self._with_parents(values.reshape(-1, FEATURES))
        back = inverse(above[:, _PLACE:])
        bones = own[:, :_PLACE] - above[:, :_PLACE]
        turned = multiply(back, own[:, _PLACE:])
        other = np.sum(turned * self._mean[:, _PLACE:], axis=1) < 0
        turned[other] *= -1.0
        return np.hstack([turn(back, bones), turned])

    def _with_parents(self, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Poses, and those of their parents; the root is at 0 and not turned."""
        root = np.zeros(FEATURES)
        root[-1] = 1.0
        return poses, np.vstack([poses, root])[self._parents]

    def _learn(self, values: FloatArray, local: FloatArray) -> None:
        """Add a pose to means, covariance and how far features stray."""
        self._weight = min(self._weight + 1.0, _MEMORY)
        away = local - self._mean
        self._mean += away / self._weight
        self._covariance *= 1.0 - 1.0 / self._weight
        self._covariance += np.outer(away.ravel(), away.ravel() / self._weight)
        strays = values.reshape(-1, FEATURES) - self._usual
        self._usual += strays / self._weight
        self._variance += (strays**2 - self._variance) / (_FIRST + self._weight)
        self._age += 1

    def _settled(self, poses: FloatArray, local: FloatArray, hidden: BoolArray) -> FloatArray:
        """(joints, 7) poses after one step."""
        free = np.repeat(np.vstack([hidden, [False, False]]), _PLACE, axis=1)
        rows, slopes = self._slopes(poses, local, free)
        weighed = self._precision[:, rows] @ slopes
        among = slopes.T @ weighed[rows]
        sure = np.repeat(self._off() ** -2.0, _PLACE, axis=1)
        among[np.diag_indices(len(among))] += sure[free[:-1]]
        step = np.zeros(free.shape)
        step[free] = solved(among, weighed.T @ (self._mean - local).ravel()[:, None])[:, 0]
        turned = np.hstack([_HALF * step[:-1, _PLACE:], np.ones((len(poses), 1))])
        places = poses[:, :_PLACE] + step[:-1, :_PLACE]
        return np.hstack([places, multiply(unit(turned), poses[:, _PLACE:])])

    def _off(self) -> FloatArray:
        """(joints, 2) how far off filled places and turns are expected to be."""
        strays = np.stack(
            [self._variance[:, :_PLACE].mean(axis=1), self._variance[:, _PLACE:].mean(axis=1)],
            axis=1,
        )
        share = np.minimum(_AT_FIRST + _MORE_IN_1_S * self._gone, _MOST)
        return np.asarray(share * np.maximum(np.sqrt(strays), _STRAYS) * [1.0, 1.0 / _HALF])

    def _inverse_covariance(self) -> FloatArray:
        """(joints · 7, joints · 7) inverse covariance: what was learnt, beside what is granted."""
        learnt, share = self._covariance, _FIRST / (_FIRST + self._weight)
        if self._twins is not None:
            signs = mirror_signs(self._mean.ravel(), self._twins)
            learnt = both_sides(learnt, self._twins, signs)
        covariance = (1.0 - share) * learnt
        covariance[np.diag_indices(len(covariance))] += share * self._at_first + _RIDGE
        return inverted(covariance)

    def _slopes(
        self, poses: FloatArray, local: FloatArray, free: BoolArray
    ) -> tuple[IntArray, FloatArray]:
        """How local features change as free joints move and turn, and which features do.

        Parameters
        ----------
        poses, local : (joints, 7)
        free : (joints + 1, 6) bool; of each joint three directions to move in and three to turn
            about, in the root's axes; the root last
        """
        moved: BoolArray = np.any(free, axis=1)
        some = np.flatnonzero(moved[:-1] | moved[self._parents])
        parents, n = self._parents[some], np.arange(len(some))
        own, above = (p[some] for p in self._with_parents(poses))
        back = matrices(inverse(above[:, _PLACE:]))
        slopes = np.zeros((len(some), FEATURES, len(free), _MOVES))
        slopes[n, :_PLACE, some, :_PLACE] = back
        slopes[n, :_PLACE, parents, :_PLACE] = -back
        across = cross_matrices(own[:, :_PLACE] - above[:, :_PLACE])
        slopes[n, :_PLACE, parents, _PLACE:] = back @ across
        turns = by_turning(local[some, _PLACE:]) @ back
        slopes[n, _PLACE:, some, _PLACE:] = turns
        slopes[n, _PLACE:, parents, _PLACE:] = -turns
        rows: IntArray = (some[:, None] * FEATURES + np.arange(FEATURES)).ravel()
        return rows, slopes.reshape(len(rows), -1)[:, free.ravel()]
