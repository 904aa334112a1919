"""Bodies as a Kinect has them, of 25 joints, from recordings of 31 segments."""

from __future__ import annotations

import numpy as np

from markermend.poses.nuitrack import JOINTS, PARENTS, to_nuitrack
from markermend.poses.pose import Pose

_MORE = (
    ("hand", "wrist", "hand"),
    ("hand_tip", "hand", "fingers"),
    ("thumb", "wrist", "thumb"),
    ("foot", "ankle", "toes"),
)


def with_hands(pose: Pose) -> Pose:
    """25 joints of a recording of the CMU skeleton."""
    body, names, parents = to_nuitrack(pose), list(JOINTS), list(PARENTS)
    columns = []
    for side in ("left", "right"):
        for name, above, segment in _MORE:
            parents.append(names.index(f"{side}_{above}"))
            names.append(f"{side}_{name}")
            columns.append(pose.index(side[0] + segment))
    return Pose(
        np.concatenate([body.positions, pose.positions[:, columns]], axis=1),
        np.concatenate([body.rotations, pose.rotations[:, columns]], axis=1),
        tuple(names),
        tuple(parents),
        pose.rate,
        np.ones((pose.frames, len(names))),
    )
