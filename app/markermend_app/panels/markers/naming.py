"""What markers are called where room is scarce."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence


def short_names(labels: Sequence[str]) -> Mapping[str, str]:
    """Labels without the body they belong to, where that leaves no two alike."""
    bare = {label: label.rpartition(":")[2] or label for label in labels}
    times = Counter(bare.values())
    return {label: name if times[name] == 1 else label for label, name in bare.items()}
