"""The take, its patches and its labels."""

from __future__ import annotations

import pickle
from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.arrays import runs
from markermend.artifact import Artifact, Kind, Status, damage_mask
from markermend.errors import DataError
from markermend.patch import Patch, apply_patch, patched
from markermend.take import Origin, Take, is_unlabelled


def make_take() -> Take:
    positions = np.arange(30 * 2 * 3, dtype=np.float64).reshape(30, 2, 3)
    positions[10:14, 1] = np.nan
    info = MappingProxyType({"manufacturer": "none"})
    return Take(positions, ("S:LHEE", "S:RHEE"), 100.0, first_frame=7, info=info)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"positions": np.zeros((3, 2))}, "frames, markers, 3"),
        ({"labels": ("A",)}, "2 trajectories but 1 labels"),
        ({"labels": ("A", "A")}, "unique"),
        ({"rate": 0.0}, "rate must be positive"),
        ({"rate": float("nan")}, "rate must be positive"),
        ({"origin": np.zeros((3, 1), dtype=np.uint8)}, "Origin must be"),
        ({"positions": [[["a", "b", "c"]]]}, "must be numbers"),
        ({"positions": np.full((3, 2, 3), np.inf)}, "must be finite"),
        ({"labels": "AB"}, "must be texts"),
        ({"labels": (1, 2)}, "must be texts"),
        ({"rate": "100"}, "rate must be positive"),
        ({"labels": None}, "must be texts"),
        ({"residuals": np.ones((3, 3), dtype=np.float32)}, "Residuals must be"),
        ({"cameras": [[1]]}, "Cameras must be"),
        ({"first_frame": 1.5}, "whole number"),
    ],
)
def test_what_does_not_fit_together_is_refused(change, says):
    values = {"positions": np.zeros((3, 2, 3)), "labels": ("A", "B"), "rate": 100.0}
    with pytest.raises(DataError, match=says):
        Take(**(values | change))


def test_labels_may_be_a_list():
    assert Take(np.zeros((3, 2, 3)), ["A", "B"], 100).labels == ("A", "B")


def test_half_a_sample_is_refused():
    positions = np.zeros((3, 1, 3))
    positions[1, 0, 2] = np.nan
    with pytest.raises(DataError, match="all three"):
        Take(positions, ("A",), 100.0)


def test_samples_are_read_only_and_frames_numbered_as_in_the_file():
    take = make_take()
    with pytest.raises(ValueError, match="read-only"):
        take.positions[0, 0, 0] = 1.0
    assert take.frame_number(0) == 7
    assert (take.origin[10:14, 1] == Origin.MISSING).all()
    assert take.subjects == ("S",)
    with pytest.raises(DataError, match="NOPE"):
        take.index("NOPE")


def test_a_take_goes_to_another_process_whole():
    take = make_take()
    again = pickle.loads(pickle.dumps(take))
    assert again.positions.tobytes() == take.positions.tobytes()
    assert (again.labels, again.rate, again.first_frame, dict(again.info)) == (
        take.labels,
        take.rate,
        take.first_frame,
        dict(take.info),
    )
    assert not again.positions.flags.writeable


@pytest.mark.parametrize("label", ["*12", "S:*3", "Unlabeled 7", "U_12", "unnamed", ""])
def test_trajectories_without_a_name(label):
    assert is_unlabelled(label)


@pytest.mark.parametrize("label", ["LHEE", "S:USP", "U1L", "LUPA", "Unit3x"])
def test_trajectories_with_a_name(label):
    assert not is_unlabelled(label)


axes_of = st.sampled_from(["x", "y", "z", "xy", "xz", "yz", "xyz"])


@given(st.integers(0, 8), st.integers(1, 10), axes_of, st.floats(-1e6, 1e6))
def test_a_patch_changes_its_place_only_and_its_inverse_restores_it(start, length, axes, value):
    take = make_take()
    positions, origin = take.positions.copy(), take.origin.copy()
    patch = Patch("S:LHEE", axes, start, start + length, np.full((length, len(axes)), value))
    inverse = apply_patch(positions, origin, 0, patch)
    changed = positions != take.positions
    changed &= ~np.isnan(take.positions)
    allowed = np.zeros_like(changed)
    allowed[start : start + length, 0, ["xyz".index(a) for a in axes]] = True
    assert not (changed & ~allowed).any()
    apply_patch(positions, origin, 0, inverse)
    assert positions.tobytes() == take.positions.tobytes()
    assert origin.tobytes() == take.origin.tobytes()


def test_filling_one_axis_of_a_missing_sample_is_refused():
    take = make_take()
    with pytest.raises(DataError, match="half missing"):
        patched(take, [Patch("S:RHEE", "x", 10, 14, np.zeros((4, 1)))])


def test_rejected_artifacts_do_not_count_as_damage():
    take = make_take()
    kept = Artifact("S:LHEE", "y", 3, 6, Kind.NOISE)
    rejected = Artifact("S:LHEE", "xyz", 20, 25, Kind.NOISE, status=Status.REJECTED)
    mask = damage_mask(take, [kept, rejected])
    assert mask.sum() == 3
    assert mask[3:6, 0, 1].all()


@given(st.lists(st.booleans(), max_size=60))
def test_runs_are_what_they_cover(values):
    mask = np.array(values, dtype=bool)
    again = np.zeros_like(mask)
    for start, stop in runs(mask):
        assert start < stop
        again[start:stop] = True
    assert (again == mask).all()


@pytest.mark.parametrize("axes", ["", "zx", "xx", "w"])
def test_strange_axes_are_refused(axes):
    with pytest.raises(DataError, match="Axes"):
        Artifact("A", axes, 0, 1, Kind.PEAK)


def test_what_a_take_was_made_of_cannot_change_it():
    larger = np.zeros((6, 2, 3))
    take = Take(larger[1:], ("A", "B"), 100.0)
    larger[1] = 77.0
    assert (take.positions == 0.0).all()
    with pytest.raises(ValueError, match="read-only"):
        take.present[0, 0] = False
