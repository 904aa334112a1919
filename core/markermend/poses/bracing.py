"""Bones learnt as poses come, which noisy joints are made to agree with."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.bones import ATTACHED, BY_BONE, BY_NOISE, BY_ROTATION, RIGID
from markermend.poses.quaternion import between, lengths_of, multiply, turn
from markermend.poses.shaking import ENOUGH

# Poses that count.
_MEMORY = 1200.0


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
        self._firm = None

    def braced(
        self,
        positions: FloatArray,
        rotations: FloatArray,
        seen: BoolArray,
        told: BoolArray,
        noise_mm: float,
    ) -> tuple[FloatArray, FloatArray]:
        """Let positions, rotations and bones agree, as :func:`markermend.poses.bones.fuse` does.

        Parameters
        ----------
        positions, rotations : (joints, 3) mm, (joints, 4)
        seen, told : (joints,) bool, positions and rotations that are known; others stay
        noise_mm : of each coordinate
        """
        if self._firm is None:
            self._firm = self._tell(noise_mm)
        firm, lengths = self._firm, self._mean[:, 0]
        bones = np.flatnonzero(firm[:, 0] & seen[self._joints] & seen[self._parents])
        if not len(bones):
            return positions, rotations
        joints, parents = self._joints[bones], self._parents[bones]
        way, turned = positions[joints] - positions[parents], rotations
        fixed = firm[bones, 1] & told[parents]
        some, swings = np.flatnonzero(fixed), np.flatnonzero(fixed & self._only[bones])
        if len(some):
            pointing = turn(rotations[parents], self._mean[bones, 1:])
            way[some] += BY_ROTATION * (pointing - way)[some]
        way *= (lengths[bones] / np.maximum(lengths_of(way), np.finfo(float).tiny))[:, None]
        there = np.where(seen[:, None], positions, 0.0)
        places = self._solver(bones) @ (there + BY_BONE * (self._binds[bones].T @ way))
        if len(swings):
            turned, own = rotations.copy(), parents[swings]
            turned[own] = multiply(between(pointing[swings], way[swings]), rotations[own])
        return np.where(seen[:, None], places, positions), turned

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
