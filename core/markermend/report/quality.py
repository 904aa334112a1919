"""A take's quality at a glance: what an index shows of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from markermend.artifact import Kind, Status
from markermend.outcome import Outcome
from markermend.take import Take


@dataclass(frozen=True)
class Quality:
    """What is told about one take beside others.

    Attributes
    ----------
    name : of the take, unique in its report
    frames, rate, markers : size of the recording; markers are the named ones
    gap_before, gap_after : share in [0, 1] of the named markers' samples that are missing
    found, repaired : artifacts by class
    review : artifacts that wait for an operator: pending and not repaired
    worst_mm : largest expected error of a repair, or None; swaps invent nothing, and have none
    """

    name: str
    frames: int
    rate: float
    markers: int
    gap_before: float
    gap_after: float
    found: Mapping[str, int]
    repaired: Mapping[str, int]
    review: int
    worst_mm: float | None

    def to_dict(self) -> dict[str, Any]:
        """Return plain values for ``json.dumps``."""
        return asdict(self)


def quality(
    name: str,
    before: Take,
    after: Take,
    done: Sequence[Outcome],
    region: tuple[int, int] | None = None,
) -> Quality:
    """Sum a cleaned take up.

    Parameters
    ----------
    name : of the take
    before, after : the same recording as read and as repaired
    done : what became of every artifact
    region : frames in which missing samples are counted, a half-open interval; None for all
    """
    found = Counter(o.artifact.kind for o in done)
    repaired = Counter(o.artifact.kind for o in done if o.method is not None)
    errors = [o.error_mm for o in done if o.error_mm]
    return Quality(
        name=name,
        frames=before.frames,
        rate=before.rate,
        markers=len(before.named),
        gap_before=gap_share(before, region),
        gap_after=gap_share(after, region),
        found={kind.value: found[kind] for kind in Kind},
        repaired={kind.value: repaired[kind] for kind in Kind},
        review=sum(waits(o) for o in done),
        worst_mm=float(max(errors)) if errors else None,
    )


def waits(outcome: Outcome) -> bool:
    """Whether an artifact is left for an operator to decide."""
    return outcome.method is None and outcome.artifact.status is Status.PENDING


def gap_share(take: Take, region: tuple[int, int] | None = None) -> float:
    """Share in [0, 1] of the named markers' samples that are missing; 0 without any marker."""
    if not take.named or not take.frames:
        return 0.0
    rows = slice(*(region or (0, take.frames)))
    return float(1.0 - take.present[rows, take.named].mean())
