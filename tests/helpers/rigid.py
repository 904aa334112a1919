"""A body of markers that keep their distances, for tests of repairs."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.take import Take

RATE = 100.0
BODY = np.array(
    [
        [0, 0, 0],
        [200, 0, 0],
        [0, 300, 0],
        [0, 0, 150],
        [120, 80, 60],
        [-90, 40, 110],
        [60, -70, 90],
        [30, 210, -40],
    ],
    dtype=float,
)


def rotations(angles: FloatArray) -> FloatArray:
    """(frames, 3, 3) rotations about z, then x."""
    c, s = np.cos(angles), np.sin(angles)
    zero, one = np.zeros((len(angles), 1))[:, 0], np.ones(len(angles[:, 0]))
    about_z = np.stack([c[:, 0], -s[:, 0], zero, s[:, 0], c[:, 0], zero, zero, zero, one], 1)
    about_x = np.stack([one, zero, zero, zero, c[:, 1], -s[:, 1], zero, s[:, 1], c[:, 1]], 1)
    return about_z.reshape(-1, 3, 3) @ about_x.reshape(-1, 3, 3)


def rigid_take(frames: int = 600, seed: int = 0) -> Take:
    """One rigid body turning and walking, with nothing missing."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames) / RATE
    phase, speed = rng.uniform(0, 6, 5), rng.uniform(0.3, 1.2, 5) * 2 * np.pi
    waves = np.sin(speed * t[:, None] + phase)
    turned = np.einsum("fij,mj->fmi", rotations(waves[:, :2]), BODY)
    positions = turned + 300 * waves[:, None, 2:] + np.array([0.0, 0.0, 900.0])
    return Take(positions, tuple(f"M{i}" for i in range(len(BODY))), RATE)


def lonely(values: FloatArray) -> Take:
    """A take of one marker only."""
    return Take(values[:, None], ("M0",), RATE)
