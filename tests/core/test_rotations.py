"""Rotations nearest to matrices, held against singular values."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.rotations import nearest_rotations


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
