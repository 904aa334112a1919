"""Loose feed-forward network: where a marker should be, slow to follow an artifact.

Section 3.3.3 of skurowski2022. Inputs are the coordinates of parent and siblings in this and
the former frame, and the marker's own moving average over 200 samples, each in powers 1 and 2.
Two hidden layers have 12 and 4·M sigmoid neurons; the output repeats the position five times
and the repetitions are averaged (eq. 11). (11) uses M for the repetitions, hence 20.

Deviations. Coordinates are taken relative to the mean of the neighbours: on takes in which the
person walks, a network on absolute coordinates spends itself on where the person is (measured on
a dance of 33 s, 300 iterations: residual 10.7 mm, relative 1.3 mm). scikit-learn has no scaled
conjugate gradient, so training is by L-BFGS; it learns from at most 1,500 frames spread evenly
over the take and stops after 400 iterations. Frames in which the marker is not trusted are left
out of training.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import uniform_filter1d
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.predictors.inputs import (
    Inputs,
    gather,
    lagged_powers,
    neighbours_of,
    standardised,
    trusted_samples,
)
from markermend.take import Take

# Fewer rows than this cannot say anything about some thousand weights.
LEAST_ROWS = 50
# A coordinate that moves less than this share of the liveliest is not scaled up any further; else
# the network learns its noise.
FLOOR = 0.1


@dataclass(frozen=True)
class FfnnParams:
    """Shape and training of the network; frames are at 100 Hz and scaled to the take's rate."""

    first: int = field(default=12, metadata={"help": "Neurons of the first hidden layer", "min": 1})
    second: int = field(
        default=20, metadata={"help": "Neurons of the second hidden layer, 4·M", "min": 1}
    )
    replicas: int = field(
        default=5,
        metadata={"help": "Repetitions of the output that are averaged (eq. 11)", "min": 1},
    )
    lags: int = field(default=1, metadata={"help": "Former frames of the neighbours", "min": 0})
    powers: int = field(default=2, metadata={"help": "Highest power of the inputs, L", "min": 1})
    average: int = field(
        default=200,
        metadata={"help": "Window of the own moving average", "unit": "frames", "min": 1},
    )
    iterations: int = field(default=400, metadata={"help": "Steps of training at most", "min": 1})
    rows: int = field(
        default=1500, metadata={"help": "Frames to learn from at most", "unit": "frames", "min": 50}
    )


def predict_ffnn(
    take: Take,
    mesh: Mesh,
    marker: int,
    *,
    trusted: BoolArray | None = None,
    params: FfnnParams | None = None,
    seed: int = 0,
) -> FloatArray:
    """Predict a marker from the rest of its body by a network trained on this take.

    Parameters
    ----------
    take : the recording
    mesh : the body's structure
    marker : column of the marker to predict
    trusted : (frames, markers, 3) bool, samples that may be believed; all seen ones by default
    params : shape and training of the network
    seed : of the initial weights; the same seed gives the same prediction

    Returns
    -------
    (frames, 3) mm; NaN where fewer than half of the neighbours are trusted

    Raises
    ------
    DataError
        when the marker has no neighbour, or too few frames to learn from
    """
    known = trusted_samples(take, trusted)
    inputs = gather(take.positions, known, marker, neighbours_of(take, mesh, marker))
    if inputs.fit.sum() < LEAST_ROWS:
        raise DataError(
            f"Marker “{take.labels[marker]}” is seen together with its neighbours in fewer than "
            f"{LEAST_ROWS} frames; that is too few to learn from."
        )
    return fit_and_predict(inputs, take.rate, params or FfnnParams(), seed + marker)


def fit_and_predict(inputs: Inputs, rate: float, params: FfnnParams, seed: int) -> FloatArray:
    """Train on the rows that may be learnt from, predict all usable ones.

    Parameters
    ----------
    inputs : a marker and its neighbours, with at least 50 rows to learn from
    rate : frames per second
    params : shape and training of the network
    seed : of the initial weights

    Returns
    -------
    (frames, 3) mm; NaN where not usable
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.neural_network import MLPRegressor

    frames = len(inputs.own)
    centre = inputs.neighbours.mean(axis=1)
    own = inputs.own - centre
    window = max(1, min(round(params.average * rate / 100), frames))
    average = uniform_filter1d(own, window, axis=0, mode="nearest")
    neighbours = (inputs.neighbours - centre[:, None]).reshape(frames, -1)
    around = lagged_powers(neighbours, params.lags, params.powers, floor=FLOOR)
    design = np.concatenate([around, lagged_powers(average, 0, params.powers, floor=FLOOR)], axis=1)
    learnt = np.flatnonzero(inputs.fit)
    learnt = learnt[:: max(1, int(np.ceil(len(learnt) / params.rows)))]
    target = own[learnt]
    scale = np.maximum(target.std(axis=0), max(FLOOR * target.std(axis=0).max(), 1e-6))

    network = MLPRegressor(
        hidden_layer_sizes=(params.first, params.second),
        activation="logistic",
        solver="lbfgs",
        max_iter=params.iterations,
        random_state=seed,
    )
    with threadpool_limits(1), warnings.catch_warnings():
        # Stopping before convergence is what keeps the predictor loose.
        warnings.simplefilter("ignore", ConvergenceWarning)
        network.fit(design[learnt], np.tile(standardised(target, FLOOR), params.replicas))
        replicas = network.predict(design).reshape(frames, params.replicas, 3)
    predicted = centre + replicas.mean(axis=1) * scale + target.mean(axis=0)
    predicted[~inputs.usable] = np.nan
    return np.asarray(predicted, dtype=np.float64)
