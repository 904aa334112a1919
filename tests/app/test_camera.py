"""The camera of the 3D view and the room it looks into."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.take import Take
from markermend.vertical import vertical_axis
from markermend_app.panels.scene.camera import Camera
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


def test_amid_a_gap_the_middle_is_where_the_body_is_seen_next():
    positions = np.arange(3000.0)[:, None, None] * np.ones((1, 2, 3))
    positions[200:900] = np.nan
    assert centre_at(positions, 100, [0, 1])[0] == 100
    assert centre_at(positions, 300, [0])[0] == 199
    assert centre_at(positions, 700, [0, 1])[0] == 900
    assert np.isnan(centre_at(np.full((40, 2, 3), np.nan), 7, [0, 1])).all()
    # Nobody waits for a whole recording to be looked through.
    positions[200:] = np.nan
    assert np.isnan(centre_at(positions, 2900, [0, 1])).all()


def test_one_marker_is_seen_with_its_way():
    way = np.zeros((300, 1, 3))
    way[:, 0, 0] = np.linspace(0, 200, 300)
    assert reach_of(Take(way, ("A",), 100.0), [0]) == pytest.approx(100, rel=0.02)
    assert reach_of(Take(20 * way, ("A",), 100.0), [0]) == 300
    assert reach_of(Take(0 * way, ("A",), 100.0), [0]) >= 10


def test_stage_of_an_empty_take_stands():
    set_stage(Take(np.zeros((5, 0, 3)), (), 100.0))
    stage = set_stage(Take(np.full((5, 2, 3), np.nan), ("A", "B"), 100.0))
    assert np.isfinite(stage.middle).all()
    assert stage.radius > 0
    assert stage.unit > 0
