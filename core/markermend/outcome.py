"""What became of each artifact when a take was cleaned."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from markermend.arrays import FloatArray
from markermend.artifact import PAIRED, Artifact, Status, changed_markers
from markermend.artifact_json import document, rounded, to_dict
from markermend.repairs import REPAIRS, Repair
from markermend.repairs.look_again import in_words
from markermend.take import Take


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of one artifact.

    Attributes
    ----------
    artifact : with status repaired where it was
    method : that repaired it, or None
    error_mm : expected error, or None when unknown
    reason : why it was left, or why another method than usual was taken; may be empty
    band_mm : (stop - start,) expected deviation per frame (one standard deviation), or None
    leaves : sudden artifacts that the detector found there after the repair
    """

    artifact: Artifact
    method: str | None
    error_mm: float | None
    reason: str
    band_mm: FloatArray | None = None
    leaves: tuple[Artifact, ...] = ()

    @property
    def method_label(self) -> str:
        """What people call the method; its name where it is none of the registry's, else empty."""
        known = REPAIRS.get(self.method or "")
        return known.label if known else self.method or ""

    @property
    def who(self) -> str:
        """Names of :func:`changed_markers`."""
        return PAIRED.join(changed_markers(self.artifact, self.method))

    @property
    def unmeasured(self) -> bool:
        """Whether it was repaired and nobody knows how far off; what invents nothing never is."""
        return self.error_mm is None and self.method not in (None, "swap", "leave_empty")

    @property
    def note(self) -> str:
        """Reason and what the repair leaves, in words; may be empty."""
        return " ".join(filter(None, (self.reason, in_words(self.leaves))))


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

    Returns
    -------
    One for each artifact, which says repaired where it is
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
                repair.band_mm if done else None,
                (repair.leaves or ()) if done else (),
            )
        )
    return tuple(result)


def cleaned_document(
    take: Take,
    done: Iterable[Outcome],
    method: str,
    version: str,
    *,
    name: str,
    region: tuple[int, int] | None = None,
) -> dict[str, Any]:
    """Describe a take, its artifacts and what was done about each as one JSON document.

    Parameters
    ----------
    take : the recording
    done : written in the order given
    method : what found the artifacts
    version : Markermend's version
    name : the take's file name
    region : the frames that were asked about, a half-open interval; None for all

    Returns
    -------
    dict of :func:`markermend.artifact_json.document`; each artifact has a ``repair`` with the
        keys ``method, error_mm, band_mm, reason, leaves``; the last lists what the detector found
        there after the repair, as artifacts
    """
    known = tuple(done)
    found = (o.artifact for o in known)
    described = document(take, found, method, version, name=name, region=region)
    for item, o in zip(described["artifacts"], known, strict=True):
        error = None if o.error_mm is None else float(o.error_mm)
        item["repair"] = {
            "method": o.method,
            "error_mm": error,
            "band_mm": None if o.band_mm is None else rounded(o.band_mm),
            "reason": o.reason,
            "leaves": [to_dict(a) for a in o.leaves],
        }
    return described


def _untried(artifact: Artifact, min_confidence: float) -> str:
    """Why an artifact was not even tried."""
    if artifact.status is Status.REJECTED:
        return "Rejected as a false alarm."
    if artifact.status is Status.REPAIRED:
        return "Repaired before."
    return f"Less sure than {min_confidence:g}."
