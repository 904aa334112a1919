"""Where the root of a skeleton was while it was not seen, from what hangs on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.body.facing import facing
from markermend.poses.filling.bridging import bridged, bridging_error
from markermend.poses.pose import Pose
from markermend.poses.quaternion import NO_TURN, inverse, lengths_of, multiply, turn, unit, unrolled

# A joint may move this much in the root's axes, mm, however still it seems to be there.
_STILL_MM = 1.0
# A joint counts this share of what one nearer to the root by a bone would: more bends between.
_FURTHER = 0.1
# How much the way the root turned beside a gap counts beside how joints stand around it, whose
# strays are bridged, too.
_BESIDE = 0.05
# What may be missed of how it turned in a gap, in radians, at least, and where nothing tells.
_LEAST_TURN, _ANY_TURN = 1e-4, 1.0
# How joints stand around a root changes slowly: what changes by this share of its squared change
# over such a time from one frame to the next is noise.
_CALM_S, _SHAKES = 0.1, 0.3
# So many sets of joints that were seen together are asked one by one.
_MOST_PARTS = 16


@dataclass(frozen=True, eq=False)
class Rooted:
    """A root that is known in every frame.

    Attributes
    ----------
    position : (frames, 3) mm
    rotation : (frames, 4)
    error_mm : (frames,) expected distance from the truth (root mean square), 0 where it was seen;
        NaN where it never was
    """

    position: FloatArray
    rotation: FloatArray
    error_mm: FloatArray


def rooted(pose: Pose, turned: BoolArray) -> Rooted:
    """Work out where a root was in frames in which it was not seen.

    Parameters
    ----------
    pose : a skeleton with one root; one that was never seen is taken to be at 0, and one without
        rotations to be turned as it faces (:func:`markermend.poses.body.facing.facing`), or not at
        all
    turned : (frames, joints) bool, rotations that are known

    Notes
    -----
    The joints that hang on a root hardly move in its axes. Laid over where they were seen
    (Kabsch 1976), each counting by how still and how near it is, they tell how the root turned and
    where it was; what that leaves in the frames in which the root was seen is bridged in time.
    Where none was seen, the root itself is bridged, and how it turned where one alone was.
    """
    root = pose.order[0]
    seen, known = pose.seen[:, root], turned[:, root]
    position, rotation = pose.positions[:, root].copy(), pose.rotations[:, root]
    if not known.any():
        rotation = facing(pose)
        known = ~np.isnan(rotation[:, 3])
    rotation = unrolled(np.where(known[:, None], rotation, np.nan)[:, None])[:, 0]
    path = _bridged(position, seen, (0.0, 0.0, 0.0))
    rotation = unit(_bridged(rotation, known, NO_TURN))
    error = np.zeros(pose.frames) if seen.all() else bridging_error(path, seen)
    both = seen & known
    hanging = [j for j in pose.order if j != root and pose.seen[both, j].any()]
    if both.all() or not hanging:
        return Rooted(path, rotation, error)
    # What some of them leave is not what all of them do, so it is bridged with the same ones.
    parts = [
        (frames, _beside(pose, np.array(hanging)[some], both, path, rotation))
        for frames, some in _parts(pose.seen[:, hanging], ~both)
    ]
    askew = np.zeros(pose.frames)
    if not known.all():
        turning = 2.0 * bridging_error(rotation, known)
        told, turns = known.copy(), rotation.copy()
        for frames, beside in parts:
            found, off, there = _turned(rotation, turning, known, beside, pose.rate)
            there &= frames & ~known
            told[there], turns[there], askew[there] = True, found[there], off[there]
        between = unrolled(np.where(told[:, None], turns, np.nan)[:, None])[:, 0]
        rotation = np.where(told[:, None], turns, unit(_bridged(between, told, NO_TURN)))
    place = path.copy()
    for frames, beside in parts:
        there, unseen = seen & beside.shown, ~seen & frames
        found = beside.middle - turn(rotation, beside.centre)
        left, shake = _calmed(path - found, there, pose.rate)
        off = np.hypot(bridging_error(left, there), askew * lengths_of(beside.centre))
        place[unseen] = (found + _bridged(left, there, (0.0, 0.0, 0.0)))[unseen]
        error[unseen] = np.hypot(off, shake)[unseen]
    return Rooted(place, rotation, error)


def _parts(shown: BoolArray, asked: BoolArray) -> list[tuple[BoolArray, BoolArray]]:
    """Frames (frames,) that are asked about, together where the same joints were seen, and these.

    Of very many such sets the rarest are taken together, and all joints for them. Frames in which
    none was seen are left out.
    """
    sets, own, times = np.unique(shown[asked], axis=0, return_inverse=True, return_counts=True)
    of = np.full(len(shown), -1)
    of[asked] = own.ravel()
    usual = np.argsort(-times, kind="stable")[:_MOST_PARTS]
    parts = [(np.asarray(of == n), sets[n]) for n in usual.tolist() if sets[n].any()]
    rest = asked & shown.any(axis=1) & ~np.isin(of, usual)
    return [*parts, (rest, np.ones(shown.shape[1], dtype=bool))] if rest.any() else parts


@dataclass(frozen=True, eq=False)
class _Beside:
    """Joints around a root, each counting by how still it is in the root's axes.

    Attributes
    ----------
    counts : (frames, joints) shares, 0 where a joint was not seen
    total : (frames,) what these are shares of: by 1/mm², how well they are known
    shown : (frames,) bool, any was seen
    middle : (frames, 3) mm, of those that were seen
    centre : (frames, 3) mm, the same in the root's axes, where they usually are
    around, usual : (frames, joints, 3) mm, joints from these two
    """

    counts: FloatArray
    total: FloatArray
    shown: BoolArray
    middle: FloatArray
    centre: FloatArray
    around: FloatArray
    usual: FloatArray


def _beside(
    pose: Pose, joints: IntArray, both: BoolArray, path: FloatArray, rotation: FloatArray
) -> _Beside:
    """Joints around a root whose position and rotation are known in some frames (frames,)."""
    around, seen = pose.positions[:, joints], pose.seen[:, joints]
    local = turn(inverse(rotation[both])[:, None], around[both] - path[both][:, None])
    place, spread = np.nanmedian(local, axis=0), np.nanvar(local, axis=0).sum(axis=1)
    near = _FURTHER ** (_depths(pose)[joints] - 1)
    counts, shown = seen * near / (spread + _STILL_MM**2), np.asarray(seen.any(axis=1))
    total = counts.sum(axis=1)
    counts[shown] /= total[shown, None]
    around = np.where(seen[..., None], around, 0.0)
    middle, centre = np.einsum("tj,tjx->tx", counts, around), counts @ place
    around, usual = around - middle[:, None], place - centre[:, None]
    return _Beside(counts, total, shown, middle, centre, around, usual)


def _depths(pose: Pose) -> IntArray:
    """(joints,) bones from the root to each joint."""
    depths = np.zeros(len(pose.joints), dtype=int)
    for joint in pose.order[1:]:
        depths[joint] = depths[pose.parents[joint]] + 1
    return depths


def _turned(
    rotation: FloatArray, turning: FloatArray, known: BoolArray, beside: _Beside, rate: float
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """(frames, 4) rotations, which are bridged where not known, by how joints stand around it.

    And (frames,) by how much they may be off, in radians, and bool, where joints tell any.
    """
    usual = float(np.sqrt(np.mean(np.nan_to_num(turning[~known], nan=_ANY_TURN) ** 2)))
    # The same in all frames: what it draws them away by is bridged with the rest.
    total = np.where(beside.shown, beside.total, 1.0)[:, None]
    firm = 3.0 * _BESIDE / max(usual, _LEAST_TURN) ** 2 / total
    laid = np.einsum("tj,tjx,tjy->txy", beside.counts, beside.around, beside.usual)
    laid += 0.5 * firm[..., None] * Rotation.from_quat(rotation).as_matrix()
    left, _, right = np.linalg.svd(laid)
    sign = np.linalg.det(left @ right)
    left[:, :, 2] *= sign[:, None]
    found = Rotation.from_matrix(left @ right).as_quat()
    off = unrolled(multiply(inverse(found), rotation)[:, None])[:, 0]
    off, shake = _calmed(off, known, rate)
    # Along axes that joints tell nothing about, the way beside the gap is all there is.
    spread = np.einsum("tj,tjx,tjy->txy", beside.counts, beside.usual, beside.usual)
    size = np.trace(spread, axis1=1, axis2=2)
    told = np.linalg.eigvalsh(size[:, None, None] * np.eye(3) - spread)
    open_to = firm / (firm + np.maximum(told, 0.0))
    missed = turning * np.sqrt(np.mean(open_to**2, axis=1))
    # A rotation's numbers are off by half of a small angle.
    error = np.hypot(2.0 * np.hypot(bridging_error(off, known), shake), missed)
    turns = multiply(found, unit(_bridged(off, known, NO_TURN)))
    # Where none was seen, or one alone, there is nothing to lay over.
    return unit(turns), error, size > 0


def _calmed(values: FloatArray, known: BoolArray, rate: float) -> tuple[FloatArray, float]:
    """(frames, n) as they are, or smoothed where mostly noise changes what is known of them.

    And how much smoothing took out (root mean square).
    """
    lag = max(round(_CALM_S * rate), 2)
    if known.sum() <= lag:
        return values, 0.0
    changes = [(values[n:] - values[:-n])[known[n:] & known[:-n]] for n in (1, lag)]
    if not all(map(len, changes)):
        return values, 0.0
    change, later = (np.mean(np.sum(way**2, axis=1)) for way in changes)
    if change <= _SHAKES * later:
        return values, 0.0
    held, there = np.where(known[:, None], values, 0.0), known.astype(float)
    summed, counted = (gaussian_filter1d(x, _CALM_S * rate, axis=0) for x in (held, there))
    calm = summed / np.maximum(counted, np.finfo(float).tiny)[:, None]
    return calm, float(np.sqrt(np.mean(np.sum((values - calm)[known] ** 2, axis=1))))


def _bridged(values: FloatArray, known: BoolArray, nothing: tuple[float, ...]) -> FloatArray:
    """(frames, n) with gaps bridged; where nothing is known, that."""
    if not known.any():
        return np.tile(nothing, (len(values), 1))
    return bridged(values, np.repeat(known[:, None], values.shape[1], axis=1))
