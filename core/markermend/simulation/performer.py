"""A simulated person: standing, reaching, walking, turning, sitting down and getting up."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray
from markermend.simulation.footsteps import FootTrack, track_foot
from markermend.simulation.script import DEFAULT_SCRIPT, Activity, Gesture, make_plan
from markermend.simulation.skeleton import (
    ANKLE_HEIGHT,
    SIDES,
    Controls,
    Motion,
    joint_offset,
    leg_length,
    move,
    rotation,
    turned,
)

# Flexion, abduction, inward rotation, elbow, pronation, wrist; radians.
_HANGING = np.array([0.05, 0.15, 0.10, 0.28, 0.15, 0.05])
_ON_LAP = np.array([0.42, 0.10, 0.35, 0.95, 0.90, 0.10])
_SEAT = (-0.215, -0.245)
"""How far back and down the hips go to sit, as shares of body height."""


def perform(
    *,
    duration_s: float,
    rate: float,
    height_mm: float,
    activities: Sequence[Activity] = DEFAULT_SCRIPT,
    rng: np.random.Generator,
) -> Motion:
    """Move a person through a list of activities.

    Parameters
    ----------
    duration_s, rate : length and frames per second
    height_mm : body height
    activities : done in order, over again until the take is full
    rng : the performer's whims; same state, same motion

    Returns
    -------
    Motion, (frames, …) with ``frames = round(duration_s * rate)``; x and y on the floor, z up,
    floor at 0

    Notes
    -----
    Feet are planned first and stay planted; the pelvis follows them, the legs are solved by
    inverse kinematics, and arms, trunk and head follow the steps and the gestures, so that one
    activity blends into the next. Every control carries slow random variation.
    """
    frames = round(duration_s * rate)
    plan = make_plan(activities, duration_s, height_mm, rng)
    feet = {
        side: track_foot(
            [step for step in plan.steps if step.side == side],
            plan.start[side],
            frames,
            rate,
            height_mm,
        )
        for side in SIDES
    }
    return move(_controls(plan.gestures, feet, rate, height_mm, rng), height_mm)


def wander(
    frames: int, rate: float, scale_s: float, rng: np.random.Generator, columns: int = 1
) -> FloatArray:
    """Smooth random curves of unit variance that change over about ``scale_s``.

    Parameters
    ----------
    frames, rate : length and Hz of the take
    scale_s : seconds
    rng : what is random about them
    columns : how many curves

    Returns
    -------
    (frames, columns) float64

    Notes
    -----
    White noise under a Gaussian in the frequency domain. In time its window would have to end
    somewhere, and the step there is a jitter that a person at rest does not have: some hundredths
    of a metre per second squared at the hands, were it cut at four standard deviations.
    """
    from scipy.fft import irfft, rfft, rfftfreq

    sigma = scale_s * rate
    margin = int(4 * sigma) + 1
    length = frames + 2 * margin
    noise = rng.standard_normal((length, columns))
    gain = np.exp(-2.0 * (np.pi * sigma * rfftfreq(length)) ** 2)
    curves = irfft(gain[:, None] * rfft(noise, axis=0), length, axis=0)[margin : margin + frames]
    return np.asarray(curves * np.sqrt(2 * np.sqrt(np.pi) * sigma))


def _smooth(values: FloatArray, sigma_s: float, rate: float) -> FloatArray:
    """Gaussian average in time."""
    from scipy.ndimage import gaussian_filter1d

    return np.asarray(gaussian_filter1d(values, sigma_s * rate, axis=0, mode="nearest"))


def _share(gesture: Gesture, frames: int, rate: float) -> FloatArray:
    """How far a gesture is taken up, in [0, 1], with no jump in acceleration."""
    time = np.arange(frames) / rate - gesture.start_s
    fall = gesture.rise_s + gesture.hold_s
    up = np.clip(time / gesture.rise_s, 0.0, 1.0)
    down = np.clip((time - fall) / gesture.fall_s, 0.0, 1.0)
    rise = up**3 * (10 - 15 * up + 6 * up**2)
    return np.asarray(rise - down**3 * (10 - 15 * down + 6 * down**2))


def _controls(
    gestures: Sequence[Gesture],
    feet: dict[str, FootTrack],
    rate: float,
    height_mm: float,
    rng: np.random.Generator,
) -> Controls:
    """Let pelvis, trunk, head and arms follow the feet and the gestures."""
    frames = len(feet["L"].yaw)
    shares = [(g, _share(g, frames, rate)) for g in gestures]
    seated, lean, look, reaching, trunk = _gathered(shares, frames)
    heading = _smooth((feet["L"].yaw + feet["R"].yaw) / 2, 0.25, rate)
    ahead = np.column_stack([np.cos(heading), np.sin(heading)])
    apart = _smooth(((feet["L"].ground - feet["R"].ground) * ahead).sum(axis=1), 0.05, rate)
    stride = np.tanh(apart / (0.37 * height_mm))
    lifted = _smooth(feet["R"].swing - feet["L"].swing, 0.06, rate)

    slow = wander(frames, rate, 0.9, rng, 12)
    bend = 0.10 * seated + 0.62 * lean + trunk[:, 0] + 0.012 * slow[:, 0]
    angles = np.column_stack(
        [
            heading - 0.09 * stride + 0.010 * slow[:, 1],
            0.12 - 0.28 * seated + 0.30 * lean + 0.25 * trunk[:, 0] + 0.008 * slow[:, 2],
            0.055 * lifted + 0.006 * slow[:, 3],
        ]
    )
    pelvis = _pelvis(feet, angles, heading, seated, lean + trunk[:, 0], lifted, rate, height_mm)
    pelvis[:, :2] += (
        wander(frames, rate, 0.8, rng, 2) * (0.0022 * height_mm) * (1 - seated)[:, None]
    )
    twist = trunk[:, 1] + 0.19 * stride + 0.02 * slow[:, 4]
    spine = np.column_stack([bend, -0.05 * lifted + 0.015 * slow[:, 5], twist])
    gaze = look + np.column_stack([0.06 * slow[:, 6], 0.05 * slow[:, 7]])
    head = np.column_stack(
        [
            gaze[:, 1] - 0.7 * bend - 0.25 * lean,
            0.02 * slow[:, 8],
            gaze[:, 0] - 0.09 * stride - 0.5 * trunk[:, 1],
        ]
    )
    arms, shoulders = {}, {}
    breath = np.sin(2 * np.pi * 0.27 * np.arange(frames) / rate + 0.8 * slow[:, 9])
    for side, sign in (("L", -1.0), ("R", 1.0)):
        activation, wanted = reaching[side]
        free = 1.0 - np.minimum(activation, 1.0)
        arm = _HANGING + seated[:, None] * (_ON_LAP - _HANGING) * free[:, None]
        arm = arm + wanted - activation[:, None] * _HANGING
        swing = _smooth(sign * stride, 0.05, rate) * free
        arm[:, 0] += 0.36 * swing + 0.35 * lean * free
        arm[:, 3] += (0.20 * np.abs(stride) ** 2 + 0.16 * swing) * free
        arm += wander(frames, rate, 0.5, rng, 6) * (0.018, 0.012, 0.02, 0.025, 0.05, 0.09)
        arms[side] = arm
        raised = np.maximum(arm[:, 0] - 0.6, 0.0) ** 2 / (np.maximum(arm[:, 0] - 0.6, 0.0) + 0.4)
        shoulders[side] = 0.12 * _smooth(raised, 0.04, rate) + 0.006 * breath
    return Controls(
        pelvis=pelvis,
        pelvis_angles=angles,
        spine=spine,
        head=head,
        shoulders=shoulders,
        arms=arms,
        ankles={side: track.ankle for side, track in feet.items()},
        feet={side: np.column_stack([t.yaw, t.pitch]) for side, t in feet.items()},
    )


def _gathered(
    shares: list[tuple[Gesture, FloatArray]], frames: int
) -> tuple[
    FloatArray, FloatArray, FloatArray, dict[str, tuple[FloatArray, FloatArray]], FloatArray
]:
    """Sum the gestures: seated, lean, look (twist, bend), each arm, trunk (bend, twist)."""
    seated, lean = np.zeros(frames), np.zeros(frames)
    look, trunk = np.zeros((frames, 2)), np.zeros((frames, 2))
    reaching = {side: (np.zeros(frames), np.zeros((frames, 6))) for side in SIDES}
    for gesture, share in shares:
        if gesture.pose == "sit":
            seated += share
        elif gesture.pose == "lean":
            lean += share
        elif gesture.pose == "look":
            look += share[:, None] * np.array(gesture.angles)
        else:
            flexion, outward, inward, elbow, bend, twist = gesture.angles
            activation, wanted = reaching[gesture.side]
            activation += share
            wanted += share[:, None] * np.array([flexion, outward, inward, elbow, 0.9, -0.3])
            trunk += share[:, None] * np.array([bend, twist])
    return seated, lean, look, reaching, trunk


def _pelvis(
    feet: dict[str, FootTrack],
    angles: FloatArray,
    heading: FloatArray,
    seated: FloatArray,
    bend: FloatArray,
    lifted: FloatArray,
    rate: float,
    height_mm: float,
) -> FloatArray:
    """Midpoint of the hips: over the feet, as high as both legs allow, back when bending."""
    leg = leg_length(height_mm)
    between = _smooth((feet["L"].ground + feet["R"].ground) / 2, 0.20, rate)
    back = (0.018 - 0.06 * bend + _SEAT[0] * seated) * height_mm
    aside = _smooth(lifted, 0.08, rate) * 0.014 * height_mm
    ahead = np.column_stack([np.cos(heading), np.sin(heading)])
    left = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    floor = between + back[:, None] * ahead + aside[:, None] * left
    turn = rotation("z", angles[:, 0])
    limits = [np.full(len(heading), 0.992 * leg + ANKLE_HEIGHT * height_mm)]
    for side, track in feet.items():
        hip = floor + turned(turn, joint_offset(side + "thigh", height_mm))[:, :2]
        flat = np.sum((track.ankle[:, :2] - hip) ** 2, axis=1)
        limits.append(track.ankle[:, 2] + np.sqrt(np.maximum((0.992 * leg) ** 2 - flat, 0.0)))
    soft = 0.004 * height_mm
    height = -soft * np.logaddexp.reduce([-limit / soft for limit in limits], axis=0)
    height = _smooth(height, 0.045, rate) - 0.003 * height_mm
    standing = height - 0.02 * height_mm * bend
    seat = (0.53 + _SEAT[1]) * height_mm
    return np.column_stack([floor, standing + seated * (seat - standing)])
