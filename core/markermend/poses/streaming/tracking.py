"""Numbers that a sensor made noisy, followed as they come."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray

# How a movement changes is learnt over this time, by so much of what was not foretold.
_LEARNS_S, _STEP = 1.0, 4.0
# At first speeds change by this share of the noise from pose to pose, and at least by the second;
# from one pose to the next this grows or shrinks no more than by these, as logarithms.
_AT_FIRST, _CALMEST, _SLOWER, _FASTER = 0.05, 1e-4, -0.3, 0.7
# Nothing is known of a speed at first, but that it is not so many times the noise.
_SPEED = 2.0
# What is further from what was foretold than so many deviations is elsewhere, and starts anew.
_ELSEWHERE = 6.0


class Tracking:
    """A filter for each of some numbers, all of them at once.

    Each changes at a speed, which changes by chance (Kalman 1960); by how much is learnt from what
    was not foretold.

    Parameters
    ----------
    shape : of the numbers
    rate : poses per second
    """

    def __init__(self, shape: tuple[int, ...], rate: float) -> None:
        self._there = np.zeros(shape, dtype=bool)
        self.come_at(rate)
        self.at, self._speed = np.zeros((2, *shape))
        self._unsure, self._together, self._speed_unsure, self._changes = np.zeros((4, *shape))

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._learns = _STEP * (1.0 - np.exp(-1.0 / (_LEARNS_S * rate)))

    def follow(
        self, values: FloatArray, known: BoolArray, noise: FloatArray, steps: float = 1.0
    ) -> FloatArray:
        """Return the next values without noise; of what is not known, anything.

        Parameters
        ----------
        values : of the shape; anything where not known
        known : of the shape; what was never known before starts with it
        noise : variances, more than 0, as many as the last axis has
        steps : poses from the last to this one; those between did not come
        """
        # What is not known goes on as it went, and is the less sure of it.
        changes, doubt = self._changes, self._speed_unsure
        ahead = self.at + steps * self._speed
        # Summed over steps, in each of which the speed changes by as much.
        shaken = steps * (4.0 * steps**2 - 1.0) / 12.0 * changes
        unsure = self._unsure + 2.0 * steps * self._together + steps**2 * doubt + shaken
        together = self._together + steps * doubt + 0.5 * steps**2 * changes
        missed, expected = np.where(known, values - ahead, 0.0), unsure + noise
        told = known / expected
        gain, speed_gain = unsure * told, together * told
        surprise = missed**2 / expected
        new = known & (~self._there | (surprise > _ELSEWHERE**2))
        learnt = np.exp(np.clip(self._learns * gain * (surprise - 1.0), _SLOWER, _FASTER))
        self._changes = np.where(
            new, _AT_FIRST * noise, np.maximum(changes * learnt, _CALMEST * noise)
        )
        self.at = np.where(new, values, ahead + gain * missed)
        self._speed = np.where(new, 0.0, self._speed + speed_gain * missed)
        self._speed_unsure = np.where(
            new, _SPEED**2 * noise, doubt + steps * changes - speed_gain * together
        )
        self._unsure = np.where(new, noise, (1.0 - gain) * unsure)
        self._together = np.where(new, 0.0, (1.0 - gain) * together)
        self._there |= known
        return np.asarray(self.at)

    def forget(self) -> None:
        """Start anew with the next values."""
        self._there[:] = False
