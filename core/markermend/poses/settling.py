"""Let a whole body settle where its noisy joints and the way it is built agree."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import inverse, multiply, turn

# Of each joint: three numbers say how it is turned in its parent's axes, three where it is.
_LOCAL = 6
# Directions in which a body varies less than this share of its largest are those it cannot move in.
_LEAST = 1e-6
# Frames that share their slopes; groups of them that are solved at once.
_ALIKE, _AT_ONCE = 4, 128


def settle(
    features: FloatArray,
    variance: FloatArray,
    pilot: FloatArray,
    parents: Sequence[int],
    order: Sequence[int],
) -> FloatArray:
    """Return the most probable poses, given noisy ones and how this body bends.

    Parameters
    ----------
    features : (frames, joints, 7) relative to the root, without NaN
    variance : (frames, joints, 7) of their errors
    pilot : (frames, joints, 7) poses near the truth, which say how the body bends; with the root of
        the noisy ones, and rotations of unit length
    parents : index of each joint's parent, -1 for the root
    order : joints, parents first

    Notes
    -----
    In its parent's axes a joint of a body keeps its place and turns about few axes: an elbow about
    one. A normal distribution over those local coordinates of the pilot, all joints together, is
    the prior; features are linearised at the pilot, and each frame is one least-squares problem.
    A few frames in a row bend alike and share slopes and variances.
    """
    joints = [j for j in order if parents[j] >= 0]
    middle = _middles(pilot, parents, joints)
    start = _to_local(pilot, parents, joints, middle)
    mean = start.mean(axis=0)
    spread, axes = np.linalg.eigh(np.cov(start.T))
    kept = spread > _LEAST * spread[-1]
    scale = np.sqrt(spread[kept])
    poses = pilot.copy()
    other = np.sum(pilot[..., 3:] * features[..., 3:], axis=2) < 0
    poses[..., 3:][other] *= -1.0
    left = (features - poses)[:, joints].reshape(len(features), -1)
    at = (start - mean) @ axes[:, kept] / scale
    directions = axes[:, kept] * scale
    firsts = np.arange(0, len(features), _ALIKE)
    counts = np.diff(np.append(firsts, len(features)))
    unsure = variance[:, joints].reshape(len(features), -1)
    certain = 1.0 / np.sqrt(np.add.reduceat(unsure, firsts) / counts[:, None])
    settled = np.empty_like(at)
    for first in range(0, len(firsts), _AT_ONCE):
        some = slice(first, first + _AT_ONCE)
        middles = firsts[some] + counts[some] // 2
        rows = slice(firsts[first], firsts[some][-1] + counts[some][-1])
        slopes = _linear(start[middles], poses[middles], parents, joints, middle, directions)
        slopes *= certain[some, :, None]
        across = slopes.transpose(0, 2, 1)
        wanted = across @ (_grouped(left[rows], _ALIKE) * certain[some, None]).transpose(0, 2, 1)
        here = _grouped(at[rows], _ALIKE).transpose(0, 2, 1)
        moved = np.linalg.solve(across @ slopes + np.eye(len(scale)), wanted - here) + here
        settled[rows] = moved.transpose(0, 2, 1).reshape(-1, len(scale))[: len(at[rows])]
    return _from_local(mean + settled @ directions.T, features, parents, joints, middle)


def _grouped(rows: FloatArray, size: int) -> FloatArray:
    """(groups, size, columns) of rows in turn, zeros after the last."""
    padded = np.pad(rows, ((0, -len(rows) % size), (0, 0)))
    return padded.reshape(-1, size, rows.shape[1])


def _middles(
    features: FloatArray, parents: Sequence[int], joints: Sequence[int]
) -> dict[int, FloatArray]:
    """Mean rotation of each joint in its parent's axes."""
    return {
        j: Rotation.from_quat(_relative(features, parents[j], j)).mean().as_quat() for j in joints
    }


def _relative(features: FloatArray, parent: int, joint: int) -> FloatArray:
    """(frames, 4) rotation of a joint in its parent's axes."""
    return multiply(inverse(features[:, parent, 3:]), features[:, joint, 3:])


def _to_local(
    features: FloatArray,
    parents: Sequence[int],
    joints: Sequence[int],
    middle: dict[int, FloatArray],
) -> FloatArray:
    """(frames, joints · 6) rotation vectors about the mean rotation, and places."""
    local = np.empty((len(features), len(joints), _LOCAL))
    for n, joint in enumerate(joints):
        parent = parents[joint]
        own = multiply(inverse(middle[joint]), _relative(features, parent, joint))
        local[:, n, :3] = Rotation.from_quat(own).as_rotvec()
        bone = features[:, joint, :3] - features[:, parent, :3]
        local[:, n, 3:] = turn(inverse(features[:, parent, 3:]), bone)
    return local.reshape(len(features), -1)


def _from_local(
    local: FloatArray,
    like: FloatArray,
    parents: Sequence[int],
    joints: Sequence[int],
    middle: dict[int, FloatArray],
) -> FloatArray:
    """(frames, joints, 7); signs of rotations as in ``like``, from which the root is taken."""
    parts = local.reshape(len(local), len(joints), _LOCAL)
    out = like.copy()
    for n, joint in enumerate(joints):
        parent = parents[joint]
        own = multiply(middle[joint], Rotation.from_rotvec(parts[:, n, :3]).as_quat())
        turned = multiply(out[:, parent, 3:], own)
        other = np.sum(turned * like[:, joint, 3:], axis=1, keepdims=True) < 0
        out[:, joint, 3:] = np.where(other, -turned, turned)
        out[:, joint, :3] = out[:, parent, :3] + turn(out[:, parent, 3:], parts[:, n, 3:])
    return out


def _linear(
    local: FloatArray,
    poses: FloatArray,
    parents: Sequence[int],
    joints: Sequence[int],
    middle: dict[int, FloatArray],
    directions: FloatArray,
) -> FloatArray:
    """(frames, joints · 7, directions) how poses, given also as local, change along directions."""
    frames, columns = len(local), directions.shape[1]
    turning, moving = np.zeros((2, poses.shape[1], frames, 3, columns))
    slopes = np.empty((frames, len(joints), FEATURES, columns))
    for n, joint in enumerate(joints):
        parent, k = parents[joint], _LOCAL * n
        axes = Rotation.from_quat(poses[:, parent, 3:]).as_matrix()
        own = axes @ Rotation.from_quat(middle[joint]).as_matrix()
        bends = own @ _left_jacobian(local[:, k : k + 3])
        bone = _cross(poses[:, joint, :3] - poses[:, parent, :3])
        turning[joint] = turning[parent] + bends @ directions[k : k + 3]
        moving[joint] = moving[parent] - bone @ turning[parent] + axes @ directions[k + 3 : k + 6]
        slopes[:, n, :3] = moving[joint]
        slopes[:, n, 3:] = _by_turning(poses[:, joint, 3:]) @ turning[joint]
    return slopes.reshape(frames, -1, columns)


def _cross(v: FloatArray) -> FloatArray:
    """(n, 3, 3) matrices that multiply as the vectors' cross product."""
    x, y, z = v.T
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


def _left_jacobian(v: FloatArray) -> FloatArray:
    """(n, 3, 3) how the rotation turns as its rotation vector changes."""
    angle = np.maximum(np.sqrt(np.sum(v**2, axis=1)), 1e-4)[:, None, None]
    across = _cross(v)
    return np.asarray(
        np.eye(3)
        + (1.0 - np.cos(angle)) / angle**2 * across
        + (angle - np.sin(angle)) / angle**3 * (across @ across)
    )


def _by_turning(q: FloatArray) -> FloatArray:
    """(n, 4, 3) how quaternions change as they are turned about x, y and z."""
    x, y, z, w = q.T
    rows = [w, z, -y, -z, w, x, y, -x, w, -x, -y, -z]
    return 0.5 * np.stack(rows, axis=1).reshape(-1, 4, 3)
