"""Bones keep their length, and a joint's rotation says where its bone points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.quaternion import between, inverse, lengths_of, multiply, turn

# A bone is rigid when its length, or its place in its parent's axes, strays by less than this
# share of its length beyond what noise explains, so many times its deviation: both ends have it.
RIGID, ATTACHED, BY_NOISE = 0.01, 0.02, 2.0
_ROUNDS = 8
# How much rotations count against positions for a bone's direction, and bones against positions.
BY_ROTATION, BY_BONE = 0.3, 3.0


@dataclass(frozen=True, eq=False)
class Bones:
    """What is constant about a body.

    Attributes
    ----------
    parents : index of each joint's parent, -1 for the root
    lengths : (joints,) of each joint's bone to its parent; NaN where it is not rigid
    places : (joints, 3) of each joint in its parent's axes; NaN where it moves in them
    """

    parents: tuple[int, ...]
    lengths: FloatArray
    places: FloatArray


def find_bones(
    features: FloatArray,
    seen: BoolArray,
    turned: BoolArray,
    parents: tuple[int, ...],
    noise: float = 0.0,
) -> Bones:
    """Find what is constant about a body where it was seen.

    Parameters
    ----------
    features : (frames, joints, 7)
    seen, turned : (frames, joints) bool, positions and rotations that are known
    parents : index of each joint's parent, -1 for the root
    noise : standard deviation that positions still have
    """
    lengths = np.full(len(parents), np.nan)
    places = np.full((len(parents), 3), np.nan)
    for joint, parent in enumerate(parents):
        if parent < 0:
            continue
        both = seen[:, joint] & seen[:, parent]
        if not both.any():
            continue
        bone = features[both, joint, :3] - features[both, parent, :3]
        far = lengths_of(bone)
        length = float(np.median(far))
        if length <= 0 or np.median(np.abs(far - length)) > RIGID * length + BY_NOISE * noise:
            continue
        lengths[joint] = length
        fixed = turned[both, parent]
        if fixed.any():
            own = turn(inverse(features[both, parent, 3:][fixed]), bone[fixed])
            place = np.median(own, axis=0)
            if np.median(lengths_of(own - place)) < ATTACHED * length + BY_NOISE * noise:
                places[joint] = place
    return Bones(parents, lengths, places)


def wobble(positions: FloatArray, seen: BoolArray, parents: tuple[int, ...], root: int) -> float:
    """Standard deviation of noise in positions, as lengths of bones that should not change show.

    Parameters
    ----------
    positions : (frames, joints, 3)
    seen : (frames, joints) bool
    parents : index of each joint's parent, -1 for the root
    root : index of the joint that all are relative to, and that has no noise

    Returns
    -------
    float
        infinite where no bone was seen in four frames in a row. Movement has no part in it, at any
        rate; nor has noise of a sensor that fits bones of constant length.
    """
    found = []
    for joint, parent in enumerate(parents):
        if parent < 0:
            continue
        third = third_differences(positions, seen, joint, parent)
        if len(third):
            ends = 1.0 if parent == root else 2.0
            found.append(noise_by(third) / np.sqrt(ends))
    return float(np.median(found)) if found else np.inf


def third_differences(
    positions: FloatArray, seen: BoolArray, joint: int, parent: int
) -> FloatArray:
    """(n,) sizes of the third differences of a bone's length, where it was seen.

    Parameters
    ----------
    positions : (frames, joints, 3)
    seen : (frames, joints) bool
    joint, parent : its ends
    """
    both = seen[:, joint] & seen[:, parent]
    far = lengths_of(positions[:, joint] - positions[:, parent])
    third = np.abs(np.diff(np.where(both, far, np.nan), 3))
    return np.asarray(third[~np.isnan(third)])


def noise_by(third: FloatArray) -> float:
    """Standard deviation of the white noise that sizes (n,) of third differences tell."""
    # Of a normal distribution the median is at 0.6745; 20 is the sum of squared weights.
    return float(np.median(third)) / 0.6745 / float(np.sqrt(20.0))


def keep_lengths(positions: FloatArray, seen: BoolArray, bones: Bones) -> FloatArray:
    """Give bones their length again by moving joints that were not seen.

    Parameters
    ----------
    positions : (frames, joints, 3)
    seen : (frames, joints) bool
    bones : what is constant
    """
    path = positions.transpose(1, 0, 2).copy()
    rigid = []
    for joint, length in enumerate(bones.lengths):
        parent = bones.parents[joint]
        if np.isnan(length):
            continue
        some = np.flatnonzero(~(seen[:, joint] & seen[:, parent]))
        mine, its = (~seen[some, j, None] for j in (joint, parent))
        shares = (np.where(a, np.where(b, 0.5, 1.0), 0.0) for a, b in ((mine, its), (its, mine)))
        rigid.append((joint, parent, length, some, *shares))
    for _ in range(_ROUNDS):
        for joint, parent, length, some, mine, its in rigid:
            bone = path[joint, some] - path[parent, some]
            far = np.maximum(lengths_of(bone), 1e-9)[:, None]
            correction = (length - far) / far * bone
            path[joint, some] += mine * correction
            path[parent, some] -= its * correction
    return path.transpose(1, 0, 2).copy()


def swing(features: FloatArray, wrong: BoolArray, bones: Bones) -> FloatArray:
    """Turn joints so that their bone points where it does; the twist about it stays.

    Parameters
    ----------
    features : (frames, joints, 7)
    wrong : (frames, joints) bool, rotations to be turned
    bones : what is constant
    """
    out = features.copy()
    for parent, joint in _only_child(bones).items():
        some = np.flatnonzero(wrong[:, parent])
        if len(some):
            bone = features[some, joint, :3] - features[some, parent, :3]
            pointing = turn(features[some, parent, 3:], _all(bones.places[joint], some))
            out[some, parent, 3:] = multiply(between(pointing, bone), features[some, parent, 3:])
    return out


def fuse(features: FloatArray, bones: Bones, root: int) -> FloatArray:
    """Let positions, rotations and bones agree, where all of them are noisy.

    Parameters
    ----------
    features : (frames, joints, 7)
    bones : what is constant
    root : index of the joint that stays

    Notes
    -----
    A bone's direction is the weighted mean of what positions and its parent's rotation say;
    positions then solve least squares between themselves and those bones, one small system for
    all frames; rotations swing to the directions.
    """
    count = features.shape[1]
    system, right = np.eye(count), features[..., :3].copy()
    directions = np.zeros_like(right)
    for joint, length in enumerate(bones.lengths):
        if np.isnan(length):
            continue
        parent = bones.parents[joint]
        bone = features[:, joint, :3] - features[:, parent, :3]
        if not np.isnan(bones.places[joint, 0]) and parent != root:
            told = turn(features[:, parent, 3:], _all(bones.places[joint], bone))
            bone = (1.0 - BY_ROTATION) * bone + BY_ROTATION * told
        directions[:, joint] = bone / np.maximum(lengths_of(bone), 1e-9)[:, None] * length
        system[joint, joint] += BY_BONE
        system[parent, parent] += BY_BONE
        system[joint, parent] -= BY_BONE
        system[parent, joint] -= BY_BONE
        right[:, joint] += BY_BONE * directions[:, joint]
        right[:, parent] -= BY_BONE * directions[:, joint]
    system[root] = np.eye(count)[root]
    right[:, root] = features[:, root, :3]
    out = features.copy()
    # A joint never seen has no bones, and must not take the others along.
    never = np.isnan(right)
    solved = np.tensordot(np.linalg.inv(system), np.where(never, 0.0, right), (1, 1))
    out[..., :3] = solved.transpose(1, 0, 2)
    out[..., :3][never] = np.nan
    for parent, joint in _only_child(bones).items():
        if parent != root:
            pointing = turn(
                features[:, parent, 3:], _all(bones.places[joint], directions[:, joint])
            )
            swung = between(pointing, directions[:, joint])
            out[:, parent, 3:] = multiply(swung, features[:, parent, 3:])
    return out


def _only_child(bones: Bones) -> dict[int, int]:
    """The child that each joint's rotation carries, of joints with exactly one such child."""
    fixed = [j for j in range(len(bones.parents)) if not np.isnan(bones.places[j, 0])]
    children = [bones.parents[j] for j in fixed]
    return {bones.parents[j]: j for j in fixed if children.count(bones.parents[j]) == 1}


def _all(place: FloatArray, like: NDArray[Any]) -> FloatArray:
    """One place for each row."""
    return np.broadcast_to(place, (len(like), 3))
