"""Small networks that predict a marker from its parent and siblings (skurowski2021, eq. 12).

Inputs are the coordinates of the parent marker and of all siblings of the body mesh in this frame
and the one before; inputs and outputs are standardised. One hidden layer of 8 neurons, linear or
hyperbolic tangent, goes straight to the three coordinates, which gives the 275 weights that
Table 4 counts for 30 inputs.

What the paper leaves open. A neighbour that is trusted in less than half of the interval is no
input; where fewer than three are left, the markers of most constant distance complete them. What
an input lacks is bridged, and frames that lack any are not learnt from. In the first frame of a
take the frame before is that same one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.repairs.body_frame import rank_references
from markermend.repairs.bridge import bridge, context_of
from markermend.repairs.registry import Evidence, MethodFunction, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.repairs.skurowski2021.network import Network, Training, glorot, train

LEAST_NEIGHBOURS = 3
LEAST_SHARE = 0.5
# Fewer frames than this cannot say anything about some 150 weights.
LEAST_ROWS = 50


@dataclass(frozen=True)
class NetworkParams:
    """Training of the network; its shape is as published."""

    epochs: int = field(default=600, metadata={"min": 1, "max": 100_000, "help": "Steps"})
    join: bool = field(
        default=False,
        metadata={"help": "Bridge what is left at both borders, which the paper does not"},
    )
    seed: int = field(default=0, metadata={"min": 0, "help": "Of the initial weights"})


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
    seen: BoolArray = np.all(evidence.trusted, axis=2)
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


def _method(name: str, tanh: bool) -> MethodFunction:
    """A repair method from a kind of hidden neurons."""

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
        own: BoolArray = np.all(evidence.trusted[:, marker], axis=1)
        own[artifact.start : artifact.stop] = False
        rows = own & complete
        if rows.sum() < LEAST_ROWS:
            reason = (
                f"{artifact.marker} is seen together with its parent and siblings in only "
                f"{rows.sum()} frames; {LEAST_ROWS} are needed."
            )
            return refuse(name, reason, params)
        start, stop = artifact.start, artifact.stop
        beside = context_of(rows, start, stop, take.rate) if params.join else np.arange(0)
        wanted = np.concatenate([beside, np.arange(start, stop)])
        network = glorot(inputs.shape[1], 3, tanh=tanh, seed=params.seed)
        predicted = _fit_and_predict(
            network, inputs, take.positions[:, marker], rows, wanted, Training(params.epochs)
        )
        values = predicted[len(beside) :]
        if len(beside):
            left = take.positions[beside, marker] - predicted[: len(beside)]
            values = values + bridge(beside, left, start, stop, take.rate)[0]
        return make_repair(name, evidence, artifact, values, params)

    return run


def _fit_and_predict(
    network: Network,
    inputs: FloatArray,
    own: FloatArray,
    rows: BoolArray,
    wanted: IntArray,
    training: Training,
) -> FloatArray:
    """Learn from some rows, standardised by them, and predict others."""
    known, target = inputs[rows], own[rows]
    middle, spread = known.mean(axis=0), _spread(known)
    level, size = target.mean(axis=0), _spread(target)
    learnt = train(network, (known - middle) / spread, (target - level) / size, training)
    return np.asarray(learnt((inputs[wanted] - middle) / spread) * size + level)


def _spread(columns: FloatArray) -> FloatArray:
    """Standard deviation of each column; infinite where it is constant, so that it becomes 0."""
    spread = columns.std(axis=0, ddof=1)
    return np.asarray(np.where(spread > 1e-9, spread, np.inf))


register(
    "ffnn_lin",
    label="Linear network",
    summary="A network of 8 linear neurons predicts the marker from its parent and siblings.",
    params=NetworkParams,
    source="skurowski2021, 3.1.4 and eq. 12",
)(_method("ffnn_lin", tanh=False))
register(
    "ffnn_tanh",
    label="Tanh network",
    summary="A network of 8 tanh neurons predicts the marker from its parent and siblings.",
    params=NetworkParams,
    source="skurowski2021, 3.1.4 and eq. 12",
)(_method("ffnn_tanh", tanh=True))
