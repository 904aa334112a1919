"""What ``clean`` and ``fill`` tell about repairs: a summary per class, a list, the reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import median

from markermend.artifact import Artifact, Kind, Status
from markermend.cli.console import count, table
from markermend.cli.detect import when
from markermend.repairs import Repair
from markermend.take import Take


@dataclass(frozen=True)
class Outcome:
    """What became of one artifact.

    Attributes
    ----------
    artifact : with status repaired where it was
    method : that repaired it, or None
    error_mm : expected error, or None when unknown
    reason : why it was left, or why another method than usual was taken; may be empty
    """

    artifact: Artifact
    method: str | None
    error_mm: float | None
    reason: str


def outcomes(
    artifacts: Iterable[Artifact],
    pairs: Sequence[tuple[Artifact, Repair]],
    min_confidence: float = 0.0,
) -> tuple[Outcome, ...]:
    """Say for every artifact what was done, in the order given.

    Parameters
    ----------
    artifacts : all that were known
    pairs : those that were tried, with their repairs
    min_confidence : below it they were not tried
    """
    tried = {artifact.id: repair for artifact, repair in pairs}
    swapped = [patch for _, repair in pairs if repair.method == "swap" for patch in repair.patches]
    result = []
    for a in artifacts:
        repair = tried.get(a.id)
        if repair is None:
            result.append(Outcome(a, None, None, _untried(a, min_confidence)))
            continue
        # The second half of a swap has no patches of its own: the first half wrote them.
        twin = repair.method == "swap" and any(
            p.marker == a.marker and a.overlaps(p.start, p.stop) for p in swapped
        )
        done = bool(repair.patches) or twin
        result.append(
            Outcome(
                a.with_status(Status.REPAIRED) if done else a,
                repair.method if done else None,
                repair.error_mm if done else None,
                repair.reason,
            )
        )
    return tuple(result)


def summary_table(done: Sequence[Outcome]) -> list[str]:
    """Per class: found, repaired, how, and the expected error."""
    rows = []
    for kind in Kind:
        of_kind = [o for o in done if o.artifact.kind is kind]
        if not of_kind:
            continue
        methods = Counter(o.method for o in of_kind if o.method)
        errors = [o.error_mm for o in of_kind if o.error_mm is not None]
        rows.append(
            [
                kind.value,
                str(len(of_kind)),
                str(methods.total()),
                ", ".join(f"{name} {n}" for name, n in methods.most_common()) or "–",
                f"{median(errors):.2f}" if errors else "–",
                f"{max(errors):.2f}" if errors else "–",
            ]
        )
    head = ["Class", "Found", "Repaired", "With", "Expected error, mm", "Worst"]
    return table(head, rows, "lrrlrr") if rows else []


def listing(take: Take, done: Sequence[Outcome]) -> list[str]:
    """Every artifact with what became of it."""
    rows = [
        [
            *when(take, o.artifact),
            o.artifact.marker,
            o.artifact.axes,
            o.artifact.kind.value,
            o.method or "left",
            "" if o.error_mm is None else f"{o.error_mm:.2f}",
            o.reason,
        ]
        for o in done
    ]
    head = ["Frames", "Seconds", "Marker", "Axes", "Class", "Repair", "mm", "Note"]
    return [*table(head, rows, "rrllllrl"), ""] if rows else []


def left_over(done: Sequence[Outcome]) -> list[str]:
    """Why some were left, a line for each reason."""
    reasons = Counter(o.reason for o in done if o.method is None)
    if not reasons:
        return []
    lines = [f"  {n:>4} × {reason}" for reason, n in reasons.most_common()]
    return ["", f"Left as they were, {count(reasons.total(), 'artifact')}:", *lines]


def _untried(artifact: Artifact, min_confidence: float) -> str:
    """Why an artifact was not even tried."""
    if artifact.status is Status.REJECTED:
        return "Rejected as a false alarm."
    if artifact.status is Status.REPAIRED:
        return "Repaired before."
    return f"Less sure than {min_confidence:g}."
