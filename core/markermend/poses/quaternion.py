"""Unit quaternions x, y, z, w as arrays ``(…, 4)``; NaN goes through."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray

NO_TURN = (0.0, 0.0, 0.0, 1.0)
"""The rotation that changes nothing."""

# Matrices of quaternions are their numbers, some of them negative: taken at once, several times as
# fast as stacked one by one. Of x, y, z, w, row by row.
_LEFT = np.array([3, 2, 1, 0, 2, 3, 0, 1, 1, 0, 3, 2, 0, 1, 2, 3])
_LEFT_SIGNS = np.array([1, -1, 1, 1, 1, 1, -1, 1, -1, 1, 1, 1, -1, -1, -1, 1], dtype=np.float64)
_RIGHT_SIGNS = np.array([1, 1, -1, 1, -1, 1, 1, 1, 1, -1, 1, 1, -1, -1, -1, 1], dtype=np.float64)
_TURNING = np.array([3, 2, 1, 2, 3, 0, 1, 0, 3, 0, 1, 2])
_TURNING_SIGNS = 0.5 * np.array([1, 1, -1, -1, 1, 1, 1, -1, 1, -1, -1, -1])
# Nine numbers of a rotation's matrix from the products xx, xy, … ww.
_UNTURNED = np.eye(3).ravel()
_ROTATING = np.zeros((16, 9))
_ROTATING[[5, 10, 0, 10, 0, 5], [0, 0, 4, 4, 8, 8]] = -2.0
_ROTATING[[1, 13, 2, 1, 6, 12, 2, 6], [1, 2, 2, 3, 5, 7, 6, 7]] = 2.0
_ROTATING[[14, 12, 13], [1, 5, 6]] = -2.0
_ROTATING[14, 3] = 2.0
# Of fewer numbers than this whole arrays of them at a time take less than one operation each.
_FEW = 256
_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])


def multiply(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the rotation that applies b first, then a."""
    if a.size < _FEW and b.size < _FEW:
        return np.asarray((by_left(a) @ b[..., None])[..., 0])
    ax, ay, az, aw = a[..., 0], a[..., 1], a[..., 2], a[..., 3]
    bx, by, bz, bw = b[..., 0], b[..., 1], b[..., 2], b[..., 3]
    w = aw * bw - ax * bx - ay * by - az * bz
    # To stack them takes half as long again.
    out = np.empty((*w.shape, 4), dtype=w.dtype)
    out[..., 0] = aw * bx + ax * bw + ay * bz - az * by
    out[..., 1] = aw * by - ax * bz + ay * bw + az * bx
    out[..., 2] = aw * bz + ax * by - ay * bx + az * bw
    out[..., 3] = w
    return out


def inverse(q: FloatArray) -> FloatArray:
    """Turn back."""
    back = -q
    back[..., 3] = q[..., 3]
    return np.asarray(back)


def turn(q: FloatArray, vectors: FloatArray) -> FloatArray:
    """Rotate vectors ``(…, 3)``."""
    axis, w = q[..., :3], q[..., 3:]
    across = 2.0 * cross(axis, vectors)
    return np.asarray(vectors + w * across + cross(axis, across))


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross product, in a fraction of the time that numpy's takes for short arrays."""
    if a.size < _FEW and b.size < _FEW:
        ahead = a.take(_NEXT, axis=-1) * b.take(_LAST, axis=-1)
        return np.asarray(ahead - a.take(_LAST, axis=-1) * b.take(_NEXT, axis=-1))
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    x = ay * bz - az * by
    out = np.empty((*x.shape, 3), dtype=x.dtype)
    out[..., 0] = x
    out[..., 1] = az * bx - ax * bz
    out[..., 2] = ax * by - ay * bx
    return out


def cross_matrices(v: FloatArray) -> FloatArray:
    """(n, 3, 3) matrices that multiply as the cross product of vectors ``(n, 3)`` does."""
    out = np.zeros((len(v), 3, 3), dtype=v.dtype)
    out[:, 2, 1], out[:, 0, 2], out[:, 1, 0] = v.T
    out[:, 1, 2], out[:, 2, 0], out[:, 0, 1] = -v.T
    return out


def matrices(q: FloatArray) -> FloatArray:
    """(n, 3, 3) matrices that rotate as unit quaternions ``(n, 4)`` do."""
    products = (q[:, :, None] * q[:, None, :]).reshape(-1, 16)
    return np.asarray((_UNTURNED + products @ _ROTATING).reshape(-1, 3, 3))


def by_left(q: FloatArray) -> FloatArray:
    """(…, 4, 4) matrices that multiply as :func:`multiply` by quaternions from the left does."""
    return np.asarray((q.take(_LEFT, axis=-1) * _LEFT_SIGNS).reshape(*q.shape, 4))


def by_right(q: FloatArray) -> FloatArray:
    """(…, 4, 4) matrices that multiply as :func:`multiply` by quaternions from the right does."""
    return np.asarray((q.take(_LEFT, axis=-1) * _RIGHT_SIGNS).reshape(*q.shape, 4))


def by_turning(q: FloatArray) -> FloatArray:
    """(n, 4, 3) how quaternions ``(n, 4)`` change as they are turned about x, y and z."""
    return np.asarray((q.take(_TURNING, axis=1) * _TURNING_SIGNS).reshape(-1, 4, 3))


def upright(q: FloatArray) -> FloatArray:
    """Choose of q and -q, which are one rotation, the one with w at least 0."""
    return np.where(q[..., 3:] < 0, -q, q)


def unrolled(q: FloatArray) -> FloatArray:
    """Choose signs along the first axis so that nothing jumps; NaN frames are passed over.

    Parameters
    ----------
    q : (frames, joints, 4)
    """
    out = q.copy()
    for joint in range(q.shape[1]):
        known = np.flatnonzero(~np.isnan(q[:, joint, 3]))
        if not len(known):
            continue
        path = upright(q[known, joint])
        steps = np.sign(np.einsum("ij,ij->i", path[1:], path[:-1]))
        steps[steps == 0] = 1.0
        out[known, joint] = path * np.concatenate([[1.0], np.cumprod(steps)])[:, None]
    return out


def signed_like(q: FloatArray, other: FloatArray, known: BoolArray) -> FloatArray:
    """Choose of q and -q the one nearer to another rotation; where that is unknown, as before.

    Parameters
    ----------
    q, other : (frames, joints, 4)
    known : (frames, joints) bool, where the other tells; before the first such frame its sign holds
    """
    signs = np.where(np.sum(q * np.where(known[..., None], other, 0.0), axis=2) < 0, -1.0, 1.0)
    frames = np.where(known, np.arange(len(q))[:, None], np.argmax(known, axis=0))
    signs = np.take_along_axis(signs, np.maximum.accumulate(frames, axis=0), axis=0)
    return np.asarray(q * signs[..., None])


def unit(q: FloatArray) -> FloatArray:
    """Scale to length one."""
    far = lengths_of(q)[..., None]
    return np.asarray(q / np.where(far > 0, far, 1.0))


def rotation_vector(q: FloatArray) -> FloatArray:
    """(…, 3) axis times angle in radians, at most half a turn, of unit quaternions ``(…, 4)``."""
    q = upright(q)
    sine = lengths_of(q[..., :3])[..., None]
    angle = 2.0 * np.arctan2(sine, q[..., 3:])
    return np.asarray(q[..., :3] * np.where(sine > 0, angle / np.where(sine > 0, sine, 1.0), 2.0))


def between(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the shortest rotation that turns the direction of a into that of b.

    Parameters
    ----------
    a, b : (…, 3) vectors, not zero
    """
    far = lengths_of(a) * lengths_of(b)
    w = far + np.einsum("...i,...i->...", a, b)
    turns = np.empty((*w.shape, 4))
    turns[..., :3], turns[..., 3] = cross(a, b), np.maximum(w, 1e-12 * far)
    return unit(turns)


def lengths_of(vectors: FloatArray) -> FloatArray:
    """(…) length of each; numpy's sums over so few take several times as long."""
    return np.asarray(np.sqrt(np.einsum("...i,...i->...", vectors, vectors)))
