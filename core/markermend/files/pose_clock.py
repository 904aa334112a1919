"""How many poses a second a table of joints has, by the times of its rows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.files.pose_rows import Header

SENSOR_RATE = 30.0
"""Poses per second where nothing tells."""

# Nobody records joints so slowly: times that grow by as much a pose are in a smaller unit.
_SLOWEST_S, _ROUNDED = 1.0, 1e-6
_SMALLER = ((1e-3, "milliseconds"), (1e-6, "microseconds"), (1e-9, "nanoseconds"))
# As far apart two times can be by being rounded to microseconds, as they are written here.
_WRITTEN_S = 1.01e-6
# Beyond it, nanoseconds of centuries, a number is no time.
_LARGEST = 1e19
# Slopes over so many poses tell the usual one; the line through all does where it is about that.
_POSES, _UNEVEN = 30, 0.1
# A pose is late by more than this share of a usual step, and a gap before it lasts where so many
# poses on both sides are apart by it. Where more of them are as early, times tremble, or are
# rounded. They tell of gaps up to so many times the length of what is there.
_LATE, _AROUND, _EARLY, _MOST_MISSING = 0.5, 9, 0.05, 9


@dataclass(frozen=True)
class Clock:
    """Times of a table.

    Attributes
    ----------
    rate : poses per second
    begins : seconds at the first of them
    second : seconds in the file's unit of time
    oddities : sentences about what was guessed
    told : times tell the rate
    """

    rate: float
    begins: float = 0.0
    second: float = 1.0
    oddities: tuple[str, ...] = ()
    told: bool = True


def with_gaps_by_times(
    told: list[float], frame: list[int], header: Header
) -> tuple[list[int], tuple[str, ...]]:
    """Frames of rows, with those left out that times tell of where numbers do not.

    Parameters
    ----------
    told : of each row; NaN where it has none
    frame : of each row, from 0, by its number
    header : which tells how frames are numbered

    Returns
    -------
    Frames of rows, from 0, and a sentence about those that are missing. A pose that comes late is
    no gap where those after it make up for it, and so many that they are most of the recording are
    none.
    """
    times, frames = np.array(told), np.array(frame)
    known = np.abs(times) < _LARGEST
    order, rows = np.unique(frames[known], return_index=True)
    there = times[known][rows]
    if len(order) < _AROUND:
        return frame, ()
    slopes = np.diff(there) / np.diff(order)
    usual = float(np.median(slopes))
    if usual <= 0 or np.mean(slopes < _LATE * usual) > _EARLY:
        return frame, ()
    usual = float(slopes[np.abs(slopes - usual) < _LATE * usual].mean())
    ahead = there - there[0] - usual * (order - order[0])
    gaps = dict[int, int]()
    for i in np.flatnonzero(np.diff(ahead) > _LATE * usual).tolist():
        before, after = ahead[max(i + 1 - _AROUND, 0) : i + 1], ahead[i + 1 : i + 1 + _AROUND]
        lasts = min(np.median(after) - np.median(before), ahead[i + 1] - ahead[i])
        if round(lasts / usual) > 0:
            gaps[i] = round(lasts / usual)
            ahead[i + 1 :] -= gaps[i] * usual
    missing = sum(gaps.values())
    if not missing or missing > _MOST_MISSING * (frames.max() + 1):
        return frame, ()
    first, behind = min(gaps), order[[i + 1 for i in gaps]]
    shift = np.concatenate([[0], np.cumsum(list(gaps.values()))])
    moved = frames + shift[np.searchsorted(behind, frames, side="right")]
    after_frame = header.stated(header.first + int(order[first]))
    oddity = (
        f"Times tell of {missing} poses that are missing, after frame {after_frame} for one; they"
        " were read as gaps, and frames after them are numbered anew."
    )
    return moved.tolist(), (oddity,)


def by_times(told: list[float], frame: list[int], header: Header) -> Clock:
    """What times of rows tell.

    Parameters
    ----------
    told : of each row; NaN where it has none
    frame : of each row, from 0
    header : which tells how frames are numbered and, where the file does, the unit of times

    Returns
    -------
    Clock
        that of a sensor, of which a file in steps has every so many poses, where times do not grow
    """
    second = header.second
    times, frames = np.array(told), np.array(frame)
    known = np.abs(times) < _LARGEST
    if np.unique(frames[known]).size < 2:
        return _no_clock(header.step)
    at = int(np.argmin(np.where(known, frames, frames.max() + 1)))
    # From the first on, since of those of the calendar no digits would be left.
    since = times[known] - times[at]
    slope = float(np.polyfit(frames[known], since, 1)[0])
    oddities: tuple[str, ...] = ()
    usual, odd = _usual_slope(frames[known], since)
    if abs(slope - usual) > _UNEVEN * usual > 0:
        slope = usual
        oddities = (
            "Times in the file jump or stand still (after frame"
            f" {header.stated(header.first + odd)}, for one); the rate is that between most poses.",
        )
    if slope <= 0:
        return _no_clock(header.step, goes=slope)
    if second is None:
        second, unit = 1.0, ""
        for smaller, name in _SMALLER:
            if second * slope >= _SLOWEST_S * (1.0 - _ROUNDED):
                second, unit = smaller, name
        if unit:
            guess = f"The times in the file grow too fast for seconds; {unit} were assumed."
            oddities = (*oddities, guess)
    rate = float(np.round(1.0 / (second * slope), 4))
    whole = float(max(round(rate), 1))
    if np.ptp(second * since - frames[known] / whole) <= _WRITTEN_S:
        # A few times, rounded as they are written, tell a rate that is a little off.
        rate, slope = whole, 1.0 / (second * whole)
    return Clock(rate, second * (times[at] - frame[at] * slope), second, oddities)


def _no_clock(step: int, *, goes: float | None = None) -> Clock:
    """What is assumed where no time tells: numbers are those of a sensor's poses."""
    rate = SENSOR_RATE / step
    if rate * _SLOWEST_S < 1.0:
        rate = SENSOR_RATE
    why = f"The file tells no rate; {rate:g} Hz was assumed."
    if goes is not None:
        doing = "run backwards" if goes < 0 else "stand still"
        why = f"Times in the file {doing} and tell no rate; {rate:g} Hz was assumed."
    return Clock(rate, oddities=(why,), told=False)


def _usual_slope(frames: FloatArray, times: FloatArray) -> tuple[float, int]:
    """How times (rows,) mostly grow a frame, and the frame after which they stray most from it."""
    order, rows = np.unique(frames, return_index=True)
    there = times[rows]
    lag = max(min(_POSES, len(order) // 4), 1)
    usual = float(np.median((there[lag:] - there[:-lag]) / (order[lag:] - order[:-lag])))
    strays = np.abs(np.diff(there) - usual * np.diff(order))
    return usual, int(order[np.argmax(strays)])
