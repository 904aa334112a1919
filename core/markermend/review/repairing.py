"""Repairing an artifact as it was proposed: the edits of a review that this takes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from markermend.artifact import Artifact, Status
from markermend.artifact_json import rounded
from markermend.errors import DataError
from markermend.review.edits import Edit, RepairNote, SetArtifacts, SetNotes, SetSamples

if TYPE_CHECKING:
    # The repair methods bring SciPy along; a review can be opened without it.
    from markermend.repairs.registry import Repair


def repairing(artifact: Artifact, proposal: Repair) -> tuple[Edit, ...]:
    """Edits that repair an artifact as proposed.

    Parameters
    ----------
    artifact : of the review
    proposal : its patches may reach no further than the artifact and its axes

    Raises
    ------
    DataError
        when the proposal has no patches, or reaches outside
    """
    if not proposal.patches:
        why = proposal.reason or "the method has no answer here"
        raise DataError(f"The {describe([artifact])} cannot be repaired: {why}")
    _check_within(artifact, proposal)
    from markermend.repairs.look_again import in_words

    band = None if proposal.band_mm is None else tuple(rounded(proposal.band_mm))
    note = RepairNote(proposal.method, proposal.error_mm, in_words(proposal.leaves or ()), band)
    return (
        SetSamples(proposal.patches),
        SetNotes({artifact.id: note}),
        SetArtifacts({artifact.id: artifact.with_status(Status.REPAIRED)}),
    )


def describe(artifacts: Sequence[Artifact]) -> str:
    """Name artifacts in a history label."""
    if len(artifacts) == 1:
        return f"{artifacts[0].kind} on {artifacts[0].marker}"
    return f"{len(artifacts)} artifacts"


def _check_within(artifact: Artifact, proposal: Repair) -> None:
    """Refuse a proposal that would touch anything its artifact does not name."""
    for p in proposal.patches:
        inside = artifact.start <= p.start and p.stop <= artifact.stop
        if p.marker not in artifact.markers or not inside or not set(p.axes) <= set(artifact.axes):
            raise DataError(
                f"The method “{proposal.method}” reached outside the artifact on "
                f"{artifact.marker}; nothing was changed."
            )
