"""How bodies move, learnt from recordings of other people: small, and kept in a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.errors import DataError, FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.body.bending import LOCAL, OthersBends
from markermend.poses.body.suppleness import Suppleness
from markermend.poses.channels import to_channels
from markermend.poses.filling.covariance import LENGTHS_S, Moments
from markermend.poses.filling.remembered import Remembered
from markermend.poses.filling.stance import IN_MIRROR
from markermend.poses.normal import FEATURES, bone_lengths
from markermend.poses.nuitrack import mirrored, to_nuitrack, usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

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
    remembered : up to ten minutes of the recordings, which tell most of who is recorded again
    suppleness : how they bend; None where nothing is known of it
    """

    joints: tuple[str, ...]
    moments: Moments
    remembered: tuple[Remembered, ...] = ()
    suppleness: Suppleness | None = None


def bones_of(pose: Pose) -> FloatArray:
    """(joints,) length of the bone of each joint but the root; NaN for those never seen."""
    lengths = bone_lengths(pose.positions, pose.parents)
    return np.asarray(lengths[[j for j in range(len(lengths)) if j != pose.order[0]]])


def fitting(pose: Pose, prior: Prior) -> tuple[Moments, bool] | None:
    """Moments in the order of a recording's joints, where the prior fits it.

    Parameters
    ----------
    pose : the recording
    prior : of joints with the same names, or with usual ones, such as Nuitrack's

    Returns
    -------
    moments, and whether they are those of the recording :func:`mirrored`, as left-handed sensors
    have it; None where joints of the prior are missing, or stand elsewhere than bodies have them.
    Of joints that the recording has besides nothing is told.
    """
    names, root = _names(pose, prior), pose.order[0]
    shared = [joint for joint, name in enumerate(names) if name in prior.joints]
    if sorted(names[j] for j in shared) != sorted(prior.joints) or names[root] != prior.joints[0]:
        return None
    order = _order_of(pose, prior)
    moments = prior.moments.of(_columns(order))
    size = _size(pose, prior, order)
    if size != 1.0:
        moments = moments.longer(size)
    if len(shared) < len(names):
        moments = _told(moments, np.repeat(order >= 0, FEATURES))
    some = _some(pose)
    apart = [_apart(body, moments) for body in (some, mirrored(some))]
    limit = _ALIKE if pose.frames > 1 else _ALIKE_ONCE
    return (moments, apart[1] < apart[0]) if min(apart) < limit else None


def remembered_of(pose: Pose, prior: Prior, *, strangers: bool = False) -> list[Remembered]:
    """What a prior remembers of the body that a recording shows, told by its bones, or of others.

    Parameters
    ----------
    pose : a recording that the prior fits, right-handed
    prior : of exactly the same joints; of a body that has more or fewer it remembers nothing
    strangers : what it remembers of others is wanted where it does not know the body

    Returns
    -------
    recordings in the order of the joints of this one
    """
    order = _order_of(pose, prior)
    if (order < 0).any() or len(order) != len(prior.joints) - 1:
        return []
    own = bones_of(pose)
    recordings = [one.of(_columns(order)) for one in prior.remembered]
    known = [one for one in recordings if one.of_body(own)]
    return known if known or not strangers else recordings


def bending_of(pose: Pose, prior: Prior) -> OthersBends | None:
    """How others bend; None where nothing is known of it.

    Parameters
    ----------
    pose : a recording that the prior fits, right-handed; of joints that it has besides, or that
        hang on others in it, nothing is told
    prior : of its joints
    """
    if prior.suppleness is None:
        return None
    names = _names(pose, prior)
    bent = [joint for joint in pose.order if pose.parents[joint] >= 0]
    above = [names[pose.parents[joint]] for joint in bent]
    size = _size(pose, prior, _order_of(pose, prior))
    return prior.suppleness.of([names[joint] for joint in bent], above, size)


def _order_of(pose: Pose, prior: Prior) -> IntArray:
    """(joints,) place of each joint but the root among the prior's, -1 where it has none."""
    at = {name: i for i, name in enumerate(prior.joints[1:])}
    others = [name for i, name in enumerate(_names(pose, prior)) if i != pose.order[0]]
    return np.array([at.get(name, -1) for name in others], dtype=int)


def _names(pose: Pose, prior: Prior) -> list[str]:
    """Names of a recording's joints: as they are where the prior has these, else the usual ones."""
    if set(prior.joints) <= set(pose.joints):
        return list(pose.joints)
    return [usual_name(joint) for joint in pose.joints]


def _columns(order: IntArray) -> IntArray:
    """Columns of joints in another order."""
    return np.asarray((order[:, None] * FEATURES + np.arange(FEATURES)).ravel())


def _size(pose: Pose, prior: Prior, order: IntArray) -> float:
    """Mean bone of the prior's joints over that of all: in fingers and faces bones are short.

    What was never seen is as long beside the others as in the bodies that were learnt from. Joints
    are in the order of :func:`_order_of`.
    """
    root, mean = pose.order[0], prior.moments.mean[_columns(order)]
    others = [joint for joint in range(len(pose.joints)) if joint != root]
    shared = {root, *(joint for joint, place in zip(others, order, strict=True) if place >= 0)}
    parents = list(pose.parents)
    for joint in pose.order:
        while parents[joint] >= 0 and parents[joint] not in shared:
            parents[joint] = parents[parents[joint]]
    bones = [joint for joint in sorted(shared) if parents[joint] >= 0]
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


def know_one_body(prior: Prior, other: Prior) -> bool:
    """Whether two priors are of the same joints, standing alike."""
    if prior.joints != other.joints:
        return False
    places = (one.moments.mean.reshape(-1, FEATURES)[:, :_TURN] for one in (prior, other))
    return bool(np.mean(lengths_of(np.subtract(*places))) < _ALIKE)


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
    bends = prior.suppleness
    if bends is not None:
        upper = np.triu_indices(len(bends.covariance))
        arrays["bending"] = bends.covariance[upper].astype(np.float32)
        arrays["bent"] = np.array([bends.joints, bends.parents])
    if prior.remembered:
        arrays["recordings"] = np.vstack([one.poses for one in prior.remembered])
        arrays["frames"] = np.array([len(one.poses) for one in prior.remembered])
        arrays["bones"] = np.stack([one.bones for one in prior.remembered])
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
        remembered = _read_recordings(arrays, len(mean))
        suppleness = _read_suppleness(arrays, joints)
    except (ValueError, KeyError, TypeError) as error:
        raise FileFormatError(
            f"{path.name} holds no prior of poses; “markermend train prior” writes one."
        ) from error
    moments = Moments(mean, whole, within, WEIGHT, np.full(len(within), WEIGHT))
    return Prior(joints, moments, remembered, suppleness)


def _read_recordings(arrays: Mapping[str, NDArray[Any]], channels: int) -> tuple[Remembered, ...]:
    """What :func:`save_prior` wrote of recordings; nothing where it wrote none."""
    if "recordings" not in arrays:
        return ()
    poses, frames, bones = (arrays[name] for name in ("recordings", "frames", "bones"))
    wide = channels + len(IN_MIRROR)
    if poses.shape != (frames.sum(), wide) or bones.shape != (len(frames), channels // FEATURES):
        raise ValueError("its recordings do not fit")
    if (frames < 1).any() or not (np.isfinite(poses).all() and (bones > 0).all()):
        raise ValueError("its recordings are damaged")
    parts = np.split(poses.astype(np.float32), np.cumsum(frames)[:-1])
    return tuple(Remembered(*one) for one in zip(parts, bones.astype(np.float32), strict=True))


def _read_suppleness(
    arrays: Mapping[str, NDArray[Any]], joints: Sequence[str]
) -> Suppleness | None:
    """What :func:`save_prior` wrote of how bodies bend; None where it wrote nothing."""
    if "bending" not in arrays:
        return None
    bent, above = ([str(name) for name in row] for row in arrays["bent"])
    if len({*bent}) != len(joints) - 1 or not {*bent, *above} <= {*joints}:
        raise ValueError("its joints do not fit")
    covariance = _square(arrays["bending"][None], LOCAL * len(bent))[0]
    if not np.isfinite(covariance).all() or (covariance.diagonal() < 0).any():
        raise ValueError("its bends are damaged")
    return Suppleness(tuple(bent), tuple(above), covariance)


def _square(upper: FloatArray, size: int) -> FloatArray:
    """(n, size, size) symmetric matrices from their upper triangles."""
    rows, columns = np.triu_indices(size)
    if upper.shape[1:] != rows.shape or upper.dtype.kind != "f":
        raise ValueError("its sizes do not fit")
    full = np.zeros((len(upper), size, size))
    full[:, rows, columns] = upper
    full[:, columns, rows] = upper
    return full
