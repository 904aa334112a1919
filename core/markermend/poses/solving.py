"""Solve the many small systems that poses take, without what each would take to check."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dposv, dpotrf, dpotri, sposv

from markermend.arrays import FloatArray

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
    factor, failed = dpotrf(matrix, lower=True)
    if failed:
        raise np.linalg.LinAlgError("The matrix is not positive definite.")
    lower, _ = dpotri(factor, lower=True)
    lower = np.tril(lower)
    return np.asarray(lower + np.tril(lower, -1).T)
