"""Joints that are wrong without a word about it are found as poses come."""

from __future__ import annotations

import io

import numpy as np
import pytest
from numpy.testing import assert_allclose

import markermend as mm
from markermend.files.pose_stream import follow
from markermend.poses import Pose
from markermend.poses.faults.guessing import INFERRED
from markermend.poses.live import Live
from markermend.poses.nuitrack import LIMBS, to_nuitrack
from markermend.poses.quaternion import NO_TURN, lengths_of
from markermend.poses.streaming.doubting import Doubting

RATE = 120.0
HIDES = 60


@pytest.fixture(scope="module")
def walk(shared_data):
    return to_nuitrack(mm.read_pose(shared_data / "poses" / "02_01.amc"))


@pytest.fixture
def places(walk):
    return walk.positions.copy()


class Seen:
    """What was made of a recording pose by pose, each kept as it came out."""

    def __init__(self, pose, places, seen=None):
        seen = np.ones(places.shape[:2], dtype=bool) if seen is None else seen
        doubting = Doubting(pose.joints, pose.parents, pose.rate)
        self.wrong, self.exchanged = np.zeros((2, *seen.shape), dtype=bool)
        self.places, self.rotations = places.copy(), pose.rotations[: len(places)].copy()
        for n, given in enumerate(places):
            now, turned, known = doubting(given, pose.rotations[n], seen[n])
            self.wrong[n] = doubting.wrong
            self.exchanged[n] = doubting.own != np.arange(len(known))
            self.rotations[n] = turned
            # As if it were filled without any error.
            self.places[n] = np.where(known[:, None], now, pose.positions[n])
            doubting.keep(self.places[n], np.ones(len(known), dtype=bool))


def arm(turned):
    """An arm of three bones whose upper one turns about z, (frames,) radians."""
    bone = 300.0 * np.stack([np.cos(turned), np.sin(turned), 0.0 * turned], axis=1)
    shoulder = np.tile([0.0, 0.0, 400.0], (len(turned), 1))
    positions = np.stack([0.0 * bone, shoulder, shoulder + bone], axis=1)
    rotations = np.tile(NO_TURN, (len(turned), 3, 1))
    return Pose(positions, rotations, ("hip", "shoulder", "elbow"), (-1, 0, 1), RATE)


def test_nothing_is_doubted_of_who_walks(walk):
    found = Seen(walk, walk.positions)
    assert not found.wrong.any()
    assert not found.exchanged.any()
    assert_allclose(found.places, walk.positions)


def test_joints_at_zero_are_not_there_but_a_root_may_be(walk, places):
    root = walk.order[0]
    places -= places[:, root : root + 1]
    there = walk.with_samples(places, walk.rotations, walk.confidence)
    elbow = walk.joints.index("left_elbow")
    broken = places.copy()
    broken[40:60, elbow] = 0.0
    found = Seen(there, broken)
    assert found.wrong[40:60, elbow].all()
    assert found.wrong.sum() == 20


def test_who_stands_still_to_the_last_digit_is_noticed_in_the_third_pose(walk, places):
    wrist = walk.joints.index("right_wrist")
    places[HIDES : HIDES + 40, wrist] = places[HIDES, wrist]
    found = Seen(walk, places)
    late = np.flatnonzero(found.wrong[:, wrist])
    assert HIDES + 2 <= late[0] <= HIDES + 5
    assert late[-1] == HIDES + 39
    assert len(late) == late[-1] - late[0] + 1
    assert not np.delete(found.wrong, wrist, axis=1).any()


def test_a_limb_that_stands_still_is_noticed_as_a_whole(walk, places):
    limb = list(LIMBS[2])
    places[HIDES : HIDES + 40, limb] = places[HIDES, limb]
    found = Seen(walk, places)
    assert found.wrong[HIDES + 8 : HIDES + 40][:, limb].mean() > 0.95
    assert not np.delete(found.wrong, limb, axis=1).any()


def test_most_of_a_body_may_stand_still_with_the_root_among_it(walk, places):
    held = [walk.joints.index(name) for name in ("waist", "torso", "collar", "left_hip")]
    places[HIDES : HIDES + 40, held] = places[HIDES, held]
    found = Seen(walk, places)
    assert found.wrong[HIDES + 8 : HIDES + 40][:, held].all()


def test_a_pose_that_comes_again_is_no_fault_nor_is_what_comes_then(walk, places):
    places[HIDES : HIDES + 25] = places[HIDES]
    found = Seen(walk, places)
    assert not found.wrong.any()


@pytest.mark.parametrize("digit", [1.0, 10.0])
def test_rounded_numbers_repeat_themselves(walk, places, digit):
    """They all do where who walks slowly is shown often."""
    n = np.arange(600) / 10.0
    slow = np.array(
        [walk.positions[int(k)] * (1.0 - k % 1) + walk.positions[int(k) + 1] * (k % 1) for k in n]
    )
    slow = np.round(slow / digit) * digit
    pose = walk.with_samples(slow, np.tile(NO_TURN, (600, 17, 1)), np.ones(slow.shape[:2]))
    assert (np.abs(np.diff(slow, axis=0)).max(axis=2) == 0).mean() > 0.1
    assert Seen(pose, slow).wrong.mean() < 0.002


def test_a_body_may_stand_still_while_its_arms_move(walk):
    arms = [*LIMBS[0], *LIMBS[1]]
    still = np.tile(walk.positions[:1], (200, 1, 1))
    turn = np.deg2rad(30.0 * np.sin(np.arange(200) / 20.0))
    for limb in LIMBS[:2]:
        first = limb[0]
        away = still[:, list(limb)] - still[:, first : first + 1]
        x, y, z = np.moveaxis(away, 2, 0)
        c, s = np.cos(turn)[:, None], np.sin(turn)[:, None]
        swung = np.stack([x, c * y - s * z, s * y + c * z], axis=2)
        still[:, list(limb)] = still[:, first : first + 1] + swung
    assert np.abs(np.diff(still[:, arms], axis=0)).max() > 1.0
    pose = walk.with_samples(still, walk.rotations[:200], walk.confidence[:200])
    assert not Seen(pose, still).wrong.any()


@pytest.mark.parametrize("name", ["left_elbow", "right_wrist", "torso", "left_hip"])
def test_only_who_jumped_is_doubted(walk, places, name):
    joint = walk.joints.index(name)
    away = np.random.default_rng(1).normal(size=(30, 3))
    places[HIDES : HIDES + 30, joint] += 400.0 * away / lengths_of(away)[:, None]
    found = Seen(walk, places)
    assert found.wrong[HIDES : HIDES + 30, joint].all()
    assert found.wrong.sum() == 30


@pytest.mark.parametrize("limb", LIMBS)
def test_somebody_elses_limb_is_doubted_as_a_whole(walk, places, limb):
    limb = list(limb)
    other = walk.positions[200:230]
    there = 0.9 * (other[:, limb] - other[:, :1]) + [700.0, 0.0, 700.0]
    places[HIDES : HIDES + 30, limb] = walk.positions[HIDES : HIDES + 30, :1] + there
    found = Seen(walk, places)
    assert found.wrong[HIDES : HIDES + 30][:, limb].all()
    assert found.wrong.sum() == 30 * len(limb)


@pytest.mark.parametrize("pair", [LIMBS[:2], LIMBS[2:]])
def test_sides_that_changed_places_are_put_back(walk, places, pair):
    a, b = (list(limb) for limb in pair)
    frames = slice(HIDES, HIDES + 80)
    rotations = walk.rotations.copy()
    for values in (places, rotations):
        values[frames, a], values[frames, b] = values[frames, b].copy(), values[frames, a].copy()
    found = Seen(walk.with_samples(walk.positions, rotations, walk.confidence), places)
    assert found.exchanged[frames][:, a + b].all()
    assert found.exchanged.sum() == 80 * len(a + b)
    assert_allclose(found.places, walk.positions)
    assert_allclose(found.rotations, walk.rotations)
    assert not found.wrong.any()


def test_a_hand_for_the_other_is_put_back_and_one_unseen_stays_so(walk, places):
    a, b = (walk.joints.index(f"{side}_wrist") for side in ("left", "right"))
    frames = slice(HIDES, HIDES + 40)
    seen = np.ones(places.shape[:2], dtype=bool)
    places[frames, a], places[frames, b] = places[frames, b].copy(), places[frames, a].copy()
    seen[HIDES + 20 : HIDES + 40, a] = False
    found = Seen(walk, places, seen)
    assert found.exchanged[HIDES : HIDES + 20][:, [a, b]].all()
    # What came as the left one alone is out of the right one's reach.
    assert found.wrong[HIDES + 20 : HIDES + 40, b].all()


@pytest.mark.parametrize(("begins", "lasts"), [(1, 120), (150, 240)])
def test_sides_that_stay_exchanged_are_believed(walk, begins, lasts):
    """After 2 s, and after one if they came otherwise for a moment only."""
    a, b = ([*LIMBS[n], *LIMBS[n + 2]] for n in (0, 1))
    places = np.tile(walk.positions[:1], (450, 1, 1)) + np.arange(450)[:, None, None] * 0.1
    pose = walk.with_samples(
        places, np.tile(walk.rotations[:1], (450, 1, 1)), np.ones(places.shape[:2])
    )
    places = places.copy()
    late = slice(begins, None)
    places[late, a], places[late, b] = places[late, b].copy(), places[late, a].copy()
    found = Seen(pose, places)
    assert found.exchanged[begins : begins + lasts][:, a + b].all()
    assert not found.exchanged[begins + lasts + 1 :].any()
    assert not found.wrong[begins + lasts + 4 :].any()


def test_lengths_that_stay_others_are_believed(walk, places):
    wrist, elbow = (walk.joints.index(f"left_{name}") for name in ("wrist", "elbow"))
    places[50:, wrist] += 0.5 * (places[50:, wrist] - places[50:, elbow])
    found = Seen(walk, places)
    lasts = int(found.wrong[:, wrist].sum())
    assert 0.5 * RATE <= lasts <= 2.0 * RATE
    assert found.wrong[50 : 50 + lasts, wrist].all()
    assert not found.wrong[50 + lasts :].any()


@pytest.mark.parametrize("noise", [0.0, 5.0, 15.0])
def test_a_fault_that_was_there_from_the_beginning_is_overcome(walk, noise):
    places = np.concatenate([walk.positions] * 3)
    random, root = np.random.default_rng(1), walk.order[0]
    places += random.normal(scale=noise, size=places.shape) if noise else 0.0
    pose = walk.with_samples(
        places, np.tile(NO_TURN, (*places.shape[:2], 1)), np.ones(places.shape[:2])
    )
    broken = places.copy()
    broken[:180, root] += 400.0
    found = Seen(pose, broken)
    after = found.wrong[180 + 300 :]
    assert after.any(axis=1).mean() < 0.01


def test_a_root_that_others_are_measured_from_may_stand(walk, places):
    places -= places[:, :1]
    random = np.random.default_rng(1).normal(scale=5.0, size=places[:, 1:].shape)
    places[:, 1:] += random
    pose = walk.with_samples(places, walk.rotations, walk.confidence)
    assert Seen(pose, places).wrong.mean() < 0.001


def test_noise_is_not_forgotten_while_a_pose_comes_again(walk, places):
    places += np.random.default_rng(1).normal(scale=15.0, size=places.shape)
    broken = np.concatenate([places[:100], np.repeat(places[100:101], 700, axis=0), places[101:]])
    pose = walk.with_samples(
        broken, np.tile(NO_TURN, (*broken.shape[:2], 1)), np.ones(broken.shape[:2])
    )
    assert Seen(pose, broken).wrong.mean() < 0.001


def test_one_bad_joint_keeps_no_other_from_being_known(walk, places):
    head, wrist = (walk.joints.index(name) for name in ("head", "left_wrist"))
    random, seen = np.random.default_rng(1), np.ones(places.shape[:2], dtype=bool)
    places[20:, head] += random.normal(scale=400.0, size=(len(places) - 20, 3))
    seen[:100, wrist] = False
    places[250:280, wrist] += 400.0 * np.where(random.random((30, 3)) < 0.5, -1.0, 1.0)
    found = Seen(walk, places, seen)
    assert found.wrong[250:280, wrist].all()


@pytest.mark.parametrize("rate", [10.0, 15.0])
def test_legs_may_pass_each_other_quickly(rate):
    """Whoever swings on as he did is not the other."""
    exchanged = 0
    for phase in np.arange(8) * np.pi / 4.0:
        swing = np.deg2rad(35.0) * np.sin(2.0 * np.pi * np.arange(100) / rate * 1.03 + phase)
        left, right = (2.0 * arm(way * swing).positions for way in (1.0, -1.0))
        left[:, 1:] += [0.0, 0.0, 30.0]
        right[:, 1:] -= [0.0, 0.0, 30.0]
        places = np.stack([left[:, 0], left[:, 1], right[:, 1], left[:, 2], right[:, 2]], axis=1)
        names = ("waist", "left_hip", "right_hip", "left_foot", "right_foot")
        turns = np.tile(NO_TURN, (100, 5, 1))
        found = Seen(Pose(places, turns, names, (-1, 0, 0, 1, 2), rate), places)
        exchanged += int(found.exchanged.any(axis=1).sum())
    assert exchanged <= 4


def test_who_came_far_is_wrong_and_not_who_hangs_on_him(walk):
    """Though the bone that carries him is as long as it was, and turned no faster than one can."""
    hip, knee = (walk.joints.index(f"left_{name}") for name in ("hip", "knee"))
    slow = Pose(walk.positions[::4], walk.rotations[::4], walk.joints, walk.parents, RATE / 4)
    places = slow.positions.copy()
    thigh = places[:, knee] - places[:, hip]
    aside = np.cross(thigh, [0.0, 0.0, 1.0])
    aside *= (lengths_of(thigh) / lengths_of(aside))[:, None]
    places[40, knee] = (places[:, hip] + np.cos(0.6) * thigh + np.sin(0.6) * aside)[40]
    found = Seen(slow, places)
    assert found.wrong[40, knee]
    assert found.wrong.sum() == 1


def test_a_joint_at_zero_in_the_first_pose_is_not_there(walk, places):
    elbow = walk.joints.index("left_elbow")
    places[0, elbow] = 0.0
    found = Seen(walk, places)
    assert found.wrong[0, elbow]
    assert found.wrong.sum() == 1


def test_what_no_number_is_is_not_there(walk, places):
    for value in (np.nan, np.inf, 1e300):
        places[50:60, 5, 1] = value
        found = Seen(walk, places)
        assert found.wrong[50:60, 5].all()
        assert found.wrong.sum() == 10


def test_small_bones_of_a_noisy_sensor_are_not_doubted(walk):
    random = np.random.default_rng(2)
    small = walk.positions * 0.12
    small += random.normal(scale=5.0, size=small.shape)
    pose = walk.with_samples(small, walk.rotations, walk.confidence)
    assert Seen(pose, small).wrong.mean() < 0.002


def test_who_throws_gathers_speed_and_who_jumps_does_not():
    speed = np.concatenate([np.linspace(0.0, 50.0, 40), np.linspace(50.0, 0.0, 40)])
    throw = arm(np.cumsum(np.concatenate([np.ones(60), speed, np.ones(20)])) / RATE)
    assert lengths_of(np.diff(throw.positions[:, 2], axis=0)).max() > 120.0
    assert not Seen(throw, throw.positions).wrong.any()
    jump = arm(np.where(np.arange(100) < 50, 0.0, 0.5) + 1e-3 * np.arange(100))
    found = Seen(jump, jump.positions)
    # What stays there is believed.
    assert found.wrong[50, 2]
    assert not found.wrong[54:].any()
    assert found.wrong.sum() <= 4


@pytest.mark.parametrize("kind", ["vanished", "jumped"])
def test_live_poses_are_as_if_the_sensor_had_told(walk, kind):
    elbow = walk.joints.index("left_elbow")
    frames = slice(HIDES, HIDES + 30)
    broken = walk.positions.copy()
    broken[frames, elbow] = 0.0 if kind == "vanished" else broken[frames, elbow] + 400.0
    told = np.ones(broken.shape[:2], dtype=bool)
    told[frames, elbow] = False
    one = Pose(walk.positions[:1], walk.rotations[:1], walk.joints, walk.parents, walk.rate)
    unsaid, said = Live(one), Live(one)
    for n in range(1, 150):
        given = broken[n], walk.rotations[n]
        places, turns = unsaid(*given, np.ones(len(walk.joints), dtype=bool))
        wanted, wanted_turns = said(*given, told[n])
        assert_allclose(places, wanted, atol=1e-6)
        assert_allclose(turns, wanted_turns, atol=1e-9)
        assert unsaid.wrong[elbow] == (not told[n, elbow])


def test_a_stream_tells_what_it_made_up(walk, tmp_path):
    elbow = walk.joints.index("left_elbow")
    broken = walk.positions[:80].copy()
    broken[50:60, elbow] += [0.0, 400.0, 0.0]
    path = tmp_path / "walk.csv"
    some = walk.with_samples(broken, walk.rotations[:80], walk.confidence[:80])
    mm.write_pose(some, path)
    out = io.StringIO()
    follow(path.read_text().splitlines(True), out.write, rate=RATE, prior=None)
    (tmp_path / "out.csv").write_text(out.getvalue())
    clean = mm.read_pose(tmp_path / "out.csv")
    sure = np.ones((80, len(walk.joints)))
    sure[50:60, elbow] = INFERRED
    assert_allclose(clean.confidence, sure)
    off = lengths_of(clean.positions - walk.positions[:80])
    assert off[50:60, elbow].max() < 60.0


def test_a_stream_tells_what_came_at_the_other_side(walk, tmp_path):
    """Beside a joint that was not seen while the sides had changed places."""
    a, b = (list(limb) for limb in LIMBS[:2])
    broken, sure = walk.positions[:120].copy(), np.ones((120, len(walk.joints)))
    frames = slice(60, 100)
    rotations = walk.rotations[:120].copy()
    for values in (broken, rotations):
        values[frames, a], values[frames, b] = values[frames, b].copy(), values[frames, a].copy()
    came = walk.joints.index("left_elbow")
    hidden = walk.joints.index("right_elbow")
    sure[70:90, came] = 0.0
    path, out = tmp_path / "walk.csv", io.StringIO()
    mm.write_pose(walk.with_samples(broken, rotations, sure), path)
    follow(path.read_text().splitlines(True), out.write, rate=RATE, prior=None)
    (tmp_path / "out.csv").write_text(out.getvalue())
    clean = mm.read_pose(tmp_path / "out.csv")
    wanted = np.ones_like(sure)
    wanted[70:90, hidden] = INFERRED
    assert_allclose(clean.confidence, wanted)
    off = lengths_of(clean.positions - walk.positions[:120])
    assert np.delete(off, hidden, axis=1).max() < 0.01
