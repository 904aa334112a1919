"""Small networks that predict a marker from its parent and siblings (skurowski2021, 3.1.4).

One hidden layer of 8 neurons, linear or hyperbolic tangent, goes straight to the three
coordinates, which gives the 275 weights that Table 4 counts for 30 inputs.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from markermend.arrays import BoolArray, FloatArray
from markermend.progress import Progress
from markermend.repairs.registry import register
from markermend.repairs.skurowski2021.network import Training, glorot, train
from markermend.repairs.skurowski2021.regression import Learn, network_method


@dataclass(frozen=True)
class NetworkParams:
    """Training of the network; its shape is as published."""

    epochs: int = field(default=600, metadata={"min": 1, "max": 100_000, "help": "Steps"})
    join: bool = field(
        default=False,
        metadata={"help": "Bridge what is left at both borders, which the paper does not"},
    )
    seed: int = field(default=0, metadata={"min": 0, "help": "Of the initial weights"})


def _learn(tanh: bool) -> Learn:
    """Training of the network, given its kind of hidden neurons."""

    def learn(
        inputs: FloatArray, targets: FloatArray, rows: BoolArray, params: Any, progress: Progress
    ) -> FloatArray:
        network = glorot(inputs.shape[1], 3, tanh=tanh, seed=params.seed)
        return train(network, inputs[rows], targets[rows], Training(params.epochs))(inputs)

    return learn


def _count(inputs: int, params: Any) -> int:
    """Weights of the network (Table 4)."""
    return glorot(inputs, 3, tanh=False, seed=0).parameters


register(
    "ffnn_lin",
    label="Linear network",
    summary="A network of 8 linear neurons predicts the marker from its parent and siblings.",
    params=NetworkParams,
    source="skurowski2021, 3.1.4 and eq. 12",
)(network_method("ffnn_lin", _learn(tanh=False), _count))
register(
    "ffnn_tanh",
    label="Tanh network",
    summary="A network of 8 tanh neurons predicts the marker from its parent and siblings.",
    params=NetworkParams,
    source="skurowski2021, 3.1.4 and eq. 12",
)(network_method("ffnn_tanh", _learn(tanh=True), _count))
