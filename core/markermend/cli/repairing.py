"""What ``clean`` and ``fill`` tell about repairs: a summary per class, a list, the reasons."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from statistics import median

from markermend.artifact import Kind
from markermend.cli.console import count, table
from markermend.cli.detect import when
from markermend.outcome import Outcome
from markermend.take import Take

_SIZE = re.compile(r"\d+(?= mm off)")


def summary_table(done: Sequence[Outcome]) -> list[str]:
    """Per class: found, repaired, how, and the expected error."""
    rows = []
    for kind in Kind:
        of_kind = [o for o in done if o.artifact.kind is kind]
        if not of_kind:
            continue
        methods = Counter(o.method for o in of_kind if o.method)
        errors = [o.error_mm for o in of_kind if o.error_mm]
        unknown = "not measured" if any(o.unmeasured for o in of_kind) else "–"
        rows.append(
            [
                kind.value,
                str(len(of_kind)),
                str(methods.total()),
                ", ".join(f"{name} {n}" for name, n in methods.most_common()) or "–",
                f"{median(errors):.2f}" if errors else unknown,
                f"{max(errors):.2f}" if errors else unknown,
            ]
        )
    head = ["Class", "Found", "Repaired", "With", "Expected error, mm", "Worst"]
    return table(head, rows, "lrrlrr") if rows else []


def listing(take: Take, done: Sequence[Outcome]) -> list[str]:
    """Every artifact with what became of it."""
    rows = [
        [
            *when(take, o.artifact),
            o.artifact.marker,
            o.artifact.axes,
            o.artifact.kind.value,
            o.method or "left",
            "not measured" if o.unmeasured else "" if o.error_mm is None else f"{o.error_mm:.2f}",
            o.note,
        ]
        for o in done
    ]
    head = ["Frames", "Seconds", "Marker", "Axes", "Class", "Repair", "mm", "Note"]
    return [*table(head, rows, "rrllllrl"), ""] if rows else []


def seen_again(done: Sequence[Outcome]) -> list[str]:
    """Say how many repairs the detector still finds damage in."""
    spoiled = sum(bool(o.leaves) for o in done)
    if not spoiled:
        return []
    return ["", f"Damage was found again after {count(spoiled, 'repair')}; --list names them."]


def left_over(done: Sequence[Outcome]) -> list[str]:
    """Why some were left, a line for each reason; reasons that differ in size only are one."""
    left = [o.reason for o in done if o.method is None]
    if not left:
        return []
    alike: dict[tuple[str, ...], list[int]] = {}
    for reason in left:
        size = _SIZE.search(reason)
        words = tuple(_SIZE.split(reason, maxsplit=1))
        alike.setdefault(words, []).append(0 if size is None else int(size[0]))
    lines = []
    for words, found in sorted(alike.items(), key=lambda item: -len(item[1])):
        low, high = min(found), max(found)
        between = f"{low}" if low == high else f"{low} to {high}"
        lines.append(f"  {len(found):>4} × {between.join(words)}")
    return ["", f"Left as they were, {count(len(left), 'artifact')}:", *lines]
