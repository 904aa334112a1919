"""Where the feet are: planted between steps, rolling over the ball, landing on the heel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.simulation.skeleton import ANKLE_HEIGHT, BALL, HEEL, rotation, turned

_HEEL_RISE = np.deg2rad(52.0)
_TOE_LIFT = np.deg2rad(16.0)
_ROLL_S = 0.28
_FLATTEN_S = 0.11
_FULL_STRIDE = 0.70


@dataclass(frozen=True)
class Footstep:
    """One foot moves.

    Attributes
    ----------
    side : ``"L"`` or ``"R"``
    lift_s, land_s : when the toes leave and the heel touches the floor
    x, y, yaw : where the foot lands (below the ankle), mm and radians
    """

    side: str
    lift_s: float
    land_s: float
    x: float
    y: float
    yaw: float


@dataclass(frozen=True, eq=False)
class FootTrack:
    """One foot over the whole take.

    Attributes
    ----------
    ground : (frames, 2) mm, where the ankle would stand if the foot were flat
    yaw, pitch : (frames,) radians, pitch positive with the toes up
    ankle : (frames, 3) mm
    swing : (frames,) in [0, 1], how much the foot is in the air
    """

    ground: FloatArray
    yaw: FloatArray
    pitch: FloatArray
    ankle: FloatArray
    swing: FloatArray


def track_foot(
    steps: Sequence[Footstep],
    start: tuple[float, float, float],
    frames: int,
    rate: float,
    height_mm: float,
) -> FootTrack:
    """Follow one foot through its steps.

    Parameters
    ----------
    steps : of this foot, in order of time
    start : x, y, yaw where it stands at first, mm and radians
    frames, rate : length and frames per second
    height_mm : body height

    Returns
    -------
    FootTrack; while planted, heel or ball of the foot stay where they are
    """
    from scipy.interpolate import PchipInterpolator
    from scipy.ndimage import gaussian_filter1d

    time = np.arange(frames) / rate
    place = np.tile(np.array(start, dtype=np.float64), (frames, 1))
    lift, swing = np.zeros(frames), np.zeros(frames)
    keys: list[tuple[float, float]] = [(-10.0, 0.0)]
    last = np.array(start)
    for step in steps:
        landing = np.array([step.x, step.y, step.yaw])
        share = np.clip((time - step.lift_s) / (step.land_s - step.lift_s), 0.0, 1.0)
        place += (share - np.sin(2 * np.pi * share) / (2 * np.pi))[:, None] * (landing - last)
        stride = np.hypot(*(landing - last)[:2]) / (_FULL_STRIDE * height_mm)
        vigour = float(np.clip(stride, 0.3, 1.0))
        lift += vigour * 0.035 * height_mm * share**2 * (1 - share) ** 3 / 0.03456
        swing += np.sin(np.pi * share) ** 2
        middle = (step.lift_s + step.land_s) / 2
        keys += [
            (max(step.lift_s - _ROLL_S, keys[-1][0] + 0.02), 0.0),
            (step.lift_s, -_HEEL_RISE * vigour),
            (middle, -0.15 * _HEEL_RISE * vigour),
            (step.land_s - 0.05, _TOE_LIFT * vigour),
            (step.land_s + _FLATTEN_S, 0.0),
        ]
        last = landing
    keys.append((keys[-1][0] + time[-1] + 20.0, 0.0))
    moments, angles = np.array(keys).T
    # The pieces above join with a kink in speed or acceleration; a real foot does not.
    sigma = 0.022 * rate
    pitch = gaussian_filter1d(PchipInterpolator(moments, angles)(time), sigma)
    place = gaussian_filter1d(place, sigma, axis=0)
    flat = np.column_stack([place[:, :2], np.full(frames, ANKLE_HEIGHT * height_mm)])
    flat[:, 2] += lift
    rolled = _rolled(place[:, 2], pitch, height_mm)
    ankle = gaussian_filter1d(flat + rolled, sigma, axis=0)
    return FootTrack(place[:, :2], place[:, 2], pitch, ankle, swing)


def _rolled(yaw: FloatArray, pitch: FloatArray, height_mm: float) -> FloatArray:
    """How far the ankle moves when the foot turns about its ball (heel up) or heel (toes up)."""
    pivot = np.where((pitch < 0)[:, None], np.array(BALL), np.array(HEEL)) * height_mm
    tilted = turned(rotation("y", -pitch), pivot)
    return turned(rotation("z", yaw), pivot - tilted)
