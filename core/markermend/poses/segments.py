"""From 17 joints back to the 31 segments of the CMU skeleton: the future work of goncalves2024."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import FloatArray
from markermend.errors import DataError, FileFormatError
from markermend.files.npz import read_arrays, write_arrays
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.normal import Normal, normalise
from markermend.poses.nuitrack import CMU_SEGMENTS, JOINTS, PARENTS, mirrored, to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import right_handed
from markermend.poses.quaternion import inverse, multiply, turn
from markermend.poses.turnless import turnless
from markermend.progress import Progress, quiet

_RIDGE = 0.01
_STRIDE = 4
_ARRAYS = ("bend", "place", "turned", "weights")
_SHIPPED = ("models", "pose_segments.npz")


def _tree() -> dict[str, str]:
    """Parent of each segment, parents first."""
    tree = {"root": ""}
    chains = ["root lowerback upperback thorax lowerneck upperneck head"]
    for side in "lr":
        chains += [
            f"root {side}hipjoint {side}femur {side}tibia {side}foot {side}toes",
            f"thorax {side}clavicle {side}humerus {side}radius {side}wrist {side}hand",
            f"{side}hand {side}fingers",
            f"{side}wrist {side}thumb",
        ]
    for chain in chains:
        names = chain.split()
        tree |= dict(zip(names[1:], names, strict=False))
    return tree


PARENT_OF = MappingProxyType(_tree())
NAMES = tuple(PARENT_OF)


def _carriers() -> dict[str, str]:
    """The joint in whose axes each segment that 17 joints do not tell of moves least."""
    carriers = {"lowerback": "waist", "upperback": "torso", "thorax": "torso", "head": "head"}
    limbs = {
        "hipjoint": "waist",
        "clavicle": "collar",
        "radius": "{}_elbow",
        "wrist": "{}_elbow",
        "hand": "{}_wrist",
        "fingers": "{}_wrist",
        "thumb": "{}_wrist",
        "foot": "{}_ankle",
        "toes": "{}_ankle",
    }
    for side in ("left", "right"):
        carriers |= {side[0] + name: joint.format(side) for name, joint in limbs.items()}
    return carriers


CARRIERS = MappingProxyType(_carriers())
"""Segments whose end or rotation is added, and what they are added to."""

_AT = {at: joint for joint, (at, _) in CMU_SEGMENTS.items()}
_TURNED = {turned: joint for joint, (_, turned) in CMU_SEGMENTS.items()}


@dataclass(frozen=True, eq=False)
class Segments:
    """Where added segments are, given how a body bends.

    Attributes
    ----------
    bend : (48,) mean rotation vectors of the joints but the waist against their parents
    place : (added, 3) mean end in the axes of its carrier, in mean bone lengths
    turned : (added, 4) mean rotation in them
    weights : (48, added, 6) what a bend adds to places and, as rotation vectors, rotations
    """

    bend: FloatArray
    place: FloatArray
    turned: FloatArray
    weights: FloatArray


def learn_segments(
    poses: Sequence[Pose], *, names: Sequence[str] = (), progress: Progress | None = None
) -> Segments:
    """Learn from recordings of the CMU skeleton, by ridge regression.

    Parameters
    ----------
    poses : clean, of all 31 segments; those in which one was not seen or has no rotation are
        passed over
    names : of the recordings, for what is wrong with one
    progress : told the share of recordings read

    Raises
    ------
    DataError
        when there is none, or one has other segments, or never all of them
    """
    if not poses:
        raise DataError("Segments need at least one recording to learn from.")
    bends, places, turns = [], [], []
    for n, pose in enumerate(poses):
        (progress or quiet)(n / len(poses), f"Learning from recording {n + 1}")
        if set(NAMES) - set(pose.joints):
            raise DataError("Segments are learnt from recordings of the CMU skeleton only.")
        features, normal = normalise(to_nuitrack(pose))
        place, turned = _added(pose, features, normal)
        bend = _bend(features)
        parts = (bend, place, turned)
        told = [np.isfinite(part.reshape(pose.frames, -1)).all(axis=1) for part in parts]
        whole = np.flatnonzero(np.all(told, axis=0))[::_STRIDE]
        if not len(whole):
            raise DataError(
                f"{names[n] if names else f'Recording {n + 1}'} has no pose in which every segment"
                " was seen and has a rotation; leave this recording out."
            )
        bends.append(bend[whole])
        places.append(place[whole])
        turns.append(turned[whole])
    x, ends, rotations = (np.concatenate(part) for part in (bends, places, turns))
    place = ends.mean(axis=0)
    turned = np.stack([Rotation.from_quat(q).mean().as_quat() for q in rotations.swapaxes(0, 1)])
    away = Rotation.from_quat(multiply(inverse(turned), rotations).reshape(-1, 4)).as_rotvec()
    wanted = np.concatenate([ends - place, away.reshape(ends.shape)], axis=2).reshape(len(x), -1)
    bend = x.mean(axis=0)
    x = x - bend
    weights = np.linalg.solve(x.T @ x + _RIDGE * len(x) * np.eye(x.shape[1]), x.T @ wanted)
    return Segments(bend, place, turned, weights.reshape(len(bend), len(CARRIERS), 6))


def to_cmu(pose: Pose, learnt: Segments | None = None) -> Pose:
    """Add what the CMU skeleton has more than 17 joints.

    Parameters
    ----------
    pose : of the 17 joints, right- or left-handed; clean it first, since nothing is added in
        frames in which a joint was not seen
    learnt : of other bodies; our own when not given

    Returns
    -------
    Pose
        of 31 segments; what the joints tell of them is exactly this
        (:func:`~markermend.poses.nuitrack.to_nuitrack` gives it back). Where the end of a segment
        was added, confidence is at most :data:`markermend.poses.restore.INFERRED`.

    Raises
    ------
    DataError
        when joints are missing, or stand elsewhere than bodies have them, or one within a limb
        never has a rotation
    """
    learnt = learnt or shipped_segments()
    body, left_handed = right_handed(pose)
    features, normal = normalise(body)
    body = _with_ends_turned(body, features, normal, learnt)
    bent = np.einsum("fb,bsc->fsc", _bend(features) - learnt.bend, learnt.weights)
    carriers = [JOINTS.index(joint) for joint in CARRIERS.values()]
    by = features[:, carriers, 3:]
    lies = features[:, carriers, :3] + turn(by, learnt.place + bent[..., :3])
    away = Rotation.from_rotvec(bent[..., 3:].reshape(-1, 3)).as_quat().reshape(by.shape)
    forth = normal.rotation[:, None]
    lies = turn(forth, lies * normal.scale) + normal.position[:, None]
    turned = multiply(forth, multiply(by, multiply(learnt.turned, away)))
    positions = np.empty((body.frames, len(NAMES), 3))
    rotations = np.empty((body.frames, len(NAMES), 4))
    confidence = np.empty(positions.shape[:2])
    added = list(CARRIERS)
    sure = np.minimum(body.confidence.min(axis=1), INFERRED)
    for i, name in enumerate(NAMES):
        at, by_joint = _AT.get(name), _TURNED.get(name)
        if at is None:
            positions[:, i], confidence[:, i] = lies[:, added.index(name)], sure
        else:
            joint = JOINTS.index(at)
            positions[:, i], confidence[:, i] = body.positions[:, joint], body.confidence[:, joint]
        if by_joint is None:
            rotations[:, i] = turned[:, added.index(name)]
        else:
            rotations[:, i] = body.rotations[:, JOINTS.index(by_joint)]
    parents = tuple(NAMES.index(name) if name else -1 for name in PARENT_OF.values())
    whole = Pose(
        positions,
        rotations,
        NAMES,
        parents,
        body.rate,
        confidence,
        first_frame=body.first_frame,
        first_time=body.first_time,
    )
    return mirrored(whole) if left_handed else whole


def _with_ends_turned(body: Pose, features: FloatArray, normal: Normal, learnt: Segments) -> Pose:
    """The body with ends of limbs that have no rotation turned as other bodies', features too."""
    without, rotations = turnless(body), np.array(body.rotations)
    for joint in np.flatnonzero(without).tolist():
        if joint in PARENTS:
            raise DataError(
                "The segments of the CMU skeleton follow how joints are turned, which this"
                f" recording never tells of {JOINTS[joint]}; leave its joints as they are."
            )
        against = Rotation.from_rotvec(learnt.bend.reshape(-1, 3)[joint - 1]).as_quat()
        features[:, joint, 3:] = multiply(features[:, PARENTS[joint], 3:], against)
        turned = multiply(normal.rotation, features[:, joint, 3:])
        rotations[:, joint] = multiply(turned, inverse(normal.offset[joint]))
    return body.with_samples(body.positions, rotations, body.confidence)


def _bend(features: FloatArray) -> FloatArray:
    """(frames, 48) rotation vectors of all joints but the waist against their parents."""
    pairs = [(joint, parent) for joint, parent in enumerate(PARENTS) if parent >= 0]
    against = [multiply(inverse(features[:, p, 3:]), features[:, j, 3:]) for j, p in pairs]
    flat = np.stack(against, axis=1).reshape(-1, 4)
    known = ~np.isnan(flat[:, 0])
    bend = np.full((len(flat), 3), np.nan)
    bend[known] = Rotation.from_quat(flat[known]).as_rotvec()
    return bend.reshape(len(features), -1)


def _added(pose: Pose, features: FloatArray, normal: Normal) -> tuple[FloatArray, FloatArray]:
    """(frames, added, 3) and (frames, added, 4): added segments in their carriers' axes."""
    columns = [pose.index(name) for name in CARRIERS]
    carriers = [JOINTS.index(joint) for joint in CARRIERS.values()]
    back = inverse(normal.rotation)[:, None]
    own = inverse(features[:, carriers, 3:])
    place = turn(back, pose.positions[:, columns] - normal.position[:, None]) / normal.scale
    rotation = multiply(back, pose.rotations[:, columns])
    return turn(own, place - features[:, carriers, :3]), multiply(own, rotation)


def save_segments(learnt: Segments, path: Path) -> None:
    """Write what was learnt, in single precision."""
    write_arrays(path, {name: getattr(learnt, name).astype(np.float32) for name in _ARRAYS})


def load_segments(path: Path) -> Segments:
    """Read what :func:`save_segments` wrote.

    Raises
    ------
    FileFormatError
        when the file holds no segments
    """
    try:
        stored = read_arrays(path)
        arrays = [stored[name].astype(float) for name in _ARRAYS]
        if arrays[3].shape != (3 * (len(JOINTS) - 1), len(CARRIERS), 6):
            raise ValueError("its sizes do not fit")
    except (ValueError, KeyError) as error:
        raise FileFormatError(
            f"{path.name} holds no segments; “markermend train segments” writes them."
        ) from error
    return Segments(*arrays)


@lru_cache(maxsize=1)
def shipped_segments() -> Segments:
    """Ours, of subjects 01 to 03 of the CMU database."""
    return load_segments(Path(str(files("markermend_resources").joinpath(*_SHIPPED))))
