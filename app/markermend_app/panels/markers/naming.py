"""What markers are called where room is scarce."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from markermend.artifact import PAIRED
from markermend_app.words import tr

_SIDE = re.compile(r"left|right|l|r", re.IGNORECASE)
_BETWEEN = re.compile(r"([ _.-])[ _.-]+")


def short_names(labels: Sequence[str]) -> Mapping[str, str]:
    """Labels without the body they belong to, where that leaves no two alike."""
    bare = {label: label.rpartition(":")[2] or label for label in labels}
    times = Counter(bare.values())
    return {label: name if times[name] == 1 else label for label, name in bare.items()}


def paired_name(names: Sequence[str]) -> str:
    """Joints that change places in one line: those that differ by their side by what they share.

    Whole, the names have no room in a column, and without their middles they all look alike.
    """
    # SciPy comes along, which a window without joints need not wait for.
    from markermend.poses.nuitrack import twins

    if len(names) == 2 and twins(names) == [1, 0]:
        one, other = map(_without_side, names)
        shared = next((part for part in one if part in other), "")
        if shared:
            return tr("L/R {0}").format(shared)
    return PAIRED.join(names)


def _without_side(name: str) -> list[str]:
    """What may be left of a name without the word for its side."""
    parts = [name[: m.start()] + name[m.end() :] for m in _SIDE.finditer(name)]
    return [_BETWEEN.sub(r"\1", part).strip(" _.-") for part in parts]
