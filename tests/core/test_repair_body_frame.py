"""Frames that move with some markers, and the rotations that hold them."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.repairs import propose
from markermend.repairs.body_frame import (
    align,
    align_each,
    alike,
    rank_references,
    to_frame,
    to_frames,
    to_lab,
)
from markermend.take import Take


def test_a_frame_held_by_some_markers_does_not_move_with_others():
    rng = np.random.default_rng(3)
    points = np.repeat(rng.normal(0.0, 100.0, (1, 6, 3)), 40, axis=0)
    points[:, 3] += rng.normal(0.0, 20.0, (40, 3))
    rotation, centre = align(points, alike(np.zeros(6), (0, 2, 4)))
    seen = to_frame(points, rotation, centre)
    assert np.ptp(seen[:, [0, 1, 2, 4, 5]], axis=0).max() < 1e-6
    assert np.ptp(seen[:, 3], axis=0).min() > 20.0
    assert np.allclose(to_lab(seen[:, 5], rotation, centre), points[:, 5])


def test_frames_of_several_weights_are_those_of_each_alone():
    rng = np.random.default_rng(4)
    points = rng.normal(0.0, 100.0, (1, 5, 3)) + rng.normal(0.0, 3.0, (250, 5, 3)) + 900.0
    weights = np.array([[1.0, 0.5, 0.2, 0.1, 0.0], [0.0, 1.0, 1.0, 0.0, 1.0]])
    along = points.transpose(1, 2, 0)
    rotations, centres = align_each(along, weights)
    seen = to_frames(along, rotations, centres)
    for weight, rotation, centre, one in zip(weights, rotations, centres, seen, strict=True):
        turn, origin = align(points, weight)
        assert np.allclose(rotation.transpose(2, 0, 1), turn, atol=1e-12)
        assert np.allclose(centre.T, origin, atol=1e-9)
        assert np.allclose(one.transpose(2, 0, 1), to_frame(points, turn, origin), atol=1e-9)
        assert np.allclose(weight @ to_frame(points, turn, origin), 0.0, atol=1e-9)


@pytest.mark.parametrize("others", ["*{}", "Other:M{}"])
def test_a_trajectory_without_named_company_has_no_references_and_is_repaired_all_the_same(others):
    positions = np.cumsum(np.random.default_rng(0).normal(0.0, 1.0, (300, 5, 3)), axis=0)
    positions[100:120, 0] = np.nan
    take = Take(positions, ("*1", *(others.format(i) for i in range(2, 6))), 100.0)
    columns, spread = rank_references(take, take.present, 0, slice(100, 120))
    assert len(columns) == len(spread) == 0
    assert propose(take, Artifact("*1", "xyz", 100, 120, Kind.GAP)).patches
