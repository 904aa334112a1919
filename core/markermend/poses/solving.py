"""Solve the many small systems that poses take, without what each would take to check."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dposv, sposv

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
    solve = sposv if system.dtype == np.float32 else dposv
    # Turned about it is in the order that the routine wants, and the same.
    _, found, failed = solve(system.T, right, lower=True, overwrite_a=True)
    if failed:
        raise np.linalg.LinAlgError("The system is not positive definite.")
    return np.asarray(found)
