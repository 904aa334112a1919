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
from markermend.poses.bridging import bridged
from markermend.poses.channels import Channels, steadied, to_channels
from markermend.poses.covariance import LENGTHS_S, Moments, averaged, learn
from markermend.poses.loose_root import body_of
from markermend.poses.normal import FEATURES, bone_lengths
from markermend.poses.nuitrack import mirrored, to_nuitrack, usual_name
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.poses.remembered import REMEMBERED_HZ, Remembered, resampled, shortened
from markermend.poses.stance import IN_MIRROR, stance
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
    remembered : up to ten minutes of the recordings, which tell most of who is recorded again
    """

    joints: tuple[str, ...]
    moments: Moments
    remembered: tuple[Remembered, ...] = ()


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
    parts = []
    for n, pose in enumerate(poses):
        (progress or quiet)(n / len(poses), f"Learning from recording {n + 1}")
        parts.append(learn_recording(pose, names[n] if names else f"Recording {n + 1}"))
    return together(parts)


def together(priors: Sequence[Prior]) -> Prior:
    """One prior of several, each by its weight.

    Raises
    ------
    DataError
        when there is none, or joints differ
    """
    if not priors:
        raise DataError("A prior needs at least one recording to learn from.")
    joints = priors[0].joints
    if any(prior.joints != joints for prior in priors):
        raise DataError("All recordings a prior learns from must have the same joints.")
    usual = priors[0].moments.mean
    moments = averaged([prior.moments.signed_like(usual) for prior in priors], WEIGHT)
    return Prior(joints, moments, shortened([one for prior in priors for one in prior.remembered]))


def learn_recording(pose: Pose, name: str) -> Prior:
    """What one recording tells, which weighs as many poses as it has.

    Parameters
    ----------
    pose : as for :func:`learn_prior`
    name : of the recording, for what is wrong with it

    Raises
    ------
    DataError
        when a joint was never seen, or has no rotation and is no end
    """
    body = _usual(pose)
    channels = _channels_of(body, name)
    values = bridged(channels.values, channels.known)
    bones, columns = _bones_of(body), np.hstack([values, stance(channels.normal)])
    remembered: tuple[Remembered, ...] = ()
    if not np.isnan(bones).any():
        moved = resampled(columns, body.rate, REMEMBERED_HZ)
        remembered = (Remembered(moved, np.asarray(bones / bones.mean(), dtype=np.float32)),)
    return Prior(body.joints, learn(values, body.rate), remembered)


def _usual(pose: Pose) -> Pose:
    """The 17 joints where a recording has them, right-handed; the body itself where not."""
    try:
        body = to_nuitrack(pose)
    except DataError:
        return body_of(pose)
    fits = fitting(body, shipped_prior())
    return mirrored(body) if fits is not None and fits[1] else body


def _bones_of(pose: Pose) -> FloatArray:
    """(joints,) length of the bone of each joint but the root; NaN for those never seen."""
    lengths = bone_lengths(pose.positions, pose.parents)
    return np.asarray(lengths[[j for j in range(len(lengths)) if j != pose.order[0]]])


def _channels_of(pose: Pose, name: str) -> Channels:
    """The columns of a recording that every joint was seen in."""
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
    return channels


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
    size = _size(pose, shared, moments.mean)
    if size != 1.0:
        moments = moments.longer(size)
    if len(shared) < len(names):
        moments = _told(moments, np.repeat(order >= 0, FEATURES))
    some = _some(pose)
    apart = [_apart(body, moments) for body in (some, mirrored(some))]
    limit = _ALIKE if pose.frames > 1 else _ALIKE_ONCE
    return (moments, apart[1] < apart[0]) if min(apart) < limit else None


def remembered_of(pose: Pose, prior: Prior) -> list[Remembered]:
    """What a prior remembers of the body that a recording shows, told by its bones.

    Parameters
    ----------
    pose : a recording that the prior fits, right-handed
    prior : of exactly the same joints; of a body that has more or fewer it remembers nothing

    Returns
    -------
    recordings in the order of the joints of this one
    """
    order = _order_of(pose, prior)
    if (order < 0).any() or len(order) != len(prior.joints) - 1:
        return []
    own = _bones_of(pose)
    recordings = (one.of(_columns(order)) for one in prior.remembered)
    return [one for one in recordings if one.of_body(own)]


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


def beside_ours(own: Prior) -> Prior:
    """What a prior of the user's own and Markermend's tell together, where they know one body.

    A few recordings tell little of how bodies move at large, and Markermend's nothing of whom they
    show; both count alike.
    """
    ours = shipped_prior()
    if own.joints != ours.joints:
        return own
    places = (prior.moments.mean.reshape(-1, FEATURES)[:, :_TURN] for prior in (own, ours))
    apart = float(np.mean(lengths_of(np.subtract(*places))))
    return together([ours, own]) if apart < _ALIKE else own


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
    except (ValueError, KeyError, TypeError) as error:
        raise FileFormatError(
            f"{path.name} holds no prior of poses; “markermend train prior” writes one."
        ) from error
    moments = Moments(mean, whole, within, WEIGHT, np.full(len(within), WEIGHT))
    return Prior(joints, moments, remembered)


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


def _square(upper: FloatArray, size: int) -> FloatArray:
    """(n, size, size) symmetric matrices from their upper triangles."""
    rows, columns = np.triu_indices(size)
    full = np.zeros((len(upper), size, size))
    full[:, rows, columns] = upper
    full[:, columns, rows] = upper
    return full
