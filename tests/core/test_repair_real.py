"""The local regression on hidden pieces of real takes, against what others reached there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import BAND_90
from markermend.repairs import evidence_for, propose_from
from markermend.repairs.body_frame import rank_references
from markermend.take import Take, is_unlabelled

BENCH = Path(__file__).resolve().parents[3] / "shared" / "bench" / "gaps-dev.json"


def labelled(path: Path) -> Take:
    take = mm.read(path)
    named = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    return Take(take.positions[:, named], tuple(take.labels[i] for i in named), take.rate)


@pytest.fixture(scope="module")
def replayed(shared_data: Path) -> dict[str, list[tuple[float, float, float, float]]]:
    """Error of ours, of PMA and of the spline, share of frames in the 90 % band."""
    if not BENCH.is_file():
        pytest.skip(f"the gap list is not here ({BENCH})")
    takes: dict[str, Take] = {}
    results: dict[str, list[tuple[float, float, float, float]]] = {}
    entries = json.loads(BENCH.read_text())
    short = [e for e in entries if e["length"] <= 10]
    for entry in short + [e for e in entries if 10 < e["length"] <= 240][::7]:
        name = entry["take"]
        if name not in takes:
            takes[name] = labelled(next(shared_data.rglob(f"{name}.c3d")))
        truth = takes[name].positions
        holed = truth.copy()
        for label, start, stop in entry["gaps"]:
            holed[start:stop, takes[name].index(label)] = np.nan
        evidence = evidence_for(Take(holed, takes[name].labels, takes[name].rate))
        errors, inside = [], []
        for label, start, stop in entry["gaps"]:
            done = propose_from(evidence, Artifact(label, "xyz", start, stop, Kind.GAP))
            (patch,) = done.patches
            miss = patch.values - truth[start:stop, takes[name].index(label)]
            errors.append(np.linalg.norm(miss, axis=1).mean())
            assert done.band_mm is not None
            inside.append(np.linalg.norm(miss, axis=1) <= BAND_90 * done.band_mm)
        row = (np.mean(errors), entry["pma_mm"], entry["spline_mm"], np.concatenate(inside).mean())
        kind = "short" if entry in short else "long"
        results.setdefault(kind, []).append(row)
    return results


def test_ours_has_at_most_half_the_error_of_model_averaging(
    replayed: dict[str, list[tuple[float, float, float, float]]],
) -> None:
    ours, pma, *_ = np.mean(replayed["long"], axis=0)
    assert ours < 0.47 * pma


def test_short_gaps_are_at_least_as_good_as_the_spline(
    replayed: dict[str, list[tuple[float, float, float, float]]],
) -> None:
    ours, _, spline, _ = np.mean(replayed["short"], axis=0)
    assert ours <= spline


def test_a_90_percent_band_holds_about_nine_frames_in_ten(
    replayed: dict[str, list[tuple[float, float, float, float]]],
) -> None:
    inside = np.mean([row[3] for row in replayed["long"] + replayed["short"]])
    assert 0.85 < inside < 0.95


@pytest.mark.parametrize("name", ["bodies/AlbertoINT.c3d", "gait/Vicon.c3d"])
def test_filling_leaves_every_measured_sample_alone(shared_data: Path, name: str) -> None:
    take = mm.read(shared_data / name)
    gaps = mm.repairs.find_gaps(take, max_gap=20)[:10]
    clean = mm.repair(take, gaps)
    kept = take.present
    assert np.array_equal(clean.positions[kept], take.positions[kept])
    assert clean.present.sum() >= take.present.sum()


@pytest.mark.parametrize(("marker", "start", "stop"), [("LELB", 900, 1020), ("RKNE", 3000, 3060)])
def test_value_and_velocity_go_on_at_both_borders_and_lengths_stay(
    shared_data: Path, marker: str, start: int, stop: int
) -> None:
    take = labelled(shared_data / "bodies" / "85_12.c3d")
    column = take.index(f"Male:{marker}")
    positions = take.positions.copy()
    positions[start:stop, column] = np.nan
    evidence = evidence_for(Take(positions.copy(), take.labels, take.rate))
    gap = Artifact(take.labels[column], "xyz", start, stop, Kind.GAP)
    positions[start:stop, column] = propose_from(evidence, gap).patches[0].values
    # A jump of value or velocity is a second difference of its own size.
    usual = np.abs(np.diff(take.positions[start - 120 : stop + 120, column], n=2, axis=0)).max()
    for edge in (start, stop):
        bend = np.abs(np.diff(positions[edge - 3 : edge + 3, column], n=2, axis=0)).max()
        assert bend < 1.25 * usual + 0.3
    nearest, _ = rank_references(take, take.present, column, slice(0, take.frames))
    for other in nearest[:3]:
        length = np.linalg.norm(positions[:, column] - positions[:, other], axis=1)
        outside = np.delete(length, np.arange(start, stop))
        low, high = outside.min(), outside.max()
        assert low - 2.0 < length[start:stop].min()
        assert length[start:stop].max() < high + 2.0
