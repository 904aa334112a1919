"""Whether the constraints of model averaging pay: the same gaps filled with and without them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import ttest_rel

from markermend.bench.gap_protocols import concomitant_cases
from markermend.bench.gaps import GapResult, replay
from markermend.errors import MethodError
from markermend.progress import Progress, quiet
from markermend.take import Take

SETTINGS = ((3, 1.0), (10, 5.0))
"""Markers missing at once, and for how many seconds (Tits and others, 2018)."""


@dataclass(frozen=True)
class ConstraintRow:
    """Model averaging with and without constraints, at one setting.

    Attributes
    ----------
    together, seconds : markers missing at once, and for how long
    cases : simulations that both filled
    on_mm, off_mm : mean over cases of the mean distance from the truth
    t, p : of the paired t-test, two-sided; negative where constraints help; NaN under two cases
    """

    together: int
    seconds: float
    cases: int
    on_mm: float
    off_mm: float
    t: float
    p: float


def compare_constraints(
    takes: Mapping[str, Take],
    *,
    simulations: int,
    seed: int,
    n_jobs: int = 1,
    progress: Progress | None = None,
) -> tuple[ConstraintRow, ...]:
    """Fill the same gaps with ``pma``, its continuity and spacing (eqs. 16-19, 25-27) on and off.

    Parameters
    ----------
    takes : complete takes by name
    simulations : for each take and setting; the paper has 200 in all
    seed : same seed, same gaps
    n_jobs : processes; −1 for one a core
    progress : told the share done; may raise ``Cancelled``

    Raises
    ------
    DataError
        when a take has no room for a setting
    MethodError
        when no simulation is asked for
    """
    if simulations < 1:
        raise MethodError("At least one simulation is needed.")
    report = progress or quiet
    # All gaps are placed before the first is filled: what does not fit is told at once.
    drawn = [
        concomitant_cases(takes, together, seconds, simulations=simulations, seed=seed)
        for together, seconds in SETTINGS
    ]
    rows, parts = [], 2 * len(SETTINGS)
    for n, ((together, seconds), cases) in enumerate(zip(SETTINGS, drawn, strict=True)):
        on, off = (
            replay(
                cases,
                takes,
                ["pma"],
                params={"pma": {"constraints": constrained}},
                n_jobs=n_jobs,
                progress=lambda share, text, part=2 * n + k: report((part + share) / parts, text),  # type: ignore[misc]
            )
            for k, constrained in enumerate((True, False))
        )
        rows.append(_row(together, seconds, on, off))
    return tuple(rows)


def _row(
    together: int, seconds: float, on: tuple[GapResult, ...], off: tuple[GapResult, ...]
) -> ConstraintRow:
    """Both ways side by side, where both filled."""
    errors = np.array([[a.error_mm, b.error_mm] for a, b in zip(on, off, strict=True)])
    errors = errors.reshape(-1, 2)
    errors = errors[np.isfinite(errors).all(axis=1)]
    t = p = on_mm = off_mm = np.nan
    if len(errors):
        on_mm, off_mm = errors.mean(axis=0)
    if len(errors) > 1:
        t, p = ttest_rel(errors[:, 0], errors[:, 1])
    return ConstraintRow(
        together, seconds, len(errors), float(on_mm), float(off_mm), float(t), float(p)
    )


def constraints_table(rows: tuple[ConstraintRow, ...]) -> list[str]:
    """Lines to print."""
    lines = [f"{'missing':<16}{'cases':>6}{'on, mm':>10}{'off, mm':>10}{'t':>8}{'p':>10}"]
    for r in rows:
        label = f"{r.together} at once, {r.seconds:g} s"
        # One case alone has no spread to test against.
        t, p = ("–", "–") if np.isnan(r.t) else (f"{r.t:.2f}", f"{r.p:.2g}")
        lines.append(f"{label:<16}{r.cases:>6}{r.on_mm:>10.2f}{r.off_mm:>10.2f}{t:>8}{p:>10}")
    return lines
