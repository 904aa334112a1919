"""Tables and CSV of the smoothing experiments."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from itertools import groupby

from markermend.bench.smooth import ORACLE, SmoothRow
from markermend.bench.smooth_paper import SINE_BEFORE, PaperRow

_CSV = (
    "truth",
    "noise",
    "noise_mm",
    "method",
    "setting",
    "position_mm",
    "velocity_mm_s",
    "acceleration_m_s2",
)


def paper_table(rows: Sequence[PaperRow]) -> list[str]:
    """Write rows of the published tables beside the published figures."""
    lines: list[str] = []
    for signal, group in groupby(rows, key=lambda row: row.signal):
        cells: list[tuple[str, ...]] = [
            ("", "SM1", "paper", "SM2", "paper", "%SM1", "paper", "%SM2", "paper")
        ]
        some = list(group)
        known = SINE_BEFORE if some[0].published_after else None
        cells.append(("before", *_pairs(some[0].before, known), "", "", "", ""))
        for row in some:
            after = _pairs(row.after, row.published_after)
            cells.append((row.method, *after, *_pairs(row.percent, row.published_percent)))
        lines += [f"ardestani2022, {signal}", *_aligned(cells), ""]
    return lines


def truth_table(rows: Sequence[SmoothRow]) -> list[str]:
    """Write the errors, a block for each truth and noise, then how ``auto`` compares."""
    lines: list[str] = []
    for (truth, noise, noise_mm), group in groupby(rows, key=_case):
        cells: list[tuple[str, ...]] = [("", "", "mm", "mm/s", "m/s²")]
        cells += [
            (
                row.method,
                row.setting,
                f"{row.position_mm:.3f}",
                f"{row.velocity_mm_s:.2f}",
                f"{row.acceleration_m_s2:.3f}",
            )
            for row in group
        ]
        lines += [f"{truth}, {noise} noise of {noise_mm:g} mm", *_aligned(cells, left=2), ""]
    return lines + _compared(rows)


def smooth_csv(rows: Sequence[SmoothRow]) -> str:
    """Write one line a row."""
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(_CSV)
    for row in rows:
        errors = (row.position_mm, row.velocity_mm_s, row.acceleration_m_s2)
        case = (row.truth, row.noise, f"{row.noise_mm:g}", row.method, row.setting)
        out.writerow((*case, *(f"{error:.6g}" for error in errors)))
    return text.getvalue()


def _compared(rows: Sequence[SmoothRow]) -> list[str]:
    """Errors of ``auto`` over those of what it should beat."""
    rivals = {
        "better oracle of B-spline and Butterworth": [("bspline", ORACLE), ("butterworth", ORACLE)],
        "Whittaker–Henderson by maximum likelihood": [("whittaker", "")],
    }
    cells: list[tuple[str, ...]] = [("auto over", "", "position", "velocity", "acceleration")]
    for (truth, noise, noise_mm), group in groupby(rows, key=_case):
        found = {(row.method, row.setting): _three(row) for row in group}
        for name, keys in rivals.items():
            others = [found[key] for key in keys if key in found]
            if ("auto", "") not in found or not others:
                continue
            best = [min(values) for values in zip(*others, strict=True)]
            ratios = [own / other for own, other in zip(found["auto", ""], best, strict=True)]
            case = f"{truth}, {noise}, {noise_mm:g} mm"
            cells.append((name, case, *(f"{ratio:.2f}" for ratio in ratios)))
    cells[1:] = sorted(cells[1:], key=lambda row: row[0])
    return _aligned(cells, left=2) if len(cells) > 1 else []


def _case(row: SmoothRow) -> tuple[str, str, float]:
    return row.truth, row.noise, row.noise_mm


def _three(row: SmoothRow) -> tuple[float, float, float]:
    return row.position_mm, row.velocity_mm_s, row.acceleration_m_s2


def _pairs(own: tuple[float, float], paper: tuple[float, float] | None) -> tuple[str, ...]:
    """Ours and the paper's, twice."""
    cells: list[str] = []
    for i, value in enumerate(own):
        cells += [f"{value:.2f}", "–" if paper is None else f"{paper[i]:.2f}"]
    return tuple(cells)


def _aligned(cells: Sequence[Sequence[str]], left: int = 1) -> list[str]:
    """Columns of equal width, indented; the first ones to the left, the others to the right."""
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    return [
        "  "
        + "  ".join(
            cell.ljust(width) if i < left else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in cells
    ]
