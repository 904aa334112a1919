"""How errors of single gaps are spread: the measures of skurowski2021, Tables 3 and A1 to A5.

The paper's mode has no definition for numbers that never repeat; here it is the half-sample mode
(bickel2006), which needs no bin width.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.bench.criteria import aic, bic
from markermend.bench.gaps import GapResult
from markermend.bench.svg import chart

INTERPOLATIONS = ("linear", "spline", "pchip", "makima", "li")
"""Methods that learn nothing."""


@dataclass(frozen=True)
class GapMeasures:
    """How far one method was off in the gaps of one protocol and length.

    Attributes
    ----------
    take : name, empty for all takes together
    protocol, length, method : what is summed up
    gaps : how many were filled
    rmse_mm : root mean square over all samples and coordinates (15)
    mean_mm, median_mm, mode_mm, std_mm, iqr_mm : of the single gaps' root mean squares (16)
    aic, bic : information criteria (18), (17) with MSE in mm²; NaN where the method does not say
        how many numbers it learnt
    """

    take: str
    protocol: str
    length: int
    method: str
    gaps: int
    rmse_mm: float
    mean_mm: float
    median_mm: float
    mode_mm: float
    std_mm: float
    iqr_mm: float
    aic: float
    bic: float


def measure(results: Sequence[GapResult], *, by_take: bool = False) -> tuple[GapMeasures, ...]:
    """Sum up replayed gaps as the paper does.

    Parameters
    ----------
    results : of :func:`markermend.bench.gaps.replay`
    by_take : each take for itself, as the paper has it

    Returns
    -------
    One for each (take,) protocol, length and method that filled a gap
    """
    groups: dict[tuple[str, str, int, str], list[GapResult]] = {}
    for r in results:
        key = (r.case.take if by_take else "", r.case.protocol, r.case.length, r.method)
        groups.setdefault(key, []).append(r)
    made = []
    for (take, protocol, length, method), some in sorted(groups.items()):
        each = np.array([v for r in some for v in r.gap_rmse_mm])
        if len(each) == 0:
            continue
        count = np.array([n for r in some for n in r.gap_samples])
        learnt = [n for r in some for n in r.gap_weights]
        mse, n = float(np.average(each**2, weights=count)), int(count.sum())
        told = any(learnt) or method in INTERPOLATIONS
        weights = float(np.mean(learnt)) if learnt and told else 0.0 if told else float("nan")
        low, middle, high = np.quantile(each, [0.25, 0.5, 0.75])
        made.append(
            GapMeasures(
                take,
                protocol,
                length,
                method,
                len(each),
                float(np.sqrt(mse)),
                float(each.mean()),
                float(middle),
                half_sample_mode(each),
                float(each.std(ddof=1)) if len(each) > 1 else float("nan"),
                float(high - low),
                aic(n, mse, weights),
                bic(n, mse, weights),
            )
        )
    return tuple(made)


def half_sample_mode(values: FloatArray) -> float:
    """Where values lie densest: the shortest half of the shortest half, and so on (bickel2006).

    Parameters
    ----------
    values : (n,) at least one
    """
    ordered = np.sort(np.asarray(values, dtype=np.float64))
    while len(ordered) > 2:
        half = (len(ordered) + 1) // 2
        width = ordered[half - 1 :] - ordered[: len(ordered) - half + 1]
        first = int(np.argmin(width))
        ordered = ordered[first : first + half]
    return float(ordered.mean())


def measures_table(measures: Sequence[GapMeasures]) -> list[str]:
    """Lay measures out as lines for a terminal."""
    named = max((len(m.take) for m in measures), default=0)
    first = f"{'take':<{named + 2}}" if named else ""
    head = f"{first}{'protocol':<16}{'frames':>7}  {'method':<18}{'gaps':>5}{'rmse':>9}{'mean':>9}"
    lines = [head + f"{'median':>9}{'mode':>9}{'std':>9}{'iqr':>9}{'AIC':>11}{'BIC':>11}"]
    for m in measures:
        sizes = (m.rmse_mm, m.mean_mm, m.median_mm, m.mode_mm, m.std_mm, m.iqr_mm)
        line = f"{m.take:<{named + 2}}" if named else ""
        line += f"{m.protocol:<16}{m.length:>7}  {m.method:<18}{m.gaps:>5}"
        line += "".join(f"{size:>9.3f}" for size in sizes)
        lines.append(
            line
            + "".join(f"{v:>11.1f}" if np.isfinite(v) else f"{'–':>11}" for v in (m.aic, m.bic))
        )
    return lines


def figure_name(protocol: str) -> str:
    """File name of a protocol's figure."""
    return f"gaps-{protocol.replace(' ', '-')}.svg"


def figures(measures: Iterable[GapMeasures]) -> dict[str, str]:
    """Draw error against gap length, a figure for each protocol of several lengths.

    Returns
    -------
    File name to SVG
    """
    drawn: dict[str, str] = {}
    by_protocol: dict[str, dict[str, list[tuple[int, float]]]] = {}
    for m in measures:
        points = by_protocol.setdefault(m.protocol, {}).setdefault(m.method, [])
        points.append((m.length, m.rmse_mm))
    for protocol, methods in by_protocol.items():
        curves = {
            name: ([x for x, _ in points], [y for _, y in points])
            for name, points in methods.items()
        }
        if max(len(x) for x, _ in curves.values()) > 1:
            drawn[figure_name(protocol)] = chart(
                curves, f"Reconstruction, {protocol}", "gap length, frames", "RMSE, mm"
            )
    return drawn
