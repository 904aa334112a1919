"""Slow changes of all markers: scanned one by one, judged beside each other."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact, Kind, axis_columns
from markermend.detectors.finding import how_long, in_mm, overlap
from markermend.detectors.joint.bank import KINDS, LONGEST
from markermend.detectors.joint.drift import Candidates, scan
from markermend.detectors.joint.judge import (
    KIND,
    LIKELY,
    Judge,
    evidence,
    is_sharp,
    load_judge,
    quiet_levels,
)
from markermend.detectors.joint.measures import CROWDS, FEATURES
from markermend.detectors.joint.refilled import Spot, unevenness
from markermend.detectors.joint.shapes import fit_of
from markermend.predictors.bridging import bridge
from markermend.predictors.cross_fit import distance_spreads
from markermend.processes import in_processes, processes_start
from markermend.progress import Progress
from markermend.take import AXES, Take

RATE = 120.0
"""Slow changes are looked for at about this rate; faster takes are thinned."""
LARGEST_OVERLAP = 0.3
LEAKED = 0.6
"""A deviation on a reference leaks into the markers foretold from it, never larger than this."""
PARALLEL_FROM = 60_000
SHORT_S = 0.1
"""Holes of this length a spline bridges as well as if the marker had been seen."""
REACH = 6
SCANNING = 0.9
"""Share of the time that looking for candidates takes; the rest goes to filling them."""
_LOUDNESS = FEATURES.index("reweighted")


@dataclass(frozen=True)
class Drift:
    """A slow change of one coordinate, in frames of the take."""

    marker: int
    axis: int
    start: int
    stop: int
    size_mm: float
    confidence: float


@dataclass(frozen=True, eq=False)
class Ground:
    """A take made ready for the search.

    Attributes
    ----------
    positions : (frames, markers, 3) thinned, bridged where damaged, NaN where unseen
    known : (frames, markers, 3) bool
    trusted : (frames, markers) bool
    thin : every so manieth frame of the take
    """

    positions: FloatArray
    known: BoolArray
    trusted: BoolArray
    thin: int


def prepare(take: Take, markers: Sequence[int], sudden: Sequence[Artifact]) -> Ground:
    """Thin a take to about 120 Hz and mend what is known to be damaged.

    Parameters
    ----------
    take : the recording
    markers : columns to look at
    sudden : artifacts found already. Swaps are exchanged back and steps pushed back; peaks are
        bridged; what is noisy is bridged for itself, and not trusted where others are foretold
        from it
    """
    positions = take.positions.copy()
    known = np.repeat(take.present[:, :, None], 3, axis=2)
    trusted = take.present.copy()
    for a in sorted(sudden, key=lambda a: a.kind is not Kind.STEP):
        marker, rows, axes = take.index(a.marker), slice(a.start, a.stop), axis_columns(a.axes)
        if a.counterpart is not None:
            other = take.index(a.counterpart)
            positions[rows, [marker, other]] = positions[rows, [other, marker]]
            known[rows, [marker, other]] = ~np.isnan(positions[rows, [marker, other]])
            trusted[rows, [marker, other]] = known[rows, [marker, other], 0]
        elif a.kind is Kind.STEP:
            positions[rows, marker, axes] -= _height(positions[:, marker], a, axes)
        else:
            known[rows, marker, axes] = False
            if a.length > SHORT_S * take.rate:
                trusted[rows, marker] = False
    thin = _thinning(take)
    columns = list(markers)
    # Thinned after bridging, so that a peak next to a kept frame does not count twice.
    flat = bridge(
        positions[:, columns].reshape(take.frames, -1), known[:, columns].reshape(take.frames, -1)
    )
    whole = flat.reshape(take.frames, len(columns), 3)
    whole[~(known | take.present[:, :, None])[:, columns]] = np.nan
    return Ground(
        np.ascontiguousarray(whole[::thin]),
        known[::thin, columns],
        trusted[::thin, columns],
        thin,
    )


def _height(x: FloatArray, step: Artifact, axes: list[int]) -> FloatArray:
    """How far a step carries each of its axes, from both its edges, (axes,) mm."""
    edges = []
    for frame, sign in ((step.start, 1.0), (step.stop, -1.0)):
        around = x[max(0, frame - REACH) : frame + REACH, axes]
        before = min(frame, REACH)
        if len(around) < 2 * REACH or np.isnan(around).any():
            continue
        weights = fit_of(len(around), before, len(around)).size
        edges.append(sign * (weights @ (around - around[0])))
    return np.asarray(np.mean(edges, axis=0)) if edges else np.zeros(len(axes))


def scan_all(ground: Ground, jobs: int, progress: Progress) -> list[Candidates]:
    """Look for candidates on every marker, in several processes where that pays."""
    frames, markers = ground.positions.shape[:2]
    if not _searchable(frames, markers):
        return []
    spreads = distance_spreads(ground.positions, ground.trusted)
    each = (
        (ground.positions, m, ground.known[:, m], ground.trusted, spreads) for m in range(markers)
    )
    scans = []
    with in_processes(scan, each, _processes(frames, markers, jobs)) as results:
        for m, one in enumerate(results):
            progress(SCANNING * (m + 1) / markers, "slow changes")
            scans.append(one)
    return scans


def fill_all(ground: Ground, spots: Sequence[Spot], jobs: int, progress: Progress) -> FloatArray:
    """How unlike drifts candidates are once filled, (n,), in several processes where that pays."""
    frames, markers = ground.positions.shape[:2]
    uneven = np.zeros(len(spots))
    each = ((ground.positions, ground.trusted, RATE, spot) for spot in spots)
    with in_processes(unevenness, each, _processes(frames, markers, jobs)) as results:
        for n, one in enumerate(results):
            progress(SCANNING + (1.0 - SCANNING) * (n + 1) / len(spots), "slow changes, filled")
            uneven[n] = one
    return uneven


def _searchable(frames: int, markers: int) -> bool:
    """Whether a thinned take is long enough, and a body."""
    return frames >= 3 * LONGEST and markers >= 4


def _processes(frames: int, markers: int, jobs: int) -> int:
    """How many processes to take: on a small take one is done before others have begun."""
    return jobs if frames * markers >= PARALLEL_FROM else 1


def _thinning(take: Take) -> int:
    """Of how many frames one is looked at."""
    return max(1, round(take.rate / RATE))


def started(take: Take, markers: int, jobs: int) -> AbstractContextManager[None]:
    """Have the processes of :func:`find_drifts` started beside what is done in the block."""
    frames = -(-take.frames // _thinning(take))
    wanted = _processes(frames, markers, jobs) if _searchable(frames, markers) else 1
    return processes_start(scan.__module__, wanted)


@dataclass(frozen=True, eq=False)
class Crowd:
    """How loud candidates are on one take: a threshold that adapts to it.

    Attributes
    ----------
    each : of each marker the scores of its candidates, (n,) ascending
    together : of all markers, ascending
    minutes : length of the take
    """

    each: tuple[FloatArray, ...]
    together: FloatArray
    minutes: float

    def fill_in(self, candidates: Candidates, marker: int, *, among: bool = True) -> Candidates:
        """Count how many candidates are at least as loud, on the marker and on the take.

        Parameters
        ----------
        candidates : of the marker
        marker : which
        among : whether the candidates themselves are part of the crowd
        """
        rows = candidates.features.copy()
        own = rows[:, _LOUDNESS]
        for column, crowd, minutes in (
            (CROWDS[0], self.each[marker], self.minutes),
            (CROWDS[1], self.together, self.minutes * len(self.each)),
        ):
            louder = len(crowd) - np.searchsorted(crowd, own) - (1 if among else 0)
            rows[:, column] = np.log1p(np.maximum(louder, 0) / minutes)
        return replace(candidates, features=rows)


def crowd_of(scans: Sequence[Candidates], ground: Ground) -> Crowd:
    """Gather the scores of a take's candidates."""
    each = tuple(np.sort(one.features[:, _LOUDNESS]) for one in scans)
    minutes = len(ground.positions) / (60.0 * RATE)
    return Crowd(each, np.sort(np.concatenate(each)), minutes)


def find_drifts(
    ground: Ground,
    neighbours: IntArray,
    judge: Judge,
    least: float,
    jobs: int,
    progress: Progress,
) -> list[Drift]:
    """Find slow changes, the surest first.

    Parameters
    ----------
    ground : from :func:`prepare`
    neighbours : (markers, k) nearest other markers
    judge : what confidence was learned into
    least : smallest confidence
    jobs : processes
    progress : told after each marker; may raise to stop

    Returns
    -------
    Slow changes; on one coordinate they overlap by three tenths at most, and what is only the
    echo of a larger one on a neighbour is left out
    """
    scans = scan_all(ground, jobs, progress)
    if not sum(map(len, scans)):
        return []
    crowd = crowd_of(scans, ground)
    scans = [crowd.fill_in(one, marker) for marker, one in enumerate(scans)]
    features = np.concatenate([one.features for one in scans])
    odds = judge.trees.log_odds(features)
    levels = quiet_levels(odds, crowd.minutes * len(scans))
    likely = odds > LIKELY
    spots = [s for m, one in enumerate(scans) for s in spots_of(one, m)]
    spots = [spots[n] for n in np.flatnonzero(likely)]
    uneven = fill_all(ground, spots, jobs, progress)
    sure = judge.confidence(evidence(odds[likely], is_sharp(features[likely]), levels, uneven))
    sizes = np.abs(np.concatenate([one.size_mm for one in scans]))[likely]
    found = [
        Drift(s.marker, s.axis, s.start * ground.thin, s.stop * ground.thin, float(mm), float(p))
        for s, mm, p in zip(spots, sizes, sure, strict=True)
        if p >= least
    ]
    kept: list[Drift] = []
    for d in sorted(found, key=lambda d: (-d.confidence, d.marker, d.start)):
        if not any(_hidden(d, k, neighbours) for k in kept):
            kept.append(d)
    return kept


def spots_of(candidates: Candidates, marker: int) -> list[Spot]:
    """Where the candidates of a marker are."""
    kinds = [tuple(KINDS)[int(kind)] for kind in candidates.features[:, KIND]]
    places = zip(candidates.axis, candidates.start, candidates.stop, kinds, strict=True)
    return [Spot(marker, int(a), int(start), int(stop), k) for a, start, stop, k in places]


def _hidden(drift: Drift, surer: Drift, neighbours: IntArray) -> bool:
    """Whether a surer drift explains this one: the same place, or a neighbour that it follows."""
    shared = overlap((drift.start, drift.stop), (surer.start, surer.stop))
    if drift.marker == surer.marker:
        return drift.axis == surer.axis and shared > LARGEST_OVERLAP
    near = surer.marker in neighbours[drift.marker] or drift.marker in neighbours[surer.marker]
    return bool(near and shared > LARGEST_OVERLAP and drift.size_mm < LEAKED * surer.size_mm)


def drift_artifacts(take: Take, markers: Sequence[int], drifts: Sequence[Drift]) -> list[Artifact]:
    """Join drifts on the axes of one marker, and put each into words."""
    groups: list[list[Drift]] = []
    for d in drifts:
        for g in groups:
            same = d.marker == g[0].marker and all(d.axis != o.axis for o in g)
            if same and overlap((d.start, d.stop), (g[0].start, g[0].stop)) >= LARGEST_OVERLAP:
                g.append(d)
                break
        else:
            groups.append([d])
    artifacts = []
    for g in groups:
        start = min(d.start for d in g)
        stop = min(max(d.stop for d in g), take.frames)
        size = float(np.sqrt(sum(d.size_mm**2 for d in g)))
        artifacts.append(
            Artifact(
                take.labels[markers[g[0].marker]],
                "".join(AXES[axis] for axis in sorted(d.axis for d in g)),
                start,
                stop,
                Kind.SLOW,
                confidence=g[0].confidence,
                amplitude_mm=size,
                why=(
                    f"drifts {in_mm(size)} mm off the place its neighbours give it and returns, "
                    f"within {how_long(stop - start, take.rate)}"
                ),
            )
        )
    return artifacts


@lru_cache(maxsize=1)
def shipped_judge() -> Judge:
    """Read the judge that ships with Markermend (``models/slow.npz``)."""
    from importlib.resources import as_file, files

    with as_file(files("markermend_resources").joinpath("models", "slow.npz")) as path:
        return load_judge(path)
