"""The way of another marker, brought to meet the marker's own on both sides."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from markermend.arrays import BoolArray
from markermend.artifact import Artifact
from markermend.repairs.body_frame import rank_references
from markermend.repairs.bridge import bridge_within, context_of
from markermend.repairs.registry import Evidence, Repair, register
from markermend.repairs.result import make_repair, refuse

METHOD = "pattern"


@dataclass(frozen=True)
class PatternParams:
    """Which marker is followed."""

    donor: str = field(
        default="",
        metadata={"help": "Marker to follow; empty for the sibling of most constant distance"},
    )


@register(
    METHOD,
    label="Pattern",
    summary="Follows one other marker and joins both borders; for markers that move alike.",
    params=PatternParams,
)
def repair_pattern(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
    """Add the donor's movement to a smooth bridge of the distance vector between the two.

    Works with one side only, at the take's beginning and end. Refuses where the donor is not
    seen all through the interval, or never beside it together with the marker.
    """
    take, marker = evidence.take, evidence.take.index(artifact.marker)
    start, stop = artifact.start, artifact.stop
    seen = evidence.seen.copy()
    seen[start:stop, marker] = False
    donor, reason = _donor(evidence, seen, artifact, params.donor)
    if donor is None:
        return refuse(METHOD, reason, params)
    known = seen[:, marker] & seen[:, donor]
    if len(context_of(known, start, stop, take.rate)) == 0:
        reason = f"{artifact.marker} and {take.labels[donor]} are not seen together nearby."
        return refuse(METHOD, reason, params)
    apart = take.positions[:, marker] - take.positions[:, donor]
    mean, deviation = bridge_within(apart, known, start, stop, take.rate)
    values = take.positions[start:stop, donor] + mean
    return make_repair(METHOD, evidence, artifact, values, params, deviation)


def _donor(
    evidence: Evidence, seen: BoolArray, artifact: Artifact, label: str
) -> tuple[int | None, str]:
    """Column of the marker to follow, or None and why there is none."""
    from markermend.mesh import infer_mesh

    take, marker = evidence.take, evidence.take.index(artifact.marker)
    interval = slice(artifact.start, artifact.stop)
    if label:
        if label not in take or label == artifact.marker:
            return None, f"{artifact.marker} cannot follow “{label}”; name another marker."
        chosen = take.index(label)
        if not seen[interval, chosen].all():
            return None, f"{label} is not seen all through the interval."
        return chosen, ""
    ranked, _ = rank_references(take, seen, marker, interval)
    # In a blackout there is no one to follow, and no need to work out the body's structure.
    if len(ranked):
        siblings = (evidence.mesh or infer_mesh(take)).siblings(marker)
        alike = [int(m) for m in ranked if m in siblings]
        if alike:
            return alike[0], ""
    return None, (
        f"No other marker of the group of {artifact.marker} is seen all through the interval; "
        "name one to follow."
    )
