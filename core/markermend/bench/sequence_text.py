"""Characteristics of takes and their correlations as tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple

import numpy as np

from markermend.bench.columns import aligned, number
from markermend.bench.sequence import MEASURES, Characteristics, Correlation


def sequence_table(known: Mapping[str, Characteristics]) -> list[str]:
    """Table 2 of skurowski2021 for other takes."""
    rows = [[name, *(number(v) for v in astuple(k))] for name, k in known.items()]
    return ["Takes (Table 2)", *aligned([["", *MEASURES], *rows])]


def correlation_tables(errors: Sequence[Correlation], pairs: Sequence[Correlation]) -> list[str]:
    """Tables 5, 6 and A6 to A12 of skurowski2021: coefficients, with p-values in brackets."""
    methods = list(dict.fromkeys(c.first for c in errors))
    lengths = sorted({c.length for c in errors})
    of = {(c.first, c.second, c.length): c for c in errors}
    mean = [
        [name, *(number(_mean([of[m, name, n].r for n in lengths])) for m in methods)]
        for name in MEASURES
    ]
    lines = ["RMSE against takes, mean over lengths (Table 5)", *aligned([["", *methods], *mean])]
    for name in MEASURES:
        rows = [[str(n), *(_cell(of[m, name, n]) for m in methods)] for n in lengths]
        lines += ["", f"RMSE against {name} (Tables A6 to A12): r (p)"]
        lines += aligned([["frames", *methods], *rows])
    pair = {frozenset((c.first, c.second)): c for c in pairs}
    square = [
        [a, *("1" if a == b else _cell(pair[frozenset((a, b))]) for b in MEASURES)]
        for a in MEASURES
    ]
    return [*lines, "", "Takes (Table 6): r (p)", *aligned([["", *MEASURES], *square])]


def _cell(c: Correlation) -> str:
    """Coefficient and p-value."""
    return f"{number(c.r)} ({number(c.p)})"


def _mean(values: Sequence[float]) -> float:
    """Mean of what is known."""
    known = [v for v in values if np.isfinite(v)]
    return float(np.mean(known)) if known else float("nan")
