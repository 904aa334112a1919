"""The performer's skeleton: segment lengths, forward kinematics, legs that reach for their feet.

Each segment has its origin at its proximal joint and, standing upright, the axes x forward,
y to the left, z up. Angles are in radians, lengths in millimetres.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from markermend.arrays import FloatArray

SIDES = ("L", "R")

PARENTS = MappingProxyType(
    {"pelvis": "", "lumbar": "pelvis", "thorax": "lumbar", "neck": "thorax", "head": "neck"}
    | {
        side + name: parent if parent in ("thorax", "pelvis") else side + parent
        for side in SIDES
        for name, parent in (
            ("clavicle", "thorax"),
            ("upperarm", "clavicle"),
            ("forearm", "upperarm"),
            ("hand", "forearm"),
            ("thigh", "pelvis"),
            ("shank", "thigh"),
            ("foot", "shank"),
        )
    }
)
"""Parent of each segment; parents come first."""

# Shares of body height, after the segment lengths of Drillis and Contini (1966); y is given
# for the left side.
_JOINTS = {
    "lumbar": (-0.015, 0.0, 0.045),
    "thorax": (0.0, 0.0, 0.100),
    "neck": (-0.015, 0.0, 0.150),
    "head": (0.010, 0.0, 0.065),
    "clavicle": (0.020, 0.015, 0.125),
    "upperarm": (-0.020, 0.095, 0.010),
    "forearm": (0.0, 0.0, -0.186),
    "hand": (0.0, 0.0, -0.146),
    "thigh": (0.0, 0.050, 0.0),
    "shank": (0.0, 0.0, -0.245),
    "foot": (0.0, 0.0, -0.246),
}
ANKLE_HEIGHT = 0.039
BALL = (0.075, 0.0, -ANKLE_HEIGHT)
HEEL = (-0.035, 0.0, -ANKLE_HEIGHT)
"""Where the foot touches the floor, in the foot's axes, as shares of body height."""

STRAIGHTEST = 0.998
"""Longest hip to ankle distance, as a share of the leg: knees never lock."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Where every segment is.

    Attributes
    ----------
    origins : segment to (frames, 3) float64, mm, in the room
    rotations : segment to (frames, 3, 3) float64, from the segment's axes to the room's
    height_mm : body height
    """

    origins: dict[str, FloatArray]
    rotations: dict[str, FloatArray]
    height_mm: float


@dataclass(frozen=True, eq=False)
class Controls:
    """What the performer does, frame by frame; angles in radians, positions in mm.

    Attributes
    ----------
    pelvis : (frames, 3) midpoint of the hips
    pelvis_angles : (frames, 3) yaw, forward tilt, roll (left side up)
    spine : (frames, 3) forward bend, bend to the right, twist to the left
    head : (frames, 3) forward bend, bend to the right, twist to the left
    shoulders : side to (frames,) elevation of the clavicle
    arms : side to (frames, 6) flexion, abduction, inward rotation, elbow flexion, pronation,
        wrist flexion
    ankles : side to (frames, 3) position asked for
    feet : side to (frames, 2) yaw and pitch (toes up)
    """

    pelvis: FloatArray
    pelvis_angles: FloatArray
    spine: FloatArray
    head: FloatArray
    shoulders: dict[str, FloatArray]
    arms: dict[str, FloatArray]
    ankles: dict[str, FloatArray]
    feet: dict[str, FloatArray]


def rotation(axis: str, angle: FloatArray) -> FloatArray:
    """Rotation matrices about one axis, (frames,) radians to (frames, 3, 3)."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    result = np.zeros((len(angle), 3, 3))
    result[:, np.arange(3), np.arange(3)] = 1.0
    result[:, i, i] = result[:, j, j] = np.cos(angle)
    result[:, j, i] = np.sin(angle)
    result[:, i, j] = -result[:, j, i]
    return result


def turned(matrices: FloatArray, vector: FloatArray) -> FloatArray:
    """Rotate one vector (3,) or one per frame (frames, 3) by (frames, 3, 3) matrices."""
    return np.asarray(
        np.einsum("fij,fj->fi", matrices, np.broadcast_to(vector, (len(matrices), 3)))
    )


def joint_offset(segment: str, height_mm: float) -> FloatArray:
    """Where a segment's proximal joint lies in its parent's axes, (3,) mm."""
    name, mirror = (segment[1:], -1.0) if segment[0] == "R" else (segment.removeprefix("L"), 1.0)
    offset = np.array(_JOINTS[segment if segment in _JOINTS else name]) * height_mm
    return np.asarray(offset * (1.0, mirror, 1.0))


def leg_length(height_mm: float) -> float:
    """Hip to ankle with a straight knee, mm."""
    return -(_JOINTS["shank"][2] + _JOINTS["foot"][2]) * height_mm


def move(controls: Controls, height_mm: float) -> Motion:
    """Work out where every segment is.

    Parameters
    ----------
    controls : what the performer does
    height_mm : body height

    Returns
    -------
    Motion; bones keep their length exactly, feet reach their ankle position wherever the leg
    is long enough
    """
    yaw, tilt, roll = controls.pelvis_angles.T
    rotations = {"pelvis": rotation("z", yaw) @ rotation("y", tilt) @ rotation("x", roll)}
    origins = {"pelvis": controls.pelvis}
    bend, side, twist = controls.spine.T / 2
    half = rotation("z", twist) @ rotation("y", bend) @ rotation("x", side)
    head_bend, head_side, head_twist = controls.head.T / 2
    nod = rotation("z", head_twist) @ rotation("y", head_bend) @ rotation("x", head_side)
    local = {"lumbar": half, "thorax": half, "neck": nod, "head": nod}
    for letter, sign in (("L", 1.0), ("R", -1.0)):
        flexion, abduction, inward, elbow, pronation, wrist = controls.arms[letter].T
        local[letter + "clavicle"] = rotation("x", sign * controls.shoulders[letter])
        local[letter + "upperarm"] = (
            rotation("y", -flexion)
            @ rotation("x", sign * abduction)
            @ rotation("z", -sign * inward)
        )
        local[letter + "forearm"] = rotation("y", -elbow) @ rotation("z", -sign * pronation)
        local[letter + "hand"] = rotation("x", -sign * wrist)
    for segment, turn in local.items():
        parent = PARENTS[segment]
        offset = joint_offset(segment, height_mm)
        origins[segment] = origins[parent] + turned(rotations[parent], offset)
        rotations[segment] = rotations[parent] @ turn
    for letter in SIDES:
        _leg(letter, controls, height_mm, origins, rotations)
    return Motion(origins, rotations, height_mm)


def _leg(
    side: str,
    controls: Controls,
    height_mm: float,
    origins: dict[str, FloatArray],
    rotations: dict[str, FloatArray],
) -> None:
    """Two-bone inverse kinematics: the knee bends in the plane between pelvis and foot."""
    thigh = -joint_offset(side + "shank", height_mm)[2]
    shank = -joint_offset(side + "foot", height_mm)[2]
    hip_offset = joint_offset(side + "thigh", height_mm)
    hip = origins["pelvis"] + turned(rotations["pelvis"], hip_offset)
    foot_yaw, foot_pitch = controls.feet[side].T
    span = controls.ankles[side] - hip
    asked = np.linalg.norm(span, axis=1)
    down = span / asked[:, None]
    reach = _at_most(asked, STRAIGHTEST * (thigh + shank), height_mm * 0.002)
    forward = np.stack(
        [
            np.cos(foot_yaw) + np.cos(controls.pelvis_angles[:, 0]),
            np.sin(foot_yaw) + np.sin(controls.pelvis_angles[:, 0]),
            np.full(len(foot_yaw), 0.3),
        ],
        axis=1,
    )
    across = np.cross(forward, down)
    left = across / np.linalg.norm(across, axis=1, keepdims=True)
    ahead = np.cross(down, left)
    along = (thigh**2 - shank**2 + reach**2) / (2 * reach)
    out = np.sqrt(np.maximum(thigh**2 - along**2, 0.0))
    knee = hip + along[:, None] * down + out[:, None] * ahead
    ankle = hip + reach[:, None] * down
    origins[side + "thigh"], origins[side + "shank"], origins[side + "foot"] = hip, knee, ankle
    for name, top, bottom in (("thigh", hip, knee), ("shank", knee, ankle)):
        up = (top - bottom) / np.linalg.norm(top - bottom, axis=1, keepdims=True)
        rotations[side + name] = np.stack([np.cross(left, up), left, up], axis=2)
    rotations[side + "foot"] = rotation("z", foot_yaw) @ rotation("y", -foot_pitch)


def _at_most(values: FloatArray, limit: float, softness: float) -> FloatArray:
    """Smooth minimum of each value and a limit."""
    return np.asarray(limit - softness * np.logaddexp(0.0, (limit - values) / softness))
