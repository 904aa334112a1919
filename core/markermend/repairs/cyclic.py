"""What the marker did when the same movement came by another time in the take."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.repairs.body_frame import (
    align,
    holding,
    pick_references,
    rank_references,
    to_frame,
    to_lab,
)
from markermend.repairs.bridge import bridge
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.take import Take

METHOD = "cyclic"
# Differences below this are alike, whatever is usual in the take.
ALIKE_MM2 = 1.0
LEAST_MARGIN = 3


@dataclass(frozen=True)
class CyclicParams:
    """What counts as a repetition."""

    margin_s: float = field(
        default=0.5,
        metadata={
            "unit": "s",
            "min": 0.05,
            "max": 10.0,
            "help": "Time on either side in which the repetition must be alike",
        },
    )
    repetitions: int = field(
        default=3, metadata={"min": 1, "max": 20, "help": "Best repetitions averaged"}
    )
    references: int = field(
        default=12, metadata={"min": 3, "max": 60, "help": "Markers whose pose is compared"}
    )
    unlikeness: float = field(
        default=0.7,
        metadata={
            "min": 0.01,
            "max": 1.0,
            "help": "Largest difference to a repetition, as a share of what is usual in the take",
        },
    )


@dataclass(frozen=True, eq=False)
class _View:
    """The take as seen from a frame that moves with the body, or from the lab."""

    own: FloatArray
    known: BoolArray
    compared: FloatArray
    pose: FloatArray | None
    posed: BoolArray
    rotation: FloatArray
    centre: FloatArray


@register(
    METHOD,
    label="Cyclic",
    summary="Copies the same movement from elsewhere in the take; for gait and other repetitions.",
    params=CyclicParams,
)
def repair_cyclic(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Average the best repetitions of the movement around the interval and join both borders.

    Where three other markers are seen all through the interval, poses are compared, and the
    marker's way, in a frame that moves with them; else its own velocity beside the interval is.
    Works with one side only, at the take's beginning and end. Refuses where nothing in the take
    is alike enough.
    """
    take, start, stop = evidence.take, artifact.start, artifact.stop
    view = _look(evidence, artifact, params.references)
    reach = max(LEAST_MARGIN, round(params.margin_s * take.rate))
    before = _run(view.known[:start][::-1], reach)
    after = _run(view.known[stop:], reach)
    if max(before, after) < LEAST_MARGIN:
        reason = f"{artifact.marker} is not seen right beside the interval."
        return refuse(METHOD, reason, params)
    unlike = _unlikeness(view, start, stop, before, after)
    if not np.isfinite(unlike).any():
        reason = f"{artifact.marker} is nowhere else seen for as long as the interval."
        return refuse(METHOD, reason, params)
    places = _best(unlike, stop - start, params)
    if len(places) == 0:
        reason = (
            "The movement is not repeated in the take: the most similar stretch differs by "
            f"{unlike.min():.2f} of what is usual, {params.unlikeness:.2f} at most is good."
        )
        return refuse(METHOD, reason, params)
    window = np.arange(-before, stop - start + after)
    copies = view.own[places[:, None] + window]
    beside = (window < 0) | (window >= stop - start)
    copies = copies - copies[:, beside].mean(axis=1, keepdims=True)
    copied = copies.mean(axis=0)
    known = start + window[beside]
    mean, deviation = bridge(known, view.own[known] - copied[beside], start, stop, take.rate)
    if len(places) > 1:
        deviation = np.hypot(deviation, copies[:, ~beside].std(axis=0, ddof=1))
    values = to_lab(copied[~beside] + mean, view.rotation[start:stop], view.centre[start:stop])
    level = np.sqrt(np.mean(deviation**2, axis=1, keepdims=True))
    return make_repair(METHOD, evidence, artifact, values, params, np.repeat(level, 3, axis=1))


def _look(evidence: Evidence, artifact: Artifact, count: int) -> _View:
    """Choose the frame from which repetitions are looked for."""
    take, marker = evidence.take, evidence.take.index(artifact.marker)
    interval = slice(artifact.start, artifact.stop)
    seen = evidence.seen.copy()
    seen[interval, marker] = False
    own = np.where(seen[:, marker, None], take.positions[:, marker], 0.0)
    ranked, spread = rank_references(take, seen, marker, interval)
    places = pick_references(ranked, seen, marker, count)
    if len(places) < 3:
        velocity = np.zeros_like(own)
        velocity[1:] = np.diff(own, axis=0)
        rotation = np.broadcast_to(np.eye(3), (take.frames, 3, 3))
        nothing = np.ones(take.frames, dtype=bool)
        known = seen[:, marker]
        return _View(own, known, velocity, None, nothing, rotation, np.zeros((take.frames, 3)))
    return _from_body(take, seen, marker, ranked[places], spread[places])


def _from_body(
    take: Take, seen: BoolArray, marker: int, references: IntArray, spread: FloatArray
) -> _View:
    """The marker and its references in the frame that moves with these."""
    posed: BoolArray = np.all(seen[:, references], axis=1)
    cloud = take.positions[posed][:, references]
    rotation = np.tile(np.eye(3), (take.frames, 1, 1))
    centre = np.zeros((take.frames, 3))
    rotation[posed], centre[posed] = align(cloud, holding(spread))
    pose = np.zeros((take.frames, 3 * len(references)))
    pose[posed] = to_frame(cloud, rotation[posed], centre[posed]).reshape(len(cloud), -1)
    pose[posed] -= pose[posed].mean(axis=0)
    known = posed & seen[:, marker]
    own = np.zeros((take.frames, 3))
    there = take.positions[known, marker][:, None]
    own[known] = to_frame(there, rotation[known], centre[known])[:, 0]
    return _View(own, known, own, pose, posed, rotation, centre)


def _run(known: BoolArray, most: int) -> int:
    """How many frames are known in a row from the first."""
    gone = np.flatnonzero(~known[:most])
    return int(gone[0]) if len(gone) else min(most, len(known))


def _unlikeness(view: _View, start: int, stop: int, before: int, after: int) -> FloatArray:
    """(frames,) how much the stretch from each frame differs, as a share of what is usual.

    Infinite where the marker is not known all through the stretch and its margins.
    """
    frames, first, last = len(view.own), start - before, stop + after
    lacking = np.concatenate([[0], np.cumsum(~view.known)])
    starts = np.arange(before, frames - (stop - start) - after + 1)
    whole = np.zeros(frames, dtype=bool)
    whole[starts] = lacking[starts + stop - start + after] == lacking[starts - before]
    # A velocity at the margin's first frame would need the frame before it.
    skip = 1 if view.pose is None else 0
    beside = np.zeros(frames)
    for begin, end in ((first + skip, start), (stop + skip, last)):
        if end > begin:
            beside += _differences(view.compared, begin, end, start)
    total = _share(beside / max(before + after, 1), whole)
    if view.pose is not None:
        pose = _differences(view.pose, first, last, start) / (last - first)
        total = (total + _share(pose, whole)) / 2.0
    return np.where(whole, np.sqrt(total), np.inf)


def _differences(track: FloatArray, begin: int, end: int, start: int) -> FloatArray:
    """(frames,) summed squared difference to ``[begin, end)``, moved along with the stretch."""
    from scipy.fft import irfft, next_fast_len, rfft

    frames, length = len(track), end - begin
    asked = track[begin:end]
    energy = np.concatenate([[0.0], np.cumsum(np.sum(track**2, axis=1))])
    # Correlation by Fourier transform: linear in the take's length, whatever the interval's.
    size = next_fast_len(frames, real=True)
    spectrum = rfft(track, size, axis=0) * np.conj(rfft(asked, size, axis=0))
    both = irfft(spectrum.sum(axis=1), size)[: frames - length + 1]
    square = energy[length:] - energy[:-length] + np.sum(asked**2) - 2.0 * both
    moved = np.zeros(frames)
    offset = begin - start
    at = np.arange(len(square)) - offset
    fits = (at >= 0) & (at < frames)
    moved[at[fits]] = np.maximum(square[fits], 0.0)
    return moved


def _share(square: FloatArray, whole: BoolArray) -> FloatArray:
    """Squared differences as a share of the usual one."""
    usual = float(np.median(square[whole])) if whole.any() else 0.0
    return np.asarray(square / max(usual, ALIKE_MM2))


def _best(unlike: FloatArray, length: int, params: CyclicParams) -> IntArray:
    """Starts of the most similar stretches, none overlapping another."""
    places: list[int] = []
    for place in np.argsort(unlike, kind="stable"):
        if unlike[place] > params.unlikeness or len(places) == params.repetitions:
            break
        if all(abs(place - other) >= length for other in places):
            places.append(int(place))
    return np.array(places, dtype=np.int64)
