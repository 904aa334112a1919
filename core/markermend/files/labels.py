"""Names of points: every marker needs one, and no two the same."""

from __future__ import annotations

from collections.abc import Sequence


def unique_labels(stated: Sequence[str], count: int) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Give every point a name of its own.

    Parameters
    ----------
    stated : names in the file, perhaps too few, empty or repeated
    count : number of points

    Returns
    -------
    labels : one per point; a nameless one is called ``*n`` after its place, a repeated one gets
        a number (``KNEE``, ``KNEE_2``)
    repeated : the names that occurred more than once
    """
    names = [stated[i] if i < len(stated) else "" for i in range(count)]
    taken = {name for name in names if name}
    seen: set[str] = set()
    labels: list[str] = []
    repeated: list[str] = []
    next_number: dict[str, int] = {}
    for place, name in enumerate(names, start=1):
        label = name or f"*{place}"
        if name and name in seen:
            repeated.append(name)
        while label in seen or (label != name and label in taken):
            # Counted on for each name, so that a thousand of the same take no thousand tries each.
            number = next_number.get(name, 2)
            next_number[name] = number + 1
            label = f"{name or f'*{place}'}_{number}"
        seen.add(label)
        labels.append(label)
    return tuple(labels), tuple(dict.fromkeys(repeated))
