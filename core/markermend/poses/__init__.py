"""Skeleton recordings: what they are, and how they are made clean."""

from markermend.poses.pose import Pose
from markermend.poses.skeleton import Movement, Segment, Skeleton, forward_kinematics

__all__ = ["Movement", "Pose", "Segment", "Skeleton", "forward_kinematics"]
