"""One event is one thing to decide: joints that went wrong together."""

from __future__ import annotations

from collections.abc import Iterable

from markermend.artifact import Artifact


def events(artifacts: Iterable[Artifact]) -> tuple[tuple[Artifact, ...], ...]:
    """Put artifacts together that tell of one event in a skeleton recording.

    A body that is carried off, a limb that is hidden or one that is taken for the other side's has
    an artifact on each of its joints, of one class and with the same frames.

    Parameters
    ----------
    artifacts : of a review

    Returns
    -------
    Those of one class, interval and decision, mix-ups apart; in the order of the first of each
    """
    found: dict[object, list[Artifact]] = {}
    for a in artifacts:
        key = (a.kind, a.start, a.stop, a.axes, a.status, len(a.markers) > 1)
        found.setdefault(key, []).append(a)
    return tuple(map(tuple, found.values()))
