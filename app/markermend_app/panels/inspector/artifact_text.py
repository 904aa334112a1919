"""An artifact in words, for tooltips and lists."""

from __future__ import annotations

from markermend.artifact import PAIRED, Artifact, Status
from markermend.take import Take
from markermend_app.style import theme
from markermend_app.telling import told
from markermend_app.words import tr as _tr

STATUS_NAME = {
    Status.PENDING: "open",
    Status.ACCEPTED: "accepted",
    Status.REJECTED: "rejected",
    Status.REPAIRED: "repaired",
}


def span(artifact: Artifact, first_frame: int) -> str:
    """Its first frame and its last as the file counts them, or the only one."""
    first, last = artifact.start + first_frame, artifact.stop - 1 + first_frame
    return f"{first}–{last}" if artifact.length > 1 else str(first)


def describe(take: Take, artifact: Artifact) -> str:
    """Marker, class, frames as the file counts them, confidence, decision; and why, below."""
    text = _tr("{marker} · {kind} · frames {first}–{last} · {sure:.0%} sure · {status}").format(
        marker=PAIRED.join(artifact.markers),
        kind=theme.kind_name(artifact.kind),
        first=take.frame_number(artifact.start),
        last=take.frame_number(artifact.stop - 1),
        sure=artifact.confidence,
        status=_tr(STATUS_NAME[artifact.status]),
    )
    return f"{text}\n{told(artifact.why)}" if artifact.why else text
