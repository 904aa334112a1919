"""The residual network of goncalves2024, run without the library that trained it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import savgol_filter

from markermend.arrays import Float32Array, FloatArray
from markermend.errors import FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.normal import FEATURES
from markermend.poses.nuitrack import JOINTS
from markermend.poses.quaternion import unit, unrolled, upright

PARTS = {"both": slice(0, 7), "positions": slice(0, 3), "rotations": slice(3, 7)}
"""What a network sees and returns of each joint."""

_WINDOW, _DEGREE = 9, 2


@dataclass(frozen=True, eq=False)
class Network:
    """Weights of a trained network.

    Attributes
    ----------
    parts : which features it takes, a name of :data:`PARTS`
    centre, spread : (inputs,) of the damaged poses it learnt from (the paper's z-score)
    weights : one (inputs, outputs) array for each dense layer
    biases : one (outputs,) array for each
    """

    parts: str
    centre: Float32Array
    spread: Float32Array
    weights: tuple[Float32Array, ...]
    biases: tuple[Float32Array, ...]

    def __call__(self, features: FloatArray) -> FloatArray:
        """Return what the network makes of poses, one by one.

        Parameters
        ----------
        features : (frames, joints, 7) normalised, the waist first; signs as w at least 0

        Returns
        -------
        (frames, joints, 7); rotations of unit length. What the network does not know stays.
        """
        columns = PARTS[self.parts]
        seen = features[:, 1:, columns]
        x = (seen.reshape(len(seen), -1).astype(np.float32) - self.centre) / self.spread
        hidden = np.maximum(x @ self.weights[0] + self.biases[0], 0.0)
        for weight, bias in zip(self.weights[1:-1], self.biases[1:-1], strict=True):
            hidden = hidden + np.maximum(hidden @ weight + bias, 0.0)
        out = features.copy()
        out[:, 1:, columns] = (hidden @ self.weights[-1] + self.biases[-1]).reshape(seen.shape)
        if self.parts != "positions":
            out[:, :, 3:] = upright(unit(out[:, :, 3:]))
        return out


def smoothed(features: FloatArray) -> FloatArray:
    """Pass poses through the paper's temporal filter, Savitzky–Golay (3.2.5).

    Parameters
    ----------
    features : (frames, joints, 7), consecutive

    Notes
    -----
    The paper gives neither window nor degree; nine frames and parabolas are used.
    """
    if len(features) < _WINDOW:
        return features
    turns = unrolled(features[..., 3:])
    path = np.concatenate([features[..., :3], turns], axis=2)
    path = np.asarray(savgol_filter(path, _WINDOW, _DEGREE, axis=0))
    path[..., 3:] = upright(unit(path[..., 3:]))
    return path


def save_networks(networks: dict[str, Network], path: Path) -> None:
    """Write networks as half-precision arrays, which costs them nothing that can be seen."""
    arrays: dict[str, Any] = {}
    for name, network in networks.items():
        arrays[f"{name}/parts"] = np.array(network.parts)
        arrays[f"{name}/centre"], arrays[f"{name}/spread"] = network.centre, network.spread
        for i, (weight, bias) in enumerate(zip(network.weights, network.biases, strict=True)):
            arrays[f"{name}/weight{i}"] = weight.astype(np.float16)
            arrays[f"{name}/bias{i}"] = bias.astype(np.float16)
    write_arrays(path, arrays)


def load_networks(path: Path) -> dict[str, Network]:
    """Read what :func:`save_networks` wrote.

    Raises
    ------
    FileFormatError
        when the file holds no networks
    """
    try:
        arrays = read_arrays(path)
        names = dict.fromkeys(key.rpartition("/")[0] for key in arrays)
        return {name: _network(name, arrays) for name in names}
    except (ValueError, KeyError) as error:
        raise FileFormatError(
            f"{path.name} holds no trained networks; “markermend train pose” writes them."
        ) from error


def _network(name: str, arrays: dict[str, Any]) -> Network:
    """One network out of the arrays of a file."""
    parts = str(arrays[f"{name}/parts"])
    layers = sum(key.startswith(f"{name}/weight") for key in arrays)
    inputs = (len(JOINTS) - 1) * len(range(FEATURES)[PARTS[parts]])
    weights = tuple(arrays[f"{name}/weight{i}"].astype(np.float32) for i in range(layers))
    if layers < 2 or weights[0].shape[0] != inputs or weights[-1].shape[1] != inputs:
        raise ValueError(f"{name} does not fit {inputs} features")
    return Network(
        parts,
        arrays[f"{name}/centre"],
        arrays[f"{name}/spread"],
        weights,
        tuple(arrays[f"{name}/bias{i}"].astype(np.float32) for i in range(layers)),
    )
