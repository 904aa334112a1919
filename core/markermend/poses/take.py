"""A skeleton recording under review: a take whose markers are joints, and back.

The take carries the recording as its source's layout. What a review changes are positions; how
joints are turned follows when the recording is written: with the bones that were moved a little,
and as restoring has it where a joint was not seen or was put elsewhere.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.errors import DataError
from markermend.mesh.model import Group, Mesh
from markermend.poses.faults.finding import FAULTS, SWAPPED
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.faults.swinging import swung
from markermend.poses.normal import bone_lengths
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior, shipped_prior
from markermend.poses.quaternion import lengths_of
from markermend.poses.restore import Restored, restore
from markermend.progress import Progress
from markermend.take import SKELETON, Source, Take

# A stretch that was moved by less than this share of the mean bone, in the middle, was not put
# anywhere else; it was put where restoring has it, if it differs from that by so much less.
_LITTLE, _AGREES = 0.25, 0.1
# So many stretches are asked about one by one; each takes as long as restoring the recording.
_MOST_TRIED = 12

_RESTORED: WeakKeyDictionary[Pose, Restored] = WeakKeyDictionary()
_WITHOUT: WeakKeyDictionary[Pose, tuple[bytes, Restored]] = WeakKeyDictionary()
_PRIORS: WeakKeyDictionary[Pose, Prior] = WeakKeyDictionary()


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
    return Take(
        pose.positions,
        pose.joints,
        pose.rate,
        pose.first_frame,
        source=source,
        warnings=pose.warnings,
    )


def pose_of(take: Take) -> Pose:
    """The recording a take was made of, as it was read.

    Raises
    ------
    DataError
        when it was made of none, or of one of other frames or joints
    """
    layout = None if take.source is None else take.source.layout
    if not isinstance(layout, Pose):
        raise DataError("This is no skeleton recording.")
    if layout.positions.shape != take.positions.shape:
        raise DataError(
            "This take has other frames or joints than the skeleton recording that it was made of."
        )
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
        as it was read but for samples that were changed. Where a joint was seen and only moved a
        little, as by smoothing, joints keep their rotations but for the least turn that lets their
        bones point where these do now. Elsewhere a joint has the rotation that restoring gives it,
        and so has its parent, which no sensor can know without it. What was worked out, not seen
        or wrong, has confidence :data:`~markermend.poses.restore.INFERRED`; what was measured and
        is only told of the other joint now, as left and right that were swapped, has that of its
        measurement.

    Raises
    ------
    DataError
        when joints have to be restored and nothing can be made of the recording
    """
    pose = pose_of(take)
    changed = changed_joints(take)
    if not changed.any():
        return replace(pose, joints=take.labels)
    told, moved = told_and_moved(take, changed, progress)
    anew = changed & ~moved
    turned = anew.copy()
    for joint, parent in enumerate(pose.parents):
        if parent >= 0:
            turned[:, parent] |= anew[:, joint]
    rotations = swung(pose, take.positions, moved, turned) if moved.any() else pose.rotations
    confidence = pose.confidence.copy()
    if told is not None:
        rotations = np.where(turned[..., None], told.pose.rotations, rotations)
        worked_out = told.filled | ~told.pose.seen
        confidence[anew] = np.where(worked_out, INFERRED, told.pose.confidence)[anew]
        exchanged = _of_another(take, anew)
        confidence = np.where(exchanged > 0, exchanged, confidence)
    confidence[~take.present] = 0.0
    done = pose.with_samples(take.positions, rotations, confidence)
    return replace(done, joints=take.labels)


def told_and_moved(
    take: Take, changed: BoolArray, progress: Progress | None = None
) -> tuple[Restored | None, BoolArray]:
    """What restoring gives where a take was changed, and where it is not asked.

    Parameters
    ----------
    take : one that :func:`as_take` made
    changed : (frames, joints) bool, where it is not as it was read
    progress : told the share done; may raise to stop

    Returns
    -------
    told : the recording restored, as if samples that come from elsewhere had not been seen, since
        they say where a joint is but not how it is turned; None where nothing needs it
    moved : (frames, joints) bool, seen samples that were only moved a little, or of joints that
        restoring could not tell anything about

    Raises
    ------
    DataError
        when restoring is needed and nothing can be made of the recording
    """
    pose = pose_of(take)
    seen = changed & pose.seen & take.present
    try:
        told = restored(pose, progress)
    except DataError:
        if (changed & ~seen).any():
            raise
        return None, seen
    elsewhere = changed & (take.positions != told.pose.positions).any(axis=2)
    # What was put right is not asked how it had been turned, if it was smoothed afterwards too.
    far, missed = (lengths_of(take.positions - p.positions) for p in (pose, told.pose))
    seen &= elsewhere & ~(_wrong(told) & (missed < far))
    # A joint that is never as it was read leaves restoring nothing to go by.
    sure = seen & (elsewhere | ~pose.seen).all(axis=0)
    hidden = elsewhere & ~sure
    if not hidden.any():
        return told, sure
    prior = prior_of(pose)
    try:
        tried = restore(_hidden(pose, hidden), prior=prior, progress=progress)
    except DataError:
        moved = sure | (seen & hidden)
    else:
        moved = sure | _little(take, tried, seen & hidden, progress)
        if not (moved & hidden).any():
            return tried, moved
    hidden &= ~moved
    if not hidden.any():
        return told, moved
    return restore(_hidden(pose, hidden), prior=prior, progress=progress), moved


def _little(take: Take, tried: Restored, some: BoolArray, tell: Progress | None) -> BoolArray:
    """(frames, joints) bool, those of some samples that were moved a little, stretch by stretch.

    What restoring itself put there, as in an interval that was marked by hand, is none of them,
    however near it is to where the joint was seen.
    """
    pose = pose_of(take)
    most = _LITTLE * _mean_bone(pose)
    moved, together = np.zeros(some.shape, dtype=bool), dict[tuple[int, int], list[int]]()
    for joint in np.flatnonzero(some.any(axis=0)).tolist():
        for start, stop in runs(some[:, joint]).tolist():
            rows = slice(start, stop)
            far = np.median(lengths_of(take.positions[rows, joint] - pose.positions[rows, joint]))
            if far <= most and not _put_by(tried, take, joint, rows):
                moved[rows, joint] = True
                together.setdefault((start, stop), []).append(joint)
    # Beside other intervals restoring puts a joint otherwise than when it was proposed, with what
    # was at the same time.
    for (start, stop), joints in list(together.items())[:_MOST_TRIED]:
        rows = slice(start, stop)
        try:
            then = restored_without(pose, joints, rows, tell, doubted=some)
        except DataError:
            continue
        moved[rows, [joint for joint in joints if _put_by(then, take, joint, rows)]] = False
    return moved


def _mean_bone(pose: Pose) -> float:
    """Length of bones on average, mm."""
    lengths = bone_lengths(pose.positions, pose.parents)
    return float(np.nanmean(lengths[np.asarray(pose.parents) >= 0]))


def _put_by(told: Restored, take: Take, joint: int, rows: slice) -> bool:
    """Whether restoring put a joint where it is, rather than where it was seen."""
    now, told_there = take.positions[rows, joint], told.pose.positions[rows, joint]
    far = np.median(lengths_of(now - pose_of(take).positions[rows, joint]))
    return bool(np.median(lengths_of(now - told_there)) <= _AGREES * far)


def _of_another(take: Take, some: BoolArray) -> FloatArray:
    """(frames, joints) confidence of the joint whose measurement a sample has; 0 where of none."""
    pose = pose_of(take)
    found = np.zeros(some.shape)
    for joint in np.flatnonzero(some.any(axis=0)):
        rows = np.flatnonzero(some[:, joint])
        same = (pose.positions[rows] == take.positions[rows, joint][:, None]).all(axis=2)
        found[rows, joint] = np.where(same, pose.confidence[rows], 0.0).max(axis=1)
    return found


def changed_joints(take: Take) -> BoolArray:
    """(frames, joints) bool: where a take of joints is not as it was read."""
    pose = pose_of(take)
    changed = np.asarray((take.positions != pose.positions).any(axis=2))
    return changed & (take.present | pose.seen)


def restored(pose: Pose, progress: Progress | None = None) -> Restored:
    """A recording restored by what :func:`prior_of` says; worked out once."""
    known = _RESTORED.get(pose)
    if known is None:
        known = _RESTORED[pose] = restore(pose, prior=prior_of(pose), progress=progress)
    return known


def restored_without(
    pose: Pose,
    joints: Iterable[int],
    rows: slice,
    progress: Progress | None = None,
    *,
    doubted: BoolArray | None = None,
) -> Restored:
    """A recording restored as if joints had not been seen for a while.

    Parameters
    ----------
    pose : the recording
    joints : indices
    rows : frames; where restoring worked the joints out anyway, nothing is done twice
    progress : told the share done; may raise to stop
    doubted : (frames, joints) bool, what else is not to be believed; of it stretches count that
        are at the same time as these, as each other's are
    """
    told = restored(pose, progress)
    hidden, worked_out = np.zeros(told.filled.shape, dtype=bool), _worked_out(told)
    hidden[rows, list(joints)] = True
    if doubted is not None:
        hidden = at_the_same_time(hidden, doubted & pose.seen & ~worked_out)
    if worked_out[hidden].all():
        return told
    # Joints that are restored together are asked for one after the other.
    key, known = np.packbits(hidden).tobytes(), _WITHOUT.get(pose)
    if known is None or known[0] != key:
        done = restore(_hidden(pose, hidden), prior=prior_of(pose), progress=progress)
        known = _WITHOUT[pose] = (key, done)
    return known[1]


def at_the_same_time(some: BoolArray, others: BoolArray) -> BoolArray:
    """(frames, n) bool: some, and stretches of others at the same time, and of these, in turn."""
    found = some.copy()
    left = [(n, *ends) for n in np.flatnonzero(others.any(axis=0)) for ends in runs(others[:, n])]
    while True:
        during: BoolArray = np.asarray(found.any(axis=1))
        beside = [stretch for stretch in left if during[stretch[1] : stretch[2]].any()]
        if not beside:
            return found
        for n, start, stop in beside:
            found[start:stop, n] = True
        left = [stretch for stretch in left if stretch not in beside]


def moved_far(take: Take) -> BoolArray:
    """(frames, joints) bool: where a take has a joint elsewhere than it was seen, or not at all.

    Not where it was smoothed, which leaves the recording to be believed; stretches count that are
    mostly elsewhere, and of others the samples that are.
    """
    pose, changed = pose_of(take), changed_joints(take)
    away = lengths_of(take.positions - pose.positions)
    far = np.asarray(pose.seen & ~(away <= _LITTLE * _mean_bone(pose)))
    for joint in np.flatnonzero(far.any(axis=0)).tolist():
        for start, stop in runs(changed[:, joint] & pose.seen[:, joint]).tolist():
            far[start:stop, joint] |= 2 * np.count_nonzero(far[start:stop, joint]) > stop - start
    return far


def restore_by(pose: Pose, prior: Prior) -> None:
    """Let a recording be restored by a prior, not by Markermend's own, for as long as it is open.

    Parameters
    ----------
    pose : the recording, which was not restored yet
    prior : one that fits it
    """
    _PRIORS[pose] = prior


def prior_of(pose: Pose) -> Prior:
    """What a recording is restored by: what :func:`restore_by` was told, or Markermend's own."""
    return _PRIORS.get(pose) or shipped_prior()


def at_hand(pose: Pose) -> BoolArray:
    """(frames, joints) bool: where :func:`restored_without` only has to look up what is known."""
    told = _RESTORED.get(pose)
    return np.zeros(pose.seen.shape, dtype=bool) if told is None else _worked_out(told)


def _worked_out(told: Restored) -> BoolArray:
    """(frames, joints) bool: where restoring did not believe a joint, or put it right."""
    return told.filled | mended(told)


def mended(told: Restored) -> BoolArray:
    """(frames, joints) bool: put right without being filled, as left and right swapped back are."""
    return _wrong(told, (SWAPPED,)) | (_wrong(told) & ~told.filled)


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


def _wrong(told: Restored, kinds: Collection[str] = FAULTS) -> BoolArray:
    """(frames, joints) bool: the recording was wrong there, in one of these ways."""
    mask = np.zeros(told.filled.shape, dtype=bool)
    for fault in told.faults:
        if fault.kind in kinds:
            mask[fault.start : fault.stop, fault.joint] = True
    return mask


def _hidden(pose: Pose, wrong: BoolArray) -> Pose:
    """The recording with joints not seen."""
    confidence = np.where(wrong, 0.0, pose.confidence)
    return pose.with_samples(pose.positions, pose.rotations, confidence)
