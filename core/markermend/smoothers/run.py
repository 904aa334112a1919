"""Smoothing a take, and its velocities and accelerations with their error bands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields
from numbers import Integral
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import FloatArray, IntArray
from markermend.errors import DataError
from markermend.parameters import read_params
from markermend.progress import Progress, quiet
from markermend.smoothers.adaptive import LEAST, smooth_with
from markermend.smoothers.bands import acceleration, deviations, velocity
from markermend.smoothers.levels import find_levels
from markermend.smoothers.registry import Signals, find_smoother
from markermend.take import Origin, Take

AUTO = "auto"
# Samples (frames × markers) looked at together: they stay in the processor's caches, and progress
# is told between two portions.
_TOGETHER = 200_000
# Where a selection begins and ends the change is blended in over this time.
_BLEND_S = 0.1


@dataclass(frozen=True, eq=False)
class Derivatives:
    """Smoothed trajectories, how they change, and one standard deviation of each.

    Every array is (frames, markers, 3) float64, NaN where the marker was not seen.

    Attributes
    ----------
    labels : of the markers, in the arrays' order
    position, position_band : mm
    velocity, velocity_band : mm/s
    acceleration, acceleration_band : mm/s²
    noise_mm : standard deviation of the recorded samples
    cutoff_hz : frequency that was halved
    """

    labels: tuple[str, ...]
    position: FloatArray
    position_band: FloatArray
    velocity: FloatArray
    velocity_band: FloatArray
    acceleration: FloatArray
    acceleration_band: FloatArray
    noise_mm: FloatArray
    cutoff_hz: FloatArray


def smooth(
    take: Take,
    method: str = AUTO,
    *,
    markers: Iterable[str] | None = None,
    start: int = 0,
    stop: int | None = None,
    params: Mapping[str, Any] | object | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> Take:
    """Take noise out of trajectories.

    Nothing is smoothed across a gap and no sample is added. Samples that were filled or edited
    are smoothed with the others, but are not asked how noisy the recording is; near events of
    the take ``auto`` lets the motion change at once.

    Parameters
    ----------
    take : the recording
    method : name in :data:`markermend.smoothers.SMOOTHERS`
    markers : labels of those to smooth; all when not given
    start, stop : half-open interval of 0-based frames to change; the whole take when not given.
        Frames outside are looked at, and the change is blended in over 0.1 s inside
    params : the method's parameters as a mapping or its dataclass; None for the defaults
    progress : told the share of samples done; may raise ``Cancelled``
    settings : single parameters by name, ``control_points=100``

    Returns
    -------
    Take
        a new one; changed samples that were measured are marked edited, filled ones stay filled

    Raises
    ------
    MethodError
        when there is no such method, or a parameter is unknown or out of range
    DataError
        when there is no such marker or no frame in the interval
    """
    smoother = find_smoother(method)
    wanted = read_params(smoother, params, settings)
    columns = _columns(take, markers)
    first, last = _interval(take, start, stop)
    positions, origin = take.positions.copy(), take.origin.copy()
    with threadpool_limits(1):
        for chosen in _portions(take, columns, progress, f"Smoothing, {smoother.label}"):
            before = take.positions[:, chosen]
            after = smoother.run(_signals(take, chosen), wanted)
            blend = _blend(take, first, last)[:, None, None]
            now = np.where(blend > 0, before + blend * (after - before), before)
            positions[:, chosen] = now
            changed = (now != before).any(axis=2) & take.present[:, chosen]
            was = origin[:, chosen]
            origin[:, chosen] = np.where(
                changed & (was == Origin.MEASURED), np.uint8(Origin.EDITED), was
            )
    return take.with_positions(positions, origin)


def derivatives(
    take: Take,
    *,
    markers: Iterable[str] | None = None,
    progress: Progress | None = None,
) -> Derivatives:
    """Velocity and acceleration of the take smoothed by ``auto``, each with its error band.

    Parameters
    ----------
    take : the recording
    markers : labels; all when not given
    progress : told the share of samples done; may raise ``Cancelled``

    Returns
    -------
    Derivatives
        differences over one frame of the smoothed trajectory; NaN also in stretches of fewer
        than six frames, which are not smoothed

    Raises
    ------
    DataError
        when there is no such marker

    Notes
    -----
    The band is one standard deviation. It includes that the levels at each frame are estimates,
    and motion that is both smaller than the noise and faster than the cut-off, as far as it falls
    off with frequency as recorded motion does.
    """
    columns = _columns(take, markers)
    shape = (take.frames, len(columns), 3)
    names = [f.name for f in fields(Derivatives) if f.name != "labels"]
    found = {name: np.full(shape, np.nan) for name in names}
    done = 0
    with threadpool_limits(1):
        for chosen in _portions(take, columns, progress, "Velocities and accelerations"):
            part = _derive(_signals(take, chosen))
            for name in names:
                found[name][:, done : done + len(chosen)] = part[name]
            done += len(chosen)
    return Derivatives(tuple(take.labels[i] for i in columns), **found)


def _derive(signals: Signals) -> dict[str, FloatArray]:
    """All arrays of :class:`Derivatives` for some markers."""
    rate = signals.rate
    levels = find_levels(signals)
    position = smooth_with(signals, levels)
    found = {
        f.name: np.full_like(position, np.nan) for f in fields(Derivatives) if f.name != "labels"
    }
    bands = deviations(levels, rate, _to_end(signals))
    for frames, markers in signals.stretches():
        n = frames.stop - frames.start
        if n < LEAST:
            continue
        smoothed = position[frames, markers]
        values = {
            "position": smoothed,
            "velocity": velocity(smoothed) * rate,
            "acceleration": acceleration(smoothed) * rate**2,
            "position_band": bands[0][frames, markers],
            "velocity_band": bands[1][frames, markers] * rate,
            "acceleration_band": bands[2][frames, markers] * rate**2,
            "noise_mm": levels.sample_noise_mm[frames, markers],
            "cutoff_hz": levels.cutoff_hz[frames, markers],
        }
        for name, value in values.items():
            found[name][frames, markers] = value
    return found


def _to_end(signals: Signals) -> FloatArray:
    """(frames, markers, 3) frames to the nearer end of the stretch, 0 outside of any."""
    to_end = np.zeros(signals.values.shape)
    for frames, markers in signals.stretches():
        there = np.arange(frames.stop - frames.start)
        to_end[frames, markers] = np.minimum(there, there[::-1])[:, None, None]
    return to_end


def _columns(take: Take, markers: Iterable[str] | None) -> IntArray:
    """Columns of the markers named, or of all."""
    names = take.labels if markers is None else dict.fromkeys(markers)
    return np.array([take.index(name) for name in names], dtype=np.int64)


def _interval(take: Take, start: int, stop: int | None) -> tuple[int, int]:
    """Check an interval of frames."""
    last = take.frames if stop is None else stop
    whole = isinstance(start, Integral) and isinstance(last, Integral)
    if take.frames and not (whole and 0 <= start < last <= take.frames):
        raise DataError(
            f"There is nothing to smooth from frame {start} to {last} of {take.frames}."
        )
    return start, last


def _portions(
    take: Take, columns: IntArray, progress: Progress | None, doing: str
) -> Iterator[IntArray]:
    """Markers in portions that fit into memory."""
    report = progress or quiet
    size = max(1, _TOGETHER // max(take.frames, 1))
    # Of a take without a frame there is nothing to look at.
    for at in range(0, len(columns) if take.frames else 0, size):
        report(at / len(columns), doing)
        yield columns[at : at + size]
    report(1.0, "Smoothed")


def _signals(take: Take, columns: IntArray) -> Signals:
    """Some markers of a take with what is known about their samples."""
    # An event's time counts from the file's first frame, which has the number 1.
    numbers = [round(event.time_s * take.rate) + 1 for event in take.events]
    return Signals(
        take.positions[:, columns],
        take.rate,
        take.origin[:, columns] == Origin.MEASURED,
        np.array(numbers, dtype=np.int64) - take.first_frame,
    )


def _blend(take: Take, start: int, stop: int) -> FloatArray:
    """(frames,) share of the smoothed trajectory: 1 inside, rising from a selection's edges."""
    share = np.zeros(take.frames)
    n = stop - start
    share[start:stop] = 1.0
    width = min(max(1, round(_BLEND_S * take.rate)), max(1, n // 2))
    rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(width) + 1) / (width + 1))
    if start > 0:
        share[start : start + width] = rise
    if stop < take.frames:
        share[stop - width : stop] = np.minimum(share[stop - width : stop], rise[::-1])
    return share
