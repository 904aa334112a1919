"""A linear dynamical system learnt by expectation maximisation from data with holes.

``z' = A z + w``, ``y = C z + v`` with w of covariance Q and v of diagonal covariance R. Samples
that are missing are left out of the likelihood (Shumway and Stoffer 1982), so that a frame in which
nothing is seen is crossed by the dynamics alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.progress import Progress, quiet

# Keeps covariances invertible; data have unit size.
LEAST_NOISE, LEAST_MOTION = 1e-6, 1e-9
# A covariance that changes by less, relative to its size, has settled.
SETTLED = 1e-9


@dataclass(frozen=True, eq=False)
class System:
    """Parameters of the system of h hidden dimensions and d observed ones.

    Attributes
    ----------
    step : (h, h) A
    motion : (h, h) Q
    output : (d, h) C
    noise : (d,) diagonal of R
    first : (h,) mean of the first state
    first_spread : (h, h) its covariance
    """

    step: FloatArray
    motion: FloatArray
    output: FloatArray
    noise: FloatArray
    first: FloatArray
    first_spread: FloatArray

    @property
    def parameters(self) -> int:
        """How many numbers are learnt; both covariances of h dimensions have h (h + 1) / 2."""
        hidden = len(self.first)
        return self.step.size + self.output.size + self.noise.size + hidden + hidden * (hidden + 1)


@dataclass(frozen=True, eq=False)
class States:
    """What the whole sequence says about its hidden states.

    Attributes
    ----------
    mean : (n, h)
    spread : (n, h, h) covariances
    lagged : (n - 1, h, h) covariances of each state with the one before it
    """

    mean: FloatArray
    spread: FloatArray
    lagged: FloatArray


def start_from(values: FloatArray, hidden: int) -> System:
    """First guess: main components of bridged data, and the regression of each on the last.

    Parameters
    ----------
    values : (n, d) without NaN, of mean 0
    hidden : dimensions of the state, at most d
    """
    u, s, vt = np.linalg.svd(values, full_matrices=False)
    states, output = u[:, :hidden] * s[:hidden], vt[:hidden].T
    before, after = states[:-1], states[1:]
    ridge = 1e-6 * np.trace(before.T @ before) / hidden * np.eye(hidden)
    step = np.linalg.solve(before.T @ before + ridge, before.T @ after).T
    left = after - before @ step.T
    motion = left.T @ left / len(left) + LEAST_MOTION * np.eye(hidden)
    noise = np.maximum(np.mean((values - states @ output.T) ** 2, axis=0), LEAST_NOISE)
    spread = states.T @ states / len(states)
    return System(step, motion, output, noise, states[0], spread)


def infer(system: System, values: FloatArray, known: BoolArray) -> States:
    """Hidden states given all that is known: Kalman filter and Rauch–Tung–Striebel smoother.

    Parameters
    ----------
    system : parameters
    values : (n, d); anything where not known
    known : (n, d) bool

    Notes
    -----
    Covariances depend on what is known only, and settle soon: where a frame is known as the last
    one was they are used again.
    """
    n, h = len(values), len(system.step)
    weighted = system.output / system.noise[:, None]
    pulls = np.where(known, values, 0.0) @ weighted
    changes = np.ones(n, dtype=bool)
    changes[1:] = (known[1:] != known[:-1]).any(axis=1)
    before, after = np.empty((n, h, h)), np.empty((n, h, h))
    guess, mean = np.empty((n, h)), np.empty((n, h))
    predicted, settled = system.first_spread, False
    inside = np.zeros((h, h))
    for t in range(n):
        if changes[t]:
            seen = known[t]
            inside, settled = system.output[seen].T @ weighted[seen], False
        if settled:
            before[t], after[t] = before[t - 1], after[t - 1]
        else:
            before[t] = predicted
            after[t] = np.linalg.solve(np.eye(h) + predicted @ inside, predicted)
            following = system.step @ after[t] @ system.step.T + system.motion
            settled = bool(np.abs(following - predicted).max() < SETTLED * predicted.max())
            predicted = 0.5 * (following + following.T)
        guess[t] = system.step @ mean[t - 1] if t else system.first
        mean[t] = guess[t] + after[t] @ (pulls[t] - inside @ guess[t])
    return _smooth(system, mean, guess, before, after)


def _smooth(
    system: System, mean: FloatArray, guess: FloatArray, before: FloatArray, after: FloatArray
) -> States:
    """Backward pass over what the filter found, in place."""
    n = len(mean)
    # Of A P and the spread predicted for the next frame.
    gains = np.linalg.solve(before[1:], system.step @ after[:-1]).transpose(0, 2, 1)
    lagged = np.empty_like(gains)
    for t in range(n - 2, -1, -1):
        gain = gains[t]
        mean[t] += gain @ (mean[t + 1] - guess[t + 1])
        lagged[t] = after[t + 1] @ gain.T
        after[t] += gain @ (after[t + 1] - before[t + 1]) @ gain.T
    return States(mean, after, lagged)


def improve(system: System, states: States, values: FloatArray, known: BoolArray) -> System:
    """Parameters under which states and data are likeliest, given the states (the M step).

    Parameters
    ----------
    system : as it was
    states : of :func:`infer`
    values, known : the data
    """
    n, h = states.mean.shape
    squares = states.spread + states.mean[:, :, None] * states.mean[:, None, :]
    crossed = states.lagged.sum(axis=0) + states.mean[1:].T @ states.mean[:-1]
    earlier, later = squares[:-1].sum(axis=0), squares[1:].sum(axis=0)
    step = np.linalg.solve(earlier, crossed.T).T
    motion = (later - step @ crossed.T) / (n - 1)
    motion = 0.5 * (motion + motion.T) + LEAST_MOTION * np.eye(h)
    output, noise = system.output.copy(), system.noise.copy()
    patterns, which = np.unique(known.T, axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns):
        if pattern.sum() <= h:
            continue
        columns = np.flatnonzero(which.ravel() == i)
        seen, total = values[np.ix_(pattern, columns)], squares[pattern].sum(axis=0)
        pulled = seen.T @ states.mean[pattern]
        output[columns] = np.linalg.solve(total, pulled.T).T
        left = np.mean(seen**2, axis=0) - np.sum(output[columns] * pulled, axis=1) / pattern.sum()
        noise[columns] = np.maximum(left, LEAST_NOISE)
    return replace(
        system,
        step=step,
        motion=motion,
        output=output,
        noise=noise,
        first=states.mean[0],
        first_spread=states.spread[0] + LEAST_MOTION * np.eye(h),
    )


def learn(
    values: FloatArray,
    known: BoolArray,
    start: System,
    rounds: int,
    progress: Progress = quiet,
) -> tuple[System, States]:
    """Expectation maximisation.

    Parameters
    ----------
    values : (n, d); anything where not known
    known : (n, d) bool
    start : first guess
    rounds : of expectation and maximisation
    progress : told every round; may raise ``Cancelled``

    Returns
    -------
    The system, and its states given the data.
    """
    system = start
    states = infer(system, values, known)
    for i in range(rounds):
        progress(i / rounds, f"Learning how the body moves, round {i + 1} of {rounds}")
        system = improve(system, states, values, known)
        states = infer(system, values, known)
    return system, states
