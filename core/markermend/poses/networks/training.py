"""Train the residual network of goncalves2024 with Keras on JAX (extra ``deep``)."""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.arrays import Float32Array, FloatArray
from markermend.errors import MethodError
from markermend.poses.networks.network import PARTS, Network
from markermend.poses.nuitrack import PARENTS
from markermend.poses.simulated.noise import Noise, corrupt
from markermend.progress import Progress, quiet

_UNITS = 1000
_LEAST_SPREAD = 1e-3
_STEPS_AT_ONCE = 8


@dataclass(frozen=True)
class Training:
    """How long and how a network learns.

    Attributes
    ----------
    epochs : times each pose is seen, damaged anew each time
    batch : poses a step
    rate : of Adam, falling to nothing along a cosine
    seed : of weights, damage and order
    """

    epochs: int = 100
    batch: int = 512
    rate: float = 1e-3
    seed: int = 0


def train_network(
    features: FloatArray,
    noise: Noise,
    *,
    parts: str = "both",
    training: Training = Training(),
    resume: Path | None = None,
    progress: Progress | None = None,
) -> Network:
    """Learn to undo a noise.

    Parameters
    ----------
    features : (poses, joints, 7) clean, normalised, the waist first, signs as w at least 0
    noise : put on them
    parts : name of :data:`markermend.poses.networks.network.PARTS`
    training : how
    resume : file ending in ``.keras`` that keeps the state of each epoch, so that a training that
        was stopped goes on
    progress : told the share of epochs done; may raise to stop

    Returns
    -------
    Network

    Raises
    ------
    MethodError
        when Keras or JAX is not installed, or the state is of another training

    Notes
    -----
    goncalves2024, 3.3: z-score within the model, a dense layer of 1000, one residual block of
    1000, mean absolute error.
    """
    keras = _keras()
    keras.utils.set_random_seed(training.seed)
    columns = PARTS[parts]

    def flat(poses: FloatArray) -> Float32Array:
        return np.asarray(poses[:, 1:, columns].reshape(len(poses), -1), dtype=np.float32)

    def damage(epoch: int) -> Float32Array:
        seed = int(np.random.SeedSequence([training.seed, epoch]).generate_state(1)[0])
        return flat(corrupt(features, PARENTS, noise, seed=seed)[0])

    clean, first = flat(features), damage(0)
    centre, spread = first.mean(axis=0), np.maximum(first.std(axis=0), _LEAST_SPREAD)
    steps = -(-len(clean) // training.batch)
    # The state keeps it as the network's name.
    which = _fingerprint(features, noise, parts, training)
    if resume is not None and resume.exists():
        model = keras.models.load_model(resume)
        if model.name != which:
            raise MethodError(
                f"{resume.name} is the state of a training on other poses or with other options;"
                " remove it to begin anew."
            )
    else:
        model = _model(keras, clean.shape[1], training.rate, steps * training.epochs, which)
    for epoch in range(int(model.optimizer.iterations) // steps, training.epochs):
        order = np.random.default_rng([training.seed, epoch]).permutation(len(clean))
        x = ((damage(epoch) - centre) / spread)[order]
        told = model.fit(x, clean[order], training.batch, verbose=0, shuffle=False)
        if resume is not None:
            model.save(resume)
        error = told.history["loss"][-1]
        (progress or quiet)((epoch + 1) / training.epochs, f"Mean absolute error {error:.4f}")
    layers = [layer.get_weights() for layer in model.layers if layer.get_weights()]
    return Network(parts, centre, spread, tuple(w for w, _ in layers), tuple(b for _, b in layers))


def held_out_error(network: Network, features: FloatArray, noise: Noise, *, seed: int) -> float:
    """Mean absolute error of a network on poses that it did not learn from.

    Parameters
    ----------
    network : over the features that it returns
    features : (poses, joints, 7) as :func:`train_network` takes them
    noise : put on them
    seed : of the noise
    """
    columns = PARTS[network.parts]
    undone = network(corrupt(features, PARENTS, noise, seed=seed)[0])
    return float(np.abs(undone[:, 1:, columns] - features[:, 1:, columns]).mean())


def _fingerprint(features: FloatArray, noise: Noise, parts: str, training: Training) -> str:
    """A name that only this training has: of its poses, what is done to them, and how."""
    told = hashlib.sha256(np.ascontiguousarray(features).tobytes())
    told.update(repr((features.shape, noise, parts, training)).encode())
    return f"training_{told.hexdigest()[:16]}"


def _model(keras: Any, width: int, rate: float, steps: int, name: str) -> Any:
    """Build the network of the paper's Figure 10."""
    dense = keras.layers.Dense
    inputs = keras.Input((width,))
    first = dense(_UNITS, "relu")(inputs)
    block = keras.layers.Add()([first, dense(_UNITS, "relu")(first)])
    model = keras.Model(inputs, dense(width)(block), name=name)
    pace = keras.optimizers.schedules.CosineDecay(rate, steps)
    model.compile(keras.optimizers.Adam(pace), "mae", steps_per_execution=_STEPS_AT_ONCE)
    return model


def _keras() -> Any:
    """Import Keras with JAX below it."""
    os.environ.setdefault("KERAS_BACKEND", "jax")
    try:
        import jax  # noqa: F401
        import keras
    except ImportError as error:
        raise MethodError(
            "Training needs Keras and JAX; install them with: "
            'python -m pip install "markermend[deep]"'
        ) from error
    return keras
