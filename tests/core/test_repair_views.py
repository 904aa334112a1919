"""Views of a marker from several frames, and from which known frames each learns."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.repairs.kriging import LEAST_HALVED, Part, View, _inverse_of_triangle, condition
from markermend.repairs.local_regression import HOLDERS, MANY, _parts

WANTED = 10


def body(known, references):
    rng = np.random.default_rng(references)
    cloud = rng.normal(0.0, 100.0, (1, references, 3)) + rng.normal(
        0.0, 5.0, (known + WANTED, references, 3)
    )
    beside = np.zeros(known, dtype=bool)
    beside[:20] = True
    own = cloud[:known, 0] + 20.0
    spread = np.linspace(1.0, 9.0, references)
    return _parts(cloud, np.zeros_like(cloud), own, spread, 2, False, beside), beside


@pytest.mark.parametrize(("references", "views"), [(4, 4), (18, 1 + len(HOLDERS))])
def test_views_learn_from_all_beside_and_from_half_of_the_rest(references, views):
    parts, beside = body(20 + MANY, references)
    assert sum(len(part.views) for part in parts) == views
    first, second = (set(part.learnt) for part in parts)
    assert first & second == set(np.flatnonzero(beside))
    assert first | second == set(range(20 + MANY))
    assert abs(len(first) - len(second)) <= 1


@pytest.mark.parametrize(("known", "references"), [(20 + MANY, 3), (19 + MANY, 18)])
def test_views_learn_from_all_where_these_or_the_views_are_few(known, references):
    (part,), _ = body(known, references)
    assert np.array_equal(part.learnt, np.arange(known))


def view(truth, rows, known, wrong_by):
    """Looks at a marker from the laboratory itself, and is off by some mm."""
    still = len(rows) + WANTED
    turned, origin = np.tile(np.eye(3), (still, 1, 1)), np.zeros((still, 3))
    pose = np.concatenate([truth[rows], truth[known:]])[:, :1] / 100.0
    return View(pose, pose, truth[rows] + wrong_by, turned, origin)


def test_views_that_do_not_learn_from_a_frame_have_no_say_in_what_is_missed_there():
    known = 60
    frames = np.concatenate([np.arange(0, 30), np.arange(40, 70), np.arange(30, 40)])
    truth = np.stack([10.0 * np.sin(frames / 15.0), frames * 0.1, np.zeros(70)], axis=1)
    rows = np.arange(known)
    whole = [Part(rows, (view(truth, rows, known, 0.0),))]
    near = np.ones(known, dtype=bool)
    alone = condition(frames, 100.0, whole, 0.1, 5, near)
    halves = [Part(rows[k::2], (view(truth, rows[k::2], known, 0.0),)) for k in range(2)]
    both = condition(frames, 100.0, halves, 0.1, 5, near)
    for mean, deviation, _ in (alone, both):
        assert np.abs(mean - truth[known:]).max() < 1.0
        assert np.isfinite(deviation).all()
        assert (deviation > 0).all()


@pytest.mark.parametrize("size", [1, LEAST_HALVED, LEAST_HALVED + 1, 5 * LEAST_HALVED + 3])
def test_triangles_are_inverted_by_halves(size):
    rng = np.random.default_rng(size)
    triangle = np.tril(rng.normal(0.0, 0.1, (size, size))) + 3.0 * np.eye(size)
    inverse = _inverse_of_triangle(np.asfortranarray(triangle))
    assert np.allclose(inverse @ triangle, np.eye(size), atol=1e-10)
    assert not np.triu(inverse, 1).any()
