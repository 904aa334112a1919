"""The camera of the 3D view and the room it looks into."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.arrays import runs
from markermend.artifact import Artifact, Kind
from markermend.review.file import open_session
from markermend.take import Take
from markermend.vertical import vertical_axis
from markermend_app.panels.scene.camera import Camera
from markermend_app.panels.scene.follow import lost_frames
from markermend_app.panels.scene.stage import centre_at, reach_of, set_stage


def test_target_is_in_the_middle_and_up_is_up():
    for up in range(3):
        camera = Camera(target=(10.0, 20.0, 30.0), up=up)
        above = np.array(camera.target)
        above[up] += 100.0
        at = camera.project(np.array([camera.target, above]), 400, 300)
        np.testing.assert_allclose(at[0], (200, 150), atol=1e-9)
        assert at[1, 1] < 150
        assert at[1, 0] == pytest.approx(200, abs=1e-6)


@given(st.floats(-7, 7), st.floats(-1.5, 1.5), st.integers(0, 2))
@settings(max_examples=40, deadline=None)
def test_axes_are_a_right_handed_frame(yaw, pitch, up):
    axes = Camera(yaw=yaw, pitch=pitch, up=up).axes()
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1.0)


def test_nearer_things_are_larger_and_those_behind_are_gone():
    camera = Camera(distance=1000.0, yaw=0.0, pitch=0.0)
    back = camera.axes()[2]
    near, far, behind = back * 500, -back * 500, back * 1200
    up = np.array([0.0, 0.0, 50.0])
    at = camera.project(np.array([near + up, far + up, behind]), 400, 300)
    assert 150 - at[0, 1] > 150 - at[1, 1] > 0
    assert np.isnan(at[2]).all()


def test_segments_are_cut_at_the_near_plane():
    camera = Camera(distance=1000.0, yaw=0.0, pitch=0.0)
    back = camera.axes()[2]
    start = np.array([np.zeros(3), back * 1500, [np.nan] * 3])
    stop = np.array([back * 1500, back * 2000, np.zeros(3)])
    ends = camera.segments(start, stop, 400, 300)
    assert np.isfinite(ends[0]).all()
    assert np.isnan(ends[1]).any()
    assert np.isnan(ends[2]).any()


def test_panning_keeps_the_target_under_the_pointer():
    camera = Camera(distance=2000.0)
    moved = camera.panned(30.0, -20.0, 300)
    at = moved.project(np.array([camera.target]), 400, 300)
    np.testing.assert_allclose(at[0], (230, 130), atol=1e-6)


# Stage


@pytest.mark.parametrize("up", [1, 2])
def test_vertical_axis_of_a_walking_body(up):
    rng = np.random.default_rng(2)
    body = rng.uniform((-250, -200, 0), (250, 200, 1750), (30, 3))
    way = np.zeros((200, 1, 3))
    way[:, 0, 0] = np.linspace(-3000, 3000, 200)
    positions = body + way
    if up == 1:
        positions = positions[:, :, [1, 2, 0]]
    assert vertical_axis(positions) == up


def test_amid_a_gap_the_middle_goes_evenly_from_where_the_body_is_seen_to_where_it_is_next():
    positions = np.arange(3000.0)[:, None, None] * np.ones((1, 2, 3))
    none = np.zeros(3000, dtype=bool)
    positions[200:900] = np.nan
    assert centre_at(positions, 100, [0, 1], none)[0] == 100
    middles = [centre_at(positions, frame, [0], none)[0] for frame in range(195, 905)]
    np.testing.assert_allclose(middles, range(195, 905), atol=3)
    assert max(np.diff(middles)) < 1.1
    assert np.isnan(centre_at(np.full((40, 2, 3), np.nan), 7, [0, 1], none[:40])).all()
    # Nobody waits for a whole recording to be looked through.
    positions[200:] = np.nan
    assert np.isnan(centre_at(positions, 2900, [0, 1], none)).all()


def test_lost_frames_do_not_say_where_the_middle_is():
    positions = np.arange(300.0)[:, None, None] * np.ones((1, 2, 3))
    lost = np.zeros(300, dtype=bool)
    lost[100:150] = True
    positions[lost] += 5000.0
    middles = [centre_at(positions, frame, [0, 1], lost)[0] for frame in range(300)]
    np.testing.assert_allclose(middles, range(300), atol=3)
    # At the end of a recording there is nothing to go to.
    lost[100:] = True
    assert centre_at(positions, 250, [0, 1], lost)[0] == pytest.approx(99, abs=3)


def test_one_marker_is_seen_with_its_way():
    way = np.zeros((300, 1, 3))
    way[:, 0, 0] = np.linspace(0, 200, 300)
    assert reach_of(Take(way, ("A",), 100.0), [0]) == pytest.approx(100, rel=0.02)
    assert reach_of(Take(20 * way, ("A",), 100.0), [0]) == 300
    assert reach_of(Take(0 * way, ("A",), 100.0), [0]) >= 10
    # Beside others that are never seen, too.
    with_unseen = Take(np.concatenate((np.full_like(way, np.nan), way), 1), ("B", "A"), 100.0)
    assert reach_of(with_unseen, [0, 1]) == pytest.approx(100, rel=0.02)


def test_stage_of_an_empty_take_stands():
    set_stage(Take(np.zeros((5, 0, 3)), (), 100.0))
    stage = set_stage(Take(np.full((5, 2, 3), np.nan), ("A", "B"), 100.0))
    assert np.isfinite(stage.middle).all()
    assert stage.radius > 0
    assert stage.unit > 0


def test_frames_in_which_most_of_what_is_seen_is_wrong_are_lost(document):
    session = document.session
    labels = session.original.labels
    document.decisions.remove([a.id for a in session.artifacts])
    gaps = [Artifact(m, "xyz", 140, 150, Kind.GAP) for m in labels]
    # Of the eight markers the first is missing from frame 60 to 90.
    places = ((labels[:4], 100, 120), (labels[:5], 200, 210), (labels[1:5], 60, 90))
    steps = [Artifact(m, "xyz", i, j, Kind.STEP) for some, i, j in places for m in some]
    document.decisions.add_detected([*gaps, *steps], "test")
    assert runs(lost_frames(session, range(8))).tolist() == [[60, 90], [200, 210]]
    document.decisions.accept([a.id for a in session.artifacts if a.start == 60])
    document.decisions.reject([a.id for a in session.artifacts if a.start == 200])
    assert runs(lost_frames(session, range(8))).tolist() == [[60, 90]]


def test_a_body_that_is_wrong_for_long_is_followed_all_the_same(tmp_path):
    take = Take(np.zeros((1000, 2, 3)), ("A", "B"), 100.0)
    session = open_session(take, folder=tmp_path).session
    flags = [Artifact(m, "xyz", 100, stop, Kind.NOISE) for m, stop in (("A", 700), ("B", 550))]
    session.add_detected(flags, "test")
    assert runs(lost_frames(session, [1])).tolist() == [[100, 550]]
    assert not lost_frames(session, [0]).any()
