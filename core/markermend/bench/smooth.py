"""Smoothing against a known truth: how far position, velocity and acceleration are off.

Every method runs with a fixed setting, and with the best one an oracle could choose for each
channel and each of the three quantities; methods without a knob run as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import FloatArray
from markermend.errors import DataError
from markermend.progress import Progress, quiet
from markermend.simulation import Activity, simulate_clean
from markermend.smoothers import SMOOTHERS, Signals
from markermend.smoothers.bands import acceleration, velocity
from markermend.take import Take

ORACLE = "oracle"
ENDS_S = 0.1
"""Frames this near to the ends do not count."""
# A take's truth is the take under a Gaussian window whose gain is a half here; no method uses it.
_HARD_HZ = 10.0
_KICK_S, _KICK_MM = 0.5, 800.0

Settings = Sequence[Mapping[str, Any]]


@dataclass(frozen=True, eq=False)
class Truth:
    """Trajectories known exactly.

    Attributes
    ----------
    name : where they come from
    positions : (frames, markers, 3) float64, mm, without NaN
    rate : frames per second
    """

    name: str
    positions: FloatArray
    rate: float


@dataclass(frozen=True)
class SmoothRow:
    """Errors of one method on one truth with one noise.

    Attributes
    ----------
    truth : name
    noise : ``"white"`` or ``"coloured"``
    noise_mm : root mean square
    method : name of the smoother, or ``"nothing"``
    setting : its parameters, ``"oracle"``, or empty
    position_mm, velocity_mm_s, acceleration_m_s2 : root mean square error, mean over channels
    """

    truth: str
    noise: str
    noise_mm: float
    method: str
    setting: str
    position_mm: float
    velocity_mm_s: float
    acceleration_m_s2: float


def performer(seed: int = 1, rate: float = 120.0, markers: int = 12) -> Truth:
    """Forty seconds of the simulated performer."""
    take = simulate_clean(duration_s=40.0, rate=rate, seed=seed, noise=False)
    return Truth("performer", _some(take.positions, markers), rate)


def kick(seed: int = 2, rate: float = 120.0, markers: int = 12) -> Truth:
    """A kick of half a second in a minute of standing; the lower a marker, the farther it goes."""
    stand = (Activity("stand", 60.0),)
    take = simulate_clean(duration_s=60.0, rate=rate, seed=seed, noise=False, activities=stand)
    positions = _some(take.positions, markers)
    share = np.clip((np.arange(len(positions)) / rate - 30.0) / _KICK_S, 0.0, 1.0)
    swing = (4.0 * share * (1.0 - share)) ** 4
    low = 1.0 - positions[0, :, 2] / positions[0, :, 2].max()
    reach = _KICK_MM * low[:, None] * np.array([0.8, 0.2, 0.55])
    return Truth("kick", positions + swing[:, None, None] * reach, rate)


def hard_smoothed(take: Take, name: str, markers: int = 12) -> Truth:
    """A recording under a Gaussian window, taken for the truth.

    Raises
    ------
    DataError
        when no marker is seen all the time
    """
    from scipy.ndimage import gaussian_filter1d

    whole = take.positions[:, take.present.all(axis=0)]
    if not whole.shape[1]:
        raise DataError(f"No marker of {name} is seen all the time.")
    width = np.sqrt(2.0 * np.log(2.0)) / (2.0 * np.pi * _HARD_HZ) * take.rate
    return Truth(name, gaussian_filter1d(_some(whole, markers), width, axis=0), take.rate)


def make_noise(
    shape: tuple[int, ...], rate: float, kind: str, rng: np.random.Generator
) -> FloatArray:
    """Noise of root mean square 1 in each channel.

    Parameters
    ----------
    shape : (frames, …)
    rate : frames per second
    kind : ``"white"``, or ``"coloured"``: correlated by 0.4 from frame to frame, and up to three
        times as strong in bursts of some tenths of a second, as while few cameras see a marker
    rng : the noise
    """
    from scipy.ndimage import gaussian_filter1d
    from scipy.signal import lfilter

    noise = rng.standard_normal(shape)
    if kind == "coloured":
        slow = gaussian_filter1d(rng.standard_normal(shape), 0.12 * rate, axis=0)
        slow /= slow.std(axis=0)
        noise = lfilter([1.0], [1.0, -0.4], noise, axis=0) * (1.0 + 2.0 * np.clip(slow - 1, 0, 1))
    return np.asarray(noise / np.sqrt(np.mean(noise**2, axis=0)))


def compare(
    truths: Iterable[Truth],
    *,
    noises_mm: Sequence[float] = (0.3, 1.0, 3.0),
    kinds: Sequence[str] = ("white", "coloured"),
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[SmoothRow, ...]:
    """Add noise to truths, smooth, and measure.

    Parameters
    ----------
    truths : known trajectories
    noises_mm : root mean square of the noise
    kinds : of noise, see :func:`make_noise`
    seed : of the noise
    progress : told the share done; may raise ``Cancelled``
    """
    rows: list[SmoothRow] = []
    with threadpool_limits(1):
        for truth, kind, noise_mm, values in noisy(
            truths, noises_mm=noises_mm, kinds=kinds, seed=seed, progress=progress
        ):
            for method, setting, error in _errors(truth, values):
                rows.append(SmoothRow(truth.name, kind, noise_mm, method, setting, *error))
    return tuple(rows)


def noisy(
    truths: Iterable[Truth],
    *,
    noises_mm: Sequence[float],
    kinds: Sequence[str],
    seed: int,
    progress: Progress | None = None,
) -> Iterator[tuple[Truth, str, float, FloatArray]]:
    """Truths, kind and size of the noise, and the truth's positions with it, one after the other.

    Arguments are those of :func:`compare`.
    """
    report = progress or quiet
    cases = [
        (truth, kind, noise_mm) for truth in truths for kind in kinds for noise_mm in noises_mm
    ]
    for i, (truth, kind, noise_mm) in enumerate(cases):
        report(i / len(cases), f"{truth.name}, {kind} noise of {noise_mm:g} mm")
        rng = np.random.default_rng(seed)
        noise = make_noise(truth.positions.shape, truth.rate, kind, rng)
        yield truth, kind, noise_mm, truth.positions + noise_mm * noise
    report(1.0, "Compared")


def _errors(
    truth: Truth, values: FloatArray
) -> Iterator[tuple[str, str, tuple[float, float, float]]]:
    """Method, setting and errors, one after the other."""
    off = partial(_off, truth)
    yield "nothing", "", _means(off(values))
    signals = Signals.of(values, truth.rate)
    for method, (fixed, choices) in _settings(truth).items():
        run = partial(_run, signals, method)
        for setting in fixed:
            text = " ".join(f"{name}={value:g}" for name, value in setting.items())
            yield method, text, _means(off(run(setting)))
        if choices:
            best = np.min([off(run(setting)) for setting in choices], axis=0)
            yield method, ORACLE, _means(best)


def _settings(truth: Truth) -> dict[str, tuple[Settings, Settings]]:
    """Fixed settings of each method, and those an oracle may choose from."""
    cutoffs = [{"cutoff_hz": float(f)} for f in np.geomspace(1.0, 0.25 * truth.rate, 28)]
    points = np.geomspace(0.01, 0.6, 24) * len(truth.positions)
    windows = [w for w in range(7, 120, 6) if w * truth.rate / 100 > 8]
    return {
        "moving_average": (
            [{"window": 5}],
            [{"window": w} for w in (3, 5, 7, 9, 11, 15, 21, 31)],
        ),
        "savgol": ([{"window": 13, "order": 5}], [{"window": w} for w in windows]),
        "butterworth": ([{"cutoff_hz": 6.0}, {"cutoff_hz": 12.0}], cutoffs),
        "bspline": (
            [{"control_points": round(0.1 * len(truth.positions))}],
            [{"control_points": round(m)} for m in points],
        ),
        "kalman": (
            [{"measurement_error": 0.01}],
            [{"measurement_error": float(e)} for e in np.geomspace(0.001, 1.0, 10)],
        ),
        "woltring": ([{}], ()),
        "rts": ([{}], ()),
        "whittaker": ([{}, {"order": 4}], cutoffs),
        "auto": ([{}], ()),
    }


def _run(signals: Signals, method: str, setting: Mapping[str, Any]) -> FloatArray:
    """Smooth with one setting."""
    smoother = SMOOTHERS[method]
    return smoother.run(signals, smoother.params(**setting))


def _off(truth: Truth, found: FloatArray) -> FloatArray:
    """(3, channels) root mean square errors in mm, mm/s and m/s²."""
    ends = max(1, round(ENDS_S * truth.rate))
    error = found - truth.positions
    kinds = (error, velocity(error) * truth.rate, acceleration(error) * truth.rate**2 / 1000.0)
    return np.stack([np.sqrt(np.mean(kind[ends:-ends] ** 2, axis=0)).ravel() for kind in kinds])


def _means(errors: FloatArray) -> tuple[float, float, float]:
    """Mean over channels."""
    position, speed, change = errors.mean(axis=1)
    return float(position), float(speed), float(change)


def _some(positions: FloatArray, markers: int) -> FloatArray:
    """At most so many markers, spread over all."""
    there = positions.shape[1]
    return positions[:, np.unique(np.linspace(0, there - 1, markers).round().astype(int))]
