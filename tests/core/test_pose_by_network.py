"""Recordings that go through a network from end to end."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.errors import DataError
from markermend.poses.networks.by_network import denoise_by_network
from markermend.poses.networks.network import PARTS, Network, save_networks
from markermend.poses.nuitrack import JOINTS, mirrored, to_nuitrack
from markermend.poses.simulated.noise import Noise, corrupt_pose


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


def unchanging(parts):
    """A network that returns what it sees: what is above and what is below zero, put together."""
    width = 16 * len(range(7)[PARTS[parts]])
    one = np.eye(width, dtype=np.float32)
    none = np.zeros(2 * width, dtype=np.float32)
    return Network(
        parts,
        np.zeros(width, dtype=np.float32),
        np.ones(width, dtype=np.float32),
        (np.hstack([one, -one]), np.diag(none), np.vstack([one, -one])),
        (none, none, none[:width]),
    )


def distance(one, other):
    return np.linalg.norm(one.positions - other.positions, axis=-1)


@pytest.mark.parametrize("parts", ["both", "positions"])
def test_what_a_network_leaves_comes_back_but_for_the_filter(walk, parts):
    out = denoise_by_network(walk, unchanging(parts))
    assert out.joints == JOINTS
    assert distance(out, walk).mean() < 2.0
    turned = np.abs(np.sum(out.rotations * walk.rotations, axis=-1))
    assert np.degrees(2 * np.arccos(np.minimum(turned, 1.0))).mean() < 1.0


def test_rotations_alone_carry_the_bones(walk):
    out = denoise_by_network(walk, unchanging("rotations"))
    # The 17 joints leave segments out, so bones are not quite fixed in their parents.
    assert 0.1 < distance(out, walk).mean() < 25.0
    for joint, parent in enumerate(walk.parents):
        if parent >= 0:
            bones = np.linalg.norm(out.positions[:, joint] - out.positions[:, parent], axis=1)
            assert np.ptp(bones) < 1e-6


def test_unseen_joints_go_in_as_learnt_and_come_out_inferred(walk):
    damaged = corrupt_pose(walk, Noise(displacement=0.0), seed=1)
    out = denoise_by_network(damaged, unchanging("both"))
    assert out.seen.all()
    assert (out.confidence[~damaged.seen] == 0.5).all()
    # At the waist, but for the filter.
    waist = np.linalg.norm(out.positions - out.positions[:, :1], axis=-1)
    head = JOINTS.index("head")
    assert np.median(waist[~damaged.seen[:, head], head]) < np.median(waist[:, head])
    other = denoise_by_network(mirrored(damaged), unchanging("both"))
    assert np.abs(mirrored(other).positions - out.positions).max() < 0.01


def test_strangers_are_refused(walk):
    stranger = walk.with_samples(walk.positions[:, ::-1], walk.rotations)
    with pytest.raises(DataError, match="stand elsewhere"):
        denoise_by_network(stranger, unchanging("both"))


def test_command_line(shared_data, tmp_path, capsys):
    nets, out = tmp_path / "nets.npz", tmp_path / "out.csv"
    save_networks({"all-both": unchanging("both")}, nets)
    asked = ["denoise", str(shared_data / "poses" / "02_03.amc"), "-o", str(out)]
    assert main([*asked, "--network", str(nets), "all"]) == 1
    assert "there are: all-both" in capsys.readouterr().err
    assert main([*asked, "--network", str(nets), "all-both"]) == 0
    assert mm.read_pose(out).joints == JOINTS
