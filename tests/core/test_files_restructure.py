"""C3D files with other labels, frames or points than their source keep everything else."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.files.c3d_layout import C3dLayout
from markermend.files.c3d_restructure import copy_restructured, structure_of
from markermend.files.diff import compare
from markermend.files.restructure import add, crop, drop, relabel
from markermend.progress import quiet
from markermend.take import Event

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
FILES = sorted(p for p in SHARED.rglob("*") if p.suffix.lower() == ".c3d" and p.stat().st_size)
LONG = "A new and rather long name"


def layout_of(take: mm.Take) -> C3dLayout:
    assert take.source is not None
    assert isinstance(take.source.layout, C3dLayout)
    return take.source.layout


def changed_records(one: mm.Take, two: mm.Take) -> set[str]:
    """Names of the records that are not byte for byte the same."""
    raws = [
        {f"{r.group}:{r.name}": r.raw for r in reversed(layout_of(take).records)}
        for take in (one, two)
    ]
    return {
        name for name in raws[0].keys() | raws[1].keys() if raws[0].get(name) != raws[1].get(name)
    }


def assert_same_take(back: mm.Take, wanted: mm.Take) -> None:
    """Everything a take holds is there again."""
    assert back.labels == wanted.labels
    assert (back.first_frame, back.rate, back.events) == (
        wanted.first_frame,
        wanted.rate,
        wanted.events,
    )
    np.testing.assert_array_equal(back.positions, wanted.positions)
    if wanted.residuals is not None:
        np.testing.assert_array_equal(back.residuals, wanted.residuals)
        np.testing.assert_array_equal(back.cameras, wanted.cameras)
    assert (back.analog is None) == (wanted.analog is None)
    if back.analog is not None and wanted.analog is not None:
        np.testing.assert_array_equal(back.analog.values, wanted.analog.values)
        assert back.analog.labels == wanted.analog.labels
    assert (back.points is None) == (wanted.points is None)
    if back.points is not None and wanted.points is not None:
        assert back.points.labels == wanted.points.labels
        np.testing.assert_array_equal(back.points.values, wanted.points.values)


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.name)
def test_restructuring_nothing_gives_the_source(path: Path) -> None:
    take = mm.read(path)
    structure = structure_of(take)
    assert structure is not None
    file = io.BytesIO()
    copy_restructured(take, structure, file, quiet, as_float=False, notes={})
    assert file.getvalue() == path.read_bytes()


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.name)
def test_only_what_must_change_does(path: Path, tmp_path: Path) -> None:
    take = mm.read(path)
    if take.markers < 3 or take.frames < 12 or not layout_of(take).strings("POINT", "UNITS"):
        pytest.skip("too small to take apart, or of guessed units")
    target = tmp_path / "out.c3d"
    fresh = np.full((take.frames, 3), np.nan)
    fresh[: take.frames // 2] = layout_of(take).scale * np.array([100.0, 200.0, 300.0])
    frames = {f"POINT:{n}" for n in ("FRAMES", "LONG_FRAMES")} | {
        f"TRIAL:ACTUAL_{n}_FIELD" for n in ("START", "END")
    }
    points = {"POINT:LABELS", "POINT:USED", "POINT:DESCRIPTIONS", "POINT:DATA_START"}
    changes: tuple[tuple[Callable[[mm.Take], mm.Take], set[str]], ...] = (
        (lambda t: relabel(t, {t.labels[0]: LONG}), {"POINT:LABELS", "POINT:DATA_START"}),
        (lambda t: crop(t, 3, t.frames - 4), frames),
        (lambda t: drop(t, [t.labels[1]]), points),
        (lambda t: add(t, "NEW", fresh), points),
    )
    # The last record of some files points nowhere, or wrongly; another behind it needs a way.
    last = layout_of(take).records[-1]
    for change, allowed in changes:
        wanted = change(take)
        mm.write(wanted, target)
        back = mm.read(target)
        # A file of metres or integers holds the new marker as exactly as it can.
        if "NEW" in wanted:
            np.testing.assert_allclose(
                back.positions[:, -1], wanted.positions[:, -1], atol=1e-3 + take.source.scale_mm / 2
            )
            wanted, back = drop(wanted, ["NEW"]), drop(back, ["NEW"])
        assert_same_take(back, wanted)
        differing = changed_records(take, mm.read(target))
        assert differing <= allowed | {f"{last.group}:{last.name}"}


def test_order_of_several_changes_at_once(shared_data: Path, tmp_path: Path) -> None:
    source = shared_data / "gait/PiG_Motion-FlatFoot-Full.c3d"
    take = mm.read(source)
    wanted = crop(
        drop(relabel(take, {"LASI": "RASI", "RASI": "LASI"}), ["LFHD", "LHipAngles"]), 10, 200
    )
    positions = wanted.positions.copy()
    positions[5, 3, 1] += 2.0
    positions[6, 4] = np.nan
    wanted = wanted.with_positions(positions, wanted.origin.copy())
    done = mm.write(wanted, tmp_path / "out.c3d")
    assert done.samples == 2
    back = mm.read(tmp_path / "out.c3d")
    assert back.labels == wanted.labels
    np.testing.assert_allclose(back.positions, wanted.positions, rtol=1e-6)
    assert back.first_frame == take.first_frame + 10
    assert back.events == take.events
    np.testing.assert_array_equal(back.analog.values, wanted.analog.values)


def test_float_from_integer(shared_data: Path, tmp_path: Path) -> None:
    ezc3d = pytest.importorskip("ezc3d")
    for name in ("formats/Eb015vi.c3d", "formats/Eb015pi.c3d", "gait/gait-pig.c3d"):
        take = mm.read(shared_data / name)
        positions = take.positions.copy()
        positions[3, 2, 1] = 12345.678
        edited = take.with_positions(positions, take.origin.copy())
        done = mm.write(edited, tmp_path / "float.c3d", as_float=True)
        assert done.samples == 1
        back = mm.read(tmp_path / "float.c3d")
        assert back.info["storage"] == "32-bit floats"
        np.testing.assert_allclose(back.positions, positions, rtol=1e-6)
        np.testing.assert_allclose(back.residuals, take.residuals, rtol=1e-6)
        np.testing.assert_array_equal(back.cameras, take.cameras)
        np.testing.assert_allclose(back.analog.values, take.analog.values, rtol=1e-6)
        assert changed_records(take, back) == {"POINT:SCALE"}
        theirs = ezc3d.c3d(str(tmp_path / "float.c3d"))["data"]["points"]
        assert theirs[1, take.source.columns[2], 3] == pytest.approx(12345.678)


def test_changed_events_replace_both_lists(shared_data: Path, tmp_path: Path) -> None:
    for name in ("formats/pc_int.c3d", "gait/PiG_Motion-FlatFoot-Full.c3d"):
        take = mm.read(shared_data / name)
        events = (*take.events[1:], Event("Foot Strike", 99.0, "Left"))
        mm.write(replace(take, events=events), tmp_path / "out.c3d")
        back = mm.read(tmp_path / "out.c3d")
        assert [(e.label, e.context) for e in back.events] == [(e.label, e.context) for e in events]
        assert_same_take(replace(back, events=take.events), take)


def test_record_of_what_was_done(shared_data: Path, tmp_path: Path) -> None:
    source = shared_data / "gait/PiG_Motion-FlatFoot-Full.c3d"
    take = mm.read(source)
    positions, origin = take.positions.copy(), take.origin.copy()
    positions[8, 2, 0] += 3.0
    origin[8, 2] = mm.Origin.EDITED
    edited = take.with_positions(positions, origin)
    first = mm.write(edited, tmp_path / "one.c3d", record=["C7 x 156 spline"], mark_outputs=True)
    assert "LHipAngles" in first.outputs
    again = mm.write(mm.read(tmp_path / "one.c3d"), tmp_path / "two.c3d", record=["nothing more"])
    assert again.samples == 0
    layout = layout_of(mm.read(tmp_path / "two.c3d"))
    assert layout.strings("MARKERMEND", "CHANGES") == ("C7 x 156 spline", "nothing more")
    assert layout.strings("MARKERMEND", "VERSION") == (mm.__version__,)
    assert "LHipAngles" in layout.strings("MARKERMEND", "STALE_OUTPUTS")
    found = compare(source, tmp_path / "two.c3d")
    assert {p.name.partition(":")[0] for p in found.parameters} <= {"MARKERMEND", "POINT"}
    assert [(s.marker, s.axes, s.start, s.stop) for s in found.samples] == [
        (take.labels[2], "x", 156, 157)
    ]


def test_record_in_a_new_file(shared_data: Path, tmp_path: Path) -> None:
    take = mm.read(shared_data / "trc/exampleFormat.trc")
    mm.write(take, tmp_path / "new.c3d", record=["marker1 1 pchip"])
    layout = layout_of(mm.read(tmp_path / "new.c3d"))
    assert layout.strings("MARKERMEND", "CHANGES") == ("marker1 1 pchip",)


def test_outputs_of_other_subjects_still_match(shared_data: Path, tmp_path: Path) -> None:
    take = mm.read(shared_data / "gait/PiG_Motion-FlatFoot-Full.c3d")
    done = mm.write(take, tmp_path / "same.c3d")
    assert done.outputs == ()


def test_what_cannot_be_done_is_said(shared_data: Path) -> None:
    take = mm.read(shared_data / "bodies/85_02.c3d")
    with pytest.raises(mm.DataError, match="no marker called"):
        relabel(take, {"NOBODY": "X"})
    with pytest.raises(mm.DataError, match="unique"):
        relabel(take, {take.labels[0]: take.labels[1]})
    with pytest.raises(mm.DataError, match="not a part"):
        crop(take, 5, 5)
    with pytest.raises(mm.DataError, match="no point called"):
        drop(take, ["NOBODY"])
    with pytest.raises(mm.DataError, match="marker of this take"):
        add(take, "NEW", np.zeros((3, 3)))


@pytest.mark.parametrize(
    "name",
    ["gait/PiG_Motion-FlatFoot-Hole.c3d", "formats/pc_int.c3d", "formats/Eb015vr.c3d",
     "gait/Walking_Hybrid_2.c3d", "gait/Qualisys.c3d"],
)  # fmt: skip
def test_other_readers_read_restructured_files(
    shared_data: Path, tmp_path: Path, name: str
) -> None:
    ezc3d, c3d = pytest.importorskip("ezc3d"), pytest.importorskip("c3d")
    take = mm.read(shared_data / name)
    wanted = crop(relabel(drop(take, [take.labels[1]]), {take.labels[0]: LONG}), 5, 60)
    path = tmp_path / "out.c3d"
    mm.write(wanted, path, record=["a line"])
    back = mm.read(path)
    assert back.labels == wanted.labels
    theirs = ezc3d.c3d(str(path))
    columns = list(back.source.columns)
    points = np.transpose(theirs["data"]["points"], (2, 1, 0))[:, columns, :3]
    seen = wanted.present
    np.testing.assert_allclose(points[seen], wanted.positions[seen], rtol=1e-6, atol=1e-5)
    assert theirs["parameters"]["POINT"]["LABELS"]["value"][columns[0]] == LONG
    assert theirs["parameters"]["MARKERMEND"]["CHANGES"]["value"] == ["a line"]
    np.testing.assert_allclose(
        theirs["data"]["analogs"][0].T, wanted.analog.values, rtol=1e-6, atol=1e-5
    )
    with path.open("rb") as handle:
        frame = next(c3d.Reader(handle).read_frames())
    np.testing.assert_allclose(
        frame[1][columns, :3][seen[0]], wanted.positions[0][seen[0]], rtol=1e-6, atol=1e-5
    )
