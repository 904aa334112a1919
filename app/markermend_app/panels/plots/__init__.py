"""Trajectories as rows of plots."""
