"""E2: detect on raw takes, and hold what is flagged against a list that people reviewed.

skurowski2022, section 4.2.2 and Table 2. Beyond the paper: a repaired take is looked at again and
what the repair added is counted, since its authors found that operators often add more damage
than they remove.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from markermend.artifact import Artifact, Kind
from markermend.detectors import detect
from markermend.progress import Progress, part
from markermend.repairs import repair
from markermend.take import Take

SURE = 0.75
"""Entries of a list below this confidence are doubtful: neither right nor wrong to flag."""
MOSTLY = 0.5
SLACK_S = 0.012
"""Where damage begins and ends is a matter of opinion within so many seconds."""


class Verdict(StrEnum):
    """What a reviewed list says about a flag."""

    APPROVED = "approved"
    REJECTED = "rejected"
    DOUBTFUL = "doubtful"


@dataclass(frozen=True)
class Reviewed:
    """A raw take with what is truly damaged in it.

    Attributes
    ----------
    name : for the table
    take : the recording
    listed : its damage; entries of a confidence below 0.75 are doubtful
    complete_from_mm : size from which the list is complete; smaller flags on no entry are doubtful
    """

    name: str
    take: Take
    listed: tuple[Artifact, ...]
    complete_from_mm: float = 0.0


@dataclass(frozen=True)
class E2Row:
    """What one detector did on one take, or on its repaired version.

    Attributes
    ----------
    take, method : names
    repair : how the take was repaired before it was looked at; empty for the raw take
    listed : entries that must be found
    flags : artifacts found, gaps left out
    approved : flags mostly on entries
    named : of them, those on an entry of their class
    rejected : flags mostly on clean samples
    doubtful : flags on doubtful entries, or too small for the list to tell
    missed : entries on which no approved flag lies
    added : flags on the repaired take that neither an entry nor a flag on the raw take explains
    minutes : length of the take
    """

    take: str
    method: str
    repair: str
    listed: int
    flags: int
    approved: int
    named: int
    rejected: int
    doubtful: int
    missed: int
    added: int
    minutes: float


def e2(
    takes: Sequence[Reviewed],
    *,
    methods: Sequence[str] = ("joint", "paper"),
    params: Mapping[str, Any] | None = None,
    repairs: Sequence[str] = (),
    repaired: Mapping[str, Sequence[tuple[str, Take]]] | None = None,
    progress: Progress | None = None,
) -> tuple[E2Row, ...]:
    """Detect on raw takes and on repaired ones, and count.

    Parameters
    ----------
    takes : raw recordings with their reviewed lists
    methods : names of detection methods
    params : parameters by method, their defaults where not given
    repairs : repair methods; each repairs, on every take, what its list is sure of
    repaired : by name of a take, other versions of it that somebody repaired, with names
    progress : told the share done; may raise ``Cancelled``

    Returns
    -------
    A row for every take and method, then one for each of its repaired versions

    Raises
    ------
    MethodError
        for an unknown method
    """
    chosen = dict(params or {})
    rows = []
    for number, reviewed in enumerate(takes):
        share = part(progress, number / len(takes), (number + 1) / len(takes))
        share(0.0, reviewed.name)
        sure = [a for a in reviewed.listed if a.confidence >= SURE]
        versions = [(name, repair(reviewed.take, sure, method=name)) for name in repairs]
        versions += list((repaired or {}).get(reviewed.name, ()))
        for k, method in enumerate(methods):
            share(k / len(methods), f"{reviewed.name}, {method}")
            before = _flags(reviewed.take, method, chosen.get(method))
            rows.append(_count(reviewed, reviewed.take, method, "", before, ()))
            for name, take in versions:
                after = _flags(take, method, chosen.get(method))
                rows.append(_count(reviewed, take, method, name, after, before))
    return tuple(rows)


def judge(
    flag: Artifact, listed: Sequence[Artifact], complete_from_mm: float, slack: int
) -> tuple[Verdict, list[Artifact]]:
    """Say what a list makes of a flag.

    Parameters
    ----------
    flag : an artifact that was found
    listed : the reviewed entries of the same take
    complete_from_mm : size below which a flag on no entry is doubtful
    slack : frames by which entries are widened on either side

    Returns
    -------
    the verdict, and the sure entries the flag lies on. A flag is approved or doubtful when half
    of its frames lie on entries of its marker that share an axis with it
    """
    near = [e for e in listed if _same_place(flag, e, slack)]
    covered = set[int]()
    for e in near:
        covered |= set(range(max(flag.start, e.start - slack), min(flag.stop, e.stop + slack)))
    if len(covered) < MOSTLY * flag.length:
        small = flag.amplitude_mm < complete_from_mm
        return (Verdict.DOUBTFUL if small else Verdict.REJECTED), []
    sure = [e for e in near if e.confidence >= SURE]
    return (Verdict.APPROVED if sure else Verdict.DOUBTFUL), sure


def _same_place(flag: Artifact, entry: Artifact, slack: int) -> bool:
    """Whether both are about the same samples; a swap is about each of its markers."""
    return (
        bool(set(flag.markers) & set(entry.markers))
        and bool(set(flag.axes) & set(entry.axes))
        and entry.overlaps(flag.start - slack, flag.stop + slack)
    )


def _flags(take: Take, method: str, params: Any) -> tuple[Artifact, ...]:
    """What a detector finds, without the gaps."""
    found = detect(take, method=method, params=params)
    return tuple(a for a in found if a.kind is not Kind.GAP)


def _count(
    reviewed: Reviewed,
    take: Take,
    method: str,
    repaired: str,
    flags: Sequence[Artifact],
    before: Sequence[Artifact],
) -> E2Row:
    """Hold flags against the list and against what was flagged before the repair."""
    slack = max(1, round(SLACK_S * take.rate))
    verdicts: list[Verdict] = []
    named = added = 0
    hit: set[str] = set()
    for flag in flags:
        verdict, entries = judge(flag, reviewed.listed, reviewed.complete_from_mm, slack)
        verdicts.append(verdict)
        hit |= {e.id for e in entries}
        named += any(e.kind is flag.kind for e in entries)
        known = [*before, *reviewed.listed]
        added += bool(repaired) and not any(_same_place(flag, other, slack) for other in known)
    listed = [a for a in reviewed.listed if a.confidence >= SURE]
    return E2Row(
        take=reviewed.name,
        method=method,
        repair=repaired,
        listed=len(listed),
        flags=len(flags),
        approved=verdicts.count(Verdict.APPROVED),
        named=named,
        rejected=verdicts.count(Verdict.REJECTED),
        doubtful=verdicts.count(Verdict.DOUBTFUL),
        missed=sum(a.id not in hit for a in listed),
        added=added,
        minutes=take.duration_s / 60,
    )
