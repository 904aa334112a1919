"""Tables 2 to 5 of goncalves2024 again: people never seen, a random split, and as published."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markermend.bench.columns import aligned
from markermend.bench.poses import Row
from markermend.bench.poses_network import FILTERED, RANDOM
from markermend.bench.poses_text import pooled
from markermend.poses.simulated.noise import NOISES

Errors = tuple[float, float, float]


@dataclass(frozen=True)
class Table:
    """One published table.

    Attributes
    ----------
    title : number and what it is
    case : name of the case that repeats it
    filtered : with the temporal filter
    published : what was learnt to be undone to the errors on both, occlusions, displacements
    """

    title: str
    case: str
    filtered: bool
    published: Mapping[str, Errors]


_CMU: Errors = (0.0724, 0.0618, 0.0127)
_KINECT: Errors = (0.0621, 0.0522, 0.0122)
_FRAMES, _SENSOR = "frame by frame", "simulated sensor, bursts of 1 s"

TABLES = (
    Table(
        "Table 2, CMU",
        _FRAMES,
        False,
        {
            "both": (0.0461, 0.0420, 0.0334),
            "occlusions": (0.0383, 0.0239, 0.0225),
            "displacements": (0.0766, 0.0734, 0.0303),
            "": _CMU,
        },
    ),
    Table(
        "Table 4, CMU, filtered",
        _FRAMES,
        True,
        {
            "both": (0.0397, 0.0382, 0.0314),
            "occlusions": (0.0289, 0.0218, 0.0172),
            "displacements": (0.0610, 0.0599, 0.0283),
            "": _CMU,
        },
    ),
    Table(
        "Table 3, a depth sensor (published: Kinect; here: simulated, occluded in bursts)",
        _SENSOR,
        False,
        {
            "both": (0.0930, 0.0894, 0.0830),
            "occlusions": (0.1096, 0.0874, 0.0928),
            "displacements": (0.1012, 0.0989, 0.0647),
            "": _KINECT,
        },
    ),
    Table(
        "Table 5, filtered, a depth sensor (published: Kinect; here: simulated, in bursts)",
        _SENSOR,
        True,
        {
            "both": (0.0869, 0.0860, 0.0826),
            "occlusions": (0.0923, 0.0814, 0.0855),
            "displacements": (0.0868, 0.0860, 0.0655),
            "": _KINECT,
        },
    ),
)
"""The published tables; the empty name is for poses left as they were damaged."""


def paper_tables(rows: Sequence[Row]) -> list[str]:
    """Each published table whose case was tried, people never seen and a random split above it.

    Columns are what was done to the poses that are tested.
    """
    lines: list[str] = []
    for table in TABLES:
        here = [row for row in rows if row.case == table.case]
        if not here:
            continue
        filtered = FILTERED if table.filtered else ""
        body = []
        for learnt, published in table.published.items():
            name = f"network {learnt}"
            ways = {"unseen": name + filtered, "random split": name + RANDOM + filtered}
            for way, method in (ways if learnt else {"here": "as it is"}).items():
                errors = [
                    pooled([r for r in here if (r.method, r.kind) == (method, k)]) for k in NOISES
                ]
                body.append([learnt or "nothing done", way, *errors])
            body.append(["", "published", *(f"{value:.4f}" for value in published)])
        lines += ["", table.title, *aligned([["Learnt to undo", "", *NOISES], *body])]
    return lines
