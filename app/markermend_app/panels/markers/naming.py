"""What markers are called where room is scarce."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence

from markermend.artifact import PAIRED
from markermend_app.words import tr

_SIDED = re.compile(r"(left|right|l|r)[ _.-]?(.+)", re.IGNORECASE)


def short_names(labels: Sequence[str]) -> Mapping[str, str]:
    """Labels without the body they belong to, where that leaves no two alike."""
    bare = {label: label.rpartition(":")[2] or label for label in labels}
    times = Counter(bare.values())
    return {label: name if times[name] == 1 else label for label, name in bare.items()}


def paired_name(names: Sequence[str]) -> str:
    """Joints that change places in one line: those that differ by their side by what they share.

    Whole, the names have no room in a column, and without their middles they all look alike.
    """
    found = [_SIDED.fullmatch(name) for name in names]
    if len(names) == 2 and found[0] and found[1]:
        (one, part), (other, same) = found[0].groups(), found[1].groups()
        if part == same and {one[0].lower(), other[0].lower()} == {"l", "r"}:
            return tr("L/R {0}").format(part)
    return PAIRED.join(names)
