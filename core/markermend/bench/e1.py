"""E1: contaminate clean takes in a known way, detect, and compare by sample and by event.

skurowski2022, section 4.1. Beyond the paper: counts by event, false alarms on the untouched
take, calibration, and generic outlier detectors on the same simulations.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, ByteArray
from markermend.artifact import Artifact, Kind, damage_mask
from markermend.bench.confusion import OUTLIER, Confusion, class_map, confuse, nothing
from markermend.bench.events import Events, count_events, no_events
from markermend.detectors import detect, find_detector
from markermend.detectors.baselines import hampel, moving_three_sigma
from markermend.errors import MethodError
from markermend.processes import in_processes
from markermend.progress import Progress, quiet
from markermend.simulation import contaminate
from markermend.take import Take, is_unlabelled

COMPANIONS: Mapping[str, tuple[Callable[[Any, int], BoolArray], int]] = {
    f"{name} {window}": (flag, window)
    for name, flag in (("three-sigma", moving_three_sigma), ("hampel", hampel))
    for window in (7, 15, 31, 61)
}
"""Outlier detectors with their window in frames; the paper's four windows are in a picture."""
SUDDEN = (Kind.PEAK, Kind.NOISE, Kind.STEP)


@dataclass(frozen=True)
class Clean:
    """A take to contaminate.

    Attributes
    ----------
    name : for the table
    take : the recording
    flaws : what is truly damaged in it already; those samples are left out of every count
    """

    name: str
    take: Take
    flaws: tuple[Artifact, ...] = ()


@dataclass(frozen=True, eq=False)
class E1Row:
    """What one detector did on all simulations of one setting.

    Attributes
    ----------
    take, method : names
    share, amplitude_mm : of the contamination; 0 for the untouched take
    simulations : how many
    confusion : by sample; sudden artifacts drawn under the least amplitude are left out
    small : by sample, those artifacts alone
    events : by artifact; empty for detectors that name no class
    seconds : mean time of a detection
    """

    take: str
    method: str
    share: float
    amplitude_mm: float
    simulations: int
    confusion: Confusion
    small: Confusion
    events: Events
    seconds: float


@dataclass(frozen=True)
class _Task:
    """One simulation with one detector."""

    clean: int
    method: str
    share: float
    amplitude_mm: float
    number: int


def e1(
    takes: Sequence[Clean],
    *,
    methods: Sequence[str] = ("joint",),
    params: Mapping[str, Any] | None = None,
    shares: Sequence[float] = (0.05, 0.1, 0.2),
    amplitudes_mm: Sequence[float] = (5.0, 10.0),
    simulations: int = 100,
    rounded: int = 0,
    seed: int = 0,
    least_mm: float = 1.0,
    n_jobs: int = -1,
    progress: Progress | None = None,
) -> tuple[E1Row, ...]:
    """Contaminate takes as skurowski2022 does, detect, and count.

    Parameters
    ----------
    takes : clean recordings, with what is damaged in them already
    methods : names of detection methods, or of :data:`COMPANIONS`
    params : parameters by method, their defaults where not given
    shares, amplitudes_mm : settings of the contamination, each with each
    simulations : per setting; the same ones for every method
    rounded : frames over which the kinks of slow changes are rounded; 0 as the paper has them
    seed : same seed, same result, on any number of processes
    least_mm : sudden artifacts drawn smaller are counted apart
    n_jobs : processes; −1 for one a core
    progress : told the share of simulations done; may raise ``Cancelled``

    Returns
    -------
    A row for every take and method untouched, then one for every share and amplitude

    Raises
    ------
    MethodError
        for an unknown method
    DataError, MethodError
        when a contamination does not fit into a take

    Notes
    -----
    skurowski2022, sections 4.1.1 to 4.1.3.
    """
    for method in methods:
        if method not in COMPANIONS:
            find_detector(method)
    if simulations < 1:
        raise MethodError("At least one simulation is needed.")
    settings = [(0.0, 0.0)] + [(share, mm) for share in shares for mm in amplitudes_mm]
    tasks = [
        _Task(i, method, share, mm, number)
        for i in range(len(takes))
        for method in methods
        for share, mm in settings
        for number in range(simulations if share else 1)
    ]
    small = [bare(clean) for clean in takes]
    chosen = dict(params or {})
    report = progress or quiet
    each = ((small[t.clean], t, chosen.get(t.method), rounded, seed, least_mm) for t in tasks)
    rows: dict[tuple[int, str, float, float], E1Row] = {}
    with in_processes(_simulate, each, n_jobs) as counted:
        for done, (task, row) in enumerate(zip(tasks, counted, strict=True)):
            key = (task.clean, task.method, task.share, task.amplitude_mm)
            rows[key] = _joined(rows[key], row) if key in rows else row
            report((done + 1) / len(tasks), f"{row.take}, {row.method}")
    return tuple(rows.values())


def bare(clean: Clean) -> Clean:
    """Keep only what detection looks at, so that little travels between processes."""
    take = clean.take
    looked_at = Take(
        take.positions,
        take.labels,
        take.rate,
        residuals=take.residuals,
        cameras=take.cameras,
        origin=take.origin,
    )
    return Clean(clean.name, looked_at, clean.flaws)


def _simulate(
    clean: Clean, task: _Task, params: Any, rounded: int, seed: int, least_mm: float
) -> E1Row:
    """Contaminate, detect and count, once."""
    take = clean.take
    truth: tuple[Artifact, ...] = ()
    if task.share:
        labels = [label for label in take.labels if not is_unlabelled(label)]
        number = int(np.random.SeedSequence((seed, task.number)).generate_state(1)[0])
        take, truth = contaminate(
            take,
            share=task.share,
            amplitude_mm=task.amplitude_mm,
            rounded=rounded,
            markers=labels,
            seed=number,
        )
    with threadpool_limits(1):
        began = time.perf_counter()
        found_map, found = _found(take, task.method, params)
        seconds = time.perf_counter() - began
    big = [a for a in truth if a.kind not in SUDDEN or a.amplitude_mm >= least_mm]
    small = [a for a in truth if a not in big]
    true, small_map = class_map(take, big), class_map(take, small)
    known = damage_mask(take, clean.flaws)
    left_out = known | (small_map > 0) | ~take.present[:, :, None]
    if task.method in COMPANIONS:
        events = no_events()
    else:
        damaged = (true > 0) | left_out
        events = count_events(take, big, found, found_map, damaged, left_out)
    return E1Row(
        take=clean.name,
        method=task.method,
        share=task.share,
        amplitude_mm=task.amplitude_mm,
        simulations=1,
        confusion=confuse(true, found_map, ~left_out),
        small=confuse(small_map, found_map, (small_map > 0) & ~known),
        events=events,
        seconds=seconds,
    )


def _found(take: Take, method: str, params: Any) -> tuple[ByteArray, tuple[Artifact, ...]]:
    """Class of every sample by one method, and its artifacts if it names any."""
    if method in COMPANIONS:
        flag, window = COMPANIONS[method]
        flags = flag(take.positions, window)
        return np.where(flags, OUTLIER, 0).astype(np.uint8), ()
    found = detect(take, method=method, params=params)
    return class_map(take, found), found


def _joined(a: E1Row, b: E1Row) -> E1Row:
    """Two rows of the same setting as one."""
    n = a.simulations + b.simulations
    return E1Row(
        take=a.take,
        method=a.method,
        share=a.share,
        amplitude_mm=a.amplitude_mm,
        simulations=n,
        confusion=a.confusion + b.confusion,
        small=a.small + b.small,
        events=a.events + b.events,
        seconds=(a.seconds * a.simulations + b.seconds * b.simulations) / n,
    )


def pooled(rows: Sequence[E1Row]) -> tuple[Confusion, Events]:
    """Add up the counts of several rows."""
    confusion, events = nothing(), no_events()
    for row in rows:
        confusion, events = confusion + row.confusion, events + row.events
    return confusion, events
