"""How much of a take networks need to learn from (skurowski2021, Figure 9).

The paper compares sequences of different length, and with them different movements. Here the same
gaps are filled again and again from a shorter or longer window of the take around them, so that
nothing but the length differs. The body's structure is that of the whole take, so that a network
keeps its inputs and with them its number of weights.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact
from markermend.bench.criteria import aic, bic
from markermend.errors import DataError
from markermend.mesh import Mesh, infer_mesh
from markermend.progress import Progress, quiet
from markermend.repairs import evidence_for, propose_from
from markermend.simulation.gap_placement import place_gaps
from markermend.take import Take

METHODS = ("ffnn_lin", "ffnn_tanh", "lstm", "gru", "bilstm")
LENGTHS = (10, 20, 50, 100, 200)
TRAIN_S = (4.0, 8.0, 16.0, 32.0)


@dataclass(frozen=True)
class TrainingRow:
    """All gaps of one length in one take, filled by one method from windows of one length.

    Attributes
    ----------
    take, method : names
    length : mean length of the gaps, frames at 100 Hz
    train_s : seconds of the take beside the gap that were learnt from
    gaps : how many were filled
    samples : coordinates tested
    mse : mean squared error, mm²; NaN when none was filled
    weights : mean number of weights
    aic, bic : of them, see :mod:`markermend.bench.criteria`
    """

    take: str
    method: str
    length: int
    train_s: float
    gaps: int
    samples: int
    mse: float
    weights: float
    aic: float
    bic: float


def study_training(
    takes: Mapping[str, Take],
    *,
    methods: Sequence[str] = METHODS,
    lengths: Sequence[int] = LENGTHS,
    train_s: Sequence[float] = TRAIN_S,
    simulations: int = 10,
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[TrainingRow, ...]:
    """Fill the same gaps after learning from less and from more.

    Parameters
    ----------
    takes : complete takes by name
    methods : names in the registry
    lengths : mean lengths of the gaps (Poisson), in frames at 100 Hz
    train_s : seconds to learn from; more than a take has are left out for it
    simulations : gaps for each take and length
    seed : same seed, same gaps
    progress : told the share of gaps done; may raise ``Cancelled``

    Raises
    ------
    DataError
        when no take is long enough for the shortest window
    MethodError
        when there is no such method
    """
    report, rows = progress or quiet, []
    for number, (name, take) in enumerate(takes.items()):
        mesh = infer_mesh(take)
        for at, length in enumerate(lengths):
            share = (number + at / len(lengths)) / len(takes)
            report(share, f"{name}, gaps of {length} frames")
            gaps = _draw(take, length * take.rate / 100.0, simulations, seed + 1000 * at)
            for seconds in train_s:
                fits = [w for g in gaps if (w := _window(take, g, seconds)) is not None]
                if fits:
                    rows += [_row(name, take, mesh, m, length, seconds, fits) for m in methods]
    report(1.0, "Learnt")
    if not rows:
        raise DataError(f"No take has {min(train_s):g} s beside its gaps to learn from.")
    return tuple(rows)


def _draw(take: Take, mean_length: float, simulations: int, seed: int) -> list[Artifact]:
    """One gap for each simulation."""
    found: list[Artifact] = []
    for i in range(simulations):
        _, gaps = place_gaps(take, count=1, mean_length=mean_length, seed=seed + i)
        found += gaps
    return found


def _window(take: Take, gap: Artifact, seconds: float) -> tuple[Artifact, int, int] | None:
    """A gap with the frames around it that are to be learnt from, None where there are too few."""
    frames = round(seconds * take.rate) + gap.length
    if frames > take.frames:
        return None
    start = min(max(0, (gap.start + gap.stop - frames) // 2), take.frames - frames)
    return gap, start, start + frames


def _row(
    name: str,
    take: Take,
    mesh: Mesh,
    method: str,
    length: int,
    seconds: float,
    windows: Sequence[tuple[Artifact, int, int]],
) -> TrainingRow:
    """Fill every gap from its window, and measure."""
    squares: list[FloatArray] = []
    weights = []
    for gap, start, stop in windows:
        column, hidden = take.index(gap.marker), slice(gap.start - start, gap.stop - start)
        holed = take.positions[start:stop].copy()
        holed[hidden, column] = np.nan
        there = Artifact(gap.marker, gap.axes, hidden.start, hidden.stop, gap.kind)
        evidence = evidence_for(Take(holed, take.labels, take.rate), mesh=mesh)
        repair = propose_from(evidence, there, method=method)
        for patch in repair.patches:
            squares.append(
                ((patch.values - take.positions[gap.start : gap.stop, column]) ** 2).ravel()
            )
            weights.append(repair.weights)
    tested = sum(len(s) for s in squares)
    mse = float(np.mean(np.concatenate(squares))) if squares else float("nan")
    size = float(np.mean(weights)) if weights else 0.0
    return TrainingRow(
        name, method, length, seconds, len(squares), tested, mse, size,
        aic(tested, mse, size), bic(tested, mse, size),
    )  # fmt: skip
