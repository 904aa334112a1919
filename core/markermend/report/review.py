"""The report of a review: what the operator decided, with notes, work by hand and pace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from markermend.artifact import Artifact, Status
from markermend.outcome import Outcome
from markermend.report.sections import take_report
from markermend.review.pace import Pace
from markermend.review.session import Session
from markermend.take import Take

_LEFT = {
    Status.PENDING: "Not decided yet.",
    Status.ACCEPTED: "Accepted: the flag is right, the samples are left.",
    Status.REJECTED: "Rejected as a false alarm.",
}


def review_outcomes(session: Session) -> tuple[Outcome, ...]:
    """Say what became of every artifact that a review asks about, by start and marker."""
    return tuple(_outcome(session, a) for a in session.listed)


@dataclass(frozen=True, eq=False)
class Reviewed:
    """A review as it stood at a moment; later decisions do not change it.

    Attributes
    ----------
    before : the take as read
    held : makes the take as it stood
    done : what became of every artifact
    method : what found them
    pace : the operator's
    by_hand : what was done to samples and names by hand, one line each
    region : the frames that were reviewed, a half-open interval; None for all of the take
    """

    before: Take
    held: Callable[[], Take]
    done: tuple[Outcome, ...]
    method: str
    pace: Pace
    by_hand: tuple[str, ...]
    region: tuple[int, int] | None = None


def reviewed(session: Session) -> Reviewed:
    """Hold on to a review as it stands."""
    searched = dict.fromkeys(
        label.removeprefix("Detect (").removesuffix(")")
        for label in session.history
        if label.startswith("Detect (")
    )
    return Reviewed(
        session.original,
        session.state.held(),
        review_outcomes(session),
        ", ".join(searched) or "hand",
        session.pace,
        session.by_hand,
        session.region,
    )


def review_report(review: Reviewed, *, name: str) -> str:
    """Report on a review.

    Parameters
    ----------
    review : from :func:`reviewed`
    name : the take's file name

    Returns
    -------
    An HTML page as :func:`markermend.report.take_report` makes it
    """
    return take_report(
        review.before,
        review.held(),
        review.done,
        method=review.method,
        name=name,
        pace=review.pace,
        by_hand=review.by_hand,
        region=review.region,
    )


def _outcome(session: Session, artifact: Artifact) -> Outcome:
    """What became of one artifact."""
    if artifact.status is not Status.REPAIRED:
        return Outcome(artifact, None, None, _LEFT[artifact.status])
    note = session.notes.get(artifact.id)
    if note is None:
        return Outcome(artifact, "by hand", None, "")
    band = None if note.band_mm is None else np.array(note.band_mm)
    return Outcome(artifact, note.method, note.error_mm, note.leaves, band)
