"""Poses cleaned while they come, and the stream of them."""

from __future__ import annotations

import io

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import markermend as mm
from markermend.cli import main
from markermend.errors import FileFormatError
from markermend.files.pose_stream import follow
from markermend.poses import Pose
from markermend.poses.live import Live
from markermend.poses.nuitrack import mirrored, to_nuitrack, twins
from markermend.poses.prior import fitting, shipped_prior
from markermend.poses.quaternion import lengths_of, multiply
from markermend.poses.simulated.noise import Noise, corrupt_pose
from markermend.poses.streaming.levels import Levels


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture(scope="module")
def damaged(walk):
    return corrupt_pose(walk, Noise(displacement=0.0, burst=30), seed=3)


@pytest.fixture(scope="module")
def filled(walk, damaged):
    """The places of the damaged walk's joints as they come out with the shipped prior."""
    return run(Live(first_of(walk), shipped_prior()), damaged)[0]


def first_of(pose):
    return Pose(pose.positions[:1], pose.rotations[:1], pose.joints, pose.parents, pose.rate)


def run(live, pose):
    out = [live(pose.positions[t], pose.rotations[t], pose.seen[t]) for t in range(1, pose.frames)]
    return np.array([places for places, _ in out]), np.array([turns for _, turns in out])


@pytest.mark.parametrize(("prior", "most"), [(None, 0.32), (shipped_prior(), 0.29)])
def test_hidden_joints_follow_the_body(walk, damaged, prior, most):
    places, turns = run(Live(first_of(walk), prior), damaged)
    truth, hidden = walk.positions[1:], ~damaged.seen[1:]
    held = np.array(damaged.positions)
    held[0] = walk.positions[0]
    offset = walk.positions[:, :1]
    for t in range(1, walk.frames):
        gone = ~damaged.seen[t]
        held[t, gone] = held[t - 1, gone] + (offset[t] - offset[t - 1])
    error = np.sqrt(np.sum((places - truth) ** 2, axis=2))
    without = np.sqrt(np.sum((held[1:] - truth) ** 2, axis=2))
    assert error[hidden].mean() < most * without[hidden].mean()
    assert error[~hidden].max() < 1e-6
    assert not np.isnan(turns).any()
    np.testing.assert_allclose(np.sum(turns**2, axis=2), 1.0, atol=1e-6)


def off_live(truth, damaged, prior):
    places = run(Live(first_of(truth), prior), damaged)[0]
    return lengths_of(places - truth.positions[1:])[~damaged.seen[1:]].mean()


def test_how_others_bend_tells_where_hidden_joints_can_be(walk, damaged, monkeypatch):
    told = off_live(walk, damaged, shipped_prior())
    monkeypatch.setattr("markermend.poses.live.bending_of", lambda *_: None)
    assert told < 0.9 * off_live(walk, damaged, shipped_prior())


def test_joints_that_turn_with_what_they_hang_on_are_told_where_they_can_be(walk, monkeypatch):
    ends = [j for j in range(len(walk.joints)) if j not in walk.parents]
    rotations = walk.rotations.copy()
    rotations[:, ends] = np.nan
    given = walk.with_samples(walk.positions, rotations)
    damaged = corrupt_pose(given, Noise(displacement=0.0, burst=30), seed=3)
    told = off_live(given, damaged, shipped_prior())
    monkeypatch.setattr("markermend.poses.live.bending_of", lambda *_: None)
    assert told < 0.95 * off_live(given, damaged, shipped_prior())


def test_how_a_root_shakes_is_no_movement_of_what_hangs_on_it(walk, damaged, monkeypatch):
    random = np.random.default_rng(0)
    shaken = damaged.rotations.copy()
    by = Rotation.from_rotvec(random.normal(scale=0.06, size=(walk.frames, 3))).as_quat()
    shaken[:, 0] = multiply(by, shaken[:, 0])
    shaking = damaged.with_samples(damaged.positions, shaken, damaged.confidence)
    calm = off_live(walk, shaking, shipped_prior())
    monkeypatch.setattr("markermend.poses.streaming.following._FOLLOWS_S", 1e-6)
    assert calm < 0.8 * off_live(walk, shaking, shipped_prior())


def test_one_side_of_a_body_tells_of_the_other(walk, damaged, monkeypatch):
    # Were both sides to count alike, a body seen in a mirror would be filled alike.
    monkeypatch.setattr("markermend.poses.filling.sides.OTHER_SIDE", 0.5)
    monkeypatch.setattr("markermend.poses.streaming.levels._DRAWN_S", 1e9)
    sides = twins(walk.joints)

    def in_mirror(pose):
        seen = mirrored(pose)
        return pose.with_samples(
            seen.positions[:, sides], seen.rotations[:, sides], seen.confidence[:, sides]
        )

    places, _ = run(Live(first_of(walk), shipped_prior()), damaged)
    other, _ = run(Live(first_of(in_mirror(walk)), shipped_prior()), in_mirror(damaged))
    np.testing.assert_allclose(other[:, sides] * [-1.0, 1.0, 1.0], places, atol=1.0)


def test_signs_of_rotations_say_nothing_about_movement(walk, damaged, filled):
    other = np.random.default_rng(0).random((1, 17, 1)) < 0.5
    turned = damaged.with_samples(
        damaged.positions,
        np.where(other, -damaged.rotations, damaged.rotations),
        damaged.confidence,
    )
    first = first_of(walk)
    negative = first.with_samples(
        first.positions, np.where(other, -first.rotations, first.rotations), first.confidence
    )
    again, _ = run(Live(negative, shipped_prior()), turned)
    np.testing.assert_allclose(again, filled, atol=1e-6)


def test_hidden_columns_are_drawn_to_where_others_tell():
    random = np.random.default_rng(7)
    poses = random.normal(size=(400, 2)) @ random.normal(size=(2, 7))
    levels = Levels(poses[0], None, 30.0)
    for pose in poses:
        levels.learn(pose)
    hidden, visible = np.array([0]), np.arange(1, 7)
    truth = poses[10] + 0.5 * (poses[11] - poses[10])
    strayed = truth.copy()
    strayed[0] += 1.0
    levels.begin(hidden, visible, poses[10])
    for _ in range(60):
        levels.draw(strayed)
    assert abs(strayed[0] - truth[0]) < 0.1
    assert (strayed[1:] == truth[1:]).all()


def test_left_hands_are_filled_alike(walk, damaged, filled):
    other, _ = run(Live(mirrored(first_of(walk)), shipped_prior()), mirrored(damaged))
    np.testing.assert_allclose(other * [-1.0, 1.0, 1.0], filled, atol=1e-6)


def test_a_body_is_known_by_one_pose_of_whatever_it_does(shared_data):
    climbing = to_nuitrack(mm.read_pose(shared_data / "poses" / "01_14.amc"))
    for pose, left_handed in ((climbing, False), (mirrored(climbing), True)):
        for frame in (0, 1200):
            once = Pose(
                pose.positions[frame : frame + 1],
                pose.rotations[frame : frame + 1],
                pose.joints,
                pose.parents,
                pose.rate,
            )
            fit = fitting(once, shipped_prior())
            assert fit is not None
            assert fit[1] == left_handed


def text_of(pose, tmp_path):
    mm.write_pose(pose, tmp_path / "stream.csv")
    return (tmp_path / "stream.csv").read_text().splitlines(keepends=True)


def test_each_pose_is_out_before_the_next_comes_in(walk, tmp_path):
    short = Pose(walk.positions[:6], walk.rotations[:6], walk.joints, walk.parents, 120.0)
    lines, taken, written = text_of(short, tmp_path), [], []

    def source():
        for line in lines:
            taken.append(line)
            yield line

    def write(text):
        written.append((len(taken), text))

    assert follow(source(), write, rate=120.0, prior=shipped_prior()) == 6
    # After the first pose, whose joints the second one's first row completes.
    assert [n for n, _ in written[2:]] == [1 + 17 * pose for pose in range(2, 7)]
    assert "".join(text for _, text in written) == "".join(lines)


def test_what_is_wrong_with_a_stream_is_said():
    for text, said in (
        ("", "empty"),
        ("frame,joint,parent,x,y,z\n0,a\n", "lacks cells"),
        ("frame,joint,parent,x,y,z\nz,a,,1,2,3\n", "no frame"),
        ("frame,joint\n", "lacks the column"),
    ):
        with pytest.raises(FileFormatError, match=said):
            follow(io.StringIO(text), lambda _: None, rate=30.0, prior=None)


def test_command_line(walk, tmp_path, monkeypatch, capsys):
    damaged = np.array(walk.confidence)
    damaged[20:40, 6] = 0
    hidden = walk.with_samples(walk.positions, walk.rotations, damaged)
    monkeypatch.setattr("sys.stdin", io.StringIO("".join(text_of(hidden, tmp_path))))
    assert main(["denoise", "-", "-o", "-", "--rate", "120"]) == 0
    (tmp_path / "back.csv").write_text(capsys.readouterr().out)
    back = mm.read_pose(tmp_path / "back.csv")
    assert back.frames == walk.frames
    assert (back.confidence[20:40, 6] == 0.5).all()
    assert np.abs(back.positions - walk.positions)[20:40, 6].max() < 60
    monkeypatch.chdir(tmp_path)
    for words, said in (
        (["-", "-o", "file.csv"], "“-”"),
        (["-", "-o", "-", "--cmu"], "--cmu has no effect on a stream"),
        (["a.csv", "-o", "b.csv", "--skeleton", "a.asf"], "--skeleton has no effect on anything"),
        (["a.csv", "-o", "b.csv", "--network", "n", "n", "--list"], "--list has no effect on what"),
    ):
        assert main(["denoise", *words]) == 1
        assert said in capsys.readouterr().err


@pytest.mark.parametrize("length", [1.0, 0.99, 1.05, 2.0])
def test_lengths_of_rotations_say_nothing(walk, damaged, filled, length):
    live = Live(first_of(walk), shipped_prior())
    turned = damaged.rotations * length
    longer = [live(damaged.positions[t], turned[t], damaged.seen[t]) for t in range(1, walk.frames)]
    np.testing.assert_allclose([again for again, _ in longer], filled, atol=1e-6)
    # What is seen goes through as it is, the root too.
    root = np.array([turns[0] for _, turns in longer])
    np.testing.assert_array_equal(root[damaged.seen[1:, 0]], turned[1:, 0][damaged.seen[1:, 0]])


@pytest.mark.parametrize("rate", [30.0, 188.0, 240.0, 1000.0])
def test_any_rate_is_filled(walk, rate):
    faster = Pose(walk.positions, walk.rotations, walk.joints, walk.parents, rate)
    damaged = corrupt_pose(faster, Noise(displacement=0.0, burst=5), seed=3)
    places, _ = run(Live(first_of(faster), shipped_prior()), damaged)
    hidden = ~damaged.seen[1:]
    assert np.linalg.norm(places - walk.positions[1:], axis=2)[hidden].mean() < 20.0


def test_what_is_no_body_spoils_nothing(walk):
    live = Live(first_of(walk), shipped_prior())
    everything, nothing = np.ones(17, dtype=bool), np.zeros(17, dtype=bool)
    for t in range(1, 40):
        live(walk.positions[t], walk.rotations[t], everything)
    odd = walk.positions[40].copy()
    odd[3], odd[9] = 1e200, 1e12
    live(odd, walk.rotations[40] * np.nan, everything)
    for seen in (nothing, nothing, everything):
        places, turns = live(walk.positions[41], walk.rotations[41], seen)
        assert np.isfinite(places).all()
        assert np.isfinite(turns).all()
    hidden = everything.copy()
    hidden[7] = False
    places, _ = live(walk.positions[42], walk.rotations[42], hidden)
    assert np.linalg.norm(places[7] - walk.positions[42, 7]) < 20.0
