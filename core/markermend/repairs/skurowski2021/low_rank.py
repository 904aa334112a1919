"""Completion of the take's matrix by one of low rank (mSVD of skurowski2021, 3.1.4).

The matrix of frames and coordinates is decomposed, its least significant part is left out, and
the missing samples take the values of what is left, until they change no more (srebro2003).

Three things are done differently from plain repetition, of which the published results never leave
the straight lines they began with. The first components are those of the frames in which nothing
is missing; straight lines only serve where there are too few. With the components fixed, the
values to which their repeated use would converge are solved for at once: the fixed point is the
same. And how much is significant, which the paper does not say, is learnt by hiding what is known.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.repairs.bridge import bridge, context_of
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.take import Take, is_unlabelled

METHOD = "msvd"
# A marker seen in a smaller share of the frames says more wrong than right about the others.
LEAST_SEEN = 0.5
LEAST_OTHERS, LEAST_ROWS = 3, 50
# Long takes are learnt from evenly spaced frames.
MOST_ROWS = 2000
RANKS = (1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36, 48, 60)
# Into so many stretches the take is cut to choose the rank; every fifth is hidden at once.
BLOCKS, FOLDS = 40, 5
# Keeps the solution finite where what is seen cannot tell all components apart.
RIDGE = 1e-5
SETTLED_MM, MOST_ROUNDS = 0.01, 30


@dataclass(frozen=True)
class LowRankParams:
    """How much of the matrix is kept."""

    rank: int = field(
        default=0,
        metadata={
            "min": 0,
            "max": 300,
            "help": "Components kept; 0 for as many as predict hidden samples best",
        },
    )
    join: bool = field(
        default=False,
        metadata={"help": "Bridge what is left at both borders, which the paper does not"},
    )


@register(
    METHOD,
    label="Low rank",
    summary="Completes the matrix of all markers by its main components; for long intervals.",
    params=LowRankParams,
    source="skurowski2021, 3.1.4 (mSVD)",
)
def repair_low_rank(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Complete all that is missing of the body together, and take the interval from it.

    Works at the take's ends too. Refuses where fewer than three other markers are seen in some
    frame of the interval, or the marker in fewer than 50 frames together with them.
    """
    take, start, stop = evidence.take, artifact.start, artifact.stop
    trusted = evidence.seen.copy()
    marker = take.index(artifact.marker)
    trusted[start:stop, marker] = False
    columns = _columns(take, trusted, marker)
    seen = trusted[:, columns]
    own = int(np.flatnonzero(columns == marker)[0])
    others = np.delete(seen, own, axis=1)[start:stop].sum(axis=1).min()
    if others < LEAST_OTHERS:
        reason = (
            f"Only {others} other markers of the body are seen in some frame of the interval of "
            f"{artifact.marker}; {LEAST_OTHERS} are needed."
        )
        return refuse(METHOD, reason, params)
    rows = _rows(take.frames, artifact)
    # What was hidden together with the marker must be hidden in the trials too.
    absent: BoolArray = ~np.any(seen[start:stop], axis=0)
    whole = rows[seen[rows][:, ~absent].all(axis=1) & seen[rows][:, own]]
    if len(whole) < LEAST_ROWS:
        reason = (
            f"{artifact.marker} is seen together with its whole body in only {len(whole)} frames; "
            f"{LEAST_ROWS} are needed."
        )
        return refuse(METHOD, reason, params)
    positions = take.positions[:, columns]
    matrix = _start(positions[rows], seen[rows], rows)
    judged = np.arange(len(columns)) == own
    rank = params.rank or choose_rank(
        matrix[np.isin(rows, whole)], np.repeat(absent, 3), np.repeat(judged, 3)
    )
    known = np.repeat(seen[rows], 3, axis=1)
    matrix, middle, basis = complete(matrix, known, rank)
    mine = slice(3 * own, 3 * own + 3)
    inside = (rows >= start) & (rows < stop)
    values = matrix[inside, mine]
    beside = context_of(seen[:, own], start, stop, take.rate) if params.join else np.arange(0)
    if len(beside):
        at = np.searchsorted(rows, beside)
        hidden = known[at].copy()
        hidden[:, mine] = False
        predicted = _solve(matrix[at], hidden, middle, basis)[:, mine]
        left = positions[beside, own] - predicted
        values = values + bridge(beside, left, start, stop, take.rate)[0]
    # A mean and the components, each a number a column.
    learnt = matrix.shape[1] * (1 + basis.shape[1])
    return make_repair(METHOD, evidence, artifact, values, params, weights=learnt)


def complete(
    matrix: FloatArray, known: BoolArray, rank: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Complete a matrix by one of low rank.

    Parameters
    ----------
    matrix : (rows, columns), filled by a first guess where not known
    known : (rows, columns) bool
    rank : components kept

    Returns
    -------
    matrix : (rows, columns), known values as they were
    middle : (columns,) its mean
    basis : (columns, rank) its main components, orthonormal
    """
    matrix = matrix.copy()
    whole: BoolArray = np.all(known, axis=1)
    lacking = np.flatnonzero(~whole)
    if whole.sum() >= LEAST_ROWS:
        middle, basis = main_components(matrix[whole], rank)
        matrix[lacking] = _solve(matrix[lacking], known[lacking], middle, basis)
    for _ in range(MOST_ROUNDS):
        middle, basis = main_components(matrix, rank)
        if len(lacking) == 0:
            break
        better = _solve(matrix[lacking], known[lacking], middle, basis)
        change = np.sqrt(np.mean((better - matrix[lacking])[~known[lacking]] ** 2))
        matrix[lacking] = better
        if change < SETTLED_MM:
            break
    return matrix, middle, basis


def main_components(matrix: FloatArray, rank: int) -> tuple[FloatArray, FloatArray]:
    """Mean and right singular vectors of the centred matrix, (columns,) and (columns, rank)."""
    middle = matrix.mean(axis=0)
    centred = matrix - middle
    # With fewer columns than rows the Gram matrix gives the same vectors much faster.
    _, vectors = np.linalg.eigh(centred.T @ centred)
    return middle, vectors[:, ::-1][:, : min(rank, matrix.shape[1])]


def choose_rank(matrix: FloatArray, hidden: BoolArray, judged: BoolArray) -> int:
    """Number of components that predicts hidden columns best in rows that were not learnt from.

    Parameters
    ----------
    matrix : (rows, columns), all known
    hidden : (columns,) bool, the columns to hide
    judged : (columns,) bool, the hidden ones by which to judge
    """
    hidden = hidden | judged
    most = int((~hidden).sum()) // 2
    ranks = [r for r in RANKS if r <= most] or [1]
    fold = np.arange(len(matrix)) * BLOCKS // len(matrix) % FOLDS
    errors = np.zeros(len(ranks))
    for i in range(0, FOLDS, 2):
        middle, basis = main_components(matrix[fold != i], max(ranks))
        test = matrix[fold == i]
        known = np.broadcast_to(~hidden, test.shape)
        for j, rank in enumerate(ranks):
            miss = (_solve(test, known, middle, basis[:, :rank]) - test)[:, judged]
            errors[j] += np.sum(np.linalg.norm(miss, axis=1))
    return ranks[int(np.argmin(errors))]


def _solve(
    matrix: FloatArray, known: BoolArray, middle: FloatArray, basis: FloatArray
) -> FloatArray:
    """Rows with what is not known put where the components that fit the rest have it."""
    solved = matrix - middle
    patterns, which = np.unique(known, axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns):
        rows = which.ravel() == i
        fit = basis[pattern]
        normal = fit.T @ fit + RIDGE * np.eye(basis.shape[1])
        weights = np.linalg.solve(normal, fit.T @ solved[np.ix_(rows, pattern)].T)
        solved[np.ix_(rows, ~pattern)] = (basis[~pattern] @ weights).T
    return np.where(known, matrix, solved + middle)


def _columns(take: Take, trusted: BoolArray, marker: int) -> IntArray:
    """The marker and the named markers of its body that are seen often."""
    subject = take.subject(take.labels[marker])
    often = trusted.mean(axis=0) >= LEAST_SEEN
    chosen = [
        i
        for i, label in enumerate(take.labels)
        if i == marker or (often[i] and not is_unlabelled(label) and take.subject(label) == subject)
    ]
    return np.array(chosen, dtype=np.int64)


def _rows(frames: int, artifact: Artifact) -> IntArray:
    """The interval, as many frames on either side, and an even sample of the others."""
    reach = max(100, artifact.length)
    near = np.arange(max(0, artifact.start - reach), min(frames, artifact.stop + reach))
    return np.union1d(near, np.arange(0, frames, max(1, frames // MOST_ROWS)))


def _start(positions: FloatArray, seen: BoolArray, rows: IntArray) -> FloatArray:
    """(rows, 3 * markers) with straight lines across what is missing."""
    filled = positions.copy()
    for column in np.flatnonzero(~seen.all(axis=0)):
        there = seen[:, column]
        for axis in range(3):
            filled[~there, column, axis] = (
                np.interp(rows[~there], rows[there], positions[there, column, axis])
                if there.any()
                else 0.0
            )
    return filled.reshape(len(rows), -1)
