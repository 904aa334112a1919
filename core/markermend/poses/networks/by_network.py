"""Recordings cleaned by a trained network: goncalves2024, Figure 4, from end to end."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.channels import to_channels, to_features
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.networks.network import Network, smoothed
from markermend.poses.normal import denormalise
from markermend.poses.nuitrack import PARENTS, mirrored
from markermend.poses.pose import Pose
from markermend.poses.prior import right_handed
from markermend.poses.quaternion import inverse, turn, upright
from markermend.progress import Progress, quiet

_UNSEEN = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def denoise_by_network(pose: Pose, network: Network, *, progress: Progress | None = None) -> Pose:
    """Let a network undo the noise of a recording pose by pose, and smooth what it returns.

    Parameters
    ----------
    pose : of the CMU skeleton or the 17 joints, right- or left-handed. Joints that were not seen
        go in as the network learnt them: at the waist, unturned, their parents unturned too.
    network : of ``train pose``. One of rotations alone turns the bones, as long as they are,
        along the tree; one of positions alone leaves rotations as they came.
    progress : told the share done; may raise ``Cancelled``

    Returns
    -------
    Pose
        of the 17 joints; confidence is 0.5 where a joint was not seen. A joint that was never
        seen stays so by a network of rotations alone: its bone's length is not known.

    Raises
    ------
    DataError
        when joints are missing, or stand elsewhere than bodies have them
    """
    told = progress or quiet
    told(0.0, "network")
    body, left_handed = right_handed(pose)
    channels = to_channels(body)
    known = channels.known.reshape(body.frames, -1, len(_UNSEEN))
    values = np.where(known, channels.values.reshape(known.shape), _UNSEEN)
    given = to_features(values.reshape(body.frames, -1), channels)
    given[..., 3:] = upright(given[..., 3:])
    told(0.3, "network")
    made = smoothed(network(given))
    if network.parts == "rotations":
        made[..., :3] = _carried(made[..., 3:], given, known)
    told(0.9, "network")
    positions, rotations = denormalise(made, channels.normal)
    if network.parts == "positions":
        rotations = np.where(np.isnan(body.rotations), rotations, body.rotations)
    confidence = np.where(body.seen, body.confidence, INFERRED)
    cleaned = body.with_samples(positions, rotations, confidence)
    return mirrored(cleaned) if left_handed else cleaned


def _carried(rotations: FloatArray, given: FloatArray, known: BoolArray) -> FloatArray:
    """(frames, joints, 3) where each parent's rotation takes the bones of the recording."""
    places = np.zeros((*rotations.shape[:2], 3))
    for joint, parent in enumerate(PARENTS):
        if parent < 0:
            continue
        seen = known[:, joint - 1, 0].copy()
        if parent > 0:
            seen &= known[:, parent - 1, 0] & known[:, parent - 1, 3]
        if not seen.any():
            places[:, joint] = np.nan
            continue
        bone = given[seen, joint, :3] - given[seen, parent, :3]
        local = np.median(turn(inverse(given[seen, parent, 3:]), bone), axis=0)
        places[:, joint] = places[:, parent] + turn(rotations[:, parent], local)
    return places
