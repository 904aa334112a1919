"""Poses made clean as they come: what each part of :mod:`markermend.poses.live` learns and does."""
