"""What can be repaired, and by which methods: the same for buttons, keys and palette."""

from __future__ import annotations

from markermend.artifact import Status
from markermend_app.document import Document


def can_repair(document: Document) -> bool:
    """Whether what is under review is to be repaired.

    Where no method has a repair it is all the same: then the flag is accepted, or it is said why
    the method that was chosen does not repair it.
    """
    a = document.current
    return document.editable and a is not None and a.status is not Status.REPAIRED


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
