"""Replaying lists of hidden gaps: how far each method is from what was hidden.

A list is JSON: one entry a simulation, with ``take`` (file name without suffix), ``protocol``,
``length`` in frames, ``gaps`` as ``[marker, start, stop]`` and, if known, the errors that others
reached on the same gaps under names that end in ``_mm``. Unlabelled trajectories are dropped.
"""

from __future__ import annotations

import csv
import json
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

import numpy as np

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
    filled : share of frames that were filled
    in_band : share of filled frames inside the 90 % band, NaN when the method gives none
    seconds : per gap
    """

    case: GapCase
    method: str
    error_mm: float
    filled: float
    in_band: float
    seconds: float

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
    take = read(path)
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
    inside: list[bool] = []
    frames = filled = 0
    began = time.perf_counter()
    for marker, start, stop in case.gaps:
        frames += stop - start
        gap = Artifact(marker, AXES, start, stop, Kind.GAP)
        repair = propose_from(evidence, gap, method=method)
        for patch in repair.patches:
            filled += stop - start
            miss = np.linalg.norm(
                patch.values - take.positions[start:stop, take.index(marker)], axis=1
            )
            errors.append(float(miss.mean()))
            if repair.band_mm is not None:
                inside.extend(miss <= BAND_90 * repair.band_mm)
    return GapResult(
        case,
        method,
        float(np.mean(errors)) if errors else float("nan"),
        filled / frames,
        float(np.mean(inside)) if inside else float("nan"),
        (time.perf_counter() - began) / len(case.gaps),
    )


@dataclass(frozen=True)
class GapRow:
    """Mean over the cases of one protocol and length, for one method.

    Attributes
    ----------
    protocol, length, method : what is summed up
    cases : how many
    error_mm : with unfilled frames counted as three times the reference's error
    reference_mm : mean error of the reference
    ratio : of the two
    filled, in_band, seconds : means of the results'
    """

    protocol: str
    length: int
    method: str
    cases: int
    error_mm: float
    reference_mm: float
    ratio: float
    filled: float
    in_band: float
    seconds: float


def summarise(results: Sequence[GapResult], reference: str = "pma") -> tuple[GapRow, ...]:
    """Mean errors by protocol, length and method, beside a reference known for the same gaps.

    Parameters
    ----------
    results : of :func:`replay`
    reference : name of the known error to compare with

    Raises
    ------
    DataError
        when a case does not know the reference's error
    """
    if any(reference not in r.case.known_mm for r in results):
        raise DataError(f"The list does not give the error of “{reference}” for every case.")
    rows = []
    keys = dict.fromkeys((r.case.protocol, r.case.length, r.method) for r in results)
    for protocol, length, method in sorted(keys):
        some = [
            r
            for r in results
            if (r.case.protocol, r.case.length, r.method) == (protocol, length, method)
        ]
        error = float(np.mean([r.penalised_mm(reference) for r in some]))
        other = float(np.mean([r.case.known_mm[reference] for r in some]))
        bands = [r.in_band for r in some if not np.isnan(r.in_band)]
        rows.append(
            GapRow(
                protocol,
                length,
                method,
                len(some),
                error,
                other,
                error / other,
                float(np.mean([r.filled for r in some])),
                float(np.mean(bands)) if bands else float("nan"),
                float(np.mean([r.seconds for r in some])),
            )
        )
    return tuple(rows)


def as_text(rows: Sequence[GapRow], reference: str = "pma") -> str:
    """Lay rows out as a table for a terminal."""
    lines = [
        f"{'protocol':<16}{'frames':>7}  {'method':<18}{'cases':>5}{'error mm':>10}"
        f"{reference + ' mm':>9}{'ratio':>7}{'filled':>8}{'in band':>9}{'ms':>7}"
    ]
    for r in rows:
        band = "" if np.isnan(r.in_band) else f"{100 * r.in_band:.0f} %"
        lines.append(
            f"{r.protocol:<16}{r.length:>7}  {r.method:<18}{r.cases:>5}{r.error_mm:>10.2f}"
            f"{r.reference_mm:>9.2f}{r.ratio:>7.2f}{100 * r.filled:>6.0f} %{band:>9}"
            f"{1000 * r.seconds:>7.0f}"
        )
    return "\n".join(lines)


def write_csv(results: Iterable[GapResult], file: TextIO) -> None:
    """Write one line for each case and method."""
    writer = csv.writer(file)
    writer.writerow(
        ["take", "protocol", "length", "gaps", "method", "error_mm", "filled", "in_band", "seconds"]
    )
    for r in results:
        c = r.case
        writer.writerow(
            [c.take, c.protocol, c.length, len(c.gaps), r.method]
            + [f"{v:.6g}" for v in (r.error_mm, r.filled, r.in_band, r.seconds)]
        )
