"""How bodies move, learnt from recordings of other people: small, and kept in a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.errors import DataError, FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.bridging import bridged
from markermend.poses.channels import steadied, to_channels
from markermend.poses.covariance import LENGTHS_S, Moments, averaged, learn
from markermend.poses.normal import FEATURES, bone_lengths
from markermend.poses.nuitrack import mirrored, to_nuitrack, usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.poses.turnless import turned_as_parents, turnless
from markermend.progress import Progress, quiet

WEIGHT = 300.0
"""Poses of the recording itself that a prior counts for."""

NOT_FITTING = (
    "The prior does not fit this recording, whose joints are others or stand elsewhere, and was not"
    " used."
)

# Mean distance of joints from where the prior has them, in mean bone lengths, up to which it fits.
# Single poses stray more.
_ALIKE, _ALIKE_ONCE = 1.0, 1.6
# Poses that tell where joints stand.
_TELLING = 300
# Where the rotation begins among a joint's features.
_TURN = 3
_SHIPPED = ("models", "pose_prior.npz")


@dataclass(frozen=True, eq=False)
class Prior:
    """Moments of bodies with certain joints.

    Attributes
    ----------
    joints : names, the root first
    moments : of all joints but the root, :data:`FEATURES` each
    """

    joints: tuple[str, ...]
    moments: Moments


def learn_prior(
    poses: Sequence[Pose], *, names: Sequence[str] = (), progress: Progress | None = None
) -> Prior:
    """Learn from clean recordings.

    Parameters
    ----------
    poses : of Nuitrack's joints or the CMU skeleton, which are reduced to those; else all of the
        same joints. Frames in which something was not seen are bridged by time.
    names : of the recordings, for what is wrong with one
    progress : told the share of recordings done

    Raises
    ------
    DataError
        when there is none, joints differ, or one was never seen, or has no rotation and is no end
    """
    if not poses:
        raise DataError("A prior needs at least one recording to learn from.")
    parts: list[Moments] = []
    joints = None
    for n, pose in enumerate(poses):
        (progress or quiet)(n / len(poses), f"Learning from recording {n + 1}")
        body = _usual(pose)
        if joints is not None and body.joints != joints:
            raise DataError("All recordings a prior learns from must have the same joints.")
        joints = body.joints
        part = learn(_filled(body, names[n] if names else f"Recording {n + 1}"), body.rate)
        parts.append(part.signed_like(parts[0].mean) if parts else part)
    assert joints is not None
    return Prior(joints, averaged(parts, WEIGHT))


def _usual(pose: Pose) -> Pose:
    """The 17 joints where a recording has them, the recording itself where not."""
    try:
        return to_nuitrack(pose)
    except DataError:
        return pose


def _filled(pose: Pose, name: str) -> FloatArray:
    """(frames, channels) without NaN."""
    # Ends of chains, as heads of a Kinect, have no rotation, and turn with what they hang on.
    ends = {*range(len(pose.joints))} - {*pose.parents}
    unseen = [joint for i, joint in enumerate(pose.joints) if not pose.seen[:, i].any()]
    without = turnless(pose)
    unturned = [joint for i, joint in enumerate(pose.joints) if without[i] and i not in ends]
    for missing, what in ((unseen, "shows"), (unturned, "tells the rotation of")):
        if missing:
            some = ", ".join(missing[:3]) + ("…" if len(missing) > 3 else "")
            raise DataError(
                f"{name} never {what} {some}, and a prior learns where every joint"
                " is and how it is turned; leave this recording out."
            )
    channels = steadied(to_channels(turned_as_parents(pose, without)), pose.rate)
    if not channels.known.any(axis=0).all():
        raise DataError(
            f"{name} never shows a joint together with all those that hang on it, and a prior"
            " learns how it is turned from that; leave this recording out."
        )
    return bridged(channels.values, channels.known)


def fitting(pose: Pose, prior: Prior) -> tuple[Moments, bool] | None:
    """Moments in the order of a recording's joints, where the prior fits it.

    Parameters
    ----------
    pose : the recording
    prior : of joints with usual names, such as Nuitrack's

    Returns
    -------
    moments, and whether they are those of the recording :func:`mirrored`, as left-handed sensors
    have it; None where joints of the prior are missing, or stand elsewhere than bodies have them.
    Of joints that the recording has besides nothing is told.
    """
    names = [usual_name(joint) for joint in pose.joints]
    root = pose.order[0]
    shared = [joint for joint, name in enumerate(names) if name in prior.joints]
    if sorted(names[j] for j in shared) != sorted(prior.joints) or names[root] != prior.joints[0]:
        return None
    at = {name: i for i, name in enumerate(prior.joints[1:])}
    order = np.array([at.get(name, -1) for j, name in enumerate(names) if j != root])
    columns: IntArray = (order[:, None] * FEATURES + np.arange(FEATURES)).ravel()
    moments = prior.moments.of(columns)
    size = _size(pose, shared, moments.mean)
    if size != 1.0:
        moments = moments.longer(size)
    if len(shared) < len(names):
        moments = _told(moments, np.repeat(order >= 0, FEATURES))
    some = _some(pose)
    apart = [_apart(body, moments) for body in (some, mirrored(some))]
    limit = _ALIKE if pose.frames > 1 else _ALIKE_ONCE
    return (moments, apart[1] < apart[0]) if min(apart) < limit else None


def _size(pose: Pose, shared: Sequence[int], mean: FloatArray) -> float:
    """Mean bone of the prior's joints over that of all: in fingers and faces bones are short.

    What was never seen is as long beside the others as in the bodies that were learnt from, whose
    mean pose is given for all joints but the root.
    """
    parents = list(pose.parents)
    for joint in pose.order:
        while parents[joint] >= 0 and parents[joint] not in shared:
            parents[joint] = parents[parents[joint]]
    bones = [joint for joint in shared if parents[joint] >= 0]
    own = bone_lengths(pose.positions, tuple(parents))[bones]
    known = ~np.isnan(own)
    if not known.any() or (known.all() and len(shared) == len(parents)):
        return 1.0
    places = np.insert(mean.reshape(-1, FEATURES)[:, :_TURN], pose.order[0], 0.0, axis=0)
    theirs = lengths_of(places[bones] - places[[parents[joint] for joint in bones]])
    unit = np.nanmean(bone_lengths(pose.positions, pose.parents))
    return float(own[known].mean() / unit * theirs.mean() / theirs[known].mean())


def _told(moments: Moments, told: BoolArray) -> Moments:
    """Moments that tell of some channels alone; 0 in all others."""
    both = np.outer(told, told)
    return replace(
        moments,
        mean=told * moments.mean,
        whole=both * moments.whole,
        within=both * moments.within,
        told=told,
    )


def _some(pose: Pose) -> Pose:
    """So many poses of a recording as it takes to tell where its joints stand."""
    step = -(-pose.frames // _TELLING)
    return pose.with_samples(
        pose.positions[::step], pose.rotations[::step], pose.confidence[::step]
    )


def right_handed(pose: Pose) -> tuple[Pose, bool]:
    """The 17 joints of a recording in right-handed axes, and whether it had them left-handed.

    Raises
    ------
    DataError
        when joints are missing, or stand elsewhere than bodies have them
    """
    body = to_nuitrack(pose)
    fits = fitting(body, shipped_prior())
    if fits is None:
        raise DataError("The joints stand elsewhere than in the bodies that were learnt from.")
    return (mirrored(body), True) if fits[1] else (body, False)


def _apart(pose: Pose, moments: Moments) -> float:
    """Mean distance of joints from where moments have them."""
    channels = to_channels(pose)
    values = np.where(channels.known, channels.values, np.nan)
    with np.errstate(invalid="ignore"):
        count = np.maximum(channels.known.sum(axis=0), 1)
        away = (np.nansum(values, axis=0) / count - moments.mean).reshape(-1, FEATURES)
    seen = np.asarray(channels.known.any(axis=0))[::FEATURES]
    if moments.told is not None:
        seen &= moments.told[::FEATURES]
    return float(np.mean(np.sqrt(np.sum(away[seen, :3] ** 2, axis=1)))) if seen.any() else np.inf


@lru_cache(maxsize=1)
def shipped_prior() -> Prior:
    """The prior that comes with Markermend: Nuitrack's 17 joints."""
    return load_prior(Path(str(files("markermend_resources").joinpath(*_SHIPPED))))


def save_prior(prior: Prior, path: Path) -> None:
    """Write a prior, whole or not at all."""
    moments = prior.moments
    upper = np.triu_indices(len(moments.mean))
    arrays = {
        "joints": np.array(prior.joints),
        "mean": moments.mean.astype(np.float32),
        "whole": moments.whole[upper].astype(np.float32),
        "within": moments.within[:, upper[0], upper[1]].astype(np.float32),
    }
    write_arrays(path, arrays)


def load_prior(path: Path) -> Prior:
    """Read what :func:`save_prior` wrote.

    Raises
    ------
    FileFormatError
        when the file holds no prior
    """
    try:
        arrays = read_arrays(path)
        joints = tuple(str(joint) for joint in arrays["joints"])
        mean = arrays["mean"].astype(np.float64)
        if mean.shape != ((len(joints) - 1) * FEATURES,):
            raise ValueError("its sizes do not fit")
        whole = _square(arrays["whole"][None], len(mean))[0]
        within = _square(arrays["within"], len(mean))
        if len(within) != len(LENGTHS_S):
            raise ValueError("it knows other lengths")
    except (ValueError, KeyError) as error:
        raise FileFormatError(
            f"{path.name} holds no prior of poses; “markermend train prior” writes one."
        ) from error
    return Prior(joints, Moments(mean, whole, within, WEIGHT, np.full(len(within), WEIGHT)))


def _square(upper: FloatArray, size: int) -> FloatArray:
    """(n, size, size) symmetric matrices from their upper triangles."""
    rows, columns = np.triu_indices(size)
    full = np.zeros((len(upper), size, size))
    full[:, rows, columns] = upper
    full[:, columns, rows] = upper
    return full
