"""Small systems solved without checks."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from markermend.poses.quaternion import (
    by_left,
    by_right,
    inverse,
    multiply,
    rotation_vector,
)
from markermend.poses.solving import (
    Regression,
    add_to_diagonal,
    average_in,
    inverted,
    part_of,
    solved,
)


@pytest.mark.parametrize(("kind", "off"), [(np.float32, 1e-3), (np.float64, 1e-10)])
def test_systems_are_solved_as_precisely_as_they_are_given(kind: type, off: float) -> None:
    random = np.random.default_rng(1)
    half = random.normal(size=(30, 60))
    system, right = half @ half.T, random.normal(size=(30, 4))
    found = solved(system.astype(kind), right.astype(kind))
    assert found.dtype == kind
    assert_allclose(found, np.linalg.solve(system, right), atol=off)


def test_a_system_that_has_no_single_answer_is_told() -> None:
    with pytest.raises(np.linalg.LinAlgError):
        solved(np.ones((3, 3)) - np.eye(3), np.ones((3, 1)))


def test_rotation_vectors_are_those_of_half_a_turn_at_most() -> None:
    half = np.array([0.0, 0.3, 1.5, 1.7])
    turns = np.stack([np.sin(half), 0 * half, 0 * half, np.cos(half)], axis=1)
    told = rotation_vector(turns)
    assert_allclose(told[:, 0], [0.0, 0.6, 3.0, 3.4 - 2 * np.pi], atol=1e-12)
    assert (told[:, 1:] == 0).all()


@pytest.mark.parametrize(("kind", "off"), [(np.float32, 1e-6), (np.float64, 1e-14)])
def test_turning_back_is_as_precise_as_the_turn(kind: type, off: float) -> None:
    turns = Rotation.random(50, rng=np.random.default_rng(2)).as_quat().astype(kind)
    assert inverse(turns).dtype == kind
    assert_allclose(multiply(turns, inverse(turns)), [[0.0, 0.0, 0.0, 1.0]] * 50, atol=off)


def test_an_inverse_is_whole_and_leaves_what_it_is_of():
    random = np.random.default_rng(1).normal(size=(20, 30))
    matrix = random @ random.T
    before = matrix.copy()
    np.testing.assert_allclose(inverted(matrix) @ matrix, np.eye(20), atol=1e-9)
    np.testing.assert_array_equal(matrix, before)
    with pytest.raises(np.linalg.LinAlgError, match="positive definite"):
        inverted(-matrix)


@pytest.mark.parametrize("order", ["C", "F"])
def test_a_diagonal_grows_however_its_matrix_lies_in_memory(order: str) -> None:
    matrix = np.zeros((3, 3), order=order)
    add_to_diagonal(matrix, np.array([1.0, 2.0, 3.0]))
    add_to_diagonal(matrix, 0.5)
    np.testing.assert_array_equal(matrix, np.diag([1.5, 2.5, 3.5]))


def test_nothing_known_tells_nothing():
    assert solved(np.empty((0, 0)), np.empty((0, 4))).shape == (0, 4)


def test_matrices_multiply_as_quaternions_do():
    a, b = np.random.default_rng(1).normal(size=(2, 5, 4))
    assert_allclose((by_left(a) @ b[:, :, None])[:, :, 0], multiply(a, b), atol=1e-12)
    assert_allclose((by_right(b) @ a[:, :, None])[:, :, 0], multiply(a, b), atol=1e-12)
    assert_allclose(by_left(a[0]) @ b[0], multiply(a[0], b[0]), atol=1e-12)


@pytest.mark.parametrize("count", [0, 1, 4])
def test_a_mean_of_products_is_gone_on_with(count):
    random = np.random.default_rng(1)
    matrix, rows = np.eye(6), random.normal(size=(count, 6))
    average_in(matrix, rows, 0.25)
    assert_allclose(matrix, 0.75 * np.eye(6) + 0.25 * rows.T @ rows, atol=1e-12)


def test_columns_tell_of_others_by_their_covariance():
    random = np.random.default_rng(1).normal(size=(20, 30))
    covariance = random @ random.T
    told, telling = np.array([3, 7]), np.array([0, 4, 5, 9])
    away = np.array([1.0, -2.0, 0.5, 3.0])
    among = part_of(covariance, telling, telling) + 0.1 * np.eye(4)
    weights = np.linalg.solve(among, covariance[np.ix_(telling, told)])
    regression = Regression(covariance, told, telling, 0.1)
    assert_allclose(regression.tell(away), away @ weights, atol=1e-9)
    none = Regression(covariance, told, np.empty(0, dtype=int), 0.1)
    assert_allclose(none.tell(np.empty(0)), 0.0)
    with pytest.raises(np.linalg.LinAlgError, match="positive definite"):
        Regression(-covariance, told, telling, 0.1)
