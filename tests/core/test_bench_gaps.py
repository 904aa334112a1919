"""Replaying gap lists: what is hidden is what is measured."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from markermend.bench.gap_protocols import PROTOCOLS, draw_cases, named_methods
from markermend.bench.gaps import read_cases, replay, summarise
from markermend.bench.gaps_text import gaps_csv, gaps_table
from markermend.errors import Cancelled, DataError, FileFormatError, MethodError
from markermend.repairs import REPAIRS
from markermend.take import Take


@pytest.fixture
def ramps() -> Take:
    t = np.arange(100.0)[:, None, None]
    return Take(
        t * np.array([[[1.0, 2.0, 0.0]], [[0.0, -1.0, 3.0]]]).reshape(1, 2, 3), ("A", "B"), 100.0
    )


def write_list(folder: Path, *entries: object) -> Path:
    path = folder / "gaps.json"
    path.write_text(json.dumps(entries))
    return path


ENTRY = {
    "take": "ramps", "protocol": "p", "length": 10, "gaps": [["A", 20, 30], ["B", 50, 60]],
    "pma_mm": 2.0,
}  # fmt: skip


def test_a_line_hides_nothing_from_linear(tmp_path: Path, ramps: Take) -> None:
    cases = read_cases(write_list(tmp_path, ENTRY))
    (result,) = replay(cases, {"ramps": ramps}, ["linear"])
    assert result.error_mm < 1e-9
    assert result.filled == 1.0
    (row,) = summarise([result])
    assert row.reference_mm == 2.0
    assert row.ratio < 1e-9
    assert "linear" in gaps_table([row])[1]


def test_an_unfilled_frame_counts_three_times_the_reference(tmp_path: Path, ramps: Take) -> None:
    entry = {**ENTRY, "gaps": [["A", 20, 30], ["B", 90, 100]]}
    (result,) = replay(read_cases(write_list(tmp_path, entry)), {"ramps": ramps}, ["linear"])
    assert result.filled == 0.5
    (row,) = summarise([result])
    assert row.error_mm == pytest.approx(3.0)


def test_csv_has_a_line_for_each_case_and_method(tmp_path: Path, ramps: Take) -> None:
    cases = read_cases(write_list(tmp_path, ENTRY, ENTRY))
    results = replay(cases, {"ramps": ramps}, ["linear", "pchip"])
    assert len(gaps_csv(results).splitlines()) == 5


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_drawn_cases_repeat_by_seed_and_fit_the_take(protocol: str) -> None:
    rng = np.random.default_rng(0)
    take = Take(rng.normal(size=(900, 8, 3)), tuple("ABCDEFGH"), 100.0)
    cases = draw_cases({"t": take}, protocol, simulations=2, seed=3)
    assert cases == draw_cases({"t": take}, protocol, simulations=2, seed=3)
    assert cases != draw_cases({"t": take}, protocol, simulations=2, seed=4)
    for case in cases:
        for marker, start, stop in case.gaps:
            assert marker in take
            assert 0 <= start < stop <= take.frames
            assert (start == 0 or stop == take.frames) == (protocol == "ends")
    counts = {len(c.gaps) for c in cases}
    wanted = {
        "skurowski2021": {2}, "tits2018": {3}, "tits2018-duration": {3},
        "tits2018-count": {1, 3, 6}, "single": {1}, "blackout": {take.markers},
        "ends": {1, 3},
    }  # fmt: skip
    assert counts == wanted[protocol]


def test_only_a_fragment_is_used_where_durations_are_compared() -> None:
    t = np.arange(1500.0)[:, None, None]
    take = Take(t * np.ones((1, 4, 3)) + np.arange(4.0)[:, None], tuple("ABCD"), 100.0)
    cases = draw_cases({"t": take}, "tits2018-duration", simulations=2, seed=0)
    assert [c.within and c.within[1] - c.within[0] for c in cases] == [500, 500, 1000, 1000]
    for case in cases:
        assert case.within is not None
        for _, start, stop in case.gaps:
            assert case.within[0] < start < stop < case.within[1]
    assert all(r.error_mm < 1e-9 for r in replay(cases, {"t": take}, ["linear"]))


def test_a_paper_stands_for_all_that_it_compares() -> None:
    names = named_methods(["skurowski2021", "pma", "linear", "tits2018"])
    assert len(names) == len(set(names)) == 10 + 9
    assert {"lstm", "gru", "bilstm", "ffnn_lin", "bolero", "pma_no_pca"} <= set(names)
    assert set(names) <= set(REPAIRS)


def test_results_do_not_depend_on_the_number_of_processes(ramps: Take) -> None:
    cases = draw_cases({"t": ramps}, "skurowski2021", simulations=2, seed=0)
    one = replay(cases, {"t": ramps}, ["pchip", "spline"])
    two = replay(cases, {"t": ramps}, ["pchip", "spline"], n_jobs=2)
    assert [(r.case, r.method, r.gap_rmse_mm) for r in one] == [
        (r.case, r.method, r.gap_rmse_mm) for r in two
    ]


def test_replaying_can_be_cancelled(ramps: Take) -> None:
    def stop(share: float, what: str) -> None:
        raise Cancelled

    cases = draw_cases({"t": ramps}, "skurowski2021", simulations=2, seed=0)
    with pytest.raises(Cancelled):
        replay(cases, {"t": ramps}, ["pchip"], progress=stop)


def test_parameters_reach_the_method_they_are_for(ramps: Take) -> None:
    cases = draw_cases({"t": ramps}, "skurowski2021", simulations=1, seed=0)
    with pytest.raises(MethodError, match="no parameter"):
        replay(cases, {"t": ramps}, ["pchip"], params={"pchip": {"nonsense": 1}})


def test_in_a_blackout_nothing_is_seen(ramps: Take) -> None:
    cases = draw_cases({"t": ramps}, "blackout", simulations=2, seed=0)
    # Those of 0.1 to 0.5 s fit into a second.
    assert {c.length for c in cases} == {10, 20, 50}
    for case in cases:
        assert {g[0] for g in case.gaps} == {"A", "B"}
        assert len({g[1:] for g in case.gaps}) == 1


def test_without_a_reference_there_is_no_ratio(ramps: Take) -> None:
    cases = draw_cases({"t": ramps}, "skurowski2021", simulations=1, seed=0)
    rows = summarise(replay(cases, {"t": ramps}, ["linear"]), None)
    assert all(np.isnan(r.ratio) and r.rmse_mm < 1e-9 for r in rows)
    assert "ratio" not in gaps_table(rows, None)[0]


def test_gaps_over_what_was_never_seen_are_refused(tmp_path: Path, ramps: Take) -> None:
    positions = ramps.positions.copy()
    positions[25, 0] = np.nan
    cases = read_cases(write_list(tmp_path, ENTRY))
    with pytest.raises(DataError, match="nothing to compare"):
        replay(cases, {"ramps": Take(positions, ramps.labels, ramps.rate)})


def test_wrong_lists_are_errors(tmp_path: Path, ramps: Take) -> None:
    with pytest.raises(FileFormatError):
        read_cases(write_list(tmp_path, {"take": "ramps"}))
    entry = {k: v for k, v in ENTRY.items() if k != "pma_mm"}
    results = replay(read_cases(write_list(tmp_path, entry)), {"ramps": ramps}, ["linear"])
    with pytest.raises(DataError, match="pma"):
        summarise(results)
