"""``markermend pose``: joint centres of a body under markers."""

from __future__ import annotations

import argparse
from pathlib import Path

import markermend as mm
from markermend.cli.console import Bar, check_outputs, count, read_take, say, table
from markermend.errors import ExportError


def run(options: argparse.Namespace) -> int:
    """Write the joint centres of one take, and say how far to trust each."""
    from markermend.poses.from_markers import joint_centres

    check_outputs([options.output], source=options.take, force=options.force)
    if Path(options.output).suffix.lower() != ".csv":
        raise ExportError(f"“{options.output}” should end in .csv: joints are written as a table.")
    take = read_take(options.take)
    with Bar() as bar:
        found = joint_centres(take, progress=bar)
    mm.write_pose(found.pose, options.output)
    rows = [
        [
            joint.name,
            f"{joint.error_mm:.1f}",
            f"{joint.doubt_mm:.0f}",
            f"{joint.turning_deg:.1f}",
            joint.along or "movement",
        ]
        for joint in found.joints
        if not joint.left_out
    ]
    head = ["Joint between", "Error, mm", "Doubt, mm", "Least turning, °", "Told by"]
    for line in table(head, rows, "lrrrl"):
        say(line)
    left_out = [[joint.name, joint.left_out] for joint in found.joints if joint.left_out]
    if left_out:
        say()
        for line in table(["Left out", "Why"], left_out):
            say(line)
    say()
    say(f"Written: {options.output}, {count(len(rows), 'joint')}, {count(take.frames, 'pose')}.")
    return 0
