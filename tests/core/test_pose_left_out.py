"""Where a sensor leaves a joint out, what hangs on the next one is no bone."""

from __future__ import annotations

import numpy as np
from recordings import seventeen_joints

from markermend.poses.faults.finding import mend_faults
from markermend.poses.pose import Pose


def without_right_elbow(pose):
    """Every fourth pose, the wrist on the shoulder."""
    kept = [j for j, joint in enumerate(pose.joints) if joint != "right_elbow"]
    parents = []
    for joint in kept:
        parent = pose.parents[joint]
        parent = parent if parent in kept or parent < 0 else pose.parents[parent]
        parents.append(kept.index(parent) if parent >= 0 else -1)
    samples = pose.positions[::4, kept], pose.rotations[::4, kept]
    return Pose(*samples, tuple(pose.joints[j] for j in kept), tuple(parents), pose.rate / 4)


def test_a_clean_recording_without_elbow_has_no_faults_and_a_jump_is_found(shared_data):
    clean = without_right_elbow(seventeen_joints(shared_data, "02_05")["02_05"])
    assert not mend_faults(clean)[1]
    wrist = clean.index("right_wrist")
    positions = np.array(clean.positions)
    positions[150:156, wrist] += [500.0, 300.0, 300.0]
    broken = clean.with_samples(positions, clean.rotations, clean.confidence)
    faults = mend_faults(broken)[1]
    assert {fault.joint for fault in faults} == {wrist}
    assert min(f.start for f in faults) == 150
    assert max(f.stop for f in faults) == 156
