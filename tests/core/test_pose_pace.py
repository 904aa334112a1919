"""Poses that did not come: how many are missing, and that what is right afterwards stays so."""

from __future__ import annotations

import io
from dataclasses import replace
from math import nan

import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.errors import FileFormatError
from markermend.files.pose_stream import follow
from markermend.files.pose_stream_pace import Pace
from markermend.poses import Pose
from markermend.poses.live import Live
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.prior import shipped_prior
from markermend.poses.quaternion import lengths_of
from markermend.poses.streaming.articulation import Articulation
from markermend.poses.streaming.doubting import Doubting
from markermend.poses.streaming.levels import Levels
from markermend.poses.streaming.shaking import Shaking
from markermend.poses.streaming.steadying import Steadying
from markermend.poses.streaming.tracking import Tracking

HEAD = "frame,time,joint,parent,x,y,z,confidence\n"


def missed(frames, times=None):
    pace, times = Pace(), times or [nan] * len(frames)
    return [pace.missed(frame, time) for frame, time in zip(frames, times, strict=True)]


def test_numbers_tell_what_is_missing():
    assert missed([3, 4, 5, 9, 10]) == [0, 0, 0, 3, 0]
    # Where every fourth is kept, none is missing.
    assert missed([0, 4, 8, 20, 24]) == [0, 0, 0, 2, 0]
    # A recording that begins again, or a pose that was overtaken.
    assert missed([7, 8, 9, 0, 1]) == [0, 0, 0, 8, 0]
    assert missed([7, 8, 10, 9, 11]) == [0, 0, 1, 0, 1]


def test_times_tell_what_numbers_do_not():
    times = [0.1 * n for n in (0, 1, 2, 3, 8, 9, 10.4, 11, 13)]
    assert missed(list(range(9)), times) == [0, 0, 0, 0, 4, 0, 0, 0, 1]
    # In any unit, where numbers are counted through or not.
    assert missed([0, 1, 2, 3, 8], [0, 33, 66, 100, 266]) == [0, 0, 0, 0, 4]
    assert missed([0, 2, 4, 6, 8, 10], [0, 1, 2, 3, 4, 8]) == [0] * 5 + [3]


@pytest.mark.parametrize(
    "times",
    [
        [0.0] * 5 + [1.0] * 3,
        [5.0, 4.0, 3.0, 2.0, 1.0, 0.0, -9.0, 1.0],
        [0.0, 1.0, 2.0, nan, 40.0, nan, np.inf, 50.0],
        [0.0, 0.005, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
    ],
)
def test_times_that_tell_nothing_are_not_asked(times):
    assert missed(list(range(8)), times) == [0] * 8


def test_no_number_is_too_far_off():
    assert missed([0, 1, 2, 3, 4], [0, 1, 2, 3, 1e18])[-1] <= 1e6
    live = Live(body(0))
    first = body(0)
    for n in (1, 2):
        live(*samples(body(n)))
    places, _ = live(*samples(body(3)), 2**53)
    assert np.isfinite(places).all()
    np.testing.assert_array_equal(live(*samples(first), -5)[0], first.positions[0])


def body(n):
    """Three joints in a row, of which the last swings."""
    places = np.array([[10.0 * n, 0, 0], [10.0 * n, 0, 300], [10.0 * n + 200, 0, 300]])
    turns = np.tile([0.0, 0.0, 0.0, 1.0], (3, 1))
    return Pose(places[None], turns[None], ("a", "b", "c"), (-1, 0, 1), 30.0)


def samples(pose):
    return pose.positions[0], pose.rotations[0], pose.seen[0]


@pytest.fixture(scope="module")
def walking(shared_data):
    """Somebody who walks, seen at 30 Hz."""
    full = mm.read_pose(shared_data / "poses" / "02_02.amc")
    part = slice(0, 180, 4)
    some = Pose(full.positions[part], full.rotations[part], full.joints, full.parents, 30.0)
    return to_nuitrack(some)


def swung(n):
    """A pose of that body in which only its last joint goes its way."""
    places, turns, seen = (part.copy() for part in samples(body(0)))
    places[2, 1] += 8.0 * n
    return places, turns, seen


def first_of(pose):
    return Pose(pose.positions[:1], pose.rotations[:1], pose.joints, pose.parents, pose.rate)


AT, AWAY = 22, 10


def after_it(pose, told):
    live = Live(first_of(pose))
    came = [*range(1, AT), *range(AT + AWAY, AT + AWAY + 6)]
    out = []
    for before, t in zip([0, *came], came, strict=False):
        some = pose.positions[t], pose.rotations[t], pose.seen[t]
        out.append(live(*some, t - before - 1 if told else 0)[0])
    return lengths_of(np.array(out) - pose.positions[came])[AT - 1 :]


def test_right_joints_stay_after_poses_that_did_not_come(walking):
    assert after_it(walking, told=False).max() > 100.0
    assert after_it(walking, told=True).max() == 0.0


def test_what_is_hidden_after_them_is_where_it_is_after_poses_that_show_nothing(walking):
    hidden = walking.joints.index("left_wrist")
    out = []
    for missing in (0, AWAY, -AWAY):
        live = Live(first_of(walking), shipped_prior())
        for t in range(1, AT):
            live(walking.positions[t], walking.rotations[t], walking.seen[t])
        nothing = np.zeros(len(walking.joints), dtype=bool)
        for _ in range(-missing):
            live(walking.positions[AT], walking.rotations[AT], nothing)
        t = AT + AWAY
        shown = np.arange(len(walking.joints)) != hidden
        places, _ = live(walking.positions[t], walking.rotations[t], shown, max(missing, 0))
        out.append(places[hidden])
    ignored, told, stepped = out
    assert lengths_of(told - stepped) < 0.4 * lengths_of(ignored - stepped)


def followed(pose, every):
    """What fills, having seen every so manyth pose."""
    live = Live(first_of(pose))
    for t in range(every, pose.frames, every):
        live(pose.positions[t], pose.rotations[t], pose.seen[t], every - 1)
    return live._following


def test_no_more_movement_is_learnt_where_poses_are_missing(walking):
    whole, half = (np.trace(followed(walking, every)._covariance) for every in (1, 2))
    assert 0.3 * whole < half < whole


def test_a_joint_that_goes_after_them_goes_on_as_fast_as_it_went():
    live = Live(body(0))
    for n in range(1, 8):
        live(*swung(n))
    live(*swung(13), 5)
    places, turns, _ = swung(14)
    filled, _ = live(places, turns, np.array([True, True, False]))
    # Further than that only if it went all the way in one pose.
    assert lengths_of(filled[2] - swung(13)[0][2]) < 32.0


def test_after_long_nothing_is_left_of_how_it_was(walking):
    live = Live(first_of(walking), shipped_prior())
    wrist = np.arange(len(walking.joints)) != walking.joints.index("left_wrist")
    for t in range(1, 30):
        live(walking.positions[t], walking.rotations[t], wrist if t > 27 else walking.seen[t])
    live(walking.positions[40], walking.rotations[40], wrist, 10**5)
    following = live._following
    levels = following._levels
    assert np.abs(following._coasting).max() < 1e-9
    assert np.abs(following._speed).max() < 1e-3
    assert np.abs(levels._away).max() < 1e-9
    np.testing.assert_allclose(following._axes_turn, following._root_pose[1], atol=1e-9)


def test_what_is_filled_after_long_is_where_it_settles(walking, monkeypatch):
    live = Live(first_of(walking))
    monkeypatch.setattr(Articulation, "follow", lambda _, values, *__: values + 1e6)
    live(walking.positions[1], walking.rotations[1], walking.seen[1], 10**5)
    assert live._following._values.min() > 0.99e6


def test_a_joint_that_went_meanwhile_went_all_the_way():
    ways = []
    for missing in (0, 3):
        live = Live(replace(body(0), rate=120.0))
        for n in range(1, 12):
            live(*swung(n))
        places, turns, _ = swung(11)
        filled, _ = live(places, turns, np.array([True, True, False]), missing)
        ways.append(lengths_of(filled[2] - places[2]))
    assert ways[1] > ways[0] + 3.0


def test_levels_are_reached_after_long():
    poses = np.random.default_rng(0).normal(size=(200, 1)) * np.array([1.0, 2.0, -1.0])
    levels = Levels(poses[0], None, 30.0)
    for pose in poses:
        levels.learn(pose)
    levels.begin(np.array([2]), np.array([0, 1]), np.array([0.0, 0.0, 3.0]))
    now = np.array([1.0, 2.0, 9.0])
    levels.draw(now, 1e5)
    assert now[2] == pytest.approx(-1.0, abs=0.1)


def test_who_came_far_after_them_is_not_taken_for_wrong():
    places = 300.0 * np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0], [2, 2, 0.0]])
    turns, seen = np.tile([0.0, 0.0, 0.0, 1.0], (5, 1)), np.ones(5, dtype=bool)
    doubting = Doubting("abcde", (-1, 0, 1, 2, 3), 30.0)
    for n in range(20):
        doubting(places + n, turns, seen)
        doubting.keep(places + n, seen)
    then = places + 3000.0
    # As far from the next as it should be, and too far from the one before.
    then[3] = then[4] + [300.0, 0.0, 0.0]
    doubting(then, turns, seen, 60.0)
    assert doubting.wrong.tolist() == [False, False, False, True, False]


def test_no_noise_is_told_from_what_lies_apart(walking, monkeypatch):
    away = []
    monkeypatch.setattr(Shaking, "look_away", lambda _: away.append(True))
    steadying = Steadying(walking.parents, walking.rate)
    for steps in (1.0, 2.0, 1.0):
        steadying(walking.positions[0], walking.rotations[0], walking.seen[0], steps)
    assert len(away) == 1


def test_a_filter_goes_on_over_what_is_missing_as_if_it_were_not_known():
    random = np.random.default_rng(0)
    far, near = Tracking((2,), 30.0), Tracking((2,), 30.0)
    noise, known = np.full(2, 4.0), np.ones(2, dtype=bool)
    for n in range(30):
        values = np.array([5.0 * n, -n]) + random.normal(0.0, 2.0, 2)
        far.follow(values, known, noise)
        near.follow(values, known, noise)
    for _ in range(4):
        near.follow(values, ~known, noise)
    then = np.array([170.0, -30.0])
    np.testing.assert_allclose(
        far.follow(then, known, noise, 5.0), near.follow(then, known, noise), rtol=1e-9
    )
    # Also how sure it is, and how fast.
    np.testing.assert_allclose(
        far.follow(then, known, noise), near.follow(then, known, noise), rtol=1e-9
    )


def rows(frames, times=None, *, head=HEAD):
    yield head
    for n, frame in enumerate(frames):
        for joint, parent, place in zip("abc", " ab", body(n).positions[0], strict=True):
            told = "" if times is None else times[n]
            yield f"{frame},{told},{joint},{parent.strip()},{','.join(map(str, place))},1\n"


def streamed(lines, monkeypatch, rate=None):
    """What is said of a stream, its output, and what poses were cleaned with."""
    given, said, out = [], [], []

    class Told(Live):
        def __call__(self, positions, rotations, seen, missed=0):
            given.append((self._body.rate, missed))
            return super().__call__(positions, rotations, seen, missed)

    monkeypatch.setattr("markermend.files.pose_stream_pace.Live", Told)
    follow(lines, out.append, rate=rate, prior=None, warn=said.append)
    return said, "".join(out).splitlines()[1:], given


def test_a_stream_is_told_what_is_missing(monkeypatch):
    said, out, given = streamed(rows([4, 5, 6, 12, 13]), monkeypatch)
    assert given == [(30.0, 0)] * 3 + [(30.0, 5), (30.0, 0)]
    assert [line.split(",")[0] for line in out] == [
        str(n) for n in (4, 5, 6, 12, 13) for _ in "abc"
    ]
    assert said == []


def test_a_rate_that_is_told_later_is_the_same_as_at_first(walking):
    late, soon = Live(first_of(walking)), Live(replace(first_of(walking), rate=12.0))
    late.come_at(12.0)
    # Of the joint that is hidden for long all that goes by time shows.
    shown = np.arange(len(walking.joints)) != walking.joints.index("left_wrist")
    places = walking.positions + np.random.default_rng(0).normal(0.0, 9.0, walking.positions.shape)
    # As far as a hand can turn in a twelfth of a second, and not in a thirtieth.
    elbow, hand = (walking.joints.index(f"right_{joint}") for joint in ("elbow", "wrist"))
    x, y, z = places[20, hand] - places[20, elbow]
    places[20, hand] = places[20, elbow] + [-y, x, z]
    for t in range(1, walking.frames):
        pose = places[t], walking.rotations[t], shown | (t < 30)
        for ours, theirs in zip(late(*pose), soon(*pose), strict=True):
            np.testing.assert_array_equal(ours, theirs)


def test_times_tell_a_rate_where_nobody_does(monkeypatch):
    times = [n / 10 for n in range(9)]
    said, out, given = streamed(rows(range(9), times), monkeypatch)
    assert said == [
        "The stream's times tell 10 poses a second, which is what was assumed; give the rate where"
        " that is wrong."
    ]
    assert given == [(30.0, 0)] * 5 + [(10.0, 0)] * 4
    assert len(out) == 27
    assert streamed(rows(range(9), times), monkeypatch, 30.0)[2] == [(30.0, 0)] * 9


@pytest.mark.parametrize(
    "times", [[0] * 9, [n / 29 for n in range(9)], [n / 1e4 for n in range(9)]]
)
def test_times_that_tell_no_other_rate_change_nothing(times, monkeypatch):
    said, _, given = streamed(rows(range(9), times), monkeypatch)
    assert said == []
    assert given == [(30.0, 0)] * 9


def test_further_columns_are_said_to_be_left_out(monkeypatch):
    lines = [
        line.rstrip("\n") + ("," + "state" if n == 0 else ",7")
        for n, line in enumerate(rows(range(3)))
    ]
    said, out, _ = streamed(lines, monkeypatch)
    assert said == ["Of further columns a stream keeps nothing: state."]
    assert len(out) == 9


@pytest.mark.parametrize("mark", ["", "\udcff\udcfe"])
def test_a_stream_in_utf_16_says_so(mark, monkeypatch):
    head = mark + "".join(letter + "\0" for letter in HEAD)
    with pytest.raises(FileFormatError, match="The stream is text in UTF-16"):
        follow([head], print, rate=30.0, prior=None)


def test_the_command_line_takes_the_rate_that_times_tell(monkeypatch, capsys):
    lines = "".join(rows(range(9), [n / 10 for n in range(9)]))
    monkeypatch.setattr("sys.stdin", io.StringIO(lines))
    assert main(["denoise", "-", "-o", "-"]) == 0
    assert "tell 10 poses a second" in capsys.readouterr().err
