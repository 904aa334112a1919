"""Rotations nearest to matrices: the solution of orthogonal Procrustes, for many frames at once."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray

# Newton's method for the nearest rotation: most steps, and of these scaled ones. Each step squares
# what is wrong: once it changes no more than this, less than rounding is left.
STEPS, SCALED, SETTLED = 12, 5, 1e-7
# Places of the nine numbers of a matrix, its rows and columns from the second on and round again.
_ROUND = [3 * (i % 3) + j % 3 for i in range(1, 5) for j in range(1, 5)]


def nearest_rotations(matrices: FloatArray) -> FloatArray:
    """Rotations nearest to matrices, the solutions of orthogonal Procrustes without reflections.

    Parameters
    ----------
    matrices : (n, 3, 3) finite

    Returns
    -------
    (n, 3, 3)
    """
    return nearest_flat(np.ascontiguousarray(matrices.reshape(-1, 9).T)).T.reshape(-1, 3, 3)


def nearest_flat(matrices: FloatArray) -> FloatArray:
    """(9, n) rotations nearest to (9, n) matrices, both flattened.

    A matrix of norm 1 plus its cofactors has the same nearest rotation, and no singular value of
    zero where the points lie in a plane. Of that Newton's method for the polar factor (Higham 1986)
    takes a fifth of the time of singular values, which only those need that do not settle:
    points on a line.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        flat: FloatArray = matrices / np.sqrt(np.sum(matrices**2, axis=0))
        flat += _cofactors(flat)
        for step in range(STEPS):
            cofactors = _cofactors(flat)
            volume = np.sum(flat[:3] * cofactors[:3], axis=0)
            scale = np.cbrt(np.abs(volume)) if step < SCALED else np.ones_like(volume)
            cofactors *= 0.5 * scale / volume
            cofactors += flat * (0.5 / scale)
            last, flat = flat, cofactors
            left = np.abs(np.subtract(flat, last, out=last), out=last)
            if not (left > SETTLED).any():
                break
    unsettled = ~((left <= SETTLED).all(axis=0) & (volume > 0.0))
    if unsettled.any():
        u, _, vt = np.linalg.svd(matrices[:, unsettled].T.reshape(-1, 3, 3))
        u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
        flat[:, unsettled] = (u @ vt).reshape(-1, 9).T
    return flat


def _cofactors(flat: FloatArray) -> FloatArray:
    """(9, n) cofactors of (9, n) flattened matrices."""
    wide = flat[_ROUND].reshape(4, 4, -1)
    cofactors: FloatArray = wide[:3, :3] * wide[1:, 1:]
    cofactors -= wide[:3, 1:] * wide[1:, :3]
    return cofactors.reshape(9, -1)
