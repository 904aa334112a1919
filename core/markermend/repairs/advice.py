"""Which method fits an artifact best, measured on known stretches of the same marker near it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray, free_starts, runs
from markermend.artifact import Artifact, Kind, axis_columns
from markermend.parameters import read_params
from markermend.repairs.body_frame import rank_references
from markermend.repairs.choice import choose
from markermend.repairs.of_joints import RESTORING, best_of
from markermend.repairs.registry import REPAIRS, Evidence, Repair, find_method
from markermend.repairs.result import axes_of, without_own
from markermend.take import Take

CANDIDATES = ("local_regression", "kalman", "spline", "pchip", "makima", "linear")
"""Methods that invent what was not seen; they can be measured by hiding what was."""

COMPARED = (*CANDIDATES, "rigid", "pattern", "cyclic", "savgol")
"""Methods an operator may want to see beside each other; those with no answer come last."""

MODELS = ("glr", "lgrnn", "li", "lpr", "pca", "pma", "pma_all", "pma_no_pca", "ffnn_loose")
"""Methods without an error of their own that are quick enough to be measured while someone waits.

Over 20,000 frames of 53 markers three trials take under a second; those of the other networks and
of low rank take several.
"""

# Those that look at the body's structure.
OF_MESH = ("rigid", "pattern")
# A few trials cannot tell less than this apart: the usual choice stays first unless another
# method is expected to do better by more.
CLEARLY_BETTER = 0.8
# A few stretches miss the worst that may happen: bands are so much wider than what was measured.
# The widest at which no method's bands hold over 95 % of the frames of the five takes it was chosen
# on, since they hold fewer elsewhere: on ten others 87 to 94 % by method.
WIDER = 1.25
# With fewer the rest of the body does not tell where a marker is.
LEAST_REFERENCES = 3


@dataclass(frozen=True, eq=False)
class Advice:
    """One method's proposal and how far off it is expected to be.

    Attributes
    ----------
    repair : what the method proposes, with :attr:`Repair.error_mm` set where it is known
    trials : known stretches on which it was measured
    """

    repair: Repair
    trials: int

    @property
    def method(self) -> str:
        """Name in the registry."""
        return self.repair.method

    @property
    def error_mm(self) -> float | None:
        """Expected mean Euclidean error over the interval."""
        return self.repair.error_mm


def advise(
    evidence: Evidence,
    artifact: Artifact,
    *,
    methods: Iterable[str] | None = None,
    trials: int = 4,
) -> tuple[Advice, ...]:
    """Rank methods for an artifact by expected error, best first.

    The nearest stretches as long as the marker is unknown around the artifact, in which it is
    known, are hidden one at a time, together with every other marker that is missing then, and
    each method fills the artifact's part of them. Its expected error is the mean over these; where
    a method also gives a band of its own for this very interval, the geometric mean of the two.

    Parameters
    ----------
    evidence : what may be believed
    artifact : what is to be repaired
    methods : names in the registry; those that cannot repair here come last, with their reason.
        When not given, those of :func:`candidates`
    trials : stretches to hide at most

    Returns
    -------
    One for each method, best first; the usual choice (:func:`markermend.repairs.choose`) stays
    before others that are not better by a fifth. A swap whose counterpart is known is first: it
    invents nothing.

    Of joints of a skeleton recording what is made when no method is named is first. There methods
    that say how far off they may be are not tried elsewhere: joints are bridged to both sides there
    and only held at an end, where trials say a third of what is true, and what methods say of
    themselves follows the truth.
    """
    own = without_own(evidence, artifact)
    names = candidates(own, artifact) if methods is None else tuple(methods)
    if own.mesh is None and any(name in OF_MESH for name in names):
        from markermend.mesh import infer_mesh

        # Each trial would work it out anew.
        own = replace(own, mesh=infer_mesh(own.take)).with_seen(own.seen)
    tried = _trials_of(own, artifact, trials)
    with threadpool_limits(1):
        advice = [_measure(tried, name) for name in names]
        if choose(artifact) == "swap":
            method = find_method("swap")
            advice.insert(0, Advice(method.run(own, artifact, method.params()), 0))
    if own.take.skeleton:
        both_sides = artifact.counterpart is not None
        best = RESTORING if both_sides else best_of(a.repair for a in advice)
        return tuple(sorted(advice, key=lambda a: (a.method != best, _rank(a, best))))
    usual = choose(artifact)
    return tuple(sorted(advice, key=lambda a: _rank(a, usual)))


def compared(take: Take) -> tuple[str, ...]:
    """Methods an operator may want to see beside each other in a take."""
    return (RESTORING, *COMPARED) if take.skeleton else COMPARED


def candidates(evidence: Evidence, artifact: Artifact) -> tuple[str, ...]:
    """Methods worth measuring for an artifact.

    Beside the usual ones rigid body is tried where three other markers of the body are seen all
    through the interval; where fewer are, pattern and those that can cross a blackout.

    Parameters
    ----------
    evidence : what may be believed
    artifact : what is to be repaired
    """
    marker = evidence.take.index(artifact.marker)
    interval = slice(artifact.start, artifact.stop)
    references, _ = rank_references(evidence.take, evidence.seen, marker, interval)
    if len(references) >= LEAST_REFERENCES:
        return (*CANDIDATES, "rigid")
    across = (m.name for m in REPAIRS.values() if m.crosses_blackout)
    return (*CANDIDATES, "pattern", *(name for name in across if name not in CANDIDATES))


def with_expected_error(
    evidence: Evidence,
    artifact: Artifact,
    repair: Repair,
    *,
    methods: Iterable[str] = CANDIDATES,
    trials: int = 3,
) -> Repair:
    """Say how far off a repair may be when its method does not say so itself.

    Parameters
    ----------
    evidence : what may be believed
    artifact : what was repaired
    repair : the proposal; returned as it is when it has an error already, has no patches, or was
        made by another method
    methods : those that are measured
    trials : stretches to hide at most
    """
    if repair.error_mm is not None or not repair.patches or repair.method not in methods:
        return repair
    own = without_own(evidence, artifact)
    params = read_params(find_method(repair.method), repair.params)
    tried = _trials_of(own, artifact, trials)
    misses = _misses(tried, repair.method, params)
    return _told(tried, repair, misses) if misses else repair


@dataclass(frozen=True, eq=False)
class _Trials:
    """Where an artifact's repair can be tried.

    Attributes
    ----------
    evidence, artifact : what is to be repaired
    start, stop : frames in which the marker is unknown, the artifact's among them: a few stray
        frames inside a gap are as far from what is known as the gap is long
    places : starts of known stretches as long
    """

    evidence: Evidence
    artifact: Artifact
    start: int
    stop: int
    places: tuple[int, ...]


def _trials_of(evidence: Evidence, artifact: Artifact, count: int) -> _Trials:
    """Find so many places, the nearest first.

    Where the marker is never known for as long, half of the longest time that it is gets hidden,
    on the side that is nearer to what is known.
    """
    known = evidence.seen[:, evidence.take.index(artifact.marker)]
    before, after = np.flatnonzero(known[: artifact.start]), np.flatnonzero(known[artifact.stop :])
    start = int(before[-1]) + 1 if len(before) else 0
    stop = artifact.stop + int(after[0]) if len(after) else len(known)
    longest = max((int(b - a) for a, b in runs(known)), default=0)
    room = max(longest // 2, artifact.length)
    # A frame on either side stays known.
    if stop - start > max(longest - 2, artifact.length):
        first = artifact.start - start <= stop - artifact.stop
        begin = max(start, artifact.stop - room) if first else min(stop - room, artifact.start)
        start, stop = begin, begin + room
    return _Trials(evidence, artifact, start, stop, _places(known, start, stop - start, count))


def _told(tried: _Trials, repair: Repair, misses: list[FloatArray]) -> Repair:
    """A repair with the error that was measured, and a band if it has none of its own.

    The band widens from where the marker is seen, as a Brownian bridge does.
    """
    error = float(np.mean([np.mean(miss) for miss in misses]))
    if repair.band_mm is not None:
        return replace(repair, error_mm=error)
    frames = np.arange(tried.artifact.start, tried.artifact.stop)
    at = (frames - tried.start + 1.0) / (tried.stop - tried.start + 1.0)
    shape = (at if tried.start > 0 else 1.0) * (
        (1.0 - at) if tried.stop < tried.evidence.take.frames else 1.0
    )
    shape = np.broadcast_to(shape, at.shape)
    square = np.mean([np.mean(miss**2) for miss in misses])
    return replace(repair, error_mm=error, band_mm=WIDER * np.sqrt(square * shape / shape.mean()))


def _rank(advice: Advice, usual: str) -> tuple[int, float]:
    """Repairs of known error first, then those of unknown error, then those without patches."""
    if not advice.repair.patches:
        return (2, 0.0)
    if advice.error_mm is None:
        return (1, 0.0)
    return (0, advice.error_mm * (CLEARLY_BETTER if advice.method == usual else 1.0))


def _measure(tried: _Trials, name: str) -> Advice:
    """Propose with one method and measure it at each place."""
    method = find_method(name)
    repair = method.run(tried.evidence, tried.artifact, method.params())
    sure = tried.evidence.take.skeleton and repair.error_mm is not None
    misses = _misses(tried, name, method.params()) if repair.patches and not sure else []
    if not misses:
        return Advice(repair, 0)
    told = _told(tried, repair, misses)
    if repair.error_mm is not None and told.error_mm is not None:
        told = replace(told, error_mm=float(np.sqrt(told.error_mm * repair.error_mm)))
    return Advice(told, len(misses))


def _misses(tried: _Trials, name: str, params: Any) -> list[FloatArray]:
    """How far off a method is, frame by frame in mm, at each place where it could fill."""
    method, artifact, take = find_method(name), tried.artifact, tried.evidence.take
    marker, columns = take.index(artifact.marker), axis_columns(axes_of(artifact))
    misses = []
    for place in tried.places:
        start = place + artifact.start - tried.start
        trial = replace(artifact, start=start, stop=start + artifact.length, kind=Kind.GAP, id="")
        done = method.run(_hidden(tried, place), trial, params)
        if done.patches:
            truth = take.positions[trial.start : trial.stop, marker]
            miss = (done.patches[0].values - truth)[:, columns]
            misses.append(np.linalg.norm(miss, axis=1))
    return misses


def _hidden(tried: _Trials, place: int) -> Evidence:
    """Evidence with the marker, and all that is missing while it is unknown, hidden at a place."""
    evidence, marker = tried.evidence, tried.evidence.take.index(tried.artifact.marker)
    there = slice(place, place + tried.stop - tried.start)
    trusted, seen = evidence.trusted.copy(), evidence.seen.copy()
    for hidden, known in ((trusted, evidence.trusted), (seen, evidence.seen)):
        hidden[there] &= known[tried.start : tried.stop]
        hidden[there, marker] = False
    return replace(evidence, trusted=trusted).with_seen(seen)


def _places(known: BoolArray, near: int, length: int, count: int) -> tuple[int, ...]:
    """Starts of the nearest known stretches of a length, none overlapping another."""
    # One frame more on either side, so that a curve has somewhere to start from.
    starts = free_starts(known, length, 1)
    nearest = starts[np.argsort(np.abs(starts - near), kind="stable")]
    places: list[int] = []
    for start in nearest.tolist():
        if all(abs(start - other) >= length for other in places):
            places.append(start)
        if len(places) == count:
            break
    return tuple(places)
