"""Predicting a marker from its parent and siblings (skurowski2021, 3.2): what every network shares.

Inputs are the coordinates of the parent marker and of all siblings of the body mesh in this frame
and the one before (eq. 12); inputs and outputs are standardised.

What the paper leaves open. A neighbour that is trusted in less than half of the interval is no
input; where fewer than three are left, the markers of most constant distance complete them. What
an input lacks is bridged, and frames that lack any are not learnt from. In the first frame of a
take the frame before is that same one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.progress import Progress
from markermend.repairs.body_frame import rank_references
from markermend.repairs.bridge import bridge, context_of
from markermend.repairs.registry import Evidence, MethodFunction, Repair
from markermend.repairs.result import make_repair, refuse

LEAST_NEIGHBOURS = 3
LEAST_SHARE = 0.5
# Fewer frames than this cannot say anything about some 150 weights.
LEAST_ROWS = 50

Learn = Callable[[FloatArray, FloatArray, BoolArray, Any, Progress], FloatArray]
"""``(inputs, targets, rows, params, progress) -> predictions``: learn from some rows, predict all.

All arrays have one row a frame and are standardised by the rows to learn from; targets of other
rows are 0.
"""
Count = Callable[[int, Any], int]
"""``(inputs, params) -> weights`` that are learnt (Table 4)."""


def neighbours(evidence: Evidence, artifact: Artifact) -> tuple[int, ...]:
    """Columns of the markers that predict one over an interval, the parent marker first.

    Parameters
    ----------
    evidence : what may be believed
    artifact : marker and interval
    """
    from markermend.mesh import infer_mesh

    take, marker = evidence.take, evidence.take.index(artifact.marker)
    interval = slice(artifact.start, artifact.stop)
    mesh = evidence.mesh or infer_mesh(take)
    parent = mesh.parent_marker(marker)
    family = ([] if parent is None else [parent]) + list(mesh.siblings(marker))
    seen = evidence.seen
    chosen = [m for m in family if seen[interval, m].mean() >= LEAST_SHARE]
    if len(chosen) < LEAST_NEIGHBOURS:
        ranked, _ = rank_references(take, seen, marker, interval)
        others = [int(m) for m in ranked if m not in chosen]
        chosen += others[: LEAST_NEIGHBOURS - len(chosen)]
    return tuple(chosen)


def input_vectors(neighbours: FloatArray) -> FloatArray:
    """Lay out the inputs of every frame as eq. 12 does.

    Parameters
    ----------
    neighbours : (frames, k, 3) mm, nothing missing

    Returns
    -------
    (frames, 6 * k) of each neighbour in turn x, y, z now, then x, y, z in the frame before
    """
    former = np.concatenate([neighbours[:1], neighbours[:-1]])
    return np.concatenate([neighbours, former], axis=2).reshape(len(neighbours), -1)


def network_method(name: str, learn: Learn, count: Count) -> MethodFunction:
    """A repair method from a network; its parameters need a field ``join``."""

    def run(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
        from markermend.predictors.bridging import bridge as fill_in

        take, marker = evidence.take, evidence.take.index(artifact.marker)
        chosen = list(neighbours(evidence, artifact))
        if not chosen:
            reason = f"No other marker near {artifact.marker} is seen in the interval."
            return refuse(name, reason, params)
        known = evidence.trusted[:, chosen].reshape(take.frames, -1)
        around = fill_in(take.positions[:, chosen].reshape(take.frames, -1), known)
        inputs = input_vectors(around.reshape(take.frames, -1, 3))
        complete: BoolArray = np.all(known, axis=1)
        complete[1:] &= complete[:-1]
        own = evidence.seen[:, marker].copy()
        own[artifact.start : artifact.stop] = False
        rows = own & complete
        if rows.sum() < LEAST_ROWS:
            reason = (
                f"{artifact.marker} is seen together with its parent and siblings in only "
                f"{rows.sum()} frames; {LEAST_ROWS} are needed."
            )
            return refuse(name, reason, params)
        start, stop, track = artifact.start, artifact.stop, take.positions[:, marker]
        inputs = (inputs - inputs[rows].mean(axis=0)) / _spread(inputs[rows])
        level, size = track[rows].mean(axis=0), _spread(track[rows])
        targets = np.where(rows[:, None], (track - level) / size, 0.0)
        predicted = learn(inputs, targets, rows, params, evidence.progress) * size + level
        values = predicted[start:stop]
        beside = context_of(rows, start, stop, take.rate) if params.join else np.arange(0)
        if len(beside):
            left = track[beside] - predicted[beside]
            values = values + bridge(beside, left, start, stop, take.rate)[0]
        learnt = count(inputs.shape[1], params)
        return make_repair(name, evidence, artifact, values, params, weights=learnt)

    return run


def _spread(columns: FloatArray) -> FloatArray:
    """Standard deviation of each column; 1 where it is constant, which stays 0 then."""
    spread = columns.std(axis=0, ddof=1)
    return np.asarray(np.where(spread > 1e-9, spread, 1.0))
