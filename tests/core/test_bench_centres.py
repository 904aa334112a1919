"""Joint centres from markers, as an experiment."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.bench.centres import NO_GROUPS, centres, centres_csv, centres_table
from markermend.errors import MethodError
from markermend.simulation import simulate_clean, simulate_motion


def test_bones_are_those_under_the_markers() -> None:
    settings = {"duration_s": 5.0, "rate": 50.0, "seed": 3, "height_m": 1.6}
    take, motion = simulate_clean(**settings), simulate_motion(**settings)
    knee = take.positions[:, [take.index("LKNE"), take.index("LKNM")]].mean(axis=1)
    assert np.linalg.norm(knee - motion.origins["Lshank"], axis=1).max() < 30.0
    with pytest.raises(MethodError, match="lasts 1 s"):
        simulate_motion(duration_s=0.5)


def test_joints_are_held_against_where_they_are() -> None:
    rows = centres(simulations=2, duration_s=30.0, seed=4)
    assert len(rows) == 2 * (2 + 2 * 6)
    found = [row for row in rows if not row.left_out]
    assert len(found) > 10
    assert all(row.off_mm < 60.0 and row.doubt_mm > 0 for row in found)
    assert np.median([row.off_mm for row in found if row.joint == "hip"]) < 20.0
    assert {row.left_out for row in rows if row.joint == "wrist"} == {NO_GROUPS}
    assert rows[:14] == centres(simulations=1, duration_s=30.0, seed=4)
    table = centres_table(rows)
    assert [line.split()[0] for line in table[4:]][:2] == ["neck", "spine"]
    assert len(centres_csv(rows).splitlines()) == 1 + len(rows)


def test_senseless_settings_are_refused() -> None:
    with pytest.raises(MethodError, match="At least one"):
        centres(simulations=0)
