"""The joint detector on what raw takes are full of: slow sides, camera switches, stray jumps."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from sudden import hurt, sudden

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.artifact_json import artifacts_of
from markermend.bench.e2 import Reviewed, e2
from markermend.detectors.joint import JointParams
from markermend.detectors.joint.jumps import Jumps
from markermend.detectors.joint.steps import pair_jumps
from markermend.detectors.joint.texture import stand_out, texture_mm
from markermend.simulation import simulate_clean
from markermend.take import Take


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=10.0, rate=120.0, seed=5)


@pytest.mark.parametrize("rate", [60.0, 120.0, 250.0])
@pytest.mark.parametrize("builds_up", [True, False])
def test_a_jump_with_a_slow_side_is_one_artifact(rate, builds_up):
    take = simulate_clean(duration_s=6.0, rate=rate, seed=5)
    length, start = round(0.08 * rate), round(3.0 * rate)
    ramp = 20.0 * np.arange(1, length + 1) / length
    (a,) = sudden(hurt(take, "LWRA", 1, start, ramp if builds_up else ramp[::-1]))
    assert (a.marker, a.axes, a.kind) == ("LWRA", "y", Kind.STEP)
    assert abs(a.start - start) <= (0.3 * length if builds_up else 0)
    assert abs(a.stop - start - length) <= (0 if builds_up else 0.3 * length)
    assert a.amplitude_mm == pytest.approx(20.0, rel=0.25)
    assert ("jumps back" if builds_up else "slides back") in a.why


def test_a_slow_side_may_end_where_the_marker_is_lost(performer):
    take = hurt(performer, "RKNE", 0, 600, 15.0 * np.arange(8, 0, -1) / 8)
    positions = take.positions.copy()
    positions[608:640, take.index("RKNE")] = np.nan
    (a,) = sudden(Take(positions, take.labels, take.rate))
    assert (a.start, a.axes) == (600, "x")
    assert 604 <= a.stop <= 608


def test_jumps_far_apart_with_rivals_between_are_no_step():
    def jumps(frames, sizes):
        n = len(frames)
        zero = np.zeros(n, dtype=np.int64)
        return Jumps(zero, np.array(frames), zero, np.array(sizes), np.full(n, 8.0))

    assert [p[:2] for p in pair_jumps(jumps([100, 260], [5.0, -5.0]), 100.0)] == [(0, 1)]
    crowded = pair_jumps(jumps([100, 150, 200, 240, 260], [5.0, -4.9, 4.0, -4.1, -5.0]), 100.0)
    assert sorted(p[:2] for p in crowded) == [(0, 1), (2, 3)]
    assert pair_jumps(jumps([100, 260], [5.0, -5.0]), 100.0, {0}) == []


def test_a_take_full_of_small_jumps_has_a_texture():
    take = simulate_clean(duration_s=6.0, rate=120.0, seed=5)
    rng = np.random.default_rng(0)

    def spread(sizes):
        return [
            Artifact(take.labels[i % 20], "x", 5 * i, 5 * i + 1, Kind.PEAK, amplitude_mm=float(s))
            for i, s in enumerate(sizes)
        ]

    falling = spread(1.0 + rng.exponential(1.2, 200))
    of_a_size = spread(np.abs(rng.normal(5.0, 2.0, 200)))
    level = texture_mm(falling, take)
    assert level == 2.0
    assert texture_mm(of_a_size, take) == 0.0
    assert texture_mm(falling[:20], take) == 0.0
    small, large = spread([2.0, 8.0])
    left = stand_out([small, large], level, 0.0)
    assert left[0].confidence == pytest.approx(0.5)
    assert left[1].confidence > 0.99
    assert stand_out([small, large], level, 0.6) == [left[1]]
    assert stand_out([small], 0.0, 0.6) == [small]


@pytest.mark.parametrize(
    ("name", "approved", "rejected", "missed"),
    [
        ("bodies/03_rolling", 275, 40, 75),
        ("gait/test_walking", 40, 15, 40),
        ("props/walkingOptiTrack", 27, 3, 6),
    ],
)
def test_flags_on_reviewed_raw_takes_are_mostly_right(
    shared_data, name, approved, rejected, missed
):
    path = shared_data / f"{name}.c3d"
    listed = json.loads(
        (Path(__file__).with_name("reviewed") / f"{path.stem}.json").read_text("utf-8")
    )
    reviewed = Reviewed(
        path.stem, mm.read(path), artifacts_of(listed), float(listed["complete_from_mm"])
    )
    (row,) = e2([reviewed], methods=["joint"], params={"joint": JointParams(slow=False)})
    assert row.approved >= approved
    assert row.rejected <= rejected
    assert row.missed <= missed
