"""Takes in the containers of other libraries, there and back."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.exchange import from_ezc3d, from_kineticstoolkit, from_xarray, to_dataframe
from markermend.take import Origin, Take


@pytest.fixture
def take() -> Take:
    """Two people, gaps, repaired samples, a first frame other than 1."""
    rng = np.random.default_rng(3)
    positions = rng.normal(0, 500, (40, 5, 3))
    positions[10:20, 2] = np.nan
    origin = (~np.isnan(positions[:, :, 0])).astype(np.uint8)
    origin[30:, 1] = Origin.EDITED
    labels = ("Ann:HEAD", "Ann:KNEE", "Bob:HEAD", "Bob:TOE", "*7")
    return Take(positions, labels, 119.88, 301, origin=origin)


def same(a: Take, b: Take) -> None:
    """Assert that two takes hold the same."""
    assert a.labels == b.labels
    assert a.rate == pytest.approx(b.rate)
    assert a.first_frame == b.first_frame
    np.testing.assert_allclose(a.positions, b.positions, rtol=0, atol=1e-9)


def test_movement_layout_has_subjects_as_individuals(take: Take) -> None:
    data = take.to_xarray()

    assert data.position.dims == ("time", "space", "keypoints", "individuals")
    assert list(data.individuals.values) == ["Ann", "Bob", "individual_0"]
    knee = data.position.sel(individuals="Ann", keypoints="KNEE")
    np.testing.assert_array_equal(knee.values, take.positions[:, 1])
    assert np.isnan(data.position.sel(individuals="Bob", keypoints="KNEE")).all()
    assert data.attrs["fps"] == take.rate
    assert float(data.time[1]) == pytest.approx(1 / take.rate)


def test_movement_layout_comes_back(take: Take) -> None:
    back = Take.from_xarray(take.to_xarray())

    same(back, take)
    np.testing.assert_array_equal(back.origin, take.origin)


def test_a_marker_of_one_body_that_is_never_seen_is_kept() -> None:
    positions = np.zeros((5, 2, 3))
    positions[:, 1] = np.nan
    back = from_xarray(Take(positions, ("A", "B"), 100.0).to_xarray())

    assert back.labels == ("A", "B")
    assert not back.present[:, 1].any()


def test_pyomeca_layout_comes_back(take: Take) -> None:
    data = take.to_xarray("pyomeca")

    assert data.dims == ("axis", "channel", "time")
    assert (data.sel(axis="ones") == 1).all()
    same(from_xarray(data), take)


def test_metres_become_millimetres() -> None:
    data = Take(np.ones((4, 2, 3)), ("A", "B"), 50.0).to_xarray("pyomeca")
    data.attrs["units"] = "m"

    assert (from_xarray(data).positions == 1000.0).all()


def test_arrays_that_are_no_takes_are_refused(take: Take) -> None:
    with pytest.raises(mm.DataError, match="not known"):
        from_xarray(take.to_xarray("pyomeca").isel(time=0))
    with pytest.raises(mm.DataError, match="three dimensions"):
        from_xarray(take.to_xarray().isel(space=slice(2)))
    uneven = take.to_xarray("pyomeca").isel(time=[0, 1, 5, 6])
    del uneven.attrs["rate"]
    with pytest.raises(mm.DataError, match="evenly"):
        from_xarray(uneven)
    unknown = take.to_xarray()
    unknown.attrs["units"] = "furlongs"
    with pytest.raises(mm.DataError, match="furlongs"):
        from_xarray(unknown)


def test_wide_and_long_tables_hold_every_sample(take: Take) -> None:
    wide, long = take.to_dataframe(), take.to_dataframe("long")

    np.testing.assert_array_equal(wide["Bob:TOE", "y"].to_numpy(), take.positions[:, 3, 1])
    assert len(long) == take.frames * take.markers
    row = long[(long.marker == "Ann:KNEE") & (long.frame == 301 + 35)].iloc[0]
    assert row.x == take.positions[35, 1, 0]
    assert row.origin == "edited"
    assert row.time == pytest.approx(35 / take.rate)


def test_layouts_that_do_not_exist_are_named(take: Take) -> None:
    with pytest.raises(mm.MethodError, match="wide, long"):
        to_dataframe(take, "tall")  # type: ignore[arg-type]
    with pytest.raises(mm.MethodError, match="movement, pyomeca"):
        take.to_xarray("tall")  # type: ignore[arg-type]


def test_without_the_extra_one_sentence_says_how_to_get_it(
    take: Take, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)

    with pytest.raises(mm.MethodError, match=r'pip install "markermend\[tables\]"'):
        take.to_xarray()


@dataclass
class Series:
    """What a Kinetics Toolkit TimeSeries has: time, data, info and events."""

    time: np.ndarray
    data: dict[str, np.ndarray]
    info: dict[str, dict[str, str]] = field(default_factory=dict)
    events: list[object] = field(default_factory=list)


def test_kinetics_toolkit_table_and_series(take: Take) -> None:
    table = take.to_dataframe("kineticstoolkit")
    data = {s: table[[f"{s}[{i}]" for i in range(4)]].to_numpy() for s in take.labels}
    assert (data["Ann:HEAD"][:, 3] == 1).all()
    assert np.isnan(data["Bob:HEAD"][10:20]).all()

    time = 300 / take.rate + table.index.to_numpy()
    back = from_kineticstoolkit(Series(time, data, {"Ann:HEAD": {"Unit": "m"}}))
    same(back, take)


def test_series_without_points_are_refused() -> None:
    with pytest.raises(mm.DataError, match="no points"):
        from_kineticstoolkit(Series(np.arange(3.0), {"force": np.zeros(3)}))


@pytest.mark.parametrize("name", ["gait/Vicon.c3d", "bodies/03_rolling.c3d"])
def test_what_ezc3d_holds_is_what_we_read(shared_data: Path, name: str) -> None:
    ezc3d = pytest.importorskip("ezc3d")
    path = shared_data / name
    theirs, ours = from_ezc3d(ezc3d.c3d(str(path))), mm.read(path)

    assert theirs.labels == ours.labels
    assert theirs.rate == pytest.approx(ours.rate)
    assert theirs.first_frame == ours.first_frame
    np.testing.assert_allclose(theirs.positions, ours.positions, rtol=1e-6, atol=1e-3)
    assert (theirs.points is None) == (ours.points is None)
    if ours.points is not None and theirs.points is not None:
        assert theirs.points.labels == ours.points.labels
        assert theirs.points.units == ours.points.units


def test_something_else_than_ezc3d_is_refused() -> None:
    with pytest.raises(mm.DataError, match="ezc3d"):
        from_ezc3d({"header": {}})


def test_what_is_printed_says_what_it_is(take: Take) -> None:
    assert repr(take) == "<Take 40 frames at 119.88 Hz (0.3 s), 5 markers, 95.0% seen>"
    flaw = mm.Artifact("Ann:KNEE", "xz", 3, 9, mm.Kind.STEP, 0.97, 41.2)
    assert repr(flaw) == "<step Ann:KNEE.xz [3, 9), 41.2 mm, 97% sure, pending>"
    session = mm.Session(take)
    session.mark(flaw)
    assert repr(session) == f"<Session of {take!r}: 1 pending, 1 steps>"
    assert repr(mm.infer_mesh(take)).startswith("<Mesh of 5 markers in ")


@pytest.mark.parametrize("layout", ["movement", "pyomeca"])
@pytest.mark.parametrize("labels", [("A", "B"), ("Ann:A", "Bob:A"), ()])
def test_takes_without_frames_or_markers(layout: str, labels: tuple[str, ...]) -> None:
    empty = Take(np.empty((0, len(labels), 3)), labels, 100.0, 7)
    same(from_xarray(empty.to_xarray(layout)), empty)
