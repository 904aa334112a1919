"""The joint detector: each coordinate by its own smoothness, each marker beside its neighbours."""

from markermend.detectors.joint.detect import detect_joint
from markermend.detectors.joint.params import JointParams

__all__ = ["JointParams", "detect_joint"]
