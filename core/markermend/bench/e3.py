"""E3: contaminate clean takes, detect, reconstruct, and compare with what was there.

skurowski2022, sections 4.1.2 and 4.2.3. Beyond the paper: our detector beside the published one,
the method that is chosen for each artifact beside one for all, and what repairs tell of their error
beside how far off they are.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray
from markermend.artifact import Artifact, Kind, axis_columns, damage_mask
from markermend.bench.e1 import Clean, bare
from markermend.bench.e3_paper import CLASSES, CLASSIFIED, DISTORTED, PERFECT, published
from markermend.bench.told import Told, beside_truth, mean_told
from markermend.detectors import detect, find_detector
from markermend.errors import DataError, MethodError
from markermend.mesh import infer_mesh
from markermend.patch import Patch, patched
from markermend.predictors.ffnn import FfnnParams, predict_ffnn
from markermend.processes import in_processes
from markermend.progress import Progress, quiet
from markermend.repairs import Repair, evidence_for, find_method, repair_all
from markermend.repairs.ffnn_loose import FfnnLooseParams
from markermend.simulation import contaminate
from markermend.take import Take, is_unlabelled

FFNN, AUTO = "ffnn", "auto"
REPAIRERS = ("linear", "savgol", "spline", FFNN, AUTO)
"""The published four and ours; any other method of the repairs may be named too."""


@dataclass(frozen=True)
class E3Row:
    """How far takes are off, damaged with one class or reconstructed in one way.

    Attributes
    ----------
    take : name
    share : of the frames that are damaged
    kind : class of the damage
    located : ``"distorted"`` before any repair, ``"perfect"`` where the truth says what is
        damaged, else the name of the detector that does
    method : reconstruction; empty for distorted
    simulations : how many
    rmse_mm : mean over simulations of (38), over all coordinates and samples
    spread_mm : standard deviation of it between simulations
    published_mm : what the paper prints; NaN where it has no such row
    seconds : mean time of detection and reconstruction
    repairs : how many tell how far off they may be, in all simulations
    told : what these say beside how far off they are, on average
    """

    take: str
    share: float
    kind: Kind
    located: str
    method: str
    simulations: int
    rmse_mm: float
    spread_mm: float
    published_mm: float
    seconds: float
    repairs: int
    told: Told


@dataclass(frozen=True)
class _Task:
    """One simulation."""

    clean: int
    share: float
    kind: Kind
    number: int


_Way = tuple[str, str]
"""Who located the damage, and what reconstructed it."""
_Result = tuple[float, float, list[Told]]
"""RMSE, seconds, and what the repairs told."""


def e3(
    takes: Sequence[Clean],
    *,
    detectors: Sequence[str] = ("paper", "joint"),
    params: Mapping[str, Any] | None = None,
    repairers: Sequence[str] = REPAIRERS,
    kinds: Sequence[str] = CLASSES,
    shares: Sequence[float] = (0.05, 0.1, 0.2),
    amplitude_mm: float = 10.0,
    all_classes: bool = False,
    simulations: int = 200,
    seed: int = 0,
    n_jobs: int = -1,
    progress: Progress | None = None,
) -> tuple[E3Row, ...]:
    """Damage takes with one class at a time, reconstruct, and measure what is left.

    Parameters
    ----------
    takes : clean recordings; what is damaged in them already is left out of every error
    detectors : names of detection methods, beside perfect classification
    params : parameters by detector, their defaults where not given
    repairers : ``"ffnn"`` for the network's prediction, ``"auto"`` for the method chosen for
        each artifact, or names of repair methods
    kinds : classes of damage, one at a time
    shares : damaged parts of the frames
    amplitude_mm : mean amplitude; its standard deviation is 0.4 of that
    all_classes : reconstruct everything a detector flags, not only what it calls the class
        that was planted
    simulations : per take, share and class
    seed : same seed, same result, on any number of processes
    n_jobs : processes; −1 for one a core
    progress : told the share of simulations done; may raise ``Cancelled``

    Returns
    -------
    For every take, share and class a row as damaged, then one for every way of locating and
    reconstructing

    Raises
    ------
    MethodError
        for an unknown detector, repair method or class
    DataError
        when a contamination does not fit into a take

    Notes
    -----
    skurowski2022, 4.1.2, 4.1.3 and equation 38. The published methods see the samples beside an
    artifact as they are; ``"auto"`` repairs as :func:`markermend.repairs.repair_all` does. With
    "all distortions simulated separately" we read the tables as reconstructing the planted class
    only: a straight line through the slow changes that the paper's detector flags wrongly costs
    0.225 mm in its own slow column (0.293 with actual, 0.188 with perfect classification), and
    its peak column has 0.039 mm in all.
    """
    if simulations < 1:
        raise MethodError("At least one simulation is needed.")
    chosen = {name: find_detector(name).params(jobs=1) for name in detectors} | dict(params or {})
    for name in repairers:
        if name not in (FFNN, AUTO):
            find_method(name)
    wanted = [_class(kind) for kind in kinds]
    tasks = [
        _Task(i, share, kind, number)
        for i in range(len(takes))
        for share in shares
        for kind in wanted
        for number in range(simulations)
    ]
    small = [bare(clean) for clean in takes]
    report = progress or quiet
    used = {name: chosen[name] for name in detectors}
    each = (
        (small[t.clean], t, used, tuple(repairers), amplitude_mm, all_classes, seed) for t in tasks
    )
    measured: dict[tuple[int, float, Kind], dict[_Way, list[_Result]]] = {}
    with in_processes(_simulate, each, n_jobs) as results:
        for done, (task, ways) in enumerate(zip(tasks, results, strict=True)):
            setting = measured.setdefault((task.clean, task.share, task.kind), {})
            for way, result in ways.items():
                setting.setdefault(way, []).append(result)
            report((done + 1) / len(tasks), f"{takes[task.clean].name}, {task.kind}")
    return tuple(
        _row(takes[i].name, share, kind, way, values)
        for (i, share, kind), ways in measured.items()
        for way, values in ways.items()
    )


def rmse(reconstructed: Take, original: Take, counted: BoolArray) -> float:
    """Root mean square error over coordinates and samples (skurowski2022, equation 38).

    Parameters
    ----------
    reconstructed, original : of the same shape
    counted : (frames, markers, 3) bool; samples missing in either are left out besides

    Returns
    -------
    mm; NaN when nothing is left to compare
    """
    difference = reconstructed.positions[counted] - original.positions[counted]
    known = difference[~np.isnan(difference)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else math.nan


def reconstruct(
    take: Take, artifacts: Iterable[Artifact], method: str
) -> tuple[Take, tuple[Repair, ...]]:
    """Reconstruct a take at the artifacts named, and nowhere else.

    Parameters
    ----------
    take : the damaged recording
    artifacts : where it is damaged; gaps are left
    method : one of :data:`REPAIRERS`, or the name of a repair method

    Returns
    -------
    The take, in which what a method cannot reconstruct stays as it is, and the repairs, of which
    the network makes none

    Raises
    ------
    MethodError
        for an unknown method
    """
    damaged = [a for a in artifacts if a.kind is not Kind.GAP]
    with threadpool_limits(1):
        if method == FFNN:
            return patched(take, _predicted(take, damaged)), ()
        if method == AUTO:
            done = tuple(repaired for _, repaired in repair_all(take, damaged))
        else:
            found = find_method(method)
            evidence, defaults = evidence_for(take, damaged), found.params()
            done = tuple(found.run(evidence, artifact, defaults) for artifact in damaged)
    return patched(take, (patch for repaired in done for patch in repaired.patches)), done


def _predicted(take: Take, artifacts: Sequence[Artifact]) -> Iterator[Patch]:
    """The network's prediction at the artifacts, trained once a marker on what is believed."""
    mesh = infer_mesh(take)
    trusted = evidence_for(take, artifacts, mesh).trusted
    shape = FfnnParams(iterations=FfnnLooseParams().iterations)
    for marker in dict.fromkeys(a.marker for a in artifacts):
        column = take.index(marker)
        try:
            predicted = predict_ffnn(take, mesh, column, trusted=trusted, params=shape)
        except DataError:
            continue
        for a in artifacts:
            rows = slice(a.start, a.stop)
            values = predicted[rows, axis_columns(a.axes)]
            whole = take.present[rows, column].all() and not np.isnan(values).any()
            if a.marker == marker and whole:
                yield Patch(marker, a.axes, a.start, a.stop, values)


def _simulate(
    clean: Clean,
    task: _Task,
    detectors: Mapping[str, Any],
    repairers: Sequence[str],
    amplitude_mm: float,
    all_classes: bool,
    seed: int,
) -> dict[_Way, _Result]:
    """Contaminate once and reconstruct in every way."""
    take = clean.take
    named = np.array([not is_unlabelled(label) for label in take.labels])
    damaged, truth = contaminate(
        take,
        share=task.share,
        amplitude_mm=amplitude_mm,
        kinds=[task.kind],
        markers=[label for label in take.labels if not is_unlabelled(label)],
        seed=int(np.random.SeedSequence((seed, task.number)).generate_state(1)[0]),
    )
    counted = ~damage_mask(take, clean.flaws) & named[:, None]
    ways: dict[_Way, _Result] = {(DISTORTED, ""): (rmse(damaged, take, counted), 0.0, [])}
    places: dict[str, tuple[tuple[Artifact, ...], float]] = {PERFECT: (truth, 0.0)}
    for name, params in detectors.items():
        began = time.perf_counter()
        found = detect(damaged, method=name, params=params)
        wanted = tuple(a for a in found if all_classes or a.kind is task.kind)
        places[name] = (wanted, time.perf_counter() - began)
    for located, (artifacts, searched) in places.items():
        for method in repairers:
            began = time.perf_counter()
            result, repairs = reconstruct(damaged, artifacts, method)
            seconds = searched + time.perf_counter() - began
            told = beside_truth(repairs, take, counted)
            ways[located, method] = (rmse(result, take, counted), seconds, told)
    return ways


def _row(take: str, share: float, kind: Kind, way: _Way, results: Sequence[_Result]) -> E3Row:
    """Mean and spread over the simulations of one setting."""
    located, method = way
    errors, seconds = np.array([result[:2] for result in results]).T
    told = [one for result in results for one in result[2]]
    where = located if located in (DISTORTED, PERFECT) else CLASSIFIED
    return E3Row(
        take=take,
        share=share,
        kind=kind,
        located=located,
        method=method,
        simulations=len(results),
        rmse_mm=float(errors.mean()),
        spread_mm=float(errors.std(ddof=1)) if len(results) > 1 else math.nan,
        published_mm=published(share, where, method, kind),
        seconds=float(seconds.mean()),
        repairs=len(told),
        told=mean_told(told),
    )


def _class(name: str) -> Kind:
    """A class of damage by name."""
    for kind in CLASSES:
        if kind == name:
            return kind
    raise MethodError(f"E3 knows the classes {', '.join(CLASSES)}, not “{name}”.")
