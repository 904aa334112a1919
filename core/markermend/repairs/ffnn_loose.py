"""The loose network's prediction, as skurowski2022 repairs with it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.artifact import Artifact
from markermend.errors import DataError
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse


@dataclass(frozen=True)
class FfnnLooseParams:
    """Training of the network; its shape is as published."""

    iterations: int = field(
        default=150, metadata={"min": 1, "max": 10_000, "help": "Steps of training at most"}
    )
    seed: int = field(default=0, metadata={"min": 0, "help": "Of the initial weights"})


@register(
    "ffnn_loose",
    label="Loose network",
    summary="A small network trained on this take predicts the marker from its body; slow.",
    params=FfnnLooseParams,
    source="skurowski2022, 3.3.3 and 4.1.2 (E3)",
    key=8,
)
def repair_ffnn_loose(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Replace the interval by the loose FFNN's prediction from parent and siblings."""
    from markermend.mesh import infer_mesh
    from markermend.predictors.ffnn import FfnnParams, predict_ffnn

    take = evidence.take
    try:
        predicted = predict_ffnn(
            take,
            evidence.mesh or infer_mesh(take),
            take.index(artifact.marker),
            trusted=evidence.trusted,
            params=FfnnParams(iterations=params.iterations),
            seed=params.seed,
        )
    except DataError as error:
        return refuse("ffnn_loose", str(error), params)
    values = predicted[artifact.start : artifact.stop]
    if np.isnan(values).any():
        return refuse(
            "ffnn_loose", "Too many of the marker's neighbours are missing in the interval.", params
        )
    return make_repair("ffnn_loose", evidence, artifact, values, params)
