"""Names of points: every marker needs one, and no two the same."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from markermend.errors import ExportError, FileFormatError


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


def check_kept(
    labels: Sequence[str], read_back: Callable[[Sequence[str]], Sequence[str]], kind: str
) -> None:
    """Refuse names that a format would lose, or would give to other markers.

    Parameters
    ----------
    labels : one per marker
    read_back : what the format's own reader makes of a file of these names
    kind : the format, as people call it

    Raises
    ------
    ExportError
        naming the first marker whose name does not come back
    """
    if _kept(labels, read_back):
        return
    # One that is lost may shift all behind it, so each is tried by itself first.
    lost = next((s for s in labels if not _kept([s], read_back)), None)
    if lost is None:
        back = [*_read_back(labels, read_back), *[None] * len(labels)]
        lost = next(s for s, got in zip(labels, back, strict=False) if s != got)
    raise ExportError(
        f"A {kind} cannot hold a marker called “{shown(lost)}”: the name would be lost or changed"
        " when it is read; rename the marker first."
    )


def shown(label: str, most: int = 40) -> str:
    r"""A name in a message: tabs and the like as ``\t``, the middle of a long one left out."""
    text = repr(label)[1:-1]
    return text if len(text) <= most else f"{text[: most // 2]}…{text[-most // 2 :]}"


def _kept(labels: Sequence[str], read_back: Callable[[Sequence[str]], Sequence[str]]) -> bool:
    """Whether all names come back; a nameless marker may be called after its place."""
    return tuple(_read_back(labels, read_back)) in (
        tuple(labels),
        unique_labels(labels, len(labels))[0],
    )


def _read_back(
    labels: Sequence[str], read_back: Callable[[Sequence[str]], Sequence[str]]
) -> Sequence[str]:
    """Names as they come back; none where the file could not be read at all."""
    try:
        return read_back(labels)
    except FileFormatError:
        return ()
