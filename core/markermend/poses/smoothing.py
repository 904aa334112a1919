"""Take noise out of a whole body at once, without a knob."""

from __future__ import annotations

from math import comb
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, idct, next_fast_len
from scipy.ndimage import uniform_filter1d
from scipy.special import gammaincinv

from markermend.arrays import BoolArray, Float32Array, FloatArray
from markermend.poses.filling.covariance import Moments, completed
from markermend.poses.normal import FEATURES

LEAST_NOISE = 1e-4
"""Of a mean bone length; below it nothing is worth smoothing."""

_ORDER = 3
# Noise below this, of a mean bone length, is left alone: about 0.2 mm in an adult.
_WORTH = 1e-3
# Movement may pass for noise up to this at this rate, at slower ones for as much more as its third
# differences are larger, but does not change bones.
_FAINT, _FAINT_HZ = 5e-3, 30.0
# Neighbouring third differences of white noise tell much the same.
_REPEATS = 1.85
_ENOUGH = 1.3
# A hand's own turns pass for noise, but no joint is that much noisier than the others.
_MOST = 1.5
# Shorter recordings: blocks in which noise is looked for, how calm a block and a channel to take.
_BLOCK, _CALM, _CALM_CHANNELS = 16, 0.1, 0.25
# Blocks of all joints that are added to a joint's own, of which it may have next to none.
_OTHERS_BLOCKS = 8
# Positions and rotations of all joints.
_KINDS = (np.s_[:, :3], np.s_[:, 3:])
# So much noisier than all together, one of these speaks for itself where little can be told.
_FAR_NOISIER = 2.0
# Cut-offs tried, as shares of the frame rate; the time over which they compete, and how sharply.
_CUTOFFS = np.geomspace(0.004, 0.4, 7)
_WINDOW_S, _SHARP = 0.6, 0.1
# The same where a pilot tells the risk, which chance then has no part in.
_PILOT_WINDOW_S, _PILOT_SHARP = 0.3, 0.2
# How much others' recordings count beside one's own in what moves together, and the time over which
# these stray from a bridge, which tells it of their velocities.
_OTHERS, _STRAYS_S = 0.8, 0.067
_TINY = 1e-30
# Channels smoothed at once.
_AT_ONCE = 16
# Blocks of frames that make up the time over which they compete, and a little more.
_BLOCKS = 6
# Middle of the slowest band, how much wider the next one is, and the last one's share of the rate.
_SLOWEST_HZ, _WIDER, _FASTEST = 1.0, 2.5, 0.4


def noise_level(values: FloatArray, known: BoolArray) -> FloatArray:
    """Standard deviation of the noise of each joint's position and of its rotation.

    Parameters
    ----------
    values : (frames, joints · 7) without NaN, gaps filled
    known : (frames, joints · 7) bool

    Returns
    -------
    (joints · 7,), at least :data:`LEAST_NOISE`

    Notes
    -----
    What third differences of a joint have in common with those of all others is movement, also at
    30 Hz; what is its own is noise. Where the recording is too short to tell, the calmest moments
    of calm channels speak for all, or for positions and rotations where these are far apart.
    """
    frames, channels = values.shape
    third = np.diff(values, _ORDER, axis=0) / np.sqrt(comb(2 * _ORDER, _ORDER))
    whole = known[:-3] & known[1:-2] & known[2:-1] & known[3:] if frames > _ORDER else known[:0]
    effective, others = len(third) / _REPEATS, channels - FEATURES
    if others < 1 or effective < _ENOUGH * others:
        power, _ = _calm_power(third, whole)
        if np.isnan(power).all():
            return np.full(channels, LEAST_NOISE)
        usual = np.sqrt(np.nanquantile(power, _CALM_CHANNELS))
        features = power.reshape(-1, FEATURES)
        calm = np.full(features.shape, max(usual, LEAST_NOISE))
        for kind in _KINDS:
            told = features[kind][~np.isnan(features[kind])]
            apart = np.sqrt(np.quantile(told, _CALM_CHANNELS)) if len(told) else usual
            if apart > _FAR_NOISIER * usual:
                calm[kind] = max(apart, LEAST_NOISE)
        return np.asarray(calm.ravel())
    scale = np.maximum(np.sqrt(np.mean(third**2, axis=0)), 1e-12)
    third = third / scale
    covariance = third.T @ third / len(third)
    precision = np.linalg.inv(covariance + 1e-9 * np.eye(channels))
    unexplained = third @ precision
    noise, blocks = np.empty((2, channels))
    for first in range(0, channels, FEATURES):
        own = slice(first, first + FEATURES)
        rest = unexplained[:, own] @ np.linalg.inv(precision[own, own]) * scale[own]
        # A rotation's four numbers have three degrees of freedom.
        for part, share in ((slice(0, 3), 1.0), (slice(3, FEATURES), 4.0 / 3.0)):
            columns = slice(first + part.start, first + part.stop)
            power, blocks[columns] = _calm_power(rest[:, part], whole[:, columns])
            left = 0.0 if np.isnan(power).all() else float(np.nanmean(power))
            noise[columns] = np.sqrt(share * left * effective / (effective - others))
    by_joint, told = noise.reshape(-1, FEATURES), blocks.reshape(-1, FEATURES)
    for kind in _KINDS:
        level, count = by_joint[kind], told[kind]
        usual = float(np.median(level[count > 0])) if count.any() else 0.0
        pooled = (count * level**2 + _OTHERS_BLOCKS * usual**2) / (count + _OTHERS_BLOCKS)
        by_joint[kind] = np.minimum(np.sqrt(pooled), _MOST * usual)
    return np.maximum(noise, LEAST_NOISE)


def overall_noise(noise: FloatArray, usable: BoolArray, shake: float, rate: float) -> float:
    """How noisy a recording is, in mean bone lengths; 0 where nothing is worth taking out.

    Parameters
    ----------
    noise : (joints · 7,) of :func:`noise_level`
    usable : (joints · 7,) bool, features that were ever seen
    shake : by how much lengths of bones vary
    rate : frames per second
    """
    level = float(np.median(noise[usable]))
    if shake >= _WORTH:
        # Bones that change their length tell of noise where rotations have none.
        level = max(level, float(np.median(noise.reshape(-1, FEATURES)[:, :3])))
    faint = _FAINT * max(_FAINT_HZ / rate, 1.0) ** _ORDER
    return 0.0 if level < _WORTH or (level < faint and shake < _WORTH) else level


def _calm_power(third: FloatArray, whole: BoolArray) -> tuple[FloatArray, FloatArray]:
    """(channels,) mean square in calm moments, NaN where never known long enough, and blocks."""
    blocks, channels = len(third) // _BLOCK, third.shape[1]
    shape = (blocks, _BLOCK, channels)
    squared = np.where(whole, third, 0.0)[: blocks * _BLOCK].reshape(shape) ** 2
    total = squared.sum(axis=1)
    count = whole[: blocks * _BLOCK].reshape(shape).sum(axis=1)
    power = np.full(channels, np.nan)
    for channel in range(channels):
        enough = count[:, channel] >= _BLOCK // 2
        if enough.any():
            means = total[enough, channel] / count[enough, channel]
            power[channel] = np.quantile(means, _CALM)
    worth = _BLOCK / _REPEATS
    known_for = np.count_nonzero(count >= _BLOCK // 2, axis=0).astype(float)
    return power * worth / float(2.0 * gammaincinv(0.5 * worth, _CALM)), known_for


def smooth(
    values: FloatArray, noise: FloatArray, rate: float, others: Moments | None = None
) -> FloatArray:
    """Smooth what moves together, each as much as it bears at each moment.

    Parameters
    ----------
    values : (frames, channels) without NaN
    noise : (channels,) standard deviation of the white noise in each
    rate : frames per second
    others : moments of other recordings, which tell what moves together without this one's noise

    Returns
    -------
    (frames, channels)

    Notes
    -----
    Principal components of the poses are smoothed, then those of the velocities that come out.
    Each component passes a bank of Whittaker filters; Stein's unbiased estimate of their risk
    over a short time says how much each counts. A component that is movement keeps it, one that is
    noise goes.
    """
    if len(values) < 2 * _ORDER + 2:
        return values
    mean = values.mean(axis=0)
    white = (values - mean) / noise
    found = white
    for order in (0, 1):
        steps = np.diff(found, order, axis=0)
        covariance = steps.T @ steps
        if others is not None:
            elsewhere = others.within_s(_STRAYS_S) if order else others.whole
            covariance = _beside(covariance, elsewhere / noise[:, None] / noise, others)
        _, axes = np.linalg.eigh(covariance)
        found = smooth_each(white @ axes, rate) @ axes.T
    return np.asarray(found * noise + mean)


def _beside(own: FloatArray, theirs: FloatArray, others: Moments) -> FloatArray:
    """A recording's covariance and others', of which their size does not matter."""
    told = np.ones(len(own), dtype=bool) if others.told is None else others.told
    size = own.diagonal()[told].sum() / max(theirs.diagonal()[told].sum(), _TINY)
    return (1.0 - _OTHERS) * own + _OTHERS * completed(size * theirs, own, told)


def smooth_again(
    values: FloatArray, pilot: FloatArray, noise: FloatArray, rate: float
) -> FloatArray:
    """Smooth once more, knowing about what comes out.

    Parameters
    ----------
    values : (frames, channels) without NaN, as noisy as they were measured; the pilot's where they
        were not
    pilot : (frames, channels) near the truth
    noise : (channels,) standard deviation of the white noise in each of the values
    rate : frames per second

    Returns
    -------
    (frames, channels)

    Notes
    -----
    The pilot's velocities say what moves together, and what each filter would take from the pilot
    is its expected bias. That is Wiener filtering in two steps; values that are the pilot's where
    nothing was measured make it a step of expectation maximisation.
    """
    if len(values) < 2 * _ORDER + 2:
        return values
    mean = pilot.mean(axis=0)
    near = (pilot - mean) / noise
    steps = np.diff(near, axis=0)
    _, axes = np.linalg.eigh(steps.T @ steps)
    found = smooth_each((values - mean) / noise @ axes, rate, near @ axes)
    return np.asarray(found @ axes.T * noise + mean)


def smooth_each(values: FloatArray, rate: float, pilot: FloatArray | None = None) -> FloatArray:
    """Smooth channels of unit white noise, each by itself.

    Parameters
    ----------
    values : (frames, channels)
    rate : frames per second
    pilot : the same near the truth, by which risks are told; by the values where not given
    """
    found = np.empty_like(values)
    # So many at once as stay near at hand, and so precise as it takes to tell noise from movement.
    for first in range(0, values.shape[1], _AT_ONCE):
        some = np.s_[:, first : first + _AT_ONCE]
        near = None if pilot is None else np.asarray(pilot[some], dtype=np.float32)
        found[some] = _smooth_some(np.asarray(values[some], dtype=np.float32), rate, near)
    return found


def _smooth_some(values: Float32Array, rate: float, pilot: Float32Array | None) -> Float32Array:
    """:func:`smooth_each` of some channels."""
    frames = len(values)
    guide = values if pilot is None else pilot
    line = np.linspace(guide[0], guide[-1], frames, dtype=np.float32)
    spectrum = _spectrum(values - line)
    guiding = spectrum if pilot is None else _spectrum(guide - line)
    count = len(spectrum)
    pitch = (2.0 * np.sin(np.pi * np.arange(count) / (2 * count))) ** (2 * _ORDER)
    window_s, sharp = (_WINDOW_S, _SHARP) if pilot is None else (_PILOT_WINDOW_S, _PILOT_SHARP)
    window = min(2 * round(0.5 * window_s * rate) + 1, frames)
    ways, risks = [values], []
    for cutoff in _CUTOFFS[frames * _CUTOFFS > 1.0]:
        gain = 1.0 / (1.0 + pitch / (2.0 * np.sin(np.pi * cutoff)) ** (2 * _ORDER))
        passed = gain.astype(np.float32)[:, None]
        ways.append(_from_spectrum(spectrum * passed, frames) + line)
        if pilot is None:
            taken, chance = values - ways[-1], 2.0 * gain.mean()
        else:
            taken, chance = _from_spectrum(guiding * (1 - passed), frames), np.mean(gain**2)
        risks.append(_power(taken, window) + np.float32(chance))
    # To leave a component as it is must be among the choices.
    risks.insert(0, np.full_like(risks[0], 2.0 if pilot is None else 1.0))
    shares = np.exp(np.float32(sharp * window) * (np.minimum.reduce(risks) - np.stack(risks)))
    shares /= shares.sum(axis=0)
    total = np.zeros_like(values)
    for way, share in zip(ways, shares, strict=True):
        total += way * _in_each_frame(share, window, frames)
    return total


def smooth_bands(values: FloatArray, pilot: FloatArray, rate: float) -> Float32Array:
    """Smooth channels of unit white noise by what a pilot does at each pace.

    Parameters
    ----------
    values : (frames, channels)
    pilot : the same near the truth
    rate : frames per second

    Returns
    -------
    (frames, channels)

    Notes
    -----
    What moves together depends on how fast it moves. So both are divided into bands of frequency
    that overlap; in each band the principal components of the pilot are found, and each keeps the
    share that Wiener's filter gives it from the power that the pilot has there for a short time.
    """
    # So precise as it takes to tell noise from movement.
    noisy, near = (np.asarray(x, dtype=np.float32) for x in (values, pilot))
    frames = len(near)
    line = np.linspace(near[0], near[-1], frames, dtype=np.float32)
    spectrum, guiding = _spectrum(noisy - line), _spectrum(near - line)
    found = line
    for pace, band in _bands(len(spectrum), rate):
        passed = band.astype(np.float32)[:, None]
        guide, here = (_from_spectrum(power * passed, frames) for power in (guiding, spectrum))
        _, axes = np.linalg.eigh(guide.T @ guide)
        window_s = max(_PILOT_WINDOW_S, 0.5 / pace)
        window = min(2 * round(0.5 * window_s * rate) + 1, frames)
        power = _power(guide @ axes, window)
        kept = _in_each_frame(power / (power + np.float32(np.mean(passed**2))), window, frames)
        found = found + (here @ axes * kept) @ axes.T
    return np.asarray(found)


def _block(window: int) -> int:
    """Frames for which mean squares over a window are told at once, since they change slowly."""
    return max(window // _BLOCKS, 1)


def _power(values: Float32Array, window: int) -> Float32Array:
    """(blocks, channels) mean squares over a window about each block of frames."""
    size = _block(window)
    whole = len(values) // size * size
    blocks = values[:whole].reshape(-1, size, values.shape[1])
    squares = np.einsum("bsc,bsc->bc", blocks, blocks) / np.float32(size)
    if whole < len(values):
        squares = np.vstack([squares, np.mean(values[whole:] ** 2, axis=0)])
    return np.asarray(
        uniform_filter1d(squares, window // (2 * size) * 2 + 1, axis=0, mode="nearest")
    )


def _in_each_frame(blocks: Float32Array, window: int, frames: int) -> Float32Array:
    """(frames, channels) of what is known of the blocks of :func:`_power`."""
    return blocks.repeat(_block(window), axis=0)[:frames]


def _bands(count: int, rate: float) -> list[tuple[float, FloatArray]]:
    """Middles in hertz and weights (count,) of bands that add up to one."""
    middles = _SLOWEST_HZ * _WIDER ** np.arange(
        max(int(np.log(_FASTEST * rate / _SLOWEST_HZ) / np.log(_WIDER)), 0) + 2
    )
    pitch = 0.5 * rate * np.maximum(np.arange(count), 0.5) / count
    place = np.interp(np.log(pitch), np.log(middles), np.arange(len(middles)))
    weights = [np.clip(1.0 - np.abs(place - n), 0.0, 1.0) for n in range(len(middles))]
    return [
        (float(middle), np.sin(0.5 * np.pi * weight) ** 2)
        for middle, weight in zip(middles, weights, strict=True)
        if weight.any()
    ]


def _spectrum(values: NDArray[Any]) -> NDArray[Any]:
    """Cosine transform, of the values mirrored on behind their end for as long as makes it fast."""
    more = min(next_fast_len(len(values), real=True), 2 * len(values)) - len(values)
    padded = np.pad(values, ((0, more), (0, 0)), mode="symmetric")
    return np.asarray(dct(padded, type=2, norm="ortho", axis=0))


def _from_spectrum(spectrum: NDArray[Any], frames: int) -> NDArray[Any]:
    """Return the first frames of what has a spectrum."""
    return np.asarray(idct(spectrum, type=2, norm="ortho", axis=0)[:frames])
