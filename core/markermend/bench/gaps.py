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
from markermend.errors import DataError, FileFormatError
from markermend.progress import Progress, quiet
from markermend.repairs import evidence_for, propose_from
from markermend.take import AXES, Take, is_unlabelled

# A frame that a method leaves empty counts as this many times the reference's error.
UNFILLED = 3.0
# A 90 % band in root-mean-square deviations of a three-dimensional Gaussian error.
BAND_90 = 1.4434


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
    """

    take: str
    protocol: str
    length: int
    gaps: tuple[tuple[str, int, int], ...]
    known_mm: Mapping[str, float]


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
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise FileFormatError(f"{path} is no list of gaps to replay ({error}).") from error


def _case(entry: Mapping[str, Any]) -> GapCase:
    """One entry of the list."""
    gaps = tuple((str(m), int(start), int(stop)) for m, start, stop in entry["gaps"])
    known = {k.removesuffix("_mm"): float(v) for k, v in entry.items() if k.endswith("_mm")}
    return GapCase(str(entry["take"]), str(entry["protocol"]), int(entry["length"]), gaps, known)


def read_named(name: str, folder: str | Path) -> Take:
    """Find a take by name anywhere below a folder, and keep its named markers.

    Raises
    ------
    DataError
        when there is no such file
    """
    from markermend.files import read

    path = next(iter(sorted(Path(folder).rglob(f"{name}.c3d"))), None)
    if path is None:
        raise DataError(f"There is no {name}.c3d below {folder}.")
    return only_named(read(path))


def only_named(take: Take) -> Take:
    """The take without its unlabelled trajectories."""
    named = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    return Take(take.positions[:, named], tuple(take.labels[i] for i in named), take.rate)


def replay(
    cases: Sequence[GapCase],
    takes: Mapping[str, Take],
    methods: Iterable[str] = ("auto",),
    *,
    progress: Progress | None = None,
) -> tuple[GapResult, ...]:
    """Hide the gaps of each case together, fill each one, and measure.

    Parameters
    ----------
    cases : what to hide
    takes : complete takes by name
    methods : names in the registry, or ``"auto"``
    progress : told the share of cases done; may raise ``Cancelled``

    Returns
    -------
    One result for each case and method, in that order.
    """
    report, names = progress or quiet, tuple(methods)
    results = []
    for i, case in enumerate(cases):
        report(i / len(cases), f"{case.protocol}, {case.length} frames")
        results += [_replay_one(case, takes[case.take], name) for name in names]
    report(1.0, "Replayed")
    return tuple(results)


def _replay_one(case: GapCase, take: Take, method: str) -> GapResult:
    """Hide, fill and measure one case with one method."""
    holed = take.positions.copy()
    for marker, start, stop in case.gaps:
        holed[start:stop, take.index(marker)] = np.nan
    evidence = evidence_for(Take(holed, take.labels, take.rate))
    errors: list[float] = []
    squares: list[FloatArray] = []
    inside: list[bool] = []
    frames = filled = 0
    began = time.perf_counter()
    for marker, start, stop in case.gaps:
        frames += stop - start
        gap = Artifact(marker, AXES, start, stop, Kind.GAP)
        repair = propose_from(evidence, gap, method=method)
        for patch in repair.patches:
            filled += stop - start
            miss = patch.values - take.positions[start:stop, take.index(marker)]
            distance = np.linalg.norm(miss, axis=1)
            errors.append(float(distance.mean()))
            squares.append(miss.ravel() ** 2)
            if repair.band_mm is not None:
                inside.extend(distance <= BAND_90 * repair.band_mm)
    return GapResult(
        case,
        method,
        float(np.mean(errors)) if errors else float("nan"),
        float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else float("nan"),
        filled / frames,
        float(np.mean(inside)) if inside else float("nan"),
        (time.perf_counter() - began) / len(case.gaps),
        tuple(float(np.sqrt(np.mean(s))) for s in squares),
        tuple(len(s) for s in squares),
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


# Protocols as published: gaps at a time, lengths in frames at 100 Hz or in seconds.
POISSON_FRAMES = (10, 20, 50, 100, 200)
CONCOMITANT_S = (0.5, 1.0, 2.0, 5.0)
CONCOMITANT_COUNTS = (1, 3, 6, 10, 20)
PROTOCOLS = ("skurowski2021", "tits2018", "tits2018-count", "single", "blackout")
# Of our own, from short to long: one marker alone, and no marker at all.
ALONE_S = (0.1, 0.2, 0.5, 1.0, 2.0, 4.0)
BLACKOUT_S = (0.1, 0.2, 0.5, 1.0, 2.0)


def draw_cases(
    takes: Mapping[str, Take], protocol: str, *, simulations: int, seed: int
) -> tuple[GapCase, ...]:
    """Place gaps at random as a paper does.

    ``skurowski2021``: two gaps of Poisson length with means 10 to 200 frames; ``tits2018``: three
    markers at once for 0.5 to 5 s; ``tits2018-count``: 1 to 20 markers at once for 1 s. Of our own
    are ``single``, one marker for 0.1 to 4 s, and ``blackout``, all markers for 0.1 to 2 s.

    Parameters
    ----------
    takes : by name; what a take has no room for is left out
    protocol : of :data:`PROTOCOLS`
    simulations : for each take and setting
    seed : same seed, same gaps

    Raises
    ------
    DataError
        when there is no such protocol
    """
    from markermend.simulation.gap_placement import place_gaps

    cases = []
    for name, take in takes.items():
        for number, (label, length, count, together) in enumerate(_settings(protocol, take)):
            for i in range(simulations):
                try:
                    _, gaps = place_gaps(
                        take,
                        count=count,
                        mean_length=length,
                        concomitant=together,
                        fixed_length=protocol != "skurowski2021",
                        seed=seed + 1000 * number + i,
                    )
                except DataError:
                    break
                hidden = tuple((g.marker, g.start, g.stop) for g in gaps)
                cases.append(GapCase(name, label, round(length), hidden, {}))
    return tuple(cases)


def _settings(protocol: str, take: Take) -> list[tuple[str, float, int, int]]:
    """Label, length in frames, intervals and markers at once for each setting."""
    rate = take.rate
    if protocol == "skurowski2021":
        return [(protocol, float(n), 2, 1) for n in POISSON_FRAMES]
    if protocol == "tits2018":
        return [("3 at once", s * rate, 1, 3) for s in CONCOMITANT_S]
    if protocol == "tits2018-count":
        return [(f"{n} at once", rate, 1, n) for n in CONCOMITANT_COUNTS]
    if protocol == "single":
        return [("1 at once", s * rate, 1, 1) for s in ALONE_S]
    if protocol == "blackout":
        return [("all at once", s * rate, 1, take.markers) for s in BLACKOUT_S]
    known = ", ".join(PROTOCOLS)
    raise DataError(f"There is no protocol “{protocol}”; choose one of {known}.")
