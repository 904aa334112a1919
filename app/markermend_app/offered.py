"""Which repair methods can be chosen for the artifact under review, by button, key or palette."""

from __future__ import annotations

from markermend.artifact import Status
from markermend_app.document import Document


def is_offered(document: Document, method: str) -> bool:
    """Whether a method can be chosen: what is under review is open, and may be swapped for a swap.

    Only joints that were mixed up can be swapped, unless that was refused there.
    """
    a = document.current
    if a is None or a.status is Status.REPAIRED or not document.editable:
        return False
    if method != "swap" or not document.joints:
        return True
    answer = document.proposals.get(a, "swap")
    return a.counterpart is not None and (answer is None or bool(answer.patches))
