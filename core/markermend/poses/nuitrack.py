"""The 17 joints of Nuitrack, which speaks for Kinect, RealSense and other depth sensors."""

from __future__ import annotations

import re
from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from markermend.errors import DataError
from markermend.poses.pose import Pose

MIRROR = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0, 1.0])
"""Signs of x, y, z and of a rotation's x, y, z, w in a mirror of x."""
MIRROR.flags.writeable = False

_SIDES = ("left", "right")
_ARM, _LEG = ("shoulder", "elbow", "wrist"), ("hip", "knee", "ankle")
WAIST = "waist"


def _tree() -> dict[str, str]:
    """Parent of each joint, parents first."""
    tree = {WAIST: "", "torso": WAIST, "collar": "torso", "neck": "collar", "head": "neck"}
    for limb, start in ((_ARM, "collar"), (_LEG, WAIST)):
        for side in _SIDES:
            above = start
            for joint in limb:
                tree[f"{side}_{joint}"] = above
                above = f"{side}_{joint}"
    return tree


PARENT_OF = MappingProxyType(_tree())
JOINTS = tuple(PARENT_OF)
PARENTS = tuple(JOINTS.index(parent) if parent else -1 for parent in PARENT_OF.values())
LIMBS = tuple(
    tuple(JOINTS.index(f"{side}_{joint}") for joint in limb)
    for limb in (_ARM, _LEG)
    for side in _SIDES
)
"""Joints of each arm and leg."""


def aligned_axis(joint: str) -> tuple[int, int]:
    """Axis and sign that a joint's bone lies along (goncalves2024, 3.2.2).

    The right arm along x, the left arm along -x, waist to head along y, the legs along -y.
    """
    side, _, name = joint.rpartition("_")
    if name in _ARM:
        return (0, 1) if side == "right" else (0, -1)
    return (1, -1) if name in _LEG else (1, 1)


# Where each joint is (the end of a segment) and how it is turned (with the segment that follows).
_TRUNK = {
    WAIST: ("root", "root"),
    "torso": ("lowerback", "upperback"),
    "collar": ("thorax", "lowerneck"),
    "neck": ("lowerneck", "upperneck"),
    "head": ("upperneck", "head"),
}
_LIMB = {
    "shoulder": ("clavicle", "humerus"),
    "elbow": ("humerus", "radius"),
    "wrist": ("wrist", "hand"),
    "hip": ("hipjoint", "femur"),
    "knee": ("femur", "tibia"),
    "ankle": ("tibia", "foot"),
}
CMU_SEGMENTS = MappingProxyType(
    _TRUNK
    | {
        f"{side}_{joint}": (side[0] + at, side[0] + turned)
        for side in _SIDES
        for joint, (at, turned) in _LIMB.items()
    }
)
"""Segments of the CMU skeleton that say where each joint is, and how it is turned."""

# A side as a name in one word begins, of the left and of the right.
_GLUED = (("left", "right"), ("l", "r"))
_OTHER_NAMES = {
    "hips": WAIST,
    "pelvis": WAIST,
    "root": WAIST,
    "spinebase": WAIST,
    "spine": "torso",
    "spinemid": "torso",
    "spinenaval": "torso",
    "spinenavel": "torso",
    "chest": "collar",
    "spinechest": "collar",
    "spineshoulder": "collar",
    "hipcenter": WAIST,
    "midhip": WAIST,
    "shouldercenter": "collar",
}
# What sensors tell besides, and what it hangs on.
_FURTHER = MappingProxyType(
    {
        "clavicle": "collar",
        "hand": "wrist",
        "handtip": "hand",
        "fingertip": "hand",
        "thumb": "hand",
        "foot": "ankle",
        "nose": "head",
        "eye": "head",
        "ear": "head",
    }
)


def side_of(name: str) -> tuple[str, str]:
    """Side of the body that a word of a joint's name tells, and the name without it.

    Parameters
    ----------
    name : ``JOINT_LEFT_SHOULDER``, ``ShoulderLeft``, ``mixamorig:LeftArm``, ``thigh.L``, ``rHand``

    Returns
    -------
    side : ``"left"``, ``"right"``, or nothing where no word is a side
    rest : in small letters, without what stands between words, and without the word “joint”
    """
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", name)
    parts = [w.lower() for w in words if w.lower() != "joint"]
    for word, meant in (("left", "left"), ("right", "right"), ("l", "left"), ("r", "right")):
        if word in parts:
            parts.remove(word)
            return meant, "".join(parts)
    return "", "".join(parts)


def usual_name(name: str) -> str:
    """Nuitrack's name of a joint as other systems write it; the name itself where it is unknown.

    ``JOINT_LEFT_SHOULDER``, ``ShoulderLeft``, ``LeftShoulder`` and ``l_shoulder`` are
    ``left_shoulder``.
    """
    side, plain = side_of(name)
    plain = _OTHER_NAMES.get(plain, plain)
    found = f"{side}_{plain}" if side else plain
    return found if found in PARENT_OF else name


def usual_parents(joints: Sequence[str]) -> dict[str, str]:
    """Parent of each joint whose name is usual: the next one that is there, nothing for a root.

    Parameters
    ----------
    joints : names as any system writes them, hands, feet and faces among them
    """
    parts = {joint: _part(joint) for joint in joints}
    named = {part: joint for joint, part in parts.items()}
    found = {}
    for joint, part in parts.items():
        above = _above(part)
        while above and above not in named:
            above = _above(above)
        if above is not None:
            found[joint] = named.get(above, "")
    return found


def _part(name: str) -> str:
    """A part of the body, with its side in front."""
    side, plain = side_of(name)
    plain = _OTHER_NAMES.get(plain, plain)
    if side and plain == "collar":
        plain = "clavicle"
    return f"{side}_{plain}" if side else plain


def _above(part: str) -> str | None:
    """What a part hangs on, nothing for the waist; None of what is no part."""
    side, _, plain = part.rpartition("_")
    if side and plain == "shoulder":
        return f"{side}_clavicle"
    if plain not in _FURTHER:
        return PARENT_OF.get(part)
    above = _FURTHER[plain]
    return f"{side}_{above}" if side and above not in PARENT_OF else above


def twins(joints: Sequence[str]) -> list[int]:
    """Index of each joint's counterpart on the other side of the body, its own where it has none.

    Parameters
    ----------
    joints : names as any system writes them, both sides alike: with a word for the side
        (:func:`side_of`), or in one word with it, as ``lfemur`` and ``rfemur`` are
    """
    told = [side_of(name) for name in joints]
    at = {name: n for n, name in enumerate(told)}
    other = list(range(len(joints)))
    for n, (side, rest) in enumerate(told):
        if side == "left":
            opposite = [("right", rest)]
        elif side:
            continue
        else:
            opposite = [
                ("", there + rest.removeprefix(here))
                for here, there in _GLUED
                if rest.startswith(here)
            ]
        for m in (at[name] for name in opposite if name in at):
            if other[m] == m:
                other[n], other[m] = m, n
                break
    return other


def to_nuitrack(pose: Pose) -> Pose:
    """Reduce a recording to the 17 joints.

    Parameters
    ----------
    pose : of the CMU skeleton (31 segments), or with Nuitrack's joints under any usual name

    Returns
    -------
    Pose
        with :data:`JOINTS`, in the same axes (goncalves2024, 3.2.1)

    Raises
    ------
    DataError
        when a joint is missing
    """
    columns = {name: i for i, name in enumerate(pose.joints)}
    if all(name in columns for pair in CMU_SEGMENTS.values() for name in pair):
        at = [columns[CMU_SEGMENTS[joint][0]] for joint in JOINTS]
        turned = [columns[CMU_SEGMENTS[joint][1]] for joint in JOINTS]
    else:
        columns = {usual_name(name): i for i, name in enumerate(pose.joints)}
        missing = [joint for joint in JOINTS if joint not in columns]
        if missing:
            raise DataError(f"The recording has no joint called “{missing[0]}”.")
        at = turned = [columns[joint] for joint in JOINTS]
    confidence = np.minimum(pose.confidence[:, at], pose.confidence[:, turned])
    return Pose(
        pose.positions[:, at],
        pose.rotations[:, turned],
        JOINTS,
        PARENTS,
        pose.rate,
        confidence,
        warnings=pose.warnings,
        first_frame=pose.first_frame,
        first_time=pose.first_time,
    )


def mirrored(pose: Pose) -> Pose:
    """Turn right-handed axes into the left-handed ones of Kinect and Unity, or back.

    Positions become (-x, y, z), rotations (x, -y, -z, w): the inversion of y and z that
    goncalves2024 (3.2.1) describes is a mirror of x.
    """
    return pose.with_samples(
        pose.positions * MIRROR[:3],
        pose.rotations * MIRROR[3:],
        pose.confidence,
    )
