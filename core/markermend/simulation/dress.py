"""Markers on a recorded skeleton: real motion under marker sets nobody has worn.

Places are drawn at random, so that what is learned from such takes holds for any marker set. Skin
swings like a damped spring behind its bone, slides as the joints beside it bend, and creeps;
cameras hiss, and shift a marker a little when one of them loses it; laboratories smooth, and fill
gaps by splines. How much of each is drawn for every take.
"""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import butter, lfilter, sosfiltfilt
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.errors import DataError
from markermend.poses import Pose
from markermend.simulation.performer import wander
from markermend.take import Take

MINOR = ("thumb", "finger", "hipjoint", "toe", "wrist")
"""Segments too small for a marker."""
FIRM = ("head", "hand", "foot", "neck", "clavicle")
LONGEST_SLIDE_MM = 40.0
STEADY_HZ = (12.0, 20.0)
"""Above this the skeleton's own jitter is taken out."""


def dress(pose: Pose, *, markers: int, seed: int) -> Take:
    """Put markers on a skeleton recording.

    Parameters
    ----------
    pose : at least 30 poses, complete
    markers : how many, spread over the segments as evenly as may be
    seed : same seed, same take

    Returns
    -------
    Take with every sample measured, in mm

    Raises
    ------
    DataError
        when the recording is too short or parts of it are unseen
    """
    frames = len(pose.positions)
    if frames < 30 or not (pose.confidence > 0).all():
        raise DataError("Markers can be put on complete recordings of 30 poses or more.")
    rng = np.random.default_rng(seed)
    segments = [
        i
        for i, name in enumerate(pose.joints)
        if pose.parents[i] >= 0 and not any(minor in name for minor in MINOR)
    ]
    homes = np.resize(rng.permutation(segments), markers)
    softness = float(rng.lognormal(np.log(2.5), 0.5))
    positions = np.empty((frames, markers, 3))
    for m, segment in enumerate(homes):
        firm = any(part in pose.joints[segment] for part in FIRM)
        soft = softness * (0.25 if firm else 1.0) * float(rng.lognormal(0.0, 0.5))
        positions[:, m] = _worn(pose, int(segment), soft, rng)
    # Solved joint angles jitter more than cameras do.
    steady = butter(2, float(rng.uniform(*STEADY_HZ)), fs=pose.rate, output="sos")
    positions = sosfiltfilt(steady, positions, axis=0)
    positions += _cameras(positions, pose.rate, rng)
    return Take(
        _processed(positions, pose.rate, rng),
        tuple(f"{pose.joints[s]}{m}" for m, s in enumerate(homes)),
        pose.rate,
    )


def _worn(pose: Pose, segment: int, soft: float, rng: np.random.Generator) -> FloatArray:
    """One marker on the skin of a segment, (frames, 3) mm."""
    parent = pose.parents[segment]
    turn = Rotation.from_quat(pose.rotations[:, segment])
    above = Rotation.from_quat(pose.rotations[:, parent])
    bone = pose.positions[:, segment] - pose.positions[:, parent]
    along = float(rng.uniform(0.1, 1.0))
    away = rng.standard_normal(3)
    away *= rng.uniform(30.0, 90.0) / np.linalg.norm(away)
    rigid = pose.positions[:, parent] + along * bone + turn.apply(away)
    bend = (above.inv() * turn).as_rotvec()
    below = [i for i, p in enumerate(pose.parents) if p == segment]
    if below:
        child = Rotation.from_quat(pose.rotations[:, below[0]])
        bend = np.hstack([bend, (turn.inv() * child).as_rotvec()])
    # Far turns come back as 2π less; the joints that matter do not turn so far.
    bend = bend - np.median(bend, axis=0)
    slide = bend @ rng.normal(0.0, 8.0, (bend.shape[1], 3))
    slide += (bend**2) @ rng.normal(0.0, 6.0, (bend.shape[1], 3))
    # Muscles harden and soften as they work, and what slides sticks.
    slide *= 1.0 + 0.3 * wander(len(rigid), pose.rate, 0.25, rng, 1)
    local = turn.inv().apply(_sway(rigid, pose.rate, rng)) + slide
    local = LONGEST_SLIDE_MM * np.tanh(soft * local / LONGEST_SLIDE_MM)
    local += 0.3 * soft * wander(len(rigid), pose.rate, 0.7, rng, 3)
    return np.asarray(rigid + turn.apply(local))


def _sway(rigid: FloatArray, rate: float, rng: np.random.Generator) -> FloatArray:
    """Skin as a damped spring that its bone's acceleration shakes, (frames, 3) mm."""
    hertz, damping = rng.uniform(5.0, 12.0), rng.uniform(0.2, 0.6)
    acceleration = np.gradient(np.gradient(rigid, axis=0), axis=0) * rate**2
    omega, step = 2 * np.pi * hertz, 1.0 / rate
    # Semi-implicit Euler of x'' = −a − 2ζω x' − ω² x.
    keep = 1.0 / (1.0 + 2 * damping * omega * step)
    b = np.array([0.0, -(step**2) * keep])
    a = np.array([1.0, -(1.0 + keep) + keep * (omega * step) ** 2, keep])
    return np.asarray(lfilter(b, a, acceleration, axis=0))


def _cameras(positions: FloatArray, rate: float, rng: np.random.Generator) -> FloatArray:
    """Hiss, louder while few cameras see, and small shifts when their number changes, mm."""
    frames, markers, _ = positions.shape
    hiss = rng.lognormal(np.log(0.025), 0.6) * rng.lognormal(0.0, 0.3, markers)
    few = np.maximum(wander(frames, rate, 0.12, rng, markers) - 1.5, 0.0)
    level = hiss * (1.0 + np.minimum(4.0 * few, 6.0))
    noise = rng.standard_normal(positions.shape) * level[:, :, None]
    often, size = rng.uniform(0.0, 0.4) / rate, rng.lognormal(np.log(0.3), 0.5)
    for m in range(markers):
        at = np.flatnonzero(rng.random(frames) < often)
        heights = rng.normal(0.0, size, (len(at) + 1, 3))
        noise[:, m] += heights[np.searchsorted(at, np.arange(frames), side="right")]
    return np.asarray(noise)


def _processed(positions: FloatArray, rate: float, rng: np.random.Generator) -> FloatArray:
    """What a laboratory makes of it: gaps bridged, often smoothed."""
    frames, markers, _ = positions.shape
    result = positions.copy()
    often = rng.uniform(0.0, 0.06) / rate
    for m in range(markers):
        hidden = np.zeros(frames, dtype=bool)
        for start in np.flatnonzero(rng.random(frames) < often):
            hidden[max(start, 3) : min(start + int(rng.integers(3, 40)), frames - 3)] = True
        if hidden.any():
            known = np.flatnonzero(~hidden)
            spline = CubicSpline(known, result[known, m])
            result[hidden, m] = spline(np.flatnonzero(hidden))
    if rng.random() < 0.6:
        cut = float(rng.uniform(6.0, 25.0))
        sos = butter(int(rng.integers(1, 4)), cut, fs=rate, output="sos")
        result = sosfiltfilt(sos, result, axis=0)
    return np.asarray(result)
