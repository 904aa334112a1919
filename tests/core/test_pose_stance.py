"""The root's own height and lean tell of limbs."""

import numpy as np
import pytest

from markermend.poses.filling.covariance import learn
from markermend.poses.filling.filling import fill
from markermend.poses.filling.stance import stance
from markermend.poses.normal import Normal
from markermend.poses.quaternion import turn

RATE, HIDDEN = 60.0, slice(400, 460)


def normal(position: np.ndarray, rotation: np.ndarray) -> Normal:
    return Normal(0, position, rotation, 250.0, np.tile([0.0, 0.0, 0.0, 1.0], (2, 1)))


@pytest.mark.parametrize("lying", [False, True])
def test_up_is_where_the_spine_points_whichever_axis_of_the_world_that_is(lying: bool) -> None:
    angle = 0.3 * np.sin(np.arange(200) / 20.0) + (np.pi / 2 if lying else 0.0)
    zero = np.zeros(200)
    # About x: the spine, along the root's y, leans from the world's y towards its z.
    rotation = np.stack([np.sin(angle / 2), zero, zero, np.cos(angle / 2)], axis=1)
    position = np.stack([zero, np.arange(200.0), -np.arange(200.0)], axis=1)
    found = stance(normal(position, rotation))
    world = np.array([0.0, 0.0, 1.0]) if lying else np.array([0.0, 1.0, 0.0])
    up = turn(rotation, found[:, :3])
    assert up / np.linalg.norm(up, axis=1)[:, None] == pytest.approx(np.tile(world, (200, 1)))
    rises = np.diff(found[:, 3])
    assert (rises < 0).all() if lying else (rises > 0).all()


def test_what_is_known_beside_fills_what_channels_do_not_tell() -> None:
    random = np.random.default_rng(3)
    paths = np.cumsum(np.cumsum(random.normal(0.0, 0.01, (900, 3)), axis=0), axis=0)
    paths -= np.stack([np.linspace(a, b, 900) for a, b in zip(paths[0], paths[-1], strict=True)], 1)
    beside = paths[:, :1] / paths[:, 0].std()
    values = np.hstack([beside, paths[:, 1:] / paths[:, 1:].std(axis=0)])
    known = np.ones(values.shape, dtype=bool)
    known[HIDDEN, 0] = False
    prior = learn(values, RATE)
    with_it = fill(values, known, RATE, prior, beside=beside)
    without = fill(values, known, RATE, prior)
    assert with_it.values.shape == with_it.variance.shape == values.shape
    off = [np.abs(f.values - values)[HIDDEN, 0].max() for f in (with_it, without)]
    assert off[0] < 0.2 * off[1]
