"""Bones learnt as poses come, which noisy joints are made to agree with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.body.bones import ATTACHED, BY_BONE, BY_NOISE, BY_ROTATION, RIGID
from markermend.poses.quaternion import between, lengths_of, multiply, turn
from markermend.poses.streaming.shaking import ENOUGH

# Poses that count, and for which what was learnt is used before it is looked at anew.
_MEMORY, _KEPT = 1200.0, 8


class Bracing:
    """What is constant about a body, learnt pose by pose.

    Parameters
    ----------
    joints, parents : (bones,) indices of each bone's ends
    count : of joints
    """

    def __init__(self, joints: IntArray, parents: IntArray, count: int) -> None:
        self._joints, self._parents = joints, parents
        rows = np.arange(len(joints))
        self._binds = np.zeros((len(joints), count))
        self._binds[rows, joints], self._binds[rows, parents] = 1.0, -1.0
        self._only = np.bincount(parents, minlength=count)[parents] == 1
        self._firm: BoolArray | None = None
        self._ties: _Ties | None = None
        self._learnt = 0
        self._tied_of = b""
        self._solved_of: IntArray = np.zeros(0, dtype=int)
        self._solved: FloatArray = np.eye(count)
        self._poses = np.zeros((len(joints), 2))
        self._mean, self._spread = np.zeros((len(joints), 4)), np.zeros((len(joints), 2))

    def learn(self, lengths: FloatArray, places: FloatArray) -> None:
        """Look at the bones of one pose.

        Parameters
        ----------
        lengths : (bones,) mm, NaN where an end was not seen
        places : (bones, 3) mm, in the axes of the joints they hang on, NaN where these are not
            turned
        """
        values = np.column_stack([lengths, places])
        known = ~np.isnan(values)
        told = known[:, [0, 1]]
        self._poses = np.minimum(self._poses + told, _MEMORY)
        share = np.where(told, 1.0 / np.maximum(self._poses, 1.0), 0.0)
        away = np.where(known, values - self._mean, 0.0)
        self._mean += share[:, [0, 1, 1, 1]] * away
        squared = np.column_stack([away[:, 0] ** 2, np.sum(away[:, 1:] ** 2, axis=1)])
        self._spread += share * ((1.0 - share) * squared - self._spread)
        self._learnt += 1
        if self._learnt % _KEPT == 0:
            self._firm = self._ties = None

    def braced(
        self,
        positions: FloatArray,
        rotations: FloatArray,
        seen: BoolArray,
        told: BoolArray,
        noise_mm: float,
    ) -> tuple[FloatArray, FloatArray]:
        """Let positions, rotations and bones agree: :func:`markermend.poses.body.bones.fuse`.

        Parameters
        ----------
        positions, rotations : (joints, 3) mm, (joints, 4)
        seen, told : (joints,) bool, positions and rotations that are known; others stay
        noise_mm : of each coordinate
        """
        tied_of = seen.tobytes() + told.tobytes()
        if self._ties is None or self._tied_of != tied_of:
            self._ties, self._tied_of = self._tie(seen, told, noise_mm), tied_of
        ties = self._ties
        if not len(ties.joints):
            return positions, rotations
        way, turned = positions[ties.joints] - positions[ties.parents], rotations
        if len(ties.fixed):
            pointing = turn(rotations[ties.carriers], ties.places)
            way[ties.fixed] += BY_ROTATION * (pointing - way[ties.fixed])
        way *= (ties.lengths / np.maximum(lengths_of(way), np.finfo(float).tiny))[:, None]
        there = np.where(seen[:, None], positions, 0.0)
        places = ties.solver @ there + ties.by_bones @ way
        if len(ties.swinging):
            turned, own = rotations.copy(), ties.swung
            swing = between(pointing[ties.swinging], way[ties.fixed[ties.swinging]])
            turned[own] = multiply(swing, rotations[own])
        return np.where(seen[:, None], places, positions), turned

    def _tie(self, seen: BoolArray, told: BoolArray, noise_mm: float) -> _Ties:
        """What binds the joints that are seen."""
        if self._firm is None:
            self._firm = self._tell(noise_mm)
        firm = self._firm
        bones = np.flatnonzero(firm[:, 0] & seen[self._joints] & seen[self._parents])
        joints, parents = self._joints[bones], self._parents[bones]
        fixed = np.flatnonzero(firm[bones, 1] & told[parents])
        swinging = np.flatnonzero(self._only[bones[fixed]])
        carriers, solver = parents[fixed], self._solver(bones)
        return _Ties(
            joints,
            parents,
            self._mean[bones, 0],
            fixed,
            carriers,
            self._mean[bones[fixed], 1:],
            swinging,
            carriers[swinging],
            solver,
            BY_BONE * (solver @ self._binds[bones].T),
        )

    def _tell(self, noise_mm: float) -> BoolArray:
        """(bones, 2) bool, those that are rigid, and those that are fixed to what carries them."""
        limits = self._mean[:, :1] * [RIGID, ATTACHED] + BY_NOISE * noise_mm
        # Three coordinates stray where one length does.
        stray = np.sqrt(self._spread / [1.0, 3.0])
        return np.asarray((self._poses >= ENOUGH) & (stray <= limits))

    def _solver(self, bones: IntArray) -> FloatArray:
        """(joints, joints) what makes positions of them and of bones, kept while those are."""
        if not np.array_equal(bones, self._solved_of):
            binds = self._binds[bones]
            system = np.eye(binds.shape[1]) + BY_BONE * (binds.T @ binds)
            self._solved_of, self._solved = bones, np.asarray(np.linalg.inv(system))
        return self._solved


@dataclass(frozen=True, eq=False)
class _Ties:
    """What binds some joints, for as long as those are seen.

    Attributes
    ----------
    joints, parents : (bones,) ends of the rigid ones
    lengths : (bones,) mm
    fixed : (some,) which bones are fixed to what carries them
    carriers, places : (some,) what that is, and (some, 3) where in its axes, mm
    swinging, swung : (few,) which of those are the only ones there, and what turns with them
    solver, by_bones : (all joints, all joints), (all joints, bones) what makes positions of
        positions, and of bones
    """

    joints: IntArray
    parents: IntArray
    lengths: FloatArray
    fixed: IntArray
    carriers: IntArray
    places: FloatArray
    swinging: IntArray
    swung: IntArray
    solver: FloatArray
    by_bones: FloatArray
