"""The comparison of predictors as text tables and as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.predictors import DRIFT_MM, PredictorRow, PredictorStudy
from markermend.bench.residuals import EDGES, densities


def predictors_table(study: PredictorStudy) -> list[str]:
    """Write the tables: order and lags, predictors, distributions, correlations.

    Parameters
    ----------
    study : from :func:`markermend.bench.predictors.study_predictors`

    Returns
    -------
    Lines of text
    """
    lines = []
    for take in dict.fromkeys(row.take for row in study.predictors):
        lines += [
            *_sweep_table(study, take),
            *_predictor_table([row for row in study.predictors if row.take == take]),
            *_shape_table([row for row in study.predictors if row.take == take]),
            *_correlation_table(study, take),
        ]
    return lines


def predictors_csv(study: PredictorStudy) -> str:
    """Write one line a figure: table, take, series, position in it, value.

    Tables are ``sweep`` (series: what, position: L and k), ``predictors`` (series: predictor,
    position: what), ``histogram`` (series: predictor or distribution, position: middle of the
    bin in standard deviations, value: share of the samples), ``correlation`` and ``matrix``
    (series and position: two markers, value: correlation of their X positions).
    """
    text = io.StringIO()
    out = csv.writer(text, lineterminator="\n")
    out.writerow(("table", "take", "series", "position", "value"))
    for s in study.sweep:
        where = f"L={s.order} k={s.lags}"
        out.writerow(("sweep", s.take, "sigma_mm", where, csv_cell(s.sigma_mm)))
        out.writerow(("sweep", s.take, "held_out_mm", where, csv_cell(s.held_out_mm)))
    for row in study.predictors:
        for what, value in _figures(row).items():
            out.writerow(("predictors", row.take, row.predictor, what, csv_cell(value)))
        for middle, share in zip(_middles(), _shares(row), strict=True):
            line = (row.take, row.predictor, f"{middle:g}", csv_cell(share))
            out.writerow(("histogram", *line))
    for name, shares in zip(("normal", "laplace"), densities(), strict=True):
        for middle, share in zip(_middles(), shares, strict=True):
            out.writerow(("histogram", "", name, f"{middle:g}", csv_cell(float(share))))
    for c in study.correlations:
        for what, value in (("pairs", c.pairs), ("mean", c.mean), ("strong", c.strong)):
            line = (c.take, f"{c.quantity}, {c.relation}", what, csv_cell(value))
            out.writerow(("correlation", *line))
    for matrix in study.matrices:
        for label, values in zip(matrix.labels, matrix.values, strict=True):
            for other, value in zip(matrix.labels, values, strict=True):
                out.writerow(("matrix", matrix.take, label, other, csv_cell(float(value))))
    return text.getvalue()


def _figures(row: PredictorRow) -> dict[str, float]:
    """The numbers of one predictor by name."""
    s = row.shape
    return {
        "markers": row.markers,
        "sigma_mm": s.sigma_mm,
        "held_out_mm": row.held_out_mm,
        "kept": row.kept,
        "b_mm": s.b_mm,
        "b_likely_mm": s.b_likely_mm,
        "log_normal": s.normal,
        "log_laplace": s.laplace,
        "log_laplace_likely": s.laplace_likely,
        "laplace_share": s.laplace_share,
        "seconds": row.seconds,
    }


def _sweep_table(study: PredictorStudy, take: str) -> list[str]:
    """Deviation of the polynomial's residual, orders down, lags across."""
    rows = {(s.order, s.lags): s for s in study.sweep if s.take == take}
    if not rows:
        return []
    orders = list(dict.fromkeys(order for order, _ in rows))
    lags = list(dict.fromkeys(k for _, k in rows))
    cells = [("", *(f"k={k}" for k in lags), *(f"k={k} held out" for k in lags))]
    for order in orders:
        found = [rows[order, k] for k in lags]
        cells.append(
            (
                f"L={order}",
                *(number(s.sigma_mm, 2) for s in found),
                *(number(s.held_out_mm, 2) for s in found),
            )
        )
    return [f"{take}, standard deviation of the polynomial's residual, mm", *aligned(cells), ""]


def _predictor_table(rows: Sequence[PredictorRow]) -> list[str]:
    """Residual and what stays of a slow change."""
    if not rows:
        return []
    cells = [("predictor", "sigma mm", "held out mm", "drift kept", "drift/sigma", "s a marker")]
    for row in rows:
        sigma = row.shape.sigma_mm
        cells.append(
            (
                row.predictor,
                number(sigma),
                number(row.held_out_mm),
                number(row.kept),
                number(DRIFT_MM * row.kept / sigma, 1),
                number(row.seconds, 2),
            )
        )
    return [f"{rows[0].take}, predictors on {rows[0].markers} markers", *aligned(cells), ""]


def _shape_table(rows: Sequence[PredictorRow]) -> list[str]:
    """Residuals against Laplace and normal distribution."""
    if not rows:
        return []
    cells: list[tuple[str, ...]] = [
        ("residual", "b mm", "likely b mm", "normal", "Laplace", "with likely b", "Laplace wins %")
    ]
    for row in rows:
        s = row.shape
        logs = (number(v) for v in (s.normal, s.laplace, s.laplace_likely))
        wins = number(100 * s.laplace_share, 0)
        cells.append((row.predictor, number(s.b_mm), number(s.b_likely_mm), *logs, wins))
    return [f"{rows[0].take}, logarithm of a sample's likelihood", *aligned(cells), ""]


def _correlation_table(study: PredictorStudy, take: str) -> list[str]:
    """Mean absolute correlation by relation of the markers."""
    found = [c for c in study.correlations if c.take == take]
    if not found:
        return []
    cells = [("correlation", "pairs", "mean |r|", "0.9 or more %")]
    for c in found:
        name = f"{c.quantity}, {c.relation}"
        cells.append((name, f"{c.pairs}", number(c.mean), number(100 * c.strong, 0)))
    return [f"{take}, correlation of markers", *aligned(cells), ""]


def _middles() -> list[float]:
    """Middle of each bin, in standard deviations."""
    return [float(v) for v in (EDGES[:-1] + EDGES[1:]) / 2]


def _shares(row: PredictorRow) -> list[float]:
    """Share of the samples in each bin."""
    counts = row.shape.counts
    return [float(v) for v in counts / max(int(counts.sum()), 1)]
