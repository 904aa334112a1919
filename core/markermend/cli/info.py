"""``markermend info``: what a take holds."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.arrays import runs
from markermend.cli.console import STDOUT, check_outputs, count, say, table, write_json
from markermend.files.info import describe_file
from markermend.mesh import Mesh
from markermend.take import Take, is_unlabelled


def run(options: argparse.Namespace) -> int:
    """Describe a take on the terminal, or as JSON."""
    check_outputs([options.json], source=options.take, force=options.force)
    take = mm.read(options.take)
    mesh = mm.infer_mesh(take)
    if options.json is not None:
        write_json(options.json, describe(take, mesh, Path(options.take).name))
    if options.json != STDOUT:
        for line in [options.take, *_facts(take), *_body(take, mesh), *_gap_table(take)]:
            say(line)
    return 0


def describe(take: Take, mesh: Mesh, name: str) -> dict[str, Any]:
    """Turn what a take holds into plain values for JSON.

    Parameters
    ----------
    take : the recording
    mesh : its body
    name : of the file

    Returns
    -------
    dict: what the file tells (:func:`markermend.files.info.describe_file`), and ``subjects``,
    ``markers``, body ``groups`` and other ``points`` by name; ``seen`` is the share of frames in
    which a marker has a position, gaps are counted and measured in frames
    """
    groups = [
        {
            "name": group.name,
            "subject": group.subject,
            "markers": [take.labels[m] for m in group.markers],
            "parent": None if group.parent is None else mesh.groups[group.parent].name,
            "parent_marker": (
                None if group.parent_marker is None else take.labels[group.parent_marker]
            ),
        }
        for group in mesh.groups
    ]
    points = take.points
    return {
        "take": name,
        "version": mm.__version__,
        "duration_s": take.duration_s,
        **describe_file(take),
        "subjects": list(take.subjects),
        "markers": [_marker(take, mesh, i) for i in range(take.markers)],
        "groups": groups,
        "points": []
        if points is None
        else [
            {"label": label, "kind": kind}
            for label, kind in zip(points.labels, points.kinds, strict=True)
        ],
    }


def _marker(take: Take, mesh: Mesh, column: int) -> dict[str, Any]:
    """One marker's name, body group and gaps."""
    gaps = runs(~take.present[:, column])
    group = mesh.group_of(column)
    return {
        "label": take.labels[column],
        "subject": take.subject(take.labels[column]),
        "unlabelled": is_unlabelled(take.labels[column]),
        "group": None if group is None else mesh.groups[group].name,
        "seen": float(take.present[:, column].mean()) if take.frames else 0.0,
        "gaps": len(gaps),
        "longest_gap": int((gaps[:, 1] - gaps[:, 0]).max()) if len(gaps) else 0,
    }


def _facts(take: Take) -> list[str]:
    """The take in a few lines of name and value."""
    last = take.frame_number(take.frames - 1)
    facts = [
        ("length", f"{take.duration_s:.2f} s: {count(take.frames, 'frame')} at {take.rate:g} Hz")
    ]
    if take.frames:
        facts.append(("frames", f"{take.first_frame} to {last}"))
    without_name = take.markers - len(take.named)
    named = take.present[:, take.named]
    seen = f", seen {named.mean():.1%} of the time" if named.size else ""
    facts.append(("markers", f"{len(take.named)}{seen}"))
    if without_name:
        facts.append(("unlabelled", str(without_name)))
    subjects = [s for s in take.subjects if s]
    if subjects:
        facts.append(("subjects", ", ".join(subjects)))
    if take.points:
        kinds = Counter(take.points.kinds)
        facts.append(("other points", ", ".join(f"{n} {kind}" for kind, n in kinds.items())))
    if take.analog:
        channels = count(len(take.analog.labels), "channel")
        facts.append(("analog", f"{channels} at {take.analog.rate:g} Hz"))
    if take.events:
        facts.append(("events", str(len(take.events))))
    facts.extend((name.replace("_", " "), text) for name, text in take.info.items())
    facts.extend(("note", warning) for warning in take.warnings)
    width = max(len(name) for name, _ in facts)
    return [f"  {name:<{width}}  {value}" for name, value in facts]


def _body(take: Take, mesh: Mesh) -> list[str]:
    """The body's groups, children indented under their parents."""
    lines: list[str] = []

    def add(index: int, depth: int) -> None:
        group = mesh.groups[index]
        markers = ", ".join(take.labels[m] for m in group.markers)
        lines.append(f"  {'  ' * depth}{group.name}: {markers}")
        for child in mesh.children(index):
            add(child, depth + 1)

    for index, group in enumerate(mesh.groups):
        if group.parent is None:
            add(index, 0)
    return ["", "Body, as it moves:", *lines] if lines else []


def _gap_table(take: Take) -> list[str]:
    """Markers that are missing at times, worst first."""
    rows = []
    for column, label in enumerate(take.labels):
        gaps = runs(~take.present[:, column])
        if len(gaps) and not is_unlabelled(label):
            seen = float(take.present[:, column].mean())
            longest = int((gaps[:, 1] - gaps[:, 0]).max())
            rows.append((seen, [label, f"{seen:.1%}", str(len(gaps)), str(longest)]))
    if not rows:
        return ["", "No named marker has a gap."]
    rows.sort(key=lambda row: row[0])
    head = ["Marker", "Seen", "Gaps", "Longest (frames)"]
    return ["", *("  " + line for line in table(head, [r for _, r in rows], "lrrr"))]
