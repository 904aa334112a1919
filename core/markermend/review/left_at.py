"""Where the operator stood in a review, to go on there when it is opened again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class LeftAt:
    """What was looked at last.

    Attributes
    ----------
    artifact : id of the one under review, or None
    frame : 0-based index of the cursor's
    """

    artifact: str | None
    frame: int


def left_at_to_dict(left: LeftAt | None) -> dict[str, Any] | None:
    """Write it for a session file or its journal."""
    return None if left is None else asdict(left)


def left_at_from_dict(entry: object) -> LeftAt | None:
    """Read it back; None where it is none: no review is refused for that."""
    if not isinstance(entry, Mapping):
        return None
    artifact, frame = entry.get("artifact"), entry.get("frame")
    if not isinstance(frame, int) or not isinstance(artifact, str | None):
        return None
    return LeftAt(artifact, frame)
