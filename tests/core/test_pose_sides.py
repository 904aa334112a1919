"""What one side of a body tells of the other."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.poses import Pose
from markermend.poses.channels import Channels, to_channels
from markermend.poses.filling.covariance import learn
from markermend.poses.filling.sides import OTHER_SIDE, mirror_of, of_both_sides
from markermend.poses.filling.stance import IN_MIRROR, stance
from markermend.poses.nuitrack import MIRROR, to_nuitrack, twins


@pytest.fixture(scope="module")
def walk(shared_data) -> Pose:
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


def columns_of(pose: Pose) -> tuple[np.ndarray, Channels]:
    channels = to_channels(pose)
    return np.hstack([channels.values, stance(channels.normal)]), channels


def test_a_mirror_shows_what_the_mirrored_person_does(walk):
    other = twins(walk.joints)
    person = walk.with_samples(
        (walk.positions * MIRROR[:3])[:, other],
        (walk.rotations * MIRROR[3:])[:, other],
        walk.confidence,
    )
    (own, channels), (there, _) = columns_of(walk), columns_of(person)
    mirror = mirror_of(
        [walk.joints[j] for j in channels.joints], channels.values.mean(axis=0), IN_MIRROR
    )
    image = mirror.image(own.astype(np.float32))
    count = channels.values.shape[1]
    shown, truth = (x[:, :count].reshape(len(x), -1, 7) for x in (image, there))
    assert shown[..., :3] == pytest.approx(truth[..., :3], abs=1e-4)
    alike = np.abs(np.sum(shown[..., 3:] * truth[..., 3:], axis=2))
    assert alike == pytest.approx(np.ones_like(alike), abs=1e-4)
    assert image[:, count:] == pytest.approx(there[:, count:], abs=1e-4)
    assert mirror.image(image) == pytest.approx(own, abs=1e-5)


def test_signs_in_a_mirror_are_those_of_the_own_side(walk):
    values = to_channels(walk).values.astype(np.float32)
    mirror = mirror_of(
        [joint for joint in walk.joints if joint != "waist"], values.mean(axis=0), ()
    )
    turned, image = (x.reshape(len(x), -1, 7)[..., 3:] for x in (values, mirror.image(values)))
    assert np.all(np.sum(turned.mean(axis=0) * image.mean(axis=0), axis=1) > 0)


def test_movement_beside_poses_is_mirrored_alike(walk):
    values = to_channels(walk).values.astype(np.float32)
    mirror = mirror_of(
        [joint for joint in walk.joints if joint != "waist"], values.mean(axis=0), ()
    )
    both = mirror.image(np.hstack([values, 2.0 * values]))
    assert both == pytest.approx(np.hstack([mirror.image(values), 2.0 * mirror.image(values)]))


def test_moments_of_both_sides_are_in_part_those_of_the_mirrored_person(walk):
    own, channels = columns_of(walk)
    mirror = mirror_of(
        [walk.joints[j] for j in channels.joints], channels.values.mean(axis=0), IN_MIRROR
    )
    one, other = (learn(rows, walk.rate) for rows in (own, mirror.image(own.astype(np.float32))))
    both = of_both_sides(one, mirror)
    sets = ([m.whole, *m.within] for m in (one, other, both))
    for own_side, other_side, found in zip(*sets, strict=True):
        parts = (1.0 - OTHER_SIDE) * own_side + OTHER_SIDE * other_side
        assert found == pytest.approx(parts, abs=1e-3 * np.abs(parts).max())
    assert np.array_equal(both.mean, one.mean)
    assert both.weight == one.weight
