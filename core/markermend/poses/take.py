"""A skeleton recording under review: a take whose markers are joints, and back.

The take carries the recording as its source's layout. What a review changes are positions; how
joints are turned follows when the recording is written.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from markermend.arrays import BoolArray
from markermend.errors import DataError
from markermend.mesh.model import Group, Mesh
from markermend.poses.faults import SWAPPED
from markermend.poses.pose import Pose
from markermend.poses.prior import shipped_prior
from markermend.poses.restore import INFERRED, Restored, restore
from markermend.poses.skeleton import Movement
from markermend.progress import Progress
from markermend.take import SKELETON, Source, Take

_RESTORED: WeakKeyDictionary[Pose, Restored] = WeakKeyDictionary()


def as_take(pose: Pose, path: Path) -> Take:
    """A recording as a take.

    Parameters
    ----------
    pose : the recording
    path : its file

    Returns
    -------
    Take
        a marker a joint; NaN where a joint was not seen
    """
    status = path.stat()
    source = Source(path.absolute(), SKELETON, status.st_size, status.st_mtime_ns, layout=pose)
    first = 1 if isinstance(pose.source, Movement) else 0
    return Take(
        pose.positions, pose.joints, pose.rate, first, source=source, warnings=pose.warnings
    )


def pose_of(take: Take) -> Pose:
    """The recording a take was made of, as it was read.

    Raises
    ------
    DataError
        when it was made of none
    """
    layout = None if take.source is None else take.source.layout
    if not isinstance(layout, Pose):
        raise DataError("This is no skeleton recording.")
    return layout


def as_pose(take: Take, *, progress: Progress | None = None) -> Pose:
    """The recording of a take as it stands.

    Parameters
    ----------
    take : one that :func:`as_take` made, reviewed or not
    progress : told the share done; may raise to stop

    Returns
    -------
    Pose
        as it was read but for samples that were changed. There a joint has the rotation that
        restoring gives it, and so has its parent, which no sensor can know without it; what was
        filled has confidence :data:`~markermend.poses.restore.INFERRED`.
    """
    pose = pose_of(take)
    changed = changed_joints(take)
    if not changed.any():
        return replace(pose, joints=take.labels)
    told = restored(pose, progress)
    # Samples that come from elsewhere say where a joint is, but not how it is turned.
    elsewhere = changed & (take.positions != told.pose.positions).any(axis=2)
    if elsewhere.any():
        told = restore(_hidden(pose, elsewhere), prior=shipped_prior(), progress=progress)
    turned = changed.copy()
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            turned[:, parent] |= changed[:, joint]
    rotations = np.where(turned[..., None], told.pose.rotations, pose.rotations)
    filled = changed & (~pose.seen | mended(told))
    confidence = np.where(filled, INFERRED, pose.confidence)
    confidence[~take.present] = 0.0
    done = pose.with_samples(take.positions, rotations, confidence)
    return replace(done, joints=take.labels)


def changed_joints(take: Take) -> BoolArray:
    """(frames, joints) bool: where a take of joints is not as it was read."""
    pose = pose_of(take)
    changed = np.asarray((take.positions != pose.positions).any(axis=2))
    return changed & (take.present | pose.seen)


def restored(pose: Pose, progress: Progress | None = None) -> Restored:
    """A recording restored with the prior that comes with Markermend; worked out once."""
    known = _RESTORED.get(pose)
    if known is None:
        known = _RESTORED[pose] = restore(pose, prior=shipped_prior(), progress=progress)
    return known


def restored_without(
    pose: Pose, joints: Iterable[int], rows: slice, progress: Progress | None = None
) -> Restored:
    """A recording restored as if joints had not been seen for a while.

    Parameters
    ----------
    pose : the recording
    joints : indices
    rows : frames; where restoring worked the joints out anyway, nothing is done twice
    progress : told the share done; may raise to stop
    """
    told, columns = restored(pose, progress), list(joints)
    done = told.filled | mended(told)
    if done[rows, columns].all():
        return told
    hidden = np.zeros(done.shape, dtype=bool)
    hidden[rows, columns] = True
    return restore(_hidden(pose, hidden), prior=shipped_prior(), progress=progress)


def mended(told: Restored) -> BoolArray:
    """(frames, joints) bool: left and right were swapped, and are swapped back."""
    mask = np.zeros(told.filled.shape, dtype=bool)
    for fault in told.faults:
        if fault.kind == SWAPPED:
            mask[fault.start : fault.stop, fault.joint] = True
    return mask


def skeleton_mesh(take: Take) -> Mesh:
    """The tree of joints: a group each, and a link for every bone."""
    pose = pose_of(take)
    place = {joint: i for i, joint in enumerate(pose.order)}
    groups = tuple(
        Group(
            take.labels[joint],
            "",
            (joint,),
            None if parent < 0 else place[parent],
            None if parent < 0 else parent,
        )
        for joint in pose.order
        for parent in (pose.parents[joint],)
    )
    links = tuple((min(j, p), max(j, p)) for j, p in enumerate(pose.parents) if p >= 0)
    return Mesh(take.labels, groups, links)


def _hidden(pose: Pose, wrong: BoolArray) -> Pose:
    """The recording with joints not seen."""
    confidence = np.where(wrong, 0.0, pose.confidence)
    return pose.with_samples(pose.positions, pose.rotations, confidence)
