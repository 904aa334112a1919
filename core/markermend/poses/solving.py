"""Solve the many small systems that poses take, without what each would take to check."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.blas import dgemm
from scipy.linalg.lapack import dposv, dpotrf, dpotri, dpotrs, sposv

from markermend.arrays import FloatArray, IntArray

Precision = TypeVar("Precision", np.float32, np.float64)


def solved(system: NDArray[Precision], right: NDArray[Precision]) -> NDArray[Precision]:
    """Solve a symmetric, positive definite system, which is spoilt.

    Parameters
    ----------
    system : (n, n) in C order
    right : (n, m) of the same precision

    Returns
    -------
    (n, m)

    Raises
    ------
    numpy.linalg.LinAlgError
        when the system is not positive definite
    """
    if not len(system):
        return right
    solve = sposv if system.dtype == np.float32 else dposv
    # Turned about it is in the order that the routine wants, and the same.
    _, found, failed = solve(system.T, right, lower=True, overwrite_a=True)
    if failed:
        raise np.linalg.LinAlgError("The system is not positive definite.")
    return np.asarray(found)


def inverted(matrix: FloatArray) -> FloatArray:
    """Invert a symmetric, positive definite matrix, in a third of the usual time.

    Parameters
    ----------
    matrix : (n, n), left as it is

    Returns
    -------
    (n, n)

    Raises
    ------
    numpy.linalg.LinAlgError
        when the matrix is not positive definite
    """
    factor, failed = dpotrf(matrix.T, lower=True)
    if failed:
        raise np.linalg.LinAlgError("The matrix is not positive definite.")
    # Above the diagonal it is 0 before and after.
    lower, _ = dpotri(factor, lower=True, overwrite_c=True)
    whole = np.add(lower, lower.T, order="C")
    whole.reshape(-1)[:: len(whole) + 1] *= 0.5
    return np.asarray(whole)


def part_of(matrix: FloatArray, rows: IntArray, columns: IntArray) -> FloatArray:
    """(n, k) of some rows and columns, in a third of the time that indexing by both takes."""
    return np.asarray(matrix.take(rows, axis=0).take(columns, axis=1))


def add_to_diagonal(matrix: NDArray[Any], more: NDArray[Any] | float) -> None:
    """Add to the diagonal of a matrix (n, n), in place; one number, or (n,)."""
    diagonal = np.einsum("ii->i", matrix)
    diagonal += more


def average_in(matrix: FloatArray, rows: FloatArray, share: float) -> None:
    """Let the products of rows count for a share of a matrix, in place.

    Parameters
    ----------
    matrix : (n, n), symmetric, in C order
    rows : (k, n) in C order; the sum of their products counts, each row by itself
    share : 0 to 1
    """
    if not len(rows):
        matrix *= 1.0 - share
        return
    # Turned about, all are in the order that the routine wants, and it works in place.
    turned = rows.T
    dgemm(share, turned, turned, 1.0 - share, matrix.T, trans_b=True, overwrite_c=True)


class Regression:
    """What some columns tell of others, by their covariance.

    Parameters
    ----------
    covariance : (columns, columns)
    told, telling : columns
    more : added to the variances of what tells

    Raises
    ------
    numpy.linalg.LinAlgError
        when the covariance is not positive definite
    """

    def __init__(
        self, covariance: FloatArray, told: IntArray, telling: IntArray, more: float
    ) -> None:
        rows = covariance.take(telling, axis=0)
        self._across, among = rows.take(told, axis=1), rows.take(telling, axis=1)
        add_to_diagonal(among, more)
        self._factor = among
        if len(among):
            # Every pose hides others, so weights of all told columns would serve but once or twice.
            self._factor, failed = dpotrf(among.T, lower=True, clean=False, overwrite_a=True)
            if failed:
                raise np.linalg.LinAlgError("The covariance is not positive definite.")

    def tell(self, away: FloatArray) -> FloatArray:
        """(told,) how far what is told is from its mean, where what tells is (telling,) away."""
        if not len(away):
            return np.zeros(self._across.shape[1])
        weighed, _ = dpotrs(self._factor, away, lower=True)
        return np.asarray(weighed @ self._across)
