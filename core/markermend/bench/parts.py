"""Recordings cut into parts, to see how experiments come out where little is known."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from markermend.poses.pose import Pose


def in_parts(name: str, pose: Pose, seconds: float | None) -> dict[str, Pose]:
    """Cut a recording into equal parts, as many as come nearest to a length.

    Parameters
    ----------
    name : of the recording
    pose : the recording
    seconds : that a part should last; None to leave it whole

    Returns
    -------
    name, a dot and the number of the part, from 1, to the part; one that stays whole has its name
    """
    count = 1 if seconds is None else round(pose.frames / pose.rate / seconds)
    if count <= 1:
        return {name: pose}
    borders = np.linspace(0, pose.frames, count + 1).astype(int).tolist()
    parts = {}
    for n, both in enumerate(pairwise(borders), start=1):
        frames = slice(*both)
        given = (pose.positions, pose.rotations, pose.confidence)
        parts[f"{name}.{n}"] = pose.with_samples(*(some[frames] for some in given))
    return parts
