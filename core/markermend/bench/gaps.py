"""Replaying lists of hidden gaps: how far each method is from what was hidden.

A list is JSON: one entry a simulation, with ``take`` (file name without suffix), ``protocol``,
``length`` in frames, ``gaps`` as ``[marker, start, stop]`` and, if known, the errors that others
reached on the same gaps under names that end in ``_mm``. Unlabelled trajectories are dropped.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind
from markermend.bench.told import WITHIN_90
from markermend.errors import DataError, FileFormatError
from markermend.files.opening import not_opened
from markermend.processes import in_processes
from markermend.progress import Progress, quiet
from markermend.repairs import evidence_for, propose_from
from markermend.take import AXES, Take, is_unlabelled

# A frame that a method leaves empty counts as this many times the reference's error.
UNFILLED = 3.0
# A 90 % band in root-mean-square deviations of a three-dimensional Gaussian error.
BAND_90 = WITHIN_90[2]


@dataclass(frozen=True)
class GapCase:
    """Gaps hidden in one take at once.

    Attributes
    ----------
    take : file name without folder and suffix
    protocol : experiment it belongs to
    length : of the gaps, in frames, as the experiment names it
    gaps : (marker, start, stop), half-open 0-based frames
    known_mm : errors that others reached on these gaps, by name
    within : part of the take that is used, half-open frames; None for all of it
    """

    take: str
    protocol: str
    length: int
    gaps: tuple[tuple[str, int, int], ...]
    known_mm: Mapping[str, float]
    within: tuple[int, int] | None = None


@dataclass(frozen=True)
class GapResult:
    """What one method made of one case.

    Attributes
    ----------
    case : the gaps
    method : name in the registry, or ``"auto"``
    error_mm : mean over the gaps of the mean Euclidean distance over filled frames, NaN if none
    rmse_mm : root mean square over all filled samples and coordinates, NaN if none
    filled : share of frames that were filled
    in_band : share of filled frames inside the 90 % band, NaN when the method gives none
    seconds : per gap
    gap_rmse_mm, gap_samples : root mean square error of each filled gap, and its coordinates
    gap_weights : numbers that were learnt for each filled gap
    """

    case: GapCase
    method: str
    error_mm: float
    rmse_mm: float
    filled: float
    in_band: float
    seconds: float
    gap_rmse_mm: tuple[float, ...] = ()
    gap_samples: tuple[int, ...] = ()
    gap_weights: tuple[int, ...] = ()

    def penalised_mm(self, reference: str) -> float:
        """Error with every unfilled frame counted as three times a reference's error."""
        filled_part = 0.0 if self.filled == 0 else self.filled * self.error_mm
        return filled_part + (1.0 - self.filled) * UNFILLED * self.case.known_mm[reference]


def read_cases(path: str | Path) -> tuple[GapCase, ...]:
    """Read a list of gaps.

    Raises
    ------
    FileFormatError
        when the file is not such a list
    """
    try:
        entries = json.loads(Path(path).read_text(encoding="utf-8"))
        return tuple(_case(entry) for entry in entries)
    except OSError as error:
        raise not_opened(Path(path), error) from error
    except (ValueError, KeyError, TypeError) as error:
        raise FileFormatError(
            f"“{path}” is no list of gaps to replay, each with take, protocol, length and gaps as"
            " [marker, start, stop]; “markermend bench gaps” draws its own without --list."
        ) from error


def _case(entry: Mapping[str, Any]) -> GapCase:
    """One entry of the list."""
    gaps = tuple((str(m), int(start), int(stop)) for m, start, stop in entry["gaps"])
    known = {k.removesuffix("_mm"): float(v) for k, v in entry.items() if k.endswith("_mm")}
    return GapCase(str(entry["take"]), str(entry["protocol"]), int(entry["length"]), gaps, known)


def only_named(take: Take) -> Take:
    """The take without its unlabelled trajectories."""
    named = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    return Take(take.positions[:, named], tuple(take.labels[i] for i in named), take.rate)


def replay(
    cases: Sequence[GapCase],
    takes: Mapping[str, Take],
    methods: Iterable[str] = ("auto",),
    *,
    params: Mapping[str, Mapping[str, Any]] | None = None,
    n_jobs: int = 1,
    progress: Progress | None = None,
) -> tuple[GapResult, ...]:
    """Hide the gaps of each case together, fill each one, and measure.

    Parameters
    ----------
    cases : what to hide
    takes : complete takes by name
    methods : names in the registry, or ``"auto"``
    params : of a method by its name, where they are not the defaults
    n_jobs : processes; −1 for one a core
    progress : told the share of fills done; may raise ``Cancelled``

    Returns
    -------
    One result for each case and method, in that order.

    Raises
    ------
    DataError
        when a case hides what was never seen, so that nothing tells how far off a fill is
    """
    for case in cases:
        _check_known(case, takes[case.take])
    chosen = params or {}
    tasks = [(case, name) for case in cases for name in dict.fromkeys(methods)]
    report = progress or quiet
    each = ((case, takes[case.take], name, chosen.get(name)) for case, name in tasks)
    results = []
    with in_processes(_replay_one, each, n_jobs) as done:
        for i, ((case, name), result) in enumerate(zip(tasks, done, strict=True)):
            results.append(result)
            report((i + 1) / len(tasks), f"{case.protocol}, {case.length} frames, {name}")
    return tuple(results)


def _check_known(case: GapCase, take: Take) -> None:
    """Refuse gaps over frames of which the truth is not known."""
    for marker, start, stop in case.gaps:
        if np.isnan(take.positions[start:stop, take.index(marker)]).any():
            raise DataError(
                f"The gap of {marker} at index {start} to {stop} of {case.take} lies where it was"
                " not seen, so that there is nothing to compare a fill with; take it out of the"
                " list."
            )


def _replay_one(
    case: GapCase, take: Take, method: str, params: Mapping[str, Any] | None
) -> GapResult:
    """Hide, fill and measure one case with one method."""
    first, last = case.within or (0, take.frames)
    truth = take.positions[first:last]
    gaps = [(m, start - first, stop - first) for m, start, stop in case.gaps]
    holed = truth.copy()
    for marker, start, stop in gaps:
        holed[start:stop, take.index(marker)] = np.nan
    evidence = evidence_for(Take(holed, take.labels, take.rate))
    errors: list[float] = []
    squares: list[FloatArray] = []
    weights: list[int] = []
    inside: list[bool] = []
    frames = filled = 0
    began = time.perf_counter()
    for marker, start, stop in gaps:
        frames += stop - start
        gap = Artifact(marker, AXES, start, stop, Kind.GAP)
        repair = propose_from(evidence, gap, method=method, params=params)
        for patch in repair.patches:
            filled += stop - start
            miss = patch.values - truth[start:stop, take.index(marker)]
            distance = np.linalg.norm(miss, axis=1)
            errors.append(float(distance.mean()))
            squares.append(miss.ravel() ** 2)
            weights.append(repair.weights)
            if repair.band_mm is not None:
                inside.extend(distance <= BAND_90 * repair.band_mm)
    return GapResult(
        case,
        method,
        float(np.mean(errors)) if errors else float("nan"),
        float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else float("nan"),
        filled / frames,
        float(np.mean(inside)) if inside else float("nan"),
        (time.perf_counter() - began) / len(gaps),
        tuple(float(np.sqrt(np.mean(s))) for s in squares),
        tuple(len(s) for s in squares),
        tuple(weights),
    )


@dataclass(frozen=True)
class GapRow:
    """Mean over the cases of one protocol and length, for one method.

    Attributes
    ----------
    protocol, length, method : what is summed up
    cases : how many
    error_mm : mean error; with a reference, unfilled frames count as three times the reference's
    rmse_mm : mean of the cases' root mean squares
    reference_mm : mean error of the reference, NaN without one
    ratio : of the two errors
    filled, in_band, seconds : means of the results'
    """

    protocol: str
    length: int
    method: str
    cases: int
    error_mm: float
    rmse_mm: float
    reference_mm: float
    ratio: float
    filled: float
    in_band: float
    seconds: float


def summarise(results: Sequence[GapResult], reference: str | None = "pma") -> tuple[GapRow, ...]:
    """Mean errors by protocol, length and method, beside a reference known for the same gaps.

    Parameters
    ----------
    results : of :func:`replay`
    reference : name of the known error to compare with, or None

    Raises
    ------
    DataError
        when a case does not know the reference's error
    """
    if reference is not None and any(reference not in r.case.known_mm for r in results):
        raise DataError(f"The list does not give the error of “{reference}” for every case.")
    rows = []
    keys = dict.fromkeys((r.case.protocol, r.case.length, r.method) for r in results)
    for protocol, length, method in sorted(keys):
        some = [
            r
            for r in results
            if (r.case.protocol, r.case.length, r.method) == (protocol, length, method)
        ]
        if reference is None:
            error, other = _mean(r.error_mm for r in some), float("nan")
        else:
            error = _mean(r.penalised_mm(reference) for r in some)
            other = _mean(r.case.known_mm[reference] for r in some)
        rows.append(
            GapRow(
                protocol,
                length,
                method,
                len(some),
                error,
                _mean(r.rmse_mm for r in some),
                other,
                error / other,
                _mean(r.filled for r in some),
                _mean(r.in_band for r in some),
                _mean(r.seconds for r in some),
            )
        )
    return tuple(rows)


def _mean(values: Iterable[float]) -> float:
    """Mean of what is not NaN, NaN when nothing is left."""
    known = [v for v in values if not np.isnan(v)]
    return float(np.mean(known)) if known else float("nan")
