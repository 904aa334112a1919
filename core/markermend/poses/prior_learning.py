"""Learn how bodies move from recordings of other people."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.errors import DataError
from markermend.poses.body.suppleness import averaged_suppleness, suppleness
from markermend.poses.channels import Channels, steadied, to_channels, to_features
from markermend.poses.filling.bridging import bridged
from markermend.poses.filling.covariance import averaged, learn
from markermend.poses.filling.remembered import REMEMBERED_HZ, Remembered, resampled, shortened
from markermend.poses.filling.stance import stance
from markermend.poses.loose_root import body_of
from markermend.poses.nuitrack import mirrored, to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import WEIGHT, Prior, bones_of, fitting, know_one_body, shipped_prior
from markermend.poses.turnless import turned_as_parents, turnless
from markermend.progress import Progress, quiet


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
    remembered = shortened([one for prior in priors for one in prior.remembered])
    weights = [prior.moments.weight for prior in priors]
    bends = averaged_suppleness([prior.suppleness for prior in priors], weights)
    return Prior(joints, moments, remembered, bends)


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
    bones, columns = bones_of(body), np.hstack([values, stance(channels.normal)])
    remembered: tuple[Remembered, ...] = ()
    if not np.isnan(bones).any():
        moved = resampled(columns, body.rate, REMEMBERED_HZ)
        remembered = (Remembered(moved, np.asarray(bones / bones.mean(), dtype=np.float32)),)
    bends = suppleness(to_features(values, channels), body.joints, body.parents, body.order)
    return Prior(body.joints, learn(values, body.rate), remembered, bends)


def _usual(pose: Pose) -> Pose:
    """The 17 joints where a recording has them, right-handed; the body itself where not."""
    try:
        body = to_nuitrack(pose)
    except DataError:
        return body_of(pose)
    fits = fitting(body, shipped_prior())
    return mirrored(body) if fits is not None and fits[1] else body


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


def beside_ours(own: Prior) -> Prior:
    """What a prior of the user's own and Markermend's tell together, where they know one body.

    A few recordings tell little of how bodies move at large, and Markermend's nothing of whom they
    show; both count alike.
    """
    ours = shipped_prior()
    return together([ours, own]) if know_one_body(own, ours) else own
