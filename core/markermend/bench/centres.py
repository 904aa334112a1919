"""How far joint centres found from markers are off, on performers whose joints are known."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.bench.columns import aligned, csv_cell, number
from markermend.errors import MethodError
from markermend.mesh import Mesh, infer_mesh
from markermend.poses.from_markers import joint_centres
from markermend.progress import Progress, quiet
from markermend.simulation import simulate_clean, simulate_motion
from markermend.simulation.markers import MARKER_SET
from markermend.simulation.skeleton import SIDES, Motion

RATE = 50.0
HEIGHTS_M = (1.55, 1.95)
NO_GROUPS = "the mesh has no two neighbouring groups of its two segments"

# A collarbone's marker moves with the trunk.
_SAME = {side + "clavicle": "thorax" for side in SIDES}
# What each joint joins, and where it is. Neck and spine bend in two joints, half in each: together
# they turn about the point between.
_JOINTS = {
    "neck": (("thorax", "head"), ("neck", "head")),
    "spine": (("pelvis", "thorax"), ("lumbar", "thorax")),
    "shoulder": (("thorax", "{}upperarm"), ("{}upperarm",)),
    "elbow": (("{}upperarm", "{}forearm"), ("{}forearm",)),
    "wrist": (("{}forearm", "{}hand"), ("{}hand",)),
    "hip": (("pelvis", "{}thigh"), ("{}thigh",)),
    "knee": (("{}thigh", "{}shank"), ("{}shank",)),
    "ankle": (("{}shank", "{}foot"), ("{}foot",)),
}


@dataclass(frozen=True)
class CentreRow:
    """One joint of one performer.

    Attributes
    ----------
    performer : number, from 0
    joint, side : ``"hip"`` and the like; ``"L"``, ``"R"``, or empty in the middle
    off_mm : root mean square distance from the true centre; NaN where none was found
    error_mm, doubt_mm : what is said of it, as in :class:`markermend.poses.from_markers.Joint`
    left_out : why it was not found; empty where it was
    """

    performer: int
    joint: str
    side: str
    off_mm: float
    error_mm: float
    doubt_mm: float
    left_out: str


def centres(
    *,
    simulations: int = 10,
    duration_s: float = 40.0,
    seed: int = 0,
    progress: Progress | None = None,
) -> tuple[CentreRow, ...]:
    """Look for the joints of simulated performers of different heights, with skin that moves.

    Parameters
    ----------
    simulations : performers
    duration_s : how long each moves
    seed : same seed, same performers
    progress : told the share of performers done; may raise ``Cancelled``

    Returns
    -------
    a row for every joint of every performer

    Raises
    ------
    MethodError
        when no simulation is asked for
    DataError
        when somebody has no joint that can be told
    """
    if simulations < 1:
        raise MethodError("At least one simulation is needed.")
    rows: list[CentreRow] = []
    random = np.random.default_rng(seed)
    for performer in range(simulations):
        (progress or quiet)(performer / simulations, f"Performer {performer + 1}")
        draw, height_m = int(random.integers(2**31)), float(random.uniform(*HEIGHTS_M))
        take = simulate_clean(duration_s=duration_s, rate=RATE, seed=draw, height_m=height_m)
        motion = simulate_motion(duration_s=duration_s, rate=RATE, seed=draw, height_m=height_m)
        mesh = infer_mesh(take)
        found, homes = joint_centres(take, mesh), _homes(mesh)
        tried = {frozenset(homes[g] for g in joint.groups): joint for joint in found.joints}
        for name, (joined, at) in _JOINTS.items():
            for side in SIDES if "{}" in joined[1] else ("",):
                joint = tried.get(frozenset(part.format(side) for part in joined))
                off = np.nan
                if joint is not None and not joint.left_out:
                    place = found.pose.positions[:, found.pose.index(joint.name)]
                    off = _off(place, motion, [part.format(side) for part in at])
                rows.append(
                    CentreRow(
                        performer,
                        name,
                        side,
                        off,
                        joint.error_mm if joint else np.nan,
                        joint.doubt_mm if joint else np.nan,
                        joint.left_out if joint else NO_GROUPS,
                    )
                )
    return tuple(rows)


def _homes(mesh: Mesh) -> list[str]:
    """Segment that most of each group's markers are on; empty where none has more than half."""
    homes = []
    for group in mesh.groups:
        on = [MARKER_SET[mesh.labels[m]][0] for m in group.markers]
        segment, count = Counter(_SAME.get(s, s) for s in on).most_common(1)[0]
        homes.append(segment if 2 * count > len(on) else "")
    return homes


def _off(place: FloatArray, motion: Motion, at: Sequence[str]) -> float:
    """Root mean square distance from the middle of one or two true joints."""
    truth = np.mean([motion.origins[name] for name in at], axis=0)
    return float(np.sqrt(np.nanmean(np.sum((place - truth) ** 2, axis=1))))


def centres_table(rows: Sequence[CentreRow]) -> list[str]:
    """Lines to print: a row for each joint, performers and sides together."""
    cells = [["Joint", "of", "in the mesh", "found", "mm off", "most", "Error", "Doubt", "within"]]
    for name in _JOINTS:
        here = [row for row in rows if row.joint == name]
        there = [row for row in here if row.left_out != NO_GROUPS]
        found = [row for row in there if not row.left_out]
        off = [row.off_mm for row in found]
        said = ([row.error_mm for row in found], [row.doubt_mm for row in found])
        figures = [np.median(off), max(off), *map(np.median, said)] if found else [np.nan] * 4
        within = sum(row.off_mm <= row.doubt_mm for row in found)
        cells.append(
            [name, str(len(here)), str(len(there)), str(len(found))]
            + [number(float(value), 1) for value in figures]
            + [str(within)]
        )
    return [
        "Distance from the true centre, root mean square over a take: median and largest; what is",
        "said of it: Error and Doubt, medians, and how many are off by no more than their Doubt.",
        "",
        *aligned(cells),
    ]


def centres_csv(rows: Sequence[CentreRow]) -> str:
    """Every joint of every performer."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["performer", "joint", "side", "off_mm", "error_mm", "doubt_mm", "left_out"])
    for row in rows:
        figures = [csv_cell(value) for value in (row.off_mm, row.error_mm, row.doubt_mm)]
        writer.writerow([row.performer, row.joint, row.side, *figures, row.left_out])
    return file.getvalue()
