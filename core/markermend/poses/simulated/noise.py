"""The noise of cheap sensors: joints occluded and displaced (goncalves2024, 3.2.4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.normal import denormalise, normalise
from markermend.poses.nuitrack import LIMBS
from markermend.poses.pose import Pose

_UNSEEN = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Noise:
    """How recordings are damaged.

    The paper gives no level; these values reproduce the error of its corrupted poses (Table 2).

    Attributes
    ----------
    occlusion : share of the time that each joint, or limb, is occluded
    displacement : standard deviation added to each normalised feature
    burst : frames that an occlusion lasts; 1 for the paper's, independent from frame to frame
    limbs : whole arms and legs are occluded, not single joints
    """

    occlusion: float = 0.112
    displacement: float = 0.0159
    burst: int = 1
    limbs: bool = False


NOISES = {
    "both": Noise(),
    "occlusions": Noise(displacement=0.0),
    "displacements": Noise(occlusion=0.0),
}
"""The paper's three trainings, which are also its three tests."""


def occlude(frames: int, joints: int, noise: Noise, random: np.random.Generator) -> BoolArray:
    """Draw which joints are occluded when; the root never is.

    Returns
    -------
    (frames, joints) bool
    """
    groups: tuple[tuple[int, ...], ...] = (
        LIMBS if noise.limbs else tuple((joint,) for joint in range(1, joints))
    )
    begins = 1.0 - (1.0 - noise.occlusion) ** (1.0 / noise.burst)
    drawn = random.random((frames + noise.burst - 1, len(groups))) < begins
    under = np.cumsum(np.vstack([np.zeros((1, len(groups)), dtype=int), drawn]), axis=0)
    hidden = under[noise.burst :] > under[: -noise.burst]
    occluded = np.zeros((frames, joints), dtype=bool)
    for column, group in enumerate(groups):
        occluded[:, group] |= hidden[:, [column]]
    return occluded


def corrupt(
    features: FloatArray, parents: tuple[int, ...], noise: Noise, *, seed: int
) -> tuple[FloatArray, BoolArray]:
    """Damage normalised poses.

    Parameters
    ----------
    features : (frames, joints, 7), the root first
    parents : index of each joint's parent, -1 for the root
    noise : how
    seed : same seed, same damage

    Returns
    -------
    features : (frames, joints, 7); an occluded joint is at 0, 0, 0 with rotation 0, 0, 0, 1, and
        the rotation of its parent is 0, 0, 0, 1 too
    occluded : (frames, joints) bool
    """
    random = np.random.default_rng(seed)
    frames, joints = features.shape[:2]
    occluded = occlude(frames, joints, noise, random)
    damaged = features.copy()
    damaged[:, 1:] += random.normal(
        0.0, noise.displacement, (frames, joints - 1, features.shape[2])
    )
    damaged[occluded] = _UNSEEN
    for joint, parent in enumerate(parents):
        if parent > 0:
            damaged[occluded[:, joint], parent, 3:] = _UNSEEN[3:]
    return damaged, occluded


def corrupt_pose(pose: Pose, noise: Noise, *, seed: int) -> Pose:
    """Damage a recording of Nuitrack's joints as :func:`corrupt` does.

    Returns
    -------
    Pose
        with confidence 0 where a joint is occluded
    """
    features, normal = normalise(pose)
    damaged, occluded = corrupt(features, pose.parents, noise, seed=seed)
    positions, rotations = denormalise(damaged, normal)
    return pose.with_samples(positions, rotations, np.where(occluded, 0.0, pose.confidence))
