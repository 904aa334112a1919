"""Heavy noise: stretches in which a trajectory jitters far more than it or its neighbours do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.detectors.joint.jumps import sixth_difference
from markermend.detectors.joint.scale import jitter

WINDOW_S, EDGE_WINDOW_S = 0.14, 0.075
# exp(E log |z|) of a standard normal z.
GEOMETRIC = 0.53
# A logarithm needs a floor; far below what any camera resolves.
DUST_MM = 0.005
TIMES_JITTER, TIMES_NEIGHBOURS, LEAST_MM = 6.0, 2.5, 0.5
LEAST_S = 0.06
PAST, PAST_ORDER = 6, 3
TIMES_ERROR, LEAST_ERROR_MM = 5.0, 0.3


@dataclass(frozen=True)
class Noise:
    """Heavy noise on one coordinate.

    Attributes
    ----------
    channel, start, stop : coordinate and half-open interval
    sigma_mm : standard deviation of the noise
    ratio : of it to what is usual there
    """

    channel: int
    start: int
    stop: int
    sigma_mm: float
    ratio: float


def find_noise(
    signal: FloatArray,
    rest: FloatArray,
    seen: BoolArray,
    neighbours: IntArray,
    rate: float,
) -> list[Noise]:
    """Find heavy noise.

    Parameters
    ----------
    signal : (frames, 3 × markers) mm, without NaN
    rest : the same without its jumps and blocks, so that no single one is taken for noise
    seen : (frames, 3 × markers) bool
    neighbours : (markers, k) nearest other markers; what shakes them too is a blow, not noise
    rate : frames per second

    Returns
    -------
    Noise, by channel and start; edges to the frame, from what each side's clean part foretells
    """
    change = np.abs(sixth_difference(rest))
    usual = jitter(change, seen, rate)
    level = _level(change, WINDOW_S, rate)
    limit = np.maximum(TIMES_JITTER * (usual + 0.02), LEAST_MM)
    loud = (level > limit) & seen
    found: list[Noise] = []
    if not loud.any():
        return found
    raw = sixth_difference(signal)
    edge_level = _level(change, EDGE_WINDOW_S, rate)
    around = _around(level, neighbours, np.flatnonzero(loud.any(axis=0)))
    for channel, near in around.items():
        heavy = loud[:, channel] & (level[:, channel] > TIMES_NEIGHBOURS * near)
        for a, b in _stretches(heavy, round(WINDOW_S * rate)):
            core = edge_level[a:b, channel] > limit[a:b, channel]
            if core.any():
                b = a + len(core) - int(core[::-1].argmax())
                a = a + int(core.argmax())
            start, stop = _edges(signal[:, channel], a, b)
            if stop - start < max(6, LEAST_S * rate):
                continue
            sigma = float(np.sqrt((raw[start:stop, channel] ** 2).mean()))
            ratio = float((level[a:b, channel] / limit[a:b, channel]).max())
            found.append(Noise(int(channel), start, stop, sigma, ratio))
    return found


def _level(change: FloatArray, seconds: float, rate: float) -> FloatArray:
    """Standard deviation by the geometric mean, which few large values do not move."""
    window = 2 * round(0.5 * seconds * rate) + 1
    return np.asarray(
        np.exp(uniform_filter1d(np.log(change + DUST_MM), window, axis=0)) / GEOMETRIC
    )


def _around(level: FloatArray, neighbours: IntArray, channels: IntArray) -> dict[int, FloatArray]:
    """For each channel the usual level of its marker's neighbours, the loudest axis counting."""
    near: dict[int, FloatArray] = {}
    loudest = level.reshape(len(level), -1, 3).max(axis=2)
    for channel in channels:
        beside = neighbours[channel // 3]
        near[int(channel)] = (
            np.median(loudest[:, beside], axis=1) if len(beside) else np.zeros(len(level))
        )
    return near


def _stretches(mask: BoolArray, join: int) -> list[tuple[int, int]]:
    """Runs of a mask; those nearer than ``join`` frames are one."""
    joined: list[tuple[int, int]] = []
    for a, b in runs(mask):
        if joined and a - joined[-1][1] < join:
            joined[-1] = (joined[-1][0], int(b))
        else:
            joined.append((int(a), int(b)))
    return joined


def _edges(x: FloatArray, a: int, b: int) -> tuple[int, int]:
    """First noisy frame and the first clean one after, near the rough interval ``[a, b)``."""
    start = _first_surprise(x, a)
    back = _first_surprise(x[::-1], len(x) - b)
    return start, len(x) - back


def _first_surprise(x: FloatArray, rough: int) -> int:
    """First frame near ``rough`` that the frames before it do not foretell."""
    if rough < PAST:
        # Too near an end of the take for any frames before it.
        return rough
    scan = np.arange(max(PAST, rough - 4), min(len(x), rough + 12))
    calm = np.arange(max(PAST, rough - 60), max(PAST, rough - 6))
    if not len(scan):
        return rough
    usual = float(np.median(_surprise(x, calm))) / 0.6745 if len(calm) >= 8 else 0.0
    beyond = _surprise(x, scan) > max(TIMES_ERROR * usual, LEAST_ERROR_MM)
    return int(scan[beyond.argmax()]) if beyond.any() else rough


def _surprise(x: FloatArray, frames: IntArray) -> FloatArray:
    """How far each frame is from the cubic through the six before it, mm."""
    past = x[frames[:, None] - np.arange(PAST, 0, -1)]
    place = np.arange(-PAST, 0.0)
    weights = np.linalg.pinv(np.vander(place, PAST_ORDER + 1))[-1]
    return np.asarray(np.abs(x[frames] - past @ weights))
