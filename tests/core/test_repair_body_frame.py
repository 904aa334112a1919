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
    nearest_rotations,
    rank_references,
    to_frame,
    to_frames,
    to_lab,
)
from markermend.take import Take


def by_singular_values(matrices):
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return u @ vt


def clouds(points, seed, noise_mm=1.0):
    """Covariances of a cloud with its own pose, turned at random and trembling."""
    rng = np.random.default_rng(seed)
    turns = by_singular_values(rng.normal(size=(50, 3, 3)))
    moved = points @ turns.transpose(0, 2, 1) + rng.normal(0.0, noise_mm, (50, *points.shape))
    return (moved - moved.mean(axis=1, keepdims=True)).transpose(0, 2, 1) @ points


@pytest.mark.parametrize("count", [3, 4, 12])
def test_nearest_rotations_are_those_of_singular_values(count):
    points = np.random.default_rng(count).normal(0.0, 50.0, (count, 3))
    matrices = clouds(points - points.mean(axis=0), seed=count)
    assert np.allclose(nearest_rotations(matrices), by_singular_values(matrices), atol=1e-8)


def test_nearest_rotations_never_reflect():
    points = np.random.default_rng(1).normal(0.0, 50.0, (6, 3))
    matrices = clouds((points - points.mean(axis=0)) * [1.0, 1.0, 0.02], seed=2, noise_mm=5.0)
    mirrored = -matrices
    assert (np.linalg.det(matrices) < 0).any()
    assert (np.linalg.det(mirrored) < 0).any()
    for some in (matrices, mirrored):
        found = nearest_rotations(some)
        assert np.allclose(np.linalg.det(found), 1.0)
        assert np.allclose(found, by_singular_values(some), atol=1e-6)


def test_points_on_a_line_have_a_rotation_all_the_same():
    line = np.outer([-1.0, 0.0, 1.0], [30.0, 10.0, 0.0])
    found = nearest_rotations(np.stack([line.T @ line, np.zeros((3, 3)), 100.0 * np.eye(3)]))
    assert np.allclose(found @ found.transpose(0, 2, 1), np.eye(3))
    assert np.allclose(found[2], np.eye(3))


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
