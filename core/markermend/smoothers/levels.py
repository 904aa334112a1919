"""How noisy and how lively a trajectory is at each moment, from its own samples.

Time is cut into blocks. In each, the trajectory is in one of a grid of states: how fast the motion
is (a cut-off) and how strong the noise (a multiple of the marker's usual). How well a state
explains a block is the likelihood of the one-step prediction errors under it, made forwards and
backwards; states change rarely between blocks. Forward and backward recursion then gives each
state's probability at each moment. Noise that is correlated from frame to frame is whitened first,
since it would pass for motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.smoothers.colour import find_colour, whiten
from markermend.smoothers.penalised import LOWEST, innovations, weight_of
from markermend.smoothers.registry import Signals

ORDER = 4
"""Order of the difference that the motion's noise drives; closest to real motion of 1 to 5."""

_BLOCK_S = 0.05
_CUTOFFS = 20
_LOWEST_HZ = 0.4
_HIGHEST = 0.35
_NOISE = np.array([0.7, 1.0, 1.4, 2.0, 2.8])
# Chance of another state in the next block, and of one anywhere on the grid at an event.
_MOTION_CHANGES, _NOISE_CHANGES, _EVENT = 0.28, 0.08, 0.5
_ROUNDS = 2
# Blocks count for the usual noise up to this many times its power.
_OUTLYING = 3.0
# Least frames from which a stretch says anything.
_LEAST = 2 * ORDER + 2
_FLOOR_MM = 1e-4


@dataclass(frozen=True, eq=False)
class Levels:
    """What was found at each frame.

    Attributes
    ----------
    cutoff_hz : (frames, markers, 3) frequency that is halved
    noise_mm : (frames, markers, 3) standard deviation of white noise as strong at the frequencies
        of the motion
    colour : (markers,) correlation of the noise from frame to frame
    states_hz : (cutoffs,) those that were weighed against each other
    chances : (blocks, cutoffs, channels) probability of each state times the variance of its
        noise, mm²
    block : frames of a block
    """

    cutoff_hz: FloatArray
    noise_mm: FloatArray
    colour: FloatArray
    states_hz: FloatArray
    chances: Float32Array
    block: int

    def mean_variance(self, of_state: FloatArray) -> FloatArray:
        """Mean over all states of what noise of one becomes in each of them.

        Parameters
        ----------
        of_state : (cutoffs,) variance for noise of one

        Returns
        -------
        (frames, markers, 3) mm²
        """
        mean = np.einsum("bkc,k->bc", self.chances, of_state)
        centres = _centres(len(mean), self.block)
        return _between(mean, centres, len(self.cutoff_hz)).reshape(self.cutoff_hz.shape)

    @property
    def sample_noise_mm(self) -> FloatArray:
        """(frames, markers, 3) standard deviation of the recorded samples' noise."""
        share = np.sqrt((1.0 - self.colour) / (1.0 + self.colour))
        return np.asarray(self.noise_mm * share[:, None])


@dataclass(frozen=True, eq=False)
class _Evidence:
    """Prediction errors summed over blocks.

    power : (blocks, cutoffs, channels) squared errors over the spread each state gives them
    count : (blocks, channels) samples behind them
    log_spread : (cutoffs,)
    """

    power: Float32Array
    count: Float32Array
    log_spread: Float32Array


def find_levels(signals: Signals) -> Levels:
    """Estimate cut-off and noise along every trajectory.

    Parameters
    ----------
    signals : what is not measured (filled, edited) is not evidence

    Returns
    -------
    Levels
        defined at every frame, in gaps as the frames around them suggest
    """
    frames, markers, _ = signals.values.shape
    length = max(1, round(_BLOCK_S * signals.rate))
    blocks = -(-frames // length)
    grid = np.geomspace(max(_LOWEST_HZ, LOWEST * signals.rate), _HIGHEST * signals.rate, _CUTOFFS)
    colour = find_colour(signals)
    white = whiten(signals, colour)
    evidence = _gather(white, grid, length, blocks)
    eventful = np.zeros(blocks, dtype=bool)
    near = signals.event_frames // length
    eventful[near[(near >= 0) & (near < blocks)]] = True
    log_cutoff, log_noise, chances = _smooth_states(
        evidence, _usual_noise(white), np.log(grid), eventful
    )
    centres, shape = _centres(blocks, length), (frames, markers, 3)
    return Levels(
        np.exp(_between(log_cutoff, centres, frames)).reshape(shape),
        np.exp(_between(log_noise, centres, frames)).reshape(shape),
        colour,
        grid,
        chances,
        length,
    )


def _gather(signals: Signals, grid: FloatArray, length: int, blocks: int) -> _Evidence:
    """Sum the prediction errors of every stretch under each cut-off."""
    channels = 3 * signals.values.shape[1]
    power = np.zeros((blocks, len(grid), channels), dtype=np.float32)
    count = np.zeros((blocks, channels), dtype=np.float32)
    weights = weight_of(grid / signals.rate, ORDER)
    log_spread = np.zeros(len(grid))
    for frames, markers in signals.stretches():
        n = frames.stop - frames.start
        if n < _LEAST:
            continue
        columns = (3 * markers[:, None] + np.arange(3)).ravel()
        first, last = frames.start // length, (frames.stop - 1) // length
        edges = np.maximum(np.arange(first, last + 1) * length - frames.start, 0)
        measured = np.repeat(signals.measured[frames, markers].T, 3, axis=0).astype(np.float64)
        rows = slice(first, last + 1)
        count[rows, columns] += np.add.reduceat(measured, edges, axis=1).T
        there = np.ascontiguousarray(
            np.diff(signals.values[frames, markers].reshape(n, -1), ORDER, axis=0).T
        )
        # An even order: the difference is the same read backwards.
        back = np.ascontiguousarray(there[:, ::-1])
        for k, weight in enumerate(weights):
            memory = signals.rate / (np.pi * grid[k])
            ahead, spread = innovations(there, float(weight), ORDER)
            behind, _ = innovations(back, float(weight), ORDER)
            squared = _both_ways(ahead, behind, n, memory) * (measured / spread)
            power[rows, k, columns] += np.add.reduceat(squared, edges, axis=1).T
            log_spread[k] = np.log(spread)
    return _Evidence(power, count, log_spread.astype(np.float32))


def _both_ways(ahead: FloatArray, behind: FloatArray, n: int, memory: float) -> FloatArray:
    """(channels, n) squared errors; each direction counts once it has seen enough."""
    trust = np.clip(np.arange(n) - ORDER + 1.0, 0.0, memory)
    total = trust + trust[::-1]
    squared = np.zeros((len(ahead), n))
    squared[:, ORDER:] += ahead * ahead * trust[ORDER:]
    squared[:, :-ORDER] += (behind * behind * trust[ORDER:])[:, ::-1]
    return np.asarray(squared / total)


def _usual_noise(signals: Signals) -> FloatArray:
    """(channels,) noise in mm as sixth differences show it."""
    measured = np.where(signals.measured[:, :, None], signals.values, np.nan)
    sixth = np.diff(measured, 6, axis=0)
    # Of a chi-square of one degree the median is 0.455; the squared weights of Δ⁶ sum to 924.
    squared = (sixth * sixth).reshape(len(sixth), sixth.shape[1] * 3)
    usual = np.zeros(squared.shape[1])
    some = ~np.isnan(squared).all(axis=0)
    if len(squared):
        usual[some] = np.nanmedian(squared[:, some], axis=0) / 0.455 / 924.0
    return np.maximum(np.sqrt(usual), _FLOOR_MM)


def _smooth_states(
    evidence: _Evidence, noise: FloatArray, log_grid: FloatArray, eventful: BoolArray
) -> tuple[FloatArray, FloatArray, Float32Array]:
    """(blocks, channels) expected log cut-off and log noise, and the chances of :class:`Levels`.

    The usual noise is re-estimated.
    """
    motion = _transitions(len(log_grid), _MOTION_CHANGES)
    change = _transitions(len(_NOISE), _NOISE_CHANGES)
    at_event = ((1 - _EVENT) * motion + _EVENT / len(log_grid)).astype(np.float32)
    total = np.maximum(evidence.count.sum(axis=0), 1.0)
    for _ in range(_ROUNDS):
        chance = _forward_backward(evidence, noise, motion, at_event, change, eventful)
        by_noise = chance.sum(axis=1)
        by_cutoff = chance.sum(axis=2)
        shrunk = np.einsum("bkjc,j->bkc", chance, (1.0 / _NOISE**2).astype(np.float32))
        power = np.einsum("bkc,bkc->bc", shrunk, evidence.power)
        # A spike or a swap that nobody repaired must not pass for noise.
        power = np.minimum(power, _OUTLYING * evidence.count * noise**2).sum(axis=0)
        usual, noise = noise, np.maximum(np.sqrt(power / total), _FLOOR_MM)
    log_cutoff = np.einsum("bkc,k->bc", by_cutoff, log_grid)
    log_noise = np.einsum("bjc,j->bc", by_noise, np.log(_NOISE)) + np.log(usual)
    chances = np.einsum("bkjc,j->bkc", chance, (_NOISE**2).astype(np.float32))
    return log_cutoff, log_noise, chances * (usual**2).astype(np.float32)


def _forward_backward(
    evidence: _Evidence,
    noise: FloatArray,
    motion: Float32Array,
    at_event: Float32Array,
    change: Float32Array,
    eventful: BoolArray,
) -> Float32Array:
    """(blocks, cutoffs, noises, channels) probability of each state given the whole trajectory."""
    blocks, cutoffs, channels = evidence.power.shape
    precision = (-0.5 / (_NOISE[:, None] * noise) ** 2).astype(np.float32)
    offset = -0.5 * evidence.log_spread[:, None] - np.log(_NOISE).astype(np.float32)
    shape = (cutoffs, len(_NOISE), channels)
    fits = np.empty((blocks, *shape), dtype=np.float32)
    chance = np.empty_like(fits)
    state = np.full(shape, 1.0 / (cutoffs * len(_NOISE)), dtype=np.float32)
    for t in range(blocks):
        fit = fits[t]
        np.multiply(evidence.power[t][:, None], precision, out=fit)
        fit += offset[:, :, None] * evidence.count[t]
        fit -= fit.max(axis=(0, 1))
        np.exp(fit, out=fit)
        moves = at_event if eventful[t] else motion
        state = change.T @ (moves.T @ state.reshape(cutoffs, -1)).reshape(shape)
        state *= fit
        state /= state.sum(axis=(0, 1))
        chance[t] = state
    state = np.ones(shape, dtype=np.float32)
    for t in range(blocks - 1, -1, -1):
        chance[t] *= state
        chance[t] /= chance[t].sum(axis=(0, 1))
        state *= fits[t]
        moves = at_event if eventful[t] else motion
        state = change @ (moves @ state.reshape(cutoffs, -1)).reshape(shape)
        state /= state.sum(axis=(0, 1))
    return chance


def _transitions(states: int, share: float) -> Float32Array:
    """(states, states) chances to stay or to move, near states first."""
    place = np.arange(states)
    away = np.exp(-np.abs(place[:, None] - place) * 1.0)
    np.fill_diagonal(away, 0.0)
    away /= away.sum(axis=1, keepdims=True)
    return np.asarray(share * away + (1.0 - share) * np.eye(states), dtype=np.float32)


def _centres(blocks: int, length: int) -> FloatArray:
    """(blocks,) middle of each block, in frames."""
    return np.asarray((np.arange(blocks) + 0.5) * length - 0.5)


def _between(values: FloatArray, centres: FloatArray, frames: int) -> FloatArray:
    """(frames, channels) straight lines between the blocks' centres."""
    if len(centres) == 1:
        return np.repeat(values, frames, axis=0)
    at = np.clip((np.arange(frames) - centres[0]) / (centres[1] - centres[0]), 0, len(centres) - 1)
    left: IntArray = np.minimum(at.astype(np.int64), len(centres) - 2)
    share = (at - left)[:, None]
    return np.asarray((1.0 - share) * values[left] + share * values[left + 1])
