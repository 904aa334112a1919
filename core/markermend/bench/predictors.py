"""What predictors leave unexplained, and what they let through of a slow change.

skurowski2022, sections 3.1 and 3.3, figures 3, 6, 7 and 9. Beyond the paper: the residual where
the predictor was not fitted, and the closed-form local regression beside the published ones.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.bench.residuals import (
    CorrelationMatrix,
    CorrelationRow,
    Shape,
    correlations,
    matrix_of,
    shape_of,
)
from markermend.errors import DataError, MethodError
from markermend.mesh import Mesh, infer_mesh
from markermend.predictors.ffnn import FfnnParams, predict_ffnn
from markermend.predictors.inputs import gather, lagged_powers, neighbours_of, trusted_samples
from markermend.predictors.local import predict_local
from markermend.predictors.polynomial import CONDITION, predict_polynomial
from markermend.processes import in_processes
from markermend.progress import Progress, quiet
from markermend.simulation.contamination import triangle
from markermend.take import Take, is_unlabelled

Predictor = Callable[[Take, Mesh, int, BoolArray], FloatArray]
"""``(take, mesh, marker, trusted) -> (frames, 3) mm``"""

DRIFT_MM, DRIFT_S, EVERY_S = 10.0, 0.5, 5.0
"""Planted slow changes: height, length, and the time from one to the next."""
BLOCK_S, HELD_OUT = 1.0, 4
"""Every fourth second is held out of the fit."""


def predict_with_own_past(
    take: Take, mesh: Mesh, marker: int, trusted: BoolArray, *, k: int = 3, order: int = 4
) -> FloatArray:
    """Predict as the polynomial does, with the marker's own former values among the inputs.

    Parameters
    ----------
    take, mesh, marker : as for the polynomial predictor
    trusted : (frames, markers, 3) bool; samples of the marker to fit to
    k, order : number of former frames, highest power

    Returns
    -------
    (frames, 3) mm; NaN where fewer than half of the neighbours are seen

    Notes
    -----
    skurowski2022, 3.3.2 and Figure 6: precise, and of no use, for it follows every artifact.
    """
    known = trusted_samples(take, None)
    inputs = gather(take.positions, known, marker, neighbours_of(take, mesh, marker))
    before = inputs.own[np.maximum(np.arange(take.frames) - 1, 0)]
    around = lagged_powers(inputs.neighbours.reshape(take.frames, -1), k, order)
    former = lagged_powers(before, k - 1, order)
    design = np.concatenate([np.ones((take.frames, 1)), around, former], axis=1)
    fit = inputs.fit & trusted[:, marker].all(axis=1)
    centre = inputs.own[fit].mean(axis=0)
    solved = np.linalg.lstsq(design[fit], inputs.own[fit] - centre, rcond=CONDITION)[0]
    predicted = design @ solved + centre
    predicted[~inputs.usable] = np.nan
    return np.asarray(predicted)


def _polynomial(take: Take, mesh: Mesh, marker: int, trusted: BoolArray) -> FloatArray:
    return predict_polynomial(take, mesh, marker, trusted=trusted)


def _network(iterations: int) -> Predictor:
    def predict(take: Take, mesh: Mesh, marker: int, trusted: BoolArray) -> FloatArray:
        shape = FfnnParams(iterations=iterations)
        return predict_ffnn(take, mesh, marker, trusted=trusted, params=shape)

    return predict


def _local(take: Take, mesh: Mesh, marker: int, trusted: BoolArray) -> FloatArray:
    return predict_local(take.positions, marker, trusted=np.asarray(trusted.all(axis=2)))


PREDICTORS: Mapping[str, Predictor] = MappingProxyType(
    {
        "polynomial": _polynomial,
        "polynomial with own past": predict_with_own_past,
        "network, 45 steps": _network(45),
        "network, 400 steps": _network(400),
        "local regression": _local,
    }
)
"""The published predictors, the network as little trained as detection has it and longer, and
ours."""


@dataclass(frozen=True)
class SweepRow:
    """Residual of the polynomial with one setting; means over markers and axes.

    Attributes
    ----------
    take : name
    order, lags : highest power L and number of former frames k
    sigma_mm : standard deviation of the residual where it was fitted
    held_out_mm : the same where it was not; the median over markers, for single ones go wild
    """

    take: str
    order: int
    lags: int
    sigma_mm: float
    held_out_mm: float


@dataclass(frozen=True, eq=False)
class PredictorRow:
    """What one predictor leaves on one take; means over markers and axes.

    Attributes
    ----------
    take, predictor : names
    markers : how many were predicted
    shape : the residual's distribution over all frames, fitted to all of them
    held_out_mm : standard deviation of the residual where it was not fitted; the median over
        markers, for single ones go wild
    kept : share of a planted slow change that stays in the residual; 1 would be best
    seconds : a marker
    """

    take: str
    predictor: str
    markers: int
    shape: Shape
    held_out_mm: float
    kept: float
    seconds: float


@dataclass(frozen=True, eq=False)
class PredictorStudy:
    """All tables: over order and lags, predictors side by side, correlation of markers.

    The correlations are summarised in rows; the matrices are those of the X positions.
    """

    sweep: tuple[SweepRow, ...]
    predictors: tuple[PredictorRow, ...]
    correlations: tuple[CorrelationRow, ...]
    matrices: tuple[CorrelationMatrix, ...]


@dataclass(frozen=True, eq=False)
class _Tried:
    """One predictor on one marker: residual (frames, 3), the rest as in :class:`PredictorRow`."""

    residual: FloatArray
    held_out_mm: float
    kept: float
    seconds: float


@dataclass(frozen=True, eq=False)
class _Marker:
    """All that is measured on one marker; (L, k) to fitted and held-out deviation."""

    sweep: dict[tuple[int, int], tuple[float, float]]
    tried: dict[str, _Tried]


def study_predictors(
    takes: Mapping[str, Take],
    *,
    names: Sequence[str] = tuple(PREDICTORS),
    orders: Sequence[int] = (1, 2, 3, 4, 5),
    lags: Sequence[int] = (0, 1, 3, 5),
    markers: int = 12,
    n_jobs: int = -1,
    progress: Progress | None = None,
) -> PredictorStudy:
    """Measure what predictors leave, and what they let through of slow changes.

    Parameters
    ----------
    takes : clean recordings by name
    names : of :data:`PREDICTORS`
    orders, lags : settings of the polynomial, each with each
    markers : predicted in each take, evenly chosen; 0 for all
    n_jobs : processes; −1 for one a core. The result does not depend on it
    progress : told the share of markers done; may raise ``Cancelled``

    Raises
    ------
    MethodError
        for an unknown predictor, order or number of lags
    DataError
        when no marker of a take can be predicted

    Notes
    -----
    skurowski2022, figures 3, 6, 7 and 9 and equation 5. Every predictor is fitted three times:
    to all frames; to three quarters of them, in blocks of a second; and to the take with a
    triangle of 10 mm and 0.5 s added to one axis every five seconds. What stays of the triangle
    is the difference of the residuals with and without it, projected onto it.
    """
    unknown = [name for name in names if name not in PREDICTORS]
    if unknown or min(orders, default=1) < 1 or min(lags, default=0) < 0:
        raise MethodError(f"Predictors are {', '.join(PREDICTORS)}; orders start at 1, lags at 0.")
    bodies = {name: (take, infer_mesh(take)) for name, take in takes.items()}
    tasks = [
        (name, marker)
        for name, (take, mesh) in bodies.items()
        for marker in _chosen(take, mesh, markers)
    ]
    report = progress or quiet
    each = (
        (*bodies[name], marker, tuple(names), tuple(orders), tuple(lags)) for name, marker in tasks
    )
    measured: dict[str, list[_Marker]] = {name: [] for name in takes}
    with in_processes(_measure, each, n_jobs) as results:
        for done, ((name, _), result) in enumerate(zip(tasks, results, strict=True)):
            measured[name].append(result)
            report((done + 1) / len(tasks), name)
    return PredictorStudy(
        sweep=tuple(row for name, found in measured.items() for row in _sweep(name, found)),
        predictors=tuple(
            _joined(name, predictor, [marker.tried[predictor] for marker in found])
            for name, found in measured.items()
            for predictor in names
        ),
        correlations=tuple(
            row for name, body in bodies.items() for row in correlations(name, *body)
        ),
        matrices=tuple(matrix_of(name, *body) for name, body in bodies.items()),
    )


def _chosen(take: Take, mesh: Mesh, number: int) -> list[int]:
    """Columns of the markers to predict, evenly over those that can be."""
    able = []
    for marker, label in enumerate(take.labels):
        if is_unlabelled(label) or take.present[:, marker].mean() < 0.5:
            continue
        try:
            neighbours_of(take, mesh, marker)
        except DataError:
            continue
        able.append(marker)
    if not able:
        raise DataError("The take has no marker that could be predicted from others.")
    if not 0 < number < len(able):
        return able
    return [able[i] for i in np.linspace(0, len(able) - 1, number).round().astype(int)]


def _measure(
    take: Take,
    mesh: Mesh,
    marker: int,
    names: Sequence[str],
    orders: Sequence[int],
    lags: Sequence[int],
) -> _Marker:
    """Everything on one marker."""
    trusted = trusted_samples(take, None)
    block = np.arange(take.frames) // max(1, round(BLOCK_S * take.rate))
    held = block % HELD_OUT == HELD_OUT - 1
    some = trusted.copy()
    some[held, marker] = False
    own = take.positions[:, marker]
    drift = _planted(take, marker)
    drifting = take.positions.copy()
    drifting[:, marker] += drift
    drifted = Take(drifting, take.labels, take.rate)
    sweep, tried = {}, {}
    with threadpool_limits(1):
        for order in orders:
            for k in lags:
                fitted, unseen = (
                    own - predict_polynomial(take, mesh, marker, k=k, order=order, trusted=t)
                    for t in (trusted, some)
                )
                sweep[order, k] = (_deviation(fitted), _deviation(unseen[held]))
        for name in names:
            predict = PREDICTORS[name]
            began = time.perf_counter()
            residual = own - predict(take, mesh, marker, trusted)
            seconds = time.perf_counter() - began
            unseen = own - predict(take, mesh, marker, some)
            moved = drifting[:, marker] - predict(drifted, mesh, marker, trusted) - residual
            here = (drift != 0) & ~np.isnan(moved)
            kept = float((drift * moved)[here].sum() / max((drift[here] ** 2).sum(), 1e-12))
            tried[name] = _Tried(residual, _deviation(unseen[held]), kept, seconds)
    return _Marker(sweep, tried)


def _planted(take: Take, marker: int) -> FloatArray:
    """(frames, 3) mm: triangles every few seconds, each on the next axis, where all is seen."""
    drift = np.zeros((take.frames, 3))
    shape = DRIFT_MM * triangle(max(2, round(DRIFT_S * take.rate)))
    every = round(EVERY_S * take.rate)
    for number, start in enumerate(range(every // 2, take.frames - len(shape), every)):
        if take.present[start : start + len(shape), marker].all():
            drift[start : start + len(shape), number % 3] = shape
    return drift


def _deviation(residual: FloatArray) -> float:
    """Standard deviation about zero, mean over the axes; NaN where nothing was predicted."""
    known = residual[~np.isnan(residual[:, 0])]
    return float(np.sqrt((known**2).mean(axis=0)).mean()) if len(known) else float("nan")


def _sweep(name: str, found: Sequence[_Marker]) -> list[SweepRow]:
    """Rows over order and lags of one take."""
    rows = []
    for order, k in found[0].sweep:
        fitted, unseen = np.array([marker.sweep[order, k] for marker in found]).T
        rows.append(SweepRow(name, order, k, float(fitted.mean()), float(np.median(unseen))))
    return rows


def _joined(name: str, predictor: str, tried: Sequence[_Tried]) -> PredictorRow:
    """One predictor over the markers of a take."""
    return PredictorRow(
        take=name,
        predictor=predictor,
        markers=len(tried),
        shape=shape_of(np.hstack([t.residual for t in tried])),
        held_out_mm=float(np.median([t.held_out_mm for t in tried])),
        kept=float(np.mean([t.kept for t in tried])),
        seconds=float(np.mean([t.seconds for t in tried])),
    )
