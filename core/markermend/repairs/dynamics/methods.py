"""DynaMMo and BoLeRO as repair methods: all markers of a body follow one hidden movement.

DynaMMo (li2009) learns a linear dynamical system of 16 hidden dimensions from the body around the
interval; BoLeRO (li2010), which tits2018 compares with, pulls what it invents softly towards the
distances that markers of a segment keep. Neither needs a single marker to be seen in the interval.

Otherwise than published: missing samples are left out of the likelihood rather than guessed again
and again; lengths are weighted by how much they vary; and what is left at both borders of the
interval is bridged, as tits2018 joins all methods it compares.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.progress import Progress
from markermend.repairs.bridge import bridge, context_of
from markermend.repairs.dynamics.bones import Bones, find_bones, pull
from markermend.repairs.dynamics.system import System, infer, learn, start_from
from markermend.repairs.registry import Evidence, MethodFunction, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.take import Take, is_unlabelled

HIDDEN = 16
LEAST_FRAMES = 60
# A marker seen in a smaller share of the frames around says nothing about the others.
LEAST_SEEN = 0.3
# How often what the lengths give is taken for seen, and the states are inferred again.
CONSTRAINED_ROUNDS = 3
# Of each take the movement found last, and what it was found from.
_LATEST: WeakKeyDictionary[Take, tuple[tuple[object, ...], tuple[FloatArray, int]]] = (
    WeakKeyDictionary()
)


@dataclass(frozen=True)
class DynamicsParams:
    """What the system is learnt from."""

    rounds: int = field(
        default=15, metadata={"min": 0, "max": 1000, "help": "Of expectation maximisation"}
    )
    reach_s: float = field(
        default=4.0,
        metadata={
            "unit": "s",
            "min": 0.5,
            "max": 600.0,
            "help": "Time on either side of the interval that is learnt from",
        },
    )
    join: bool = field(default=True, metadata={"help": "Bridge what is left at both borders"})


def _method(name: str, constrained: bool) -> MethodFunction:
    """A repair method with or without bone lengths."""

    def run(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
        take, marker = evidence.take, evidence.take.index(artifact.marker)
        first, last = _window(take, artifact, params.reach_s)
        seen: BoolArray = np.all(evidence.trusted[first:last], axis=2)
        seen[artifact.start - first : artifact.stop - first, marker] = False
        columns = _columns(take, seen, marker)
        seen = seen[:, columns]
        own = int(np.flatnonzero(columns == marker)[0])
        if seen[:, own].sum() < LEAST_FRAMES:
            reason = (
                f"{artifact.marker} is seen in only {seen[:, own].sum()} frames around the "
                f"interval; {LEAST_FRAMES} are needed."
            )
            return refuse(name, reason, params)
        positions = take.positions[first:last, columns]
        # Markers that are missing together, as in a blackout, ask for the same movement.
        key = (constrained, params.rounds, first, last, columns.tobytes(), seen.tobytes())
        latest = _LATEST.get(take)
        if latest is None or latest[0] != key:
            found = _movement(positions, seen, constrained, params.rounds, evidence.progress)
            latest = _LATEST[take] = key, found
        movement, learnt = latest[1]
        track = movement[:, own]
        begin, end = artifact.start - first, artifact.stop - first
        values = track[begin:end]
        beside = context_of(seen[:, own], begin, end, take.rate) if params.join else np.arange(0)
        if len(beside):
            left = positions[beside, own] - track[beside]
            values = values + bridge(beside, left, begin, end, take.rate)[0]
        return make_repair(name, evidence, artifact, values, params, weights=learnt)

    return run


def _movement(
    positions: FloatArray, seen: BoolArray, constrained: bool, rounds: int, progress: Progress
) -> tuple[FloatArray, int]:
    """(n, markers, 3) mm by the system learnt from all that is seen, and its parameters' number."""
    from markermend.predictors.bridging import bridge as fill_in

    known = np.repeat(seen, 3, axis=1)
    whole = fill_in(positions.reshape(len(positions), -1), known)
    middle, size = whole.mean(axis=0), float(whole.std(axis=0).mean()) + 1e-6
    scaled = (whole - middle) / size
    start = start_from(scaled, min(HIDDEN, scaled.shape[1] - 1))
    system, states = learn(scaled, known, start, rounds, progress)
    found = (states.mean @ system.output.T) * size + middle
    learnt = system.parameters
    if constrained:
        bones = find_bones(positions, seen)
        learnt += bones.length.size + bones.spread.size
        doubt = _doubt(system, states.spread) * size
        found = _constrain(system, positions, found, doubt, seen, middle, size, bones)
    return np.asarray(found.reshape(positions.shape)), learnt


def _constrain(
    system: System,
    positions: FloatArray,
    found: FloatArray,
    doubt: FloatArray,
    seen: BoolArray,
    middle: FloatArray,
    size: float,
    bones: Bones,
) -> FloatArray:
    """What the system gives, pulled towards usual lengths and smoothed again, by turns."""
    known = np.repeat(seen, 3, axis=1)
    everywhere = np.ones_like(known)
    for _ in range(CONSTRAINED_ROUNDS):
        mixed = np.where(known, positions.reshape(found.shape), found).reshape(positions.shape)
        pulled = pull(mixed, doubt, ~seen, bones).reshape(found.shape)
        states = infer(system, (pulled - middle) / size, everywhere)
        smoothed = (states.mean @ system.output.T) * size + middle
        found = np.where(known, smoothed, 0.5 * (pulled + smoothed))
    return found


def _doubt(system: System, spread: FloatArray) -> FloatArray:
    """(n, markers) standard deviation of each marker's guessed coordinates."""
    variance = np.einsum("dh,nhk,dk->nd", system.output, spread, system.output) + system.noise
    return np.asarray(np.sqrt(variance.reshape(len(spread), -1, 3).mean(axis=2)))


def _window(take: Take, artifact: Artifact, reach_s: float) -> tuple[int, int]:
    """Frames that are looked at: the interval and at least its length on either side."""
    reach = max(round(reach_s * take.rate), artifact.length)
    return max(0, artifact.start - reach), min(take.frames, artifact.stop + reach)


def _columns(take: Take, seen: BoolArray, marker: int) -> IntArray:
    """The marker and the named markers of its body that are seen often enough."""
    subject = take.subject(take.labels[marker])
    often = seen.mean(axis=0) >= LEAST_SEEN
    chosen = [
        i
        for i, label in enumerate(take.labels)
        if i == marker or (often[i] and not is_unlabelled(label) and take.subject(label) == subject)
    ]
    return np.array(chosen, dtype=np.int64)


register(
    "dynammo",
    label="DynaMMo",
    summary="One hidden movement of the whole body; crosses intervals in which nothing is seen.",
    params=DynamicsParams,
    source="li2009 (DynaMMo), as in tits2018",
    crosses_blackout=True,
)(_method("dynammo", constrained=False))
register(
    "bolero",
    label="BoLeRO",
    summary="DynaMMo held softly to the distances that markers of a segment keep.",
    params=DynamicsParams,
    source="li2010 (BoLeRO), as in tits2018",
    crosses_blackout=True,
)(_method("bolero", constrained=True))
