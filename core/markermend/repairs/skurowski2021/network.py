"""A network of one hidden layer, trained as MATLAB's ``sgdm`` does (skurowski2021, 3.1.4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray

HIDDEN = 8


@dataclass(frozen=True, eq=False)
class Network:
    """Weights of a hidden layer and of the output that follows it.

    Attributes
    ----------
    first : (inputs, hidden)
    first_bias : (hidden,)
    second : (hidden, outputs)
    second_bias : (outputs,)
    tanh : whether the hidden neurons are hyperbolic tangents; linear otherwise
    """

    first: FloatArray
    first_bias: FloatArray
    second: FloatArray
    second_bias: FloatArray
    tanh: bool

    @property
    def parameters(self) -> int:
        """How many numbers are learnt (skurowski2021, Table 4)."""
        return sum(w.size for w in _weights(self))

    def __call__(self, inputs: FloatArray) -> FloatArray:
        """Outputs (rows, outputs) for inputs (rows, inputs)."""
        return _hidden(self, inputs) @ self.second + self.second_bias


@dataclass(frozen=True)
class Training:
    """How the weights are learnt; the defaults are those published.

    Attributes
    ----------
    epochs : steps over the whole sequence, which is one batch
    rate, drop, period : first learning rate, and the factor it falls by every `period` epochs
    momentum : share of the last step that is kept
    threshold : a gradient of one weight matrix or bias whose Euclidean norm is larger is scaled
        back to it (MATLAB's ``l2norm``)
    """

    epochs: int = 600
    rate: float = 0.01
    drop: float = 0.9
    period: int = 10
    momentum: float = 0.8
    threshold: float = 0.7


def glorot(inputs: int, outputs: int, *, tanh: bool, seed: int, hidden: int = HIDDEN) -> Network:
    """Weights before training: Glorot's uniform distribution, biases 0."""
    rng = np.random.default_rng(seed)

    def draw(rows: int, columns: int) -> FloatArray:
        limit = np.sqrt(6.0 / (rows + columns))
        return rng.uniform(-limit, limit, (rows, columns))

    return Network(
        draw(inputs, hidden), np.zeros(hidden), draw(hidden, outputs), np.zeros(outputs), tanh
    )


def train(
    network: Network, inputs: FloatArray, targets: FloatArray, training: Training | None = None
) -> Network:
    """Descend half the squared error, summed over outputs and averaged over rows.

    Parameters
    ----------
    network : weights to start from
    inputs : (rows, inputs), standardised
    targets : (rows, outputs), standardised
    training : steps and rates; as published by default
    """
    how = training or Training()
    columns = np.asfortranarray(inputs)
    steps = tuple(np.zeros_like(w) for w in _weights(network))
    for epoch in range(how.epochs):
        rate = how.rate * how.drop ** (epoch // how.period)
        slopes = (_limited(g, how.threshold) for g in gradient(network, columns, targets))
        steps = tuple(how.momentum * s - rate * g for s, g in zip(steps, slopes, strict=True))
        first, first_bias, second, second_bias = (
            w + s for w, s in zip(_weights(network), steps, strict=True)
        )
        network = Network(first, first_bias, second, second_bias, network.tanh)
    return network


def gradient(
    network: Network, inputs: FloatArray, targets: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Slope of the error by each of the weights, in the order of :class:`Network`."""
    hidden = _hidden(network, inputs)
    miss = (hidden @ network.second + network.second_bias - targets) / len(targets)
    back = miss @ network.second.T
    if network.tanh:
        back *= 1.0 - hidden**2
    return inputs.T @ back, back.sum(axis=0), hidden.T @ miss, miss.sum(axis=0)


def _hidden(network: Network, inputs: FloatArray) -> FloatArray:
    """(rows, hidden) what the hidden neurons give."""
    total = inputs @ network.first + network.first_bias
    return np.tanh(total, out=total) if network.tanh else total


def _limited(slope: FloatArray, threshold: float) -> FloatArray:
    """A gradient, scaled back where its norm is above the threshold."""
    norm = float(np.sqrt(np.sum(slope**2)))
    return slope * (threshold / norm) if norm > threshold else slope


def _weights(network: Network) -> tuple[FloatArray, ...]:
    """All weight arrays of a network, in order."""
    return network.first, network.first_bias, network.second, network.second_bias
