"""Make a skeleton recording clean: mend faults, fill what was not seen, take out noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from os import PathLike

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError, MethodError
from markermend.poses.body.agreeing import NOISY, SURE, agreeing, agreeing_in_time, with_bones
from markermend.poses.body.bending import OthersBends
from markermend.poses.body.bones import Bones, wobble
from markermend.poses.body.calming import calmed, root_noise_mm
from markermend.poses.body.jointed import jointed
from markermend.poses.channels import (
    Channels,
    columns_of,
    known_joints,
    of_all_joints,
    steadied,
    to_channels,
    to_features,
    trusted_turns,
)
from markermend.poses.faults.finding import Fault, mend_faults
from markermend.poses.faults.guessing import INFERRED, guessed, restored_beside_guesses
from markermend.poses.faults.wrong_angles import with_own_angles
from markermend.poses.filling.covariance import Moments
from markermend.poses.filling.expecting import (
    left_of_noise,
    limbs_doubted,
    with_disagreement,
    with_root_errors,
)
from markermend.poses.filling.filling import BRIEF_S, Filled, fill
from markermend.poses.filling.hanging import by_parents, hanging_joints
from markermend.poses.filling.likeness import FEW_MOMENTS, MOMENTS, SOME_MOMENTS
from markermend.poses.filling.linking import linked_channels
from markermend.poses.filling.remembered import Remembered, performances
from markermend.poses.filling.sides import mirror_of
from markermend.poses.filling.stance import IN_MIRROR, stance
from markermend.poses.filling.trials import tried
from markermend.poses.loose_root import with_loose_root, without_loose_root
from markermend.poses.normal import FEATURES, denormalise
from markermend.poses.nuitrack import mirrored
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior, bending_of, fitting, remembered_of, shipped_prior
from markermend.poses.quaternion import signed_like, unit
from markermend.poses.smoothing import (
    LEAST_NOISE,
    noise_level,
    overall_noise,
    smooth,
    smooth_again,
)
from markermend.poses.turnless import with_one_turn, without_one_turn
from markermend.progress import Progress, part, quiet

# What was filled without noise is filled again so many times from what comes out.
_ROUNDS = 2
# How much others' bends count beside a recording's own. Where nothing is noisy these count by how
# long the recording is, and others' as if they had been seen for so many seconds, but by no more
# than the share. That is how much they count where it is noisy, and its own tell of the noise, too.
_OTHERS_S, _OTHERS = 40.0, 0.85
# Shorter recordings tell too little by themselves, so strangers that a prior remembers are asked,
# where it does not know the body.
_SHORT_S = 20.0
# Lasting gaps are filled again so many times where they are few and where they are many, then once
# less where it is noisy.
_LOOKS, _MANY = (4, 2), 150
# Gaps, known better once all is smooth, make it worth to smooth a second time from there, unless
# many of them last.
_ROUNDS_WITH_GAPS = 2
# Shares of what two earlier steps made in the mean of what was seen and smoothed in three ways.
_BEFORE, _AT_FIRST = 0.3, 0.1
_LEAST_FRAMES = 3


@dataclass(frozen=True, eq=False)
class Restored:
    """A clean recording, and how far to trust it.

    Attributes
    ----------
    pose : the recording; joints that were not seen have confidence :data:`INFERRED`. Of q and -q,
        which are one rotation, it has the one that was recorded, or else that of the frame before.
    error_mm : (frames, joints) expected distance of each joint from the truth (root mean square);
        NaN for joints never seen
    noise_mm : (joints,) standard deviation of the noise that was taken out of each coordinate
    filled : (frames, joints) bool, positions that were worked out
    faults : joints that were wrong without the recording saying so
    """

    pose: Pose
    error_mm: FloatArray
    noise_mm: FloatArray
    filled: BoolArray
    faults: tuple[Fault, ...] = ()


def denoise(pose: Pose, *, prior: Prior | None = None, progress: Progress | None = None) -> Pose:
    """Return a recording made clean; see :func:`restore` for what is done, and how sure it is.

    Parameters
    ----------
    pose : any skeleton with one root, at any rate
    prior : how bodies move; the one that comes with Markermend where not given
    progress : told the share done; may raise to stop

    Raises
    ------
    DataError
        when nothing can be made of it: fewer than three poses, or no bone ever seen whole; or it is
        no skeleton recording
    MethodError
        when what should be a prior is none
    """
    if not isinstance(pose, Pose):
        raise DataError(
            f"{_kind(pose)} is no skeleton recording; give what read_pose makes of a file."
        )
    if not isinstance(prior, Prior | None):
        raise MethodError(f"{_kind(prior)} is no prior; give what own_prior makes of a file.")
    return restore(pose, prior=prior or shipped_prior(), progress=progress).pose


def _kind(thing: object) -> str:
    """What somebody gave, in words."""
    return f"“{thing}”" if isinstance(thing, str | PathLike) else f"A {type(thing).__name__}"


def restore(
    pose: Pose, *, prior: Prior | None = None, progress: Progress | None = None
) -> Restored:
    """Find what is wrong, fill what was not seen, take out noise, and keep bones as they are.

    Parameters
    ----------
    pose : any skeleton with one root, at any rate
    prior : how bodies move, learnt from other recordings; used where the recording has its joints,
        which may be some of them. Left-handed recordings are found and mirrored for it.
    progress : told the share done; may raise to stop

    Returns
    -------
    Restored
        whose expected errors, of joints that no prior tells of and of those that are none of the 17
        usual ones, are those made where as much that is known was hidden, which takes up to as long
        again; so does judging a sensor's guesses

    Raises
    ------
    DataError
        when there are fewer than three poses, or no bone was ever seen whole
    """
    if pose.frames < _LEAST_FRAMES:
        raise DataError(
            f"The recording is too short: it takes {_LEAST_FRAMES} poses, and has {pose.frames};"
            " take a longer one."
        )
    body = without_loose_root(pose)
    if body is not None:
        return with_loose_root(restore(body, prior=prior, progress=progress), pose)
    tell, given = progress or quiet, pose
    guesses = guessed(pose)
    if guesses.any():
        return restored_beside_guesses(
            pose, guesses, lambda some, told: restore(some, prior=prior, progress=told), tell
        )
    # Matrices as small as these take several times as long where two threads share one.
    with threadpool_limits(1):
        mended, faults = mend_faults(pose)
        pose = without_one_turn(mended)
        fit = fitting(pose, prior) if prior is not None else None
        moments, left_handed = fit or (None, False)
        shown = mirrored(pose) if left_handed else pose
        remembered: Sequence[Remembered] = ()
        bending = None
        if prior is not None and fit is not None:
            remembered = remembered_of(shown, prior, strangers=pose.frames < _SHORT_S * pose.rate)
            bending = bending_of(shown, prior)
        run = partial(_restore, prior=moments, remembered=remembered, bending=bending)
        restored = run(shown, tell=tell)
        hanging = hanging_joints(shown, moments)
        if hanging.any():
            restored = tried(restored, hanging, partial(run, tell=part(tell, 0.9, 1.0)))
    if left_handed:
        restored = replace(restored, pose=mirrored(restored.pose))
    if pose is not mended:
        restored = replace(restored, pose=with_one_turn(restored.pose, mended))
    own = with_own_angles(restored.pose, given, faults)
    error = with_disagreement(restored.error_mm, restored.pose, own)
    restored = replace(restored, pose=own)
    error = with_root_errors(error, restored.filled, restored.pose, faults, pose)
    return replace(restored, error_mm=error, faults=faults)


def _restore(
    pose: Pose,
    prior: Moments | None,
    tell: Progress,
    remembered: Sequence[Remembered],
    bending: OthersBends | None,
) -> Restored:
    """Restore by moments of the recording's channels, what is remembered, and how others bend."""
    faced = not trusted_turns(pose)[:, pose.order[0]].any()
    channels = steadied(to_channels(pose), pose.rate, faced)
    channels, off_mm = linked_channels(channels, known_joints(channels, pose), pose.parents)
    usable = np.asarray(channels.known.any(axis=0))
    values, known = channels.values[:, usable], channels.known[:, usable]
    hangs = hanging_joints(pose, prior)[list(channels.joints)].repeat(FEATURES)[usable]
    mirror = performed = None
    if prior is not None:
        usual = np.where(channels.known, channels.values, 0.0).sum(axis=0)
        prior = prior.signed_like(usual)
        kept = np.append(usable, np.ones(len(IN_MIRROR), dtype=bool))
        mirror = mirror_of([pose.joints[j] for j in channels.joints], usual, IN_MIRROR).of(kept)
        like = [one.signed_like(usual).some(kept) for one in remembered]
        performed = performances(like, pose.rate)
        prior = prior.of(usable)
    beside = stance(channels.normal)
    filled_by = partial(
        fill,
        known=known,
        rate=pose.rate,
        prior=prior,
        beside=beside,
        mirror=mirror,
        performed=performed,
        joints=np.flatnonzero(usable) // FEATURES,
    )
    tell(0.1, "Looking for noise")
    begun = filled_by(values, rough=True)
    rough = begun.values
    whole = np.zeros(channels.values.shape)
    whole[:, usable] = rough
    seen_turned = known_joints(channels, pose)
    shown = to_features(channels.values, channels)[..., :3]
    shake = wobble(shown, seen_turned[0], pose.parents, channels.normal.root)
    noise = noise_level(whole, channels.known)
    level = overall_noise(noise, usable, shake, pose.rate)
    root_noise = 0.0
    if not level:
        noise[:] = LEAST_NOISE
    else:
        tell(0.3, "Smoothing")
        values = smooth(rough, noise[usable], pose.rate, prior)
        root_noise = root_noise_mm(pose) / channels.normal.scale
        if root_noise:
            remains = left_of_noise(pose.rate) * noise[usable]
            channels = calmed(channels, whole, values, remains, root_noise, pose.rate)
    share = _OTHERS
    if level <= NOISY:
        share = min(_OTHERS, _OTHERS_S / (_OTHERS_S + pose.frames / pose.rate))
    others = bending and replace(bending, share=share)
    ever_seen, ever_turned = (np.asarray(x.any(axis=0)) for x in seen_turned)
    body = jointed(pose, ever_seen, ever_turned, others)
    tell(0.5, "Filling")
    left = left_of_noise(pose.rate)
    filled = filled_by(values, noise=left * level, begun=begun)
    whole[:, ~usable] = np.nan
    variance = np.full(channels.values.shape, np.nan)

    def hung(filled: Filled) -> Filled:
        if not hangs.any() or known.all():
            return filled
        whole[:, usable] = filled.values
        unsure = np.full(whole.shape, np.nan)
        unsure[:, usable] = filled.variance
        given = to_features(whole, channels), of_all_joints(unsure, channels), seen_turned
        body = pose.parents, pose.order, pose.rate
        told, doubt = by_parents(*given, *body, beside, left * level)
        told, doubt = (columns_of(x, channels)[:, usable] for x in (told, doubt))
        kept = known | ~hangs
        doubt = np.where(kept, filled.variance, doubt)
        return replace(filled, values=np.where(kept, filled.values, told), variance=doubt)

    def settled(filled: Filled, rounds: int) -> tuple[FloatArray, Bones]:
        whole[:, usable] = filled.values
        variance[:, usable] = _variance(filled, known, left * noise[usable])
        return agreed(whole, variance, rounds=rounds)

    agreed = partial(
        agreeing, channels=channels, pose=pose, known=seen_turned, noise=level, body=body
    )
    tell(0.7, "Keeping bones")
    many, rounds = filled.lasting >= _MANY, 1 if level > NOISY else _ROUNDS
    looks = _LOOKS[many] - int(many and level > 0) if filled.lasting else 0
    filled = filled if looks else hung(filled)
    features, bones = settled(filled, int(not many) if looks else rounds)
    for look in range(1, looks + 1):
        tell(0.7 + 0.1 * look / (looks + 1), "Filling again")
        near = replace(filled, values=columns_of(features, channels)[:, usable])
        compared = FEW_MOMENTS if look < looks else SOME_MOMENTS if many else MOMENTS
        filled = filled_by(values, noise=left * level, near=near, compared=compared)
        filled = filled if look < looks else hung(filled)
        features, bones = settled(filled, 1 if many and look < looks else rounds)
    if level > NOISY:
        tell(0.8, "Smoothing again")
        first = features
        for _ in range(1 if many or known.all() else _ROUNDS_WITH_GAPS):
            pilot = columns_of(features, channels)[:, usable]
            again = np.where(known, channels.values[:, usable], pilot)
            whole[:, usable] = smooth_again(again, pilot, noise[usable], pose.rate)
            features, bones = agreed(whole, variance, rounds=1)
            last = agreeing_in_time(features, channels, noise, pose, body)
            features = _between(last, features, first, seen_turned)
    features = with_bones(features, seen_turned, bones)
    variance[:, usable] *= limbs_doubted(known.shape, filled.gaps, BRIEF_S * pose.rate)
    return _finished(pose, features, channels, noise, variance, off_mm, root_noise)


def _variance(filled: Filled, known: BoolArray, left: FloatArray) -> FloatArray:
    """(frames, channels) of errors of what was filled, and of the noise that is left."""
    unsure = np.where(known, 0.0, np.maximum(filled.variance, SURE**2))
    return unsure + left**2


def _between(
    last: FloatArray, before: FloatArray, first: FloatArray, known: tuple[BoolArray, BoolArray]
) -> FloatArray:
    """(frames, joints, 7) mean of what three ways of smoothing made of what is known.

    Each keeps other noise and takes other movement, so that their mean is nearer than the last,
    which is the nearest of them. What was filled is best as the last has it.
    """
    mean = (1.0 - _BEFORE - _AT_FIRST) * last + _BEFORE * before + _AT_FIRST * first
    out = last.copy()
    out[..., :3][known[0]] = mean[..., :3][known[0]]
    out[..., 3:][known[1]] = unit(mean[..., 3:][known[1]])
    return out


def _finished(
    pose: Pose,
    features: FloatArray,
    channels: Channels,
    noise: FloatArray,
    variance: FloatArray,
    off_mm: FloatArray,
    root_noise: float,
) -> Restored:
    """Back to millimetres and global axes."""
    joints, count, root = list(channels.joints), len(pose.joints), channels.normal.root
    positions, rotations = denormalise(features, channels.normal)
    # A root that was never seen is where poses are looked at from.
    positions[:, ~pose.seen.any(axis=0)] = np.nan
    rotations = signed_like(rotations, pose.rotations, trusted_turns(pose))
    # Of what could never be trusted nothing better is known.
    rotations = np.where(np.isnan(rotations), pose.rotations, rotations)
    there = ~np.isnan(positions[..., 0])
    rotations[:, np.isnan(pose.rotations).all(axis=(0, 2))] = np.nan
    filled = there & ~pose.seen
    confidence = np.where(filled, INFERRED, np.where(there, pose.confidence, 0.0))
    error = np.zeros((pose.frames, count))
    squared = variance.reshape(pose.frames, -1, FEATURES)[..., :3].sum(axis=2)
    error[:, joints] = np.sqrt(squared) * channels.normal.scale
    error = np.hypot(error, off_mm)
    level = np.zeros(count)
    level[joints] = noise[::FEATURES] * channels.normal.scale
    level[root] = root_noise * channels.normal.scale
    error[:, root] = left_of_noise(pose.rate) * np.sqrt(3.0) * level[root]
    return Restored(pose.with_samples(positions, rotations, confidence), error, level, filled)
