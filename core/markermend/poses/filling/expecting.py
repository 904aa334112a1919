"""How far off restored joints are expected to be."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.body.rooting import rooted
from markermend.poses.channels import trusted_turns
from markermend.poses.faults.finding import CARRIED, Fault
from markermend.poses.filling.bridging import bridging_error
from markermend.poses.filling.gaps import Gap
from markermend.poses.filling.likeness import reach_of
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of

# What is left of white noise after smoothing, about, at 120 Hz; and the more the fewer frames there
# are to tell it from movement, by this power of how many times as few.
_LEFT, _AT_HZ, _FEWER = 0.35, 120.0, 0.2


def left_of_noise(rate: float) -> float:
    """Share of white noise that smoothing leaves, about, at a rate in frames per second."""
    return float(min(_LEFT * (_AT_HZ / rate) ** _FEWER, 1.0))


def limbs_doubted(shape: tuple[int, int], gaps: Iterable[Gap], at_least: float) -> FloatArray:
    """How many times the variances of what was filled are as large as they were said to be.

    Parameters
    ----------
    shape : frames, channels
    gaps : all that were filled
    at_least : frames that a gap has which is told by alike moments

    Returns
    -------
    (frames, channels) 1 or more: where a limb is gone poses further away are asked, which are taken
        to tell more than they do
    """
    more = np.ones(shape)
    for gap in gaps:
        if gap.length >= at_least:
            more[gap.part] = reach_of(len(gap.channels))
    return more


def with_root_errors(
    error_mm: FloatArray,
    filled: BoolArray,
    restored: Pose,
    faults: Sequence[Fault],
    pose: Pose,
) -> FloatArray:
    """Expect errors of a root that was not seen, and of a body carried back to where it belongs.

    Parameters
    ----------
    error_mm : (frames, joints) expected otherwise
    filled : (frames, joints) bool
    restored : what came out
    faults : that were mended
    pose : the recording without them
    """
    root = pose.order[0]
    unseen = filled[:, root]
    carried = np.zeros(filled.shape, dtype=bool)
    for fault in faults:
        if fault.kind == CARRIED:
            carried[fault.start : fault.stop, fault.joint] = True
    error = error_mm.copy()
    if unseen.any():
        # What was filled beside it was worked out from it.
        off = np.where(unseen, rooted(pose, trusted_turns(pose)).error_mm, 0.0)
        error = np.where(filled, np.hypot(error, np.nan_to_num(off)[:, None]), error)
        error[unseen, root] = off[unseen]
    if carried.any():
        off = bridging_error(restored.positions[:, root], ~(unseen | carried.any(axis=1)))
        error = np.where(carried, np.hypot(error, off[:, None]), error)
    return error


def with_disagreement(error_mm: FloatArray, one: Pose, other: Pose) -> FloatArray:
    """Expect more where joints were worked out in two ways that disagree.

    Parameters
    ----------
    error_mm : (frames, joints) expected otherwise; NaN stays
    one, other : the same recording, in both ways. Errors of two that are as good as each other, and
        independent, are apart by the root of two times either.
    """
    apart = np.nan_to_num(lengths_of(one.positions - other.positions))
    return np.asarray(np.hypot(error_mm, apart / np.sqrt(2.0)))
