"""Recurrent networks that predict a marker from its parent and siblings (skurowski2021, 3.1).

LSTM, GRU or bidirectional LSTM of 60 neurons, straight to the three coordinates, as Table 4 counts
their weights: 22,023 and 16,563 for 30 inputs. For BiLSTM its formula gives 44,043 and the table
prints 47,043. The layer of 8 sigmoidal neurons that the text puts in between is in none of these
counts; ``dense`` adds it.

The sequence goes through the network in one piece, and frames that are not learnt from have no
weight in the error. They need the optional extra ``deep`` (Keras 3 on JAX).
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import Any

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.progress import Progress
from markermend.repairs.registry import Evidence, MethodFunction, Repair, register
from markermend.repairs.result import refuse
from markermend.repairs.skurowski2021.network import HIDDEN, Training
from markermend.repairs.skurowski2021.regression import Learn, network_method

UNITS = 60
INSTALL = 'python -m pip install "markermend[deep]"'


@dataclass(frozen=True)
class RecurrentParams:
    """Training of the network; its shape is as published."""

    epochs: int = field(default=600, metadata={"min": 1, "max": 100_000, "help": "Steps"})
    dense: bool = field(
        default=False,
        metadata={"help": "Put 8 sigmoidal neurons before the output, as the text has it"},
    )
    join: bool = field(
        default=False,
        metadata={"help": "Bridge what is left at both borders, which the paper does not"},
    )
    seed: int = field(default=0, metadata={"min": 0, "help": "Of the initial weights"})


def can_learn() -> bool:
    """Whether the optional extra ``deep`` is installed."""
    return find_spec("keras") is not None and find_spec("jax") is not None


def count_weights(kind: str, inputs: int, *, dense: bool = False) -> int:
    """How many numbers a network of :func:`build` learns (Table 4); needs no extra.

    Parameters
    ----------
    kind, inputs, dense : as for :func:`build`
    """
    gates, directions = {"lstm": (4, 1), "gru": (3, 1), "bilstm": (4, 2)}[kind]
    given = directions * UNITS
    recurrent = given * gates * (inputs + UNITS + 1)
    between, last = (HIDDEN * (given + 1), HIDDEN) if dense else (0, given)
    return recurrent + between + 3 * (last + 1)


def build(kind: str, inputs: int, *, dense: bool = False, seed: int = 0) -> Any:
    """Make an untrained network; needs the extra ``deep``.

    Parameters
    ----------
    kind : ``"lstm"``, ``"gru"`` or ``"bilstm"``
    inputs : numbers a frame
    dense : with a layer of 8 sigmoidal neurons before the output
    seed : of the initial weights

    Returns
    -------
    keras.Sequential of (1, frames, inputs) to (1, frames, 3)

    Notes
    -----
    skurowski2021, eq. 2 to 11. Eq. 10 resets the gated unit before the product, so ``reset_after``
    is off. Initial weights as in MATLAB: Glorot and orthogonal, the forget gate's bias 1.
    """
    # Read by Keras when it is first imported.
    os.environ.setdefault("KERAS_BACKEND", "jax")
    from keras import Input, Sequential, initializers, layers

    seeds = iter(range(10 * seed, 10 * seed + 10))

    def drawn() -> dict[str, Any]:
        return {
            "kernel_initializer": initializers.GlorotUniform(next(seeds)),
            "recurrent_initializer": initializers.Orthogonal(seed=next(seeds)),
            "return_sequences": True,
        }

    if kind == "gru":
        recurrent: Any = layers.GRU(UNITS, reset_after=False, **drawn())
    elif kind == "lstm":
        recurrent = layers.LSTM(UNITS, **drawn())
    else:
        back = layers.LSTM(UNITS, go_backwards=True, **drawn())
        recurrent = layers.Bidirectional(layers.LSTM(UNITS, **drawn()), backward_layer=back)
    glorot = initializers.GlorotUniform
    between = [layers.Dense(HIDDEN, "sigmoid", kernel_initializer=glorot(next(seeds)))]
    output = layers.Dense(3, kernel_initializer=glorot(next(seeds)))
    return Sequential([Input((None, inputs)), recurrent, *(between if dense else []), output])


def fit(
    model: Any,
    inputs: FloatArray,
    targets: FloatArray,
    rows: BoolArray,
    training: Training,
    progress: Progress,
) -> FloatArray:
    """Train a network of :func:`build` as published, and predict every frame.

    Parameters
    ----------
    model : changed in place
    inputs : (frames, k) standardised
    targets : (frames, 3) standardised
    rows : (frames,) bool, those to learn from
    training : the settings
    progress : told every epoch; may raise ``Cancelled``

    Returns
    -------
    (frames, 3)
    """
    from keras import callbacks, ops, optimizers

    class Tell(callbacks.Callback):  # type: ignore[misc]
        """Reports each epoch, and so lets it be stopped."""

        def on_epoch_end(self, epoch: int, logs: dict[str, float] | None = None) -> None:
            loss = f", error {logs['loss']:.3g}" if logs else ""
            told = f"Epoch {epoch + 1} of {training.epochs}{loss}"
            progress((epoch + 1) / training.epochs, told)

    def half_squares(wanted: Any, found: Any) -> Any:
        return 0.5 * ops.sum(ops.square(wanted - found), axis=-1)

    falling = optimizers.schedules.ExponentialDecay(
        training.rate, training.period, training.drop, staircase=True
    )
    model.compile(
        optimizer=optimizers.SGD(falling, training.momentum, clipnorm=training.threshold),
        loss=half_squares,
    )
    # The loss is averaged over all frames, those without weight included.
    weight = rows / rows.mean()
    progress(0.0, "Compiling the network")
    model.fit(
        inputs[None],
        targets[None],
        sample_weight=weight[None],
        epochs=training.epochs,
        batch_size=1,
        verbose=0,
        callbacks=[Tell()],
    )
    found = model.predict(inputs[None], verbose=0)[0]
    return np.asarray(found, dtype=np.float64)


def _learn(kind: str) -> Learn:
    """Training of one kind of network."""

    def learn(
        inputs: FloatArray, targets: FloatArray, rows: BoolArray, params: Any, progress: Progress
    ) -> FloatArray:
        model = build(kind, inputs.shape[1], dense=params.dense, seed=params.seed)
        return fit(model, inputs, targets, rows, Training(params.epochs), progress)

    return learn


def _method(kind: str, label: str) -> MethodFunction:
    """A repair method that says how to get the extra where it is missing."""

    def count(inputs: int, params: Any) -> int:
        return count_weights(kind, inputs, dense=params.dense)

    method = network_method(kind, _learn(kind), count)

    def run(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
        if not can_learn():
            return refuse(kind, f"{label} needs an optional extra: {INSTALL}.", params)
        return method(evidence, artifact, params)

    return run


for _kind, _label, _what in (
    ("lstm", "LSTM", "60 long short-term memory neurons"),
    ("gru", "GRU", "60 gated recurrent neurons"),
    ("bilstm", "BiLSTM", "Long short-term memory in both directions"),
):
    register(
        _kind,
        label=_label,
        summary=f"{_what} predict the marker from its parent and siblings; trains for seconds.",
        params=RecurrentParams,
        source="skurowski2021, 3.1.2 to 3.1.4; needs the extra “deep”",
    )(_method(_kind, _label))
