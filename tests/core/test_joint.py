"""The joint detector: what it finds, to the frame, and what it leaves alone."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sudden import hurt, sudden

import markermend as mm
from markermend.artifact import Kind, damage_mask
from markermend.artifact_json import artifacts_of
from markermend.detectors.joint import JointParams
from markermend.detectors.joint.jumps import Jumps
from markermend.detectors.joint.steps import pair_jumps
from markermend.errors import Cancelled, MethodError
from markermend.simulation import Amounts, contaminate, damage, simulate_clean
from markermend.take import Take

REVIEWED = Path(__file__).with_name("reviewed")


@pytest.fixture(scope="module")
def performer():
    return simulate_clean(duration_s=10.0, rate=120.0, seed=5)


@pytest.mark.parametrize("rate", [100.0, 120.0, 240.0])
def test_a_clean_performance_is_left_alone(rate):
    assert sudden(simulate_clean(duration_s=8.0, rate=rate, seed=1)) == []


@pytest.mark.parametrize("length", [1, 2, 4])
def test_a_peak_is_found_to_the_frame(performer, length):
    (a,) = sudden(hurt(performer, "LWRA", 1, 500, np.full(length, 8.0)))
    assert (a.marker, a.axes, a.start, a.stop) == ("LWRA", "y", 500, 500 + length)
    assert a.kind is Kind.PEAK
    assert a.amplitude_mm == pytest.approx(8.0, abs=1.0)
    assert "sticks out" in a.why


@pytest.mark.parametrize("length", [10, 18, 60, 150])
def test_a_step_is_found_to_the_frame(performer, length):
    (a,) = sudden(hurt(performer, "RKNE", 2, 400, np.full(length, -6.0)))
    assert (a.marker, a.axes, a.start, a.stop) == ("RKNE", "z", 400, 400 + length)
    assert a.kind is Kind.STEP
    assert a.amplitude_mm == pytest.approx(6.0, abs=1.0)
    assert "comes back" in a.why


def test_heavy_noise_is_found(performer):
    jitter = 5.0 * np.random.default_rng(0).standard_normal(50)
    (a,) = sudden(hurt(performer, "C7", 0, 700, jitter))
    assert (a.marker, a.axes, a.kind) == ("C7", "x", Kind.NOISE)
    assert abs(a.start - 700) <= 2
    assert abs(a.stop - 750) <= 2
    assert a.amplitude_mm == pytest.approx(5.0, rel=0.3)


def test_axes_hurt_together_are_one_artifact(performer):
    take = hurt(performer, "LTOE", 0, 300, np.full(30, 12.0))
    take = hurt(take, "LTOE", 2, 300, np.full(30, -5.0))
    (a,) = sudden(take)
    assert (a.marker, a.axes, a.start, a.stop, a.kind) == ("LTOE", "xz", 300, 330, Kind.STEP)
    assert a.amplitude_mm == pytest.approx(13.0, abs=1.0)


def test_a_jump_of_the_whole_body_is_no_artifact_of_its_markers(performer):
    positions = performer.positions.copy()
    positions[600:640] += [0.0, 0.0, 3.0]
    moved = Take(positions, performer.labels, performer.rate)
    alone = hurt(performer, "LFHD", 2, 600, np.full(40, 3.0))
    assert sudden(alone)[0].confidence > 0.7
    together = [a.confidence for a in sudden(moved, sensitivity=1.0) if a.kind is Kind.STEP]
    assert max(together, default=0.0) < sudden(alone)[0].confidence


def test_nothing_is_made_of_gaps(performer):
    positions = performer.positions.copy()
    rng = np.random.default_rng(3)
    for marker in range(0, performer.markers, 3):
        start = int(rng.integers(20, performer.frames - 120))
        positions[start : start + int(rng.integers(1, 80)), marker] = np.nan
    assert sudden(Take(positions, performer.labels, performer.rate)) == []


def test_a_peak_next_to_a_gap_is_found(performer):
    positions = performer.positions.copy()
    positions[500:530, 4] = np.nan
    positions[496, 4, 1] += 25.0
    found = sudden(Take(positions, performer.labels, performer.rate))
    assert [(a.start, a.stop, a.axes) for a in found] == [(496, 497, "y")]


@pytest.mark.parametrize("edge", ["begin", "end", "before a gap", "after a gap"])
@pytest.mark.parametrize(
    ("kind", "length"), [("peak", 1), ("peak", 4), ("step", 10), ("step", 25), ("noise", 14)]
)
def test_damage_in_the_first_and_last_frames_is_found(edge, kind, length, performer):
    positions, truth = performer.positions.copy(), []
    rng = np.random.default_rng(2)
    gap = (500, 540)
    for marker, away in enumerate((0, 1, 2, 3, 5, 9)):
        column = 7 * marker
        if edge in ("begin", "after a gap"):
            start = away + (gap[1] if edge == "after a gap" else 0)
        else:
            start = (gap[0] if edge == "before a gap" else performer.frames) - away - length
        high = np.full(length, 20.0) if kind != "noise" else 20.0 * rng.standard_normal(length)
        positions[start : start + length, column, marker % 3] += high
        if "gap" in edge:
            positions[gap[0] : gap[1], column] = np.nan
        truth.append((performer.labels[column], "xyz"[marker % 3], kind, start, start + length))
    found = sudden(Take(positions, performer.labels, performer.rate))
    if kind != "noise":
        assert sorted((a.marker, a.axes, a.kind.value, a.start, a.stop) for a in found) == sorted(
            truth
        )
        return
    for label, axis, _, start, stop in truth:
        (a,) = (a for a in found if a.marker == label)
        assert (a.axes, a.kind) == (axis, Kind.NOISE)
        both = min(a.stop, stop) - max(a.start, start)
        assert both >= 0.5 * (max(a.stop, stop) - min(a.start, start))


def test_a_frame_at_an_edge_that_may_be_wrong_by_itself_takes_back_only_what_is_as_large():
    nothing = np.zeros(2, dtype=np.int64)

    def paired(back):
        two = Jumps(nothing, np.array([10, 40]), nothing, np.array([5.0, back]), np.full(2, 20.0))
        return [p[:2] for p in pair_jumps(two, 100.0, (), {1})]

    assert paired(-5.5) == [(0, 1)]
    assert paired(-6.5) == []


def test_a_step_cut_off_by_a_gap_is_found(performer):
    positions = performer.positions.copy()
    positions[500:540, 4] += [0.0, 18.0, 0.0]
    positions[540:560, 4] = np.nan
    (a,) = sudden(Take(positions, performer.labels, performer.rate))
    assert (a.start, a.stop, a.axes, a.kind) == (500, 540, "y", Kind.STEP)
    assert "beside a gap" in a.why


@pytest.mark.parametrize("off", [[12.0, 3.0, -2.0], [4.2, -4.2, 4.2]])
def test_a_step_cut_off_by_a_gap_is_named_on_all_its_axes(off, performer):
    positions = performer.positions.copy()
    positions[500:520, 4] += off
    positions[520:540, 4] = np.nan
    (a,) = sudden(Take(positions, performer.labels, performer.rate))
    assert (a.start, a.stop, a.axes, a.kind) == (500, 520, "xyz", Kind.STEP)
    assert a.amplitude_mm == pytest.approx(np.linalg.norm(off), abs=1.0)


@pytest.mark.parametrize(("size", "found"), [(18.0, 0), (40.0, 1)])
def test_a_gap_long_after_a_jump_explains_it_only_when_a_marker_is_clearly_off(
    size, found, performer
):
    positions = performer.positions.copy()
    positions[500:600, 4] += [0.0, size, 0.0]
    positions[600:620, 4] = np.nan
    flags = sudden(Take(positions, performer.labels, performer.rate))
    assert [(a.start, a.stop) for a in flags] == [(500, 600)] * found


def test_a_marker_that_falls_off_before_the_end_is_found(performer):
    end = performer.frames
    (a,) = sudden(hurt(performer, "LTOE", 2, end - 60, np.full(60, -30.0)))
    assert (a.start, a.stop, a.axes, a.kind) == (end - 60, end, "z", Kind.STEP)


def test_a_swap_is_one_artifact_with_both_names(performer):
    positions = performer.positions.copy()
    a, b = performer.index("LFHD"), performer.index("RFHD")
    positions[500:560, [a, b]] = positions[500:560, [b, a]]
    found = sudden(Take(positions, performer.labels, performer.rate))
    swap = next(x for x in found if x.counterpart)
    assert {swap.marker, swap.counterpart} == {"LFHD", "RFHD"}
    assert (swap.start, swap.stop, swap.axes) == (500, 560, "xyz")


@pytest.mark.parametrize("kind", ["swaps", "swaps_of_three", "brief_swaps", "swaps_with_gap"])
def test_swaps_of_every_sort_are_found_and_taken_back(kind):
    clean = simulate_clean(duration_s=12.0, rate=120.0, seed=41)
    nothing = dict.fromkeys(Amounts.__dataclass_fields__, 0.0)
    damaged, truth = damage(clean, amounts=Amounts(**(nothing | {kind: 16.0})), seed=3)
    found = sudden(damaged)
    assert {(frozenset(a.markers), a.start, a.stop) for a in found} == {
        (frozenset(a.markers), a.start, a.stop) for a in truth if a.counterpart
    }
    repaired = mm.repair(damaged, found)
    seen = repaired.present
    assert np.array_equal(repaired.positions[seen], clean.positions[seen])


def test_names_mixed_up_where_markers_were_lost_are_a_swap(performer):
    positions = performer.positions.copy()
    a, b = performer.index("LWRA"), performer.index("LWRB")
    positions[500:560, [a, b]] = positions[500:560, [b, a]]
    positions[495:506, b] = np.nan
    positions[498:500, a] = np.nan
    found = sudden(Take(positions, performer.labels, performer.rate))
    assert [(x.markers, x.start, x.stop) for x in found] == [(("LWRA", "LWRB"), 500, 560)]


def test_a_peak_onto_another_marker_is_no_swap(performer):
    positions = performer.positions.copy()
    a, b = performer.index("LWRA"), performer.index("LWRB")
    positions[500, a] = positions[500, b]
    (found,) = sudden(Take(positions, performer.labels, performer.rate))
    assert (found.marker, found.kind, found.counterpart) == ("LWRA", Kind.PEAK, None)


@pytest.mark.parametrize(
    ("kind", "many", "words"),
    [
        ("ghosts", 10.0, "inside a gap"),
        ("frozen", 8.0, "repeats one position"),
        ("falls", 5.0, "fell off"),
        ("peaks_on_drifts", 10.0, "sticks out"),
    ],
)
def test_what_no_pair_of_jumps_shows_is_found_and_explained(kind, many, words):
    clean = simulate_clean(duration_s=20.0, rate=120.0, seed=142)
    nothing = dict.fromkeys(Amounts.__dataclass_fields__, 0.0)
    damaged, truth = damage(clean, amounts=Amounts(**(nothing | {kind: many})), seed=2)
    found = sudden(damaged)
    wanted = [a for a in truth if a.kind not in (Kind.GAP, Kind.SLOW)]
    hit = [
        b
        for a in wanted
        for b in found
        if b.marker == a.marker and abs(a.start - b.start) <= 1 and abs(a.stop - b.stop) <= 1
    ]
    assert len(hit) >= len(wanted) - 1 > 0
    assert all(words in b.why for b in hit)
    assert len(found) == len(hit)


def test_a_marker_by_itself_has_no_neighbours_to_be_told_of(performer):
    column = performer.index("LWRA")
    positions = performer.positions[:, [column]].copy()
    positions[300:302, 0] += 60.0
    (found,) = sudden(Take(positions, ("LWRA",), performer.rate))
    assert "neighbours" not in found.why
    assert "times its usual scatter" in found.why


def test_after_a_frozen_stretch_the_marker_is_where_it_should_be(performer):
    positions = performer.positions.copy()
    a, end = performer.index("LWRA"), performer.frames
    away = np.linalg.norm(positions[end - 100, a] - positions[end - 140 : end - 100, a], axis=1)
    start = end - 140 + int(away.argmax())
    positions[start : end - 100, a] = positions[start - 1, a]
    found = sudden(Take(positions, performer.labels, performer.rate))
    assert [(x.marker, x.start, x.stop) for x in found] == [("LWRA", start, end - 100)]
    assert away.max() > 10.0


def test_samples_that_rest_repeat_and_are_left_alone(performer):
    still = np.round(performer.positions, 1)
    still[300:420] = still[300]
    take = Take(still[::2], performer.labels, 60.0)
    frozen = [a for a in sudden(take) if "repeats" in a.why]
    assert {a.marker for a in frozen} == set(take.labels)
    assert all("the recording stands still" in a.why for a in frozen)
    # Nothing shows that this one would tremble at rest.
    pushed = still[0] + np.maximum(np.arange(300) - 150, 0)[:, None, None] * [3.0, 0.0, 0.0]
    assert not any("repeats" in a.why for a in sudden(Take(pushed, performer.labels, 60.0)))
    resting = np.repeat(still[:1], 300, axis=0)
    assert sudden(Take(resting, performer.labels, 60.0)) == []


def test_a_stray_piece_in_its_place_is_left_alone(performer):
    positions = performer.positions.copy()
    a = performer.index("LKNE")
    positions[500:540, a] = positions[546:590, a] = np.nan
    assert sudden(Take(positions, performer.labels, performer.rate)) == []


def test_sensitivity_only_adds(performer):
    damaged, _ = contaminate(performer, share=0.05, amplitude_mm=1.0, seed=4)
    counts = [
        int(damage_mask(damaged, sudden(damaged, sensitivity=s)).sum()) for s in (0.1, 0.5, 0.95)
    ]
    assert counts[0] <= counts[1] <= counts[2]
    assert counts[0] < counts[2]


@settings(max_examples=5, deadline=None)
@given(
    st.tuples(*[st.floats(-1e4, 1e4) for _ in range(3)]),
    st.permutations([0, 1, 2]),
)
def test_origin_and_order_of_axes_do_not_matter(shift, order):
    take = simulate_clean(duration_s=4.0, seed=2, labels=("LFHD", "RFHD", "C7", "LSHO", "RSHO"))
    take = hurt(take, "C7", 1, 200, np.full(20, 9.0))
    moved = Take(take.positions[:, :, list(order)] + np.array(shift), take.labels, take.rate)
    (here,), (there,) = sudden(take), sudden(moved)
    assert (here.start, here.stop, here.kind) == (there.start, there.stop, there.kind)
    assert "xyz"[order.index(1)] == there.axes
    assert there.confidence == pytest.approx(here.confidence, abs=1e-6)


def test_most_of_a_contamination_is_found(performer):
    damaged, truth = contaminate(
        performer, share=0.05, amplitude_mm=10.0, kinds=("peak", "noise", "step"), seed=8
    )
    hit = damage_mask(damaged, sudden(damaged))
    true = damage_mask(damaged, truth)
    assert (hit & true).sum() >= 0.97 * true.sum()
    assert (hit & ~true).sum() <= 0.02 * true.sum()


def test_it_can_be_stopped(performer):
    def stop(share, doing):
        raise Cancelled

    with pytest.raises(Cancelled):
        mm.detect(performer, method="joint", params=JointParams(slow=False), progress=stop)


def test_parameters_are_checked():
    with pytest.raises(MethodError, match="sensitivity"):
        JointParams(sensitivity=1.5)


def test_a_take_without_named_markers_has_nothing_to_find():
    positions = np.cumsum(np.ones((60, 1, 3)), axis=0)
    assert sudden(Take(positions, ("*1",), 100.0)) == []


@pytest.mark.parametrize(("start", "stop"), [(0, 50), (1150, 1200)])
def test_a_small_step_that_an_end_of_the_take_cuts_off_is_found(performer, start, stop):
    assert performer.frames >= 1200
    take = Take(performer.positions[:1200], performer.labels, performer.rate)
    damaged = hurt(take, "C7", 1, start, np.full(stop - start, 4.0))
    assert [(a.marker, a.axes, a.start, a.stop, a.kind) for a in sudden(damaged)] == [
        ("C7", "y", start, stop, Kind.STEP)
    ]


def test_a_raw_take_has_no_artifact_twice(shared_data):
    found = sudden(mm.read(shared_data / "gait" / "test_walking.c3d"))
    assert len({a.id for a in found}) == len(found) > 0


@pytest.mark.parametrize("name", ["85_02", "85_12", "HDM_mm_01-02_03_120"])
def test_real_takes_raise_no_false_alarm(shared_data, name):
    take = mm.read(shared_data / "bodies" / f"{name}.c3d")
    flaws = artifacts_of(json.loads((REVIEWED / f"{name}.json").read_text("utf-8")))
    known = damage_mask(take, flaws).any(axis=2)

    # Nor does what is flagged reach beyond what is listed.
    assert not (damage_mask(take, sudden(take)).any(axis=2) & ~known).any()
