"""The models of tits2018 and their averages as repair methods."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from markermend.arrays import BoolArray
from markermend.artifact import Artifact
from markermend.repairs.registry import Evidence, MethodFunction, Repair, register
from markermend.repairs.result import make_repair, refuse
from markermend.repairs.tits2018.recovery import MODELS, make_scene, recover
from markermend.take import is_unlabelled


@dataclass(frozen=True)
class RecoveryParams:
    """What the recovered trajectory is held to."""

    constraints: bool = field(
        default=True,
        metadata={"help": "Hold it to continuity at the borders and to usual distances"},
    )


def _method(name: str, models: tuple[str, ...]) -> MethodFunction:
    """A repair method from a choice of models."""

    def run(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
        take, marker = evidence.take, evidence.take.index(artifact.marker)
        subject = take.subject(artifact.marker)
        body = [
            i
            for i, label in enumerate(take.labels)
            if i == marker or (not is_unlabelled(label) and take.subject(label) == subject)
        ]
        trusted: BoolArray = np.all(evidence.trusted[:, body], axis=2)
        own = body.index(marker)
        trusted[artifact.start : artifact.stop, own] = False
        if not trusted[:, own].any():
            return refuse(name, f"{artifact.marker} is not seen anywhere else.", params)
        positions = np.where(trusted[:, :, None], take.positions[:, body], np.nan)
        scene = make_scene(positions, own, take.rate, constrain=params.constraints)
        values, learnt = recover(scene, artifact.start, artifact.stop, models)
        if np.isnan(values).any():
            return refuse(
                name,
                f"No three other markers of the body are seen all through the interval of "
                f"{artifact.marker}.",
                params,
            )
        return make_repair(name, evidence, artifact, values, params, weights=learnt)

    return run


def _register(name: str, label: str, summary: str, equations: str, models: tuple[str, ...]) -> None:
    """Put one choice of models into the registry."""
    register(
        name,
        label=label,
        summary=summary,
        params=RecoveryParams,
        source=f"tits2018, {equations}",
    )(_method(name, models))


_register(
    "pma",
    "Model averaging",
    "Averages local polynomial, local GRNN, global linear and PCA by likely distances.",
    "eq. 20-27, all models but local interpolation",
    MODELS[1:],
)
_register(
    "pma_all",
    "Model averaging, all models",
    "Averages all five models by likely distances.",
    "eq. 20-27, all models",
    MODELS,
)
_register(
    "pma_no_pca",
    "Model averaging without PCA",
    "Averages all models but PCA by likely distances.",
    "eq. 20-27, all models but PCA",
    MODELS[:-1],
)
_register(
    "li",
    "Local interpolation",
    "A straight line in a system of three references.",
    "eq. 4-10",
    ("li",),
)
_register(
    "lpr",
    "Local polynomial regression",
    "Quadratic regression on three references in their own system.",
    "eq. 11-14",
    ("lpr",),
)
_register(
    "lgrnn",
    "Local GRNN",
    "Average of similar poses of three references in their own system.",
    "eq. 15",
    ("lgrnn",),
)
_register(
    "glr",
    "Global linear regression",
    "Least squares on all markers whose distance varies little.",
    "eq. 2-3",
    ("glr",),
)
_register(
    "pca",
    "Weighted PCA",
    "Rebuilds the marker from the main components of the others.",
    "model 5, after Gløersen and Federolf 2016",
    ("pca",),
)
