"""Recordings that experiments on gaps are about."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import markermend as mm
from markermend.bench.gaps import only_named
from markermend.poses.nuitrack import to_nuitrack


def read_named(name: str, folder: Path) -> mm.Take:
    """Find a take by name anywhere below a folder, and keep its named markers."""
    return only_named(mm.read(next(iter(sorted(folder.rglob(f"{name}.c3d"))))))


def seventeen_joints(shared: Path, *names: str) -> dict[str, mm.Pose]:
    """Skeleton recordings by name, as the 17 joints that sensors share."""
    folder = shared / "poses"
    return {name: to_nuitrack(mm.read_pose(folder / f"{name}.amc")) for name in names}


def to_and_fro(pose: mm.Pose, seconds: float) -> mm.Pose:
    """So much of every fourth pose of a recording, played forwards and backwards."""
    rate, there = pose.rate / 4, np.arange(0, pose.frames, 4)
    rows = np.resize(np.append(there, there[-2:0:-1]), round(seconds * rate))
    return mm.Pose(pose.positions[rows], pose.rotations[rows], pose.joints, pose.parents, rate)


def exchange_angles(source: Path, target: Path, names: tuple[str, ...], frames: range) -> Path:
    """Write an AMC in which left and right segments have each other's angles in some frames."""
    lines, pose = source.read_text().splitlines(), -1
    place: dict[tuple[int, str], int] = {}
    for n, line in enumerate(lines):
        if line.strip().isdigit():
            pose = int(line) - 1
        elif pose in frames:
            place[pose, line.split()[0]] = n
    for frame in frames:
        for name in names:
            left, right = place[frame, "l" + name], place[frame, "r" + name]
            here, there = (lines[n].partition(" ")[2] for n in (left, right))
            lines[left], lines[right] = f"l{name} {there}", f"r{name} {here}"
    target.write_text("\n".join(lines) + "\n")
    return target
