"""How sure a sudden artifact is: a logistic curve on what was measured, one for each class."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Kind
from markermend.detectors.joint.sudden import Sudden

FEATURES = ("score", "size", "beside", "one frame")
# What cannot be told apart from nothing, in mm; keeps logarithms finite.
_DUST_MM = 0.1
_SURE = 0.999


@dataclass(frozen=True)
class Curve:
    """Logistic curve: 1 / (1 + exp(−(bias + weights · features)))."""

    bias: float
    weights: tuple[float, ...]


def features(found: Sequence[Sudden]) -> FloatArray:
    """Measure artifacts for :class:`Curve`.

    Parameters
    ----------
    found : sudden artifacts of any class

    Returns
    -------
    (n, 4): logarithms of score, of size, of the neighbours' jump over the size, and whether it
    is one frame long. Nothing absolute but the size: rate, speed and place do not count.
    """
    rows = [
        (
            math.log(s.score),
            math.log(s.size_mm + _DUST_MM),
            math.log((s.beside_mm + _DUST_MM) / (s.size_mm + _DUST_MM)),
            float(s.stop - s.start == 1),
        )
        for s in found
    ]
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(FEATURES))


def confidences(found: Sequence[Sudden], curves: Mapping[Kind, Curve] | None = None) -> FloatArray:
    """Confidence of each artifact, (n,) in (0, 1); the shipped curves when none are given."""
    by_kind = curves if curves is not None else shipped_curves()
    measured = features(found)
    bias = np.array([by_kind[s.kind].bias for s in found], dtype=np.float64)
    weights = np.array([by_kind[s.kind].weights for s in found]).reshape(measured.shape)
    logit = bias + (measured * weights).sum(axis=1)
    return np.asarray(np.minimum(1.0 / (1.0 + np.exp(-np.clip(logit, -50, 50))), _SURE))


@lru_cache(maxsize=1)
def shipped_curves() -> Mapping[Kind, Curve]:
    """Read the curves that ship with Markermend (``models/sudden.json``)."""
    from importlib.resources import files

    text = files("markermend_resources").joinpath("models", "sudden.json").read_text("utf-8")
    return {
        Kind(kind): Curve(float(c["bias"]), tuple(float(w) for w in c["weights"]))
        for kind, c in json.loads(text)["curves"].items()
    }
