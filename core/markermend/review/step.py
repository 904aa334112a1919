"""One step of a review, and what can be asked of it."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass

from markermend.artifact import Artifact
from markermend.patch import Patch
from markermend.review.edits import Edit, Group, SetArtifacts, SetNames, SetRegion, SetSamples


@dataclass(frozen=True)
class Step:
    """One entry of the history.

    Attributes
    ----------
    label : what it is called
    edit, inverse : what it does and what takes it back
    spent_s : seconds of work that the review had taken when it was done
    by_itself : whether it came with opening the take, and no operator did it
    """

    label: str
    edit: Edit
    inverse: Edit
    spent_s: float = 0.0
    by_itself: bool = False


FOUND_BEFORE = "Found before the export"
"""Label of what a detector had found when the take was exported over its original."""


def decides(step: Step) -> bool:
    """Whether a step holds a decision, not just what was found or the frames that matter."""
    found = step.label == FOUND_BEFORE or step.label.startswith("Detect (")
    return not found and not isinstance(step.edit, SetRegion)


def parts(edit: Edit, *kinds: type) -> list[Edit]:
    """Those of the edits that one is made of that are of these kinds."""
    if isinstance(edit, Group):
        return [part for inner in edit.edits for part in parts(inner, *kinds)]
    return [edit] if isinstance(edit, kinds) else []


def artifacts_of(step: Step) -> tuple[str, ...]:
    """Ids of the artifacts that a step adds, changes or removes."""
    return tuple(
        i
        for part in parts(step.edit, SetArtifacts)
        if isinstance(part, SetArtifacts)
        for i in part.changes
    )


def stretch(step: Step) -> tuple[int, int] | None:
    """First frame, and the one past the last, that a step is about; None if it is about many.

    Where an artifact's edges are moved these are its frames afterwards.
    """
    about = artifacts_of(step)
    if step.label.startswith(("Nudge ", "Adjust ", "Call ")):
        # What a gap leaves to others beside it is not what was moved.
        about = about[:1]
    several = len(about) > 1
    after = _places(step.edit, about)
    if not decides(step) or parts(step.edit, SetNames):
        return None
    if len(after) == 1 and not parts(step.edit, SetSamples):
        return after.pop()
    one_place = len(after | _places(step.inverse, about)) == 1
    if several and not (one_place or step.label.startswith(("Split ", "Join "))):
        return None
    found: list[Artifact | Patch] = []
    for edit in (step.inverse, step.edit):
        for part in parts(edit, SetArtifacts, SetSamples):
            if isinstance(part, SetSamples):
                found.extend(part.patches)
            elif isinstance(part, SetArtifacts):
                found.extend(a for i, a in part.changes.items() if a is not None and i in about)
    if not found:
        return None
    return min(x.start for x in found), max(x.stop for x in found)


def _places(edit: Edit, about: Container[str]) -> set[tuple[int, int]]:
    """Intervals of artifacts with these ids that an edit leaves."""
    return {
        (a.start, a.stop)
        for part in parts(edit, SetArtifacts)
        if isinstance(part, SetArtifacts)
        for i, a in part.changes.items()
        if a is not None and i in about
    }


def touched_by_hand(steps: Iterable[Step]) -> set[str]:
    """Ids of artifacts that the operator marked, changed or decided about in these steps."""
    return {i for step in steps if decides(step) for i in artifacts_of(step)}
