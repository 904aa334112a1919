"""Take noise out of poses as they come, with nothing held back."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.quaternion import inverse, lengths_of, turn, unit
from markermend.poses.streaming.bracing import Bracing
from markermend.poses.streaming.shaking import Shaking
from markermend.poses.streaming.tracking import Tracking
from markermend.poses.turnless import given_turns

# So many poses are looked at at first, then so many in a row of as many as the last.
_AT_FIRST, _IN_A_ROW, _OF = 240, 8, 32
_PLACE, _TURN = 3, 4


class Steadying:
    """Filters the joints that a sensor sees, and has them agree with bones that do not change.

    Clean poses go through as they are. Of noisy ones each number is followed by itself
    (:class:`markermend.poses.streaming.tracking.Tracking`), then positions and rotations are made
    to agree with the body (:class:`markermend.poses.streaming.bracing.Bracing`). How noisy they
    are, bones tell (:class:`markermend.poses.streaming.shaking.Shaking`).

    Parameters
    ----------
    parents : index of each joint's parent, -1 for the root
    rate : poses per second
    """

    def __init__(self, parents: Sequence[int], rate: float) -> None:
        bones = [(joint, parent) for joint, parent in enumerate(parents) if parent >= 0]
        self._joints, self._parents = np.array(bones, dtype=int).reshape(-1, 2).T
        self._age = 0
        self._shaking = Shaking(len(bones))
        self._bracing = Bracing(self._joints, self._parents, len(parents))
        self._tracking = Tracking((len(parents), _PLACE + _TURN), rate)

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._tracking.come_at(rate)

    def __call__(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, steps: float = 1.0
    ) -> tuple[FloatArray, FloatArray]:
        """Steady one pose.

        Parameters
        ----------
        positions, rotations, seen : as
            :class:`markermend.poses.streaming.doubting.Doubting` returns them, mm
        steps : poses from the last to this one; those between did not come

        Returns
        -------
        positions and rotations; as they came of what was not seen, and where there is no noise
        """
        told = given_turns(rotations, seen)
        self._age += 1
        turn_of = self._age % _OF
        if steps > 1.0:
            self._shaking.look_away()
        if self._age <= _AT_FIRST or turn_of < _IN_A_ROW:
            self._look(positions, rotations, seen, told)
        elif turn_of == _IN_A_ROW:
            self._shaking.look_away()
        shaking = self._shaking
        if not shaking.noise_mm:
            self._tracking.forget()
            return positions, rotations
        # A rotation's numbers change by half of a small angle; without noise they are not asked.
        turning = 0.5 * shaking.noise_rad or 1.0
        noise = np.array([shaking.noise_mm] * _PLACE + [turning] * _TURN) ** 2
        known = np.empty(self._tracking.at.shape, dtype=bool)
        known[:, :_PLACE], known[:, _PLACE:] = seen[:, None], told[:, None]
        values = np.zeros(known.shape)
        np.copyto(values[:, :_PLACE], positions, where=known[:, :_PLACE])
        turns = values[:, _PLACE:]
        np.copyto(turns, rotations, where=known[:, _PLACE:])
        # Of q and -q the one that it was.
        other = np.einsum("jq,jq->j", turns, self._tracking.at[:, _PLACE:]) < 0
        turns[other] *= -1.0
        now = self._tracking.follow(values, known, noise, steps)
        turns = now[:, _PLACE:] if shaking.noise_rad else turns
        turns = unit(np.where(told[:, None], turns, 1.0))
        given = now[:, :_PLACE], turns, seen, told
        places, turns = self._bracing.braced(*given, shaking.noise_mm)
        turns = np.where(other[:, None], -turns, turns)
        told &= shaking.noise_rad > 0.0
        return (
            np.where(seen[:, None], places, positions),
            np.where(told[:, None], turns, rotations),
        )

    def _look(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, told: BoolArray
    ) -> None:
        """Look at bones as they came."""
        joints, parents = self._joints, self._parents
        bones = positions[joints] - positions[parents]
        lengths = lengths_of(bones)
        whole = seen[joints] & seen[parents] & (lengths > 0)
        lengths = np.where(whole, lengths, np.nan)
        own = [
            np.where((whole & told[end])[:, None], turn(inverse(rotations[end]), bones), np.nan)
            for end in (joints, parents)
        ]
        self._shaking.look(lengths, *own)
        self._bracing.learn(lengths, own[1])
