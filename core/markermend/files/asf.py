"""Read Acclaim skeletons (ASF)."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from markermend.errors import FileFormatError
from markermend.files.plausible import FARTHEST
from markermend.files.text import read_lines
from markermend.files.units import MILLIMETRES
from markermend.poses.skeleton import ROOT, Segment, Skeleton

_DOFS = ("rx", "ry", "rz", "tx", "ty", "tz", "l")
_MOST_SEGMENTS = 10_000
# A unit of length may go so many times into an inch, or be so many.
_WIDEST = 1e4


def bare(line: str) -> str:
    """A line without its comment, which begins with #, // or ;."""
    for mark in ("#", "//", ";"):
        line = line.partition(mark)[0]
    return line


def words_of(path: Path) -> list[tuple[int, list[str]]]:
    """Number and words of each line that says something besides a comment."""
    lines = []
    for number, line in enumerate(read_lines(path), 1):
        words = bare(line).split()
        if words:
            lines.append((number, words))
    return lines


def read_asf(path: Path) -> Skeleton:
    """Read a skeleton.

    Parameters
    ----------
    path : the file. Its lengths are in inches times ``:units length`` (0.45 in the CMU database),
        its angles in degrees or radians.

    Returns
    -------
    Skeleton
        angles in degrees

    Raises
    ------
    FileFormatError
        when the file is damaged: a bone without name or length, a hierarchy that does not fit
    """
    sections = _sections(path)
    if "root" not in sections or "bonedata" not in sections:
        raise FileFormatError(f"{path.name} is no Acclaim skeleton: it has no :root or :bonedata.")
    units = {words[0].lower(): (line, words[1:]) for line, words in sections.get("units", [])}
    _, angle = units.get("angle", (0, []))
    degrees = not (angle or ["deg"])[0].lower().startswith("rad")
    line, length = units.get("length", (0, ["1"]))
    unit = _numbers(length, 1, path, line)[0]
    if unit <= 0:
        raise FileFormatError(f"{path.name} is damaged: its unit of length is {unit:g}.")
    if not 1.0 / _WIDEST <= unit <= _WIDEST:
        raise FileFormatError(
            f"{path.name} is damaged: its unit of length, {unit:g} in line {line}, makes no body."
        )
    root, position = _root(sections["root"], degrees, path)
    bones = [_bone(lines, degrees, path) for lines in _bones(sections["bonedata"], path)]
    names = [bone.name for bone in bones]
    if len(set(names)) != len(names) or ROOT in names:
        raise FileFormatError(f"{path.name} is damaged: two bones have the same name.")
    segments = _hang([root, *bones], _hierarchy(sections.get("hierarchy", []), path), path)
    return Skeleton(segments, MILLIMETRES["in"] / unit, degrees, position, path)


def _sections(path: Path) -> dict[str, list[tuple[int, list[str]]]]:
    """Lines of each ``:section``, with what stands behind its name on the same line first."""
    sections: dict[str, list[tuple[int, list[str]]]] = {}
    current: list[tuple[int, list[str]]] = []
    for number, words in words_of(path):
        if words[0].startswith(":"):
            current = sections.setdefault(words[0][1:].lower(), [])
            words = words[1:]
        if words:
            current.append((number, words))
    return sections


def _root(
    lines: list[tuple[int, list[str]]], degrees: bool, path: Path
) -> tuple[Segment, tuple[float, float, float]]:
    """Return the root segment and where it rests."""
    order: tuple[str, ...] = ("tx", "ty", "tz", "rx", "ry", "rz")
    axis_order, angles, position = "xyz", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for number, words in lines:
        match words[0].lower():
            case "order":
                order = _dofs(words[1:], path, number)
            case "axis":
                axis_order = _axes(words[-1], path, number)
            case "orientation":
                angles = _angles(words[1:4], degrees, path, number)
            case "position":
                position = _three(words[1:4], path, number)
    return Segment(ROOT, -1, (0.0, 0.0, 0.0), 0.0, angles, axis_order, order), position


def _bones(lines: list[tuple[int, list[str]]], path: Path) -> list[list[tuple[int, list[str]]]]:
    """Lines between each ``begin`` and ``end``."""
    bones: list[list[tuple[int, list[str]]]] = []
    inside = False
    for number, words in lines:
        match words[0].lower():
            case "begin":
                if inside:
                    raise FileFormatError(
                        f"{path.name} is damaged: line {number} begins a bone twice."
                    )
                bones.append([])
                inside = True
            case "end":
                inside = False
            case _ if inside:
                bones[-1].append((number, words))
    if inside:
        raise FileFormatError(f"{path.name} is cut short: its last bone has no end.")
    if len(bones) > _MOST_SEGMENTS:
        raise FileFormatError(f"{path.name} is damaged: it tells of {len(bones):,} bones.")
    return bones


def _bone(lines: list[tuple[int, list[str]]], degrees: bool, path: Path) -> Segment:
    """Read one bone."""
    name, length, direction = "", math.nan, (0.0, 0.0, 0.0)
    angles, axis_order = (0.0, 0.0, 0.0), "xyz"
    dofs: tuple[str, ...] = ()
    for number, words in lines:
        match words[0].lower():
            case "name" if len(words) > 1:
                name = words[1]
            case "length":
                length = _numbers(words[1:], 1, path, number)[0]
            case "direction":
                direction = _three(words[1:], path, number)
            case "axis":
                angles = _angles(words[1:4], degrees, path, number)
                axis_order = _axes(words[4] if len(words) > 4 else "xyz", path, number)
            case "dof":
                dofs = _dofs(words[1:], path, number)
    where = f" near line {lines[0][0]}" if lines else ""
    if not name:
        raise FileFormatError(f"{path.name} is damaged: a bone{where} has no name.")
    size = float(np.linalg.norm(direction))
    if not math.isfinite(length) or length < 0 or (size == 0 and length > 0):
        raise FileFormatError(f"{path.name} is damaged: bone {name} has no length or direction.")
    x, y, z = (float(value / size) if size else 0.0 for value in direction)
    return Segment(name, -1, (x, y, z), length, angles, axis_order, dofs)


def _hierarchy(lines: list[tuple[int, list[str]]], path: Path) -> dict[str, str]:
    """Parent of each bone that has one."""
    parents: dict[str, str] = {}
    for number, (parent, *children) in lines:
        if parent.lower() in ("begin", "end"):
            continue
        for child in children:
            if parents.setdefault(child, parent) != parent:
                raise FileFormatError(
                    f"{path.name} is damaged: {child} gets a second parent in line {number}."
                )
    return parents


def _hang(bones: list[Segment], parents: dict[str, str], path: Path) -> tuple[Segment, ...]:
    """Put parents before children and give each its parent's index."""
    unknown = (set(parents) | set(parents.values())) - {bone.name for bone in bones}
    if unknown:
        raise FileFormatError(
            f"{path.name} is damaged: its hierarchy names {sorted(unknown)[0]}, which is no bone."
        )
    placed: dict[str, int] = {}
    hung: list[Segment] = []
    waiting = bones
    while waiting:
        ready = [b for b in waiting if b.name == ROOT or parents.get(b.name) in placed]
        if not ready:
            raise FileFormatError(
                f"{path.name} is damaged: bone {waiting[0].name} does not hang on the root."
            )
        for bone in ready:
            parent = placed[parents[bone.name]] if bone.name != ROOT else -1
            placed[bone.name] = len(hung)
            hung.append(
                Segment(
                    bone.name,
                    parent,
                    bone.direction,
                    bone.length,
                    bone.axis,
                    bone.axis_order,
                    bone.dofs,
                )
            )
        waiting = [bone for bone in waiting if bone.name not in placed]
    return tuple(hung)


def _numbers(words: list[str], wanted: int, path: Path, line: int) -> list[float]:
    """Read so many finite numbers."""
    try:
        values = [float(word) for word in words[:wanted]]
    except ValueError:
        values = []
    if len(values) < wanted or not all(abs(value) <= FARTHEST for value in values):
        what = "a number" if wanted == 1 else f"{wanted} numbers"
        raise FileFormatError(
            f"{path.name} is damaged: line {line} should have {what} of a body, but reads"
            f" “{' '.join(words)[:40]}”."
        )
    return values


def _three(words: list[str], path: Path, line: int) -> tuple[float, float, float]:
    x, y, z = _numbers(words, 3, path, line)
    return x, y, z


def _angles(words: list[str], degrees: bool, path: Path, line: int) -> tuple[float, float, float]:
    """Three angles, in degrees whatever the file has."""
    x, y, z = _three(words, path, line)
    return (x, y, z) if degrees else (math.degrees(x), math.degrees(y), math.degrees(z))


def _axes(word: str, path: Path, line: int) -> str:
    """Read an order of axes such as ``XYZ``."""
    if sorted(word.lower()) != ["x", "y", "z"]:
        raise FileFormatError(
            f"{path.name} is damaged: line {line} has no order of axes: “{word}”."
        )
    return word.lower()


def _dofs(words: list[str], path: Path, line: int) -> tuple[str, ...]:
    """Read degrees of freedom."""
    dofs = tuple(word.lower() for word in words)
    if any(dof not in _DOFS for dof in dofs) or len(set(dofs)) != len(dofs):
        raise FileFormatError(
            f"{path.name} is damaged: line {line} has degrees of freedom that are none:"
            f" “{' '.join(words)[:40]}”."
        )
    return dofs
