"""Few rotations and many, which are reckoned in different ways, turn alike."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from markermend.poses.quaternion import between, cross, lengths_of, multiply, turn

COUNTS = [1, 17, 400]


@pytest.mark.parametrize("count", COUNTS)
def test_rotations_one_after_the_other(count):
    first, then = (Rotation.random(count, random_state=seed) for seed in (1, 2))
    q = multiply(then.as_quat(), first.as_quat())
    assert_allclose(Rotation.from_quat(q).as_matrix(), (then * first).as_matrix(), atol=1e-12)
    # One of them after all.
    q = multiply(then[0].as_quat(), first.as_quat())
    assert_allclose(Rotation.from_quat(q).as_matrix(), (then[0] * first).as_matrix(), atol=1e-12)
    q = multiply(then.as_quat(), first[0].as_quat())
    assert_allclose(Rotation.from_quat(q).as_matrix(), (then * first[0]).as_matrix(), atol=1e-12)


@pytest.mark.parametrize("count", COUNTS)
def test_what_is_not_known_stays_with_its_own(count):
    q = Rotation.random(count + 1, random_state=1).as_quat()
    q[0] = np.nan
    product = multiply(q, q)
    assert np.isnan(product[0]).all()
    assert np.isfinite(product[1:]).all()


@pytest.mark.parametrize("count", COUNTS)
def test_vectors_across_and_turned(count):
    a, b = np.random.default_rng(1).normal(size=(2, count, 3))
    assert_allclose(cross(a, b), np.cross(a, b), atol=1e-12)
    assert_allclose(cross(a[0], b), np.cross(a[0], b), atol=1e-12)
    turned = Rotation.random(count, random_state=1)
    assert_allclose(turn(turned.as_quat(), a), turned.apply(a), atol=1e-12)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
def test_the_shortest_way_from_one_direction_to_another(count, size):
    a, b = np.random.default_rng(1).normal(size=(2, count, 3)) * size
    way = between(a, 3.0 * b)
    assert_allclose(lengths_of(way), 1.0)
    far = lengths_of(b) / lengths_of(a)
    assert_allclose(turn(way, a) * far[:, None], b, atol=1e-9 * size)
    assert_allclose(np.sum(way[:, :3] * a, axis=1), 0.0, atol=1e-9 * size)


def test_opposite_directions_have_no_shortest_way_but_end_nothing():
    way = between(np.array([[500.0, 0.0, 0.0]]), np.array([[-20.0, 0.0, 0.0]]))
    assert np.isfinite(way).all()
