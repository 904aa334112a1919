"""TRC and CSV, in and out, and which reader a file gets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import markermend as mm
from markermend.files.axes import vertical_of, with_vertical
from markermend.files.labels import unique_labels

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
REFUSED = {"Empty.trc": "empty", "Truncated.trc": "cut short"}
FILES = sorted(p for p in (SHARED / "trc").glob("*.trc") if p.name not in REFUSED)
# Frames, markers, rate and samples seen, counted from the files with other tools.
KNOWN = {
    "dataWithEformat.trc": (5, 14, 119.88012, 70),
    "dataWithNaNsOfDifferentCases.trc": (5, 14, 250.0, 65),
    "exampleFormat.trc": (5, 3, 100.0, 13),
    "gait10dof18musc_walk_CRLF_line_ending.trc": (10, 41, 60.0, 410),
    "markers_walk.trc": (238, 41, 100.0, 238 * 41),
    "Anto.trc": (128, 34, 100.0, 128 * 34),
}


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.name)
def test_trc_survives_every_format(path: Path, tmp_path: Path) -> None:
    take = mm.read(path)
    assert take.source is not None
    assert take.source.format == "trc"
    if path.name in KNOWN:
        assert (take.frames, take.markers, take.rate, take.present.sum()) == KNOWN[path.name]
    for name in ("out.trc", "out.csv", "out.c3d"):
        mm.write(take, tmp_path / name)
        back = mm.read(tmp_path / name)
        assert back.warnings == ()
        assert back.labels == take.labels
        assert back.rate == pytest.approx(take.rate, rel=1e-6)
        assert back.first_frame == take.first_frame
        np.testing.assert_allclose(back.positions, take.positions, rtol=1e-6, atol=2e-6)


@pytest.mark.parametrize("name", sorted(REFUSED))
def test_trc_that_cannot_be_read(shared_data: Path, name: str) -> None:
    with pytest.raises(mm.FileFormatError, match=REFUSED[name]) as caught:
        mm.read(shared_data / "trc" / name)
    assert name in str(caught.value)


def test_trc_values(shared_data: Path) -> None:
    take = mm.read(shared_data / "trc/exampleFormat.trc")
    assert take.labels == ("marker1", "marker2", "marker3")
    np.testing.assert_allclose(take.positions[1, 0], [-273.0, 74.5, -1570.0])
    assert not take.present[0, 0]
    assert not take.present[2, 1]
    spaces = mm.read(shared_data / "trc/markers_walk.trc")
    np.testing.assert_allclose(spaces.positions[0, 0], [-652.630, 1529.542, -94.520])


def test_trc_cut_short_opens_to_look_at(shared_data: Path, tmp_path: Path) -> None:
    lines = (shared_data / "trc/markers_walk.trc").read_text().split("\n")
    (tmp_path / "cut.trc").write_text("\n".join(lines[:100]))
    take = mm.read(tmp_path / "cut.trc")
    assert take.read_only
    assert any("238 frames" in w and "94 are present" in w for w in take.warnings)


def test_csv_of_other_programs(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    path.write_text("Time;LASI_X (m);LASI_Y (m);LASI_Z (m)\n0,00;0,1;0,2;0,3\n0,01;;;\n")
    take = mm.read(path)
    assert take.labels == ("LASI",)
    assert take.rate == 100.0
    np.testing.assert_allclose(take.positions[0, 0], [100.0, 200.0, 300.0])
    assert not take.present[1, 0]
    path.write_text("A.x,A.y,A.z\n1,2,three\n4,5,6\n")
    take = mm.read(path)
    assert not take.present[0, 0]
    assert any("no numbers" in w for w in take.warnings)
    assert any("100 Hz" in w for w in take.warnings)
    for text, said in (("a,b\n1,2\n", "no marker"), ("A.x,A.y,A.z\n", "cut short"), ("", "empty")):
        path.write_text(text)
        with pytest.raises(mm.FileFormatError, match=said):
            mm.read(path)


def test_content_decides_not_the_name(shared_data: Path, tmp_path: Path) -> None:
    for source, name in (
        ("bodies/85_02.c3d", "take.trc"),
        ("trc/exampleFormat.trc", "take.csv"),
        ("trc/exampleFormat.trc", "take.dat"),
    ):
        (tmp_path / name).write_bytes((shared_data / source).read_bytes())
        take = mm.read(tmp_path / name)
        assert take.source is not None
        assert take.source.format == source.rpartition(".")[2]
    (tmp_path / "noise.bin").write_bytes(bytes(range(256)))
    with pytest.raises(mm.FileFormatError, match="unknown kind"):
        mm.read(tmp_path / "noise.bin")
    with pytest.raises(mm.ExportError, match="should end in"):
        mm.write(take, tmp_path / "out.xyz")


@given(st.binary(max_size=400))
def test_any_bytes_are_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, raw: bytes
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.trc"
    for head in (
        b"",
        b"PathFileType\t4\nDataRate\tNumMarkers\tUnits\n100\t1\tmm\nF\tT\tA\n\n1\t0\t",
    ):
        path.write_bytes(head + raw)
        try:
            mm.read(path)
        except mm.FileFormatError as error:
            said = str(error)
            assert "\n" not in said


def test_vertical_axis_only_when_asked(shared_data: Path) -> None:
    take = mm.read(shared_data / "gait/test_walking.c3d")
    assert vertical_of(take) == "z"
    assert with_vertical(take, "z") is take
    turned = with_vertical(take, "y")
    np.testing.assert_array_equal(turned.positions[..., 1], take.positions[..., 2])
    np.testing.assert_array_equal(with_vertical(turned, "z").positions, take.positions)
    lengths = [np.linalg.norm(np.diff(t.positions, axis=1), axis=2) for t in (take, turned)]
    np.testing.assert_allclose(*lengths)
    with pytest.raises(mm.DataError, match="say which"):
        with_vertical(mm.read(shared_data / "bodies/85_02.c3d"), "y")


@given(st.lists(st.sampled_from(["", "A", "A_2", "A_2_2", "*1", "*2", "B"]), max_size=12))
def test_labels_become_unique(stated: list[str]) -> None:
    labels, repeated = unique_labels(stated, len(stated) + 1)
    assert len(labels) == len(set(labels)) == len(stated) + 1
    assert all(labels)
    assert set(repeated) == {name for name in stated if name and stated.count(name) > 1}
    for name in set(stated) - {""}:
        assert labels[stated.index(name)] == name


@pytest.mark.parametrize(
    ("rows", "seen"),
    [
        ("1,0.00\n2,0.01\n5,0.04\n6,0.05", "##..##"),
        (",0.000\n,0.010\n,0.020\n,0.050\n,0.060", "###..##"),
        ("1,0.00\n3,0.02\n5,0.04\n9,0.08", "###.#"),
        ("1,0.00\n2,0.00\n3,0.01\n4,0.02", "####"),
        (",0.00\n,0.01\n,0.02\n,0.03\n,0.04\n,0.06\n,0.07", "#######"),
        ("4,0.04\n3,0.03\n2,0.02\n1,0.01", "####"),
        ("inf,0.000\ninf,0.010\n-inf,0.020\n1e308,0.050", "###..#"),
        ("-1e308,\n1e308,\n,", "###"),
    ],
)
def test_rows_that_are_missing_are_gaps(tmp_path: Path, rows: str, seen: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text("frame,time,A.x,A.y,A.z\n" + "".join(f"{r},1,2,3\n" for r in rows.split()))
    take = mm.read(path)
    assert "".join("#" if x == x else "." for x in take.positions[:, 0, 0]) == seen
    said = [w for w in take.warnings if "rows are missing" in w]
    assert said == (
        [f"{seen.count('.')} rows are missing; their frames were read as gaps."] * bool("." in seen)
    )
    if said:
        assert take.rate == (50.0 if "9" in rows else 100.0)


@pytest.mark.parametrize("numbers", ["1 2 3 900000000", "1 2 3 9 10 4 5 6"])
def test_rows_that_cannot_be_placed_are_read_one_after_the_other(
    tmp_path: Path, numbers: str
) -> None:
    path, frames = tmp_path / "a.csv", numbers.split()
    path.write_text(
        "frame,time,A.x,A.y,A.z\n" + "".join(f"{f},{int(f) / 100},1,2,3\n" for f in frames)
    )
    take = mm.read(path)
    assert take.frames == len(frames)
    assert take.rate == 100.0
    assert any("after row 3, for one" in w for w in take.warnings)


def test_rows_missing_from_a_trc_and_columns_there_twice_are_told(tmp_path: Path) -> None:
    take, _ = mm.simulate(duration_s=1.0, rate=50.0, damaged=False)
    whole, holed, table = tmp_path / "a.trc", tmp_path / "b.trc", tmp_path / "c.csv"
    mm.write(take, whole)
    lines = whole.read_text().splitlines(keepends=True)
    holed.write_text("".join(lines[:20] + lines[23:]))
    read, gapped = mm.read(whole), mm.read(holed)
    assert not read.warnings
    assert gapped.warnings == ("3 rows are missing; their frames were read as gaps.",)
    assert not gapped.read_only
    gone = np.isnan(gapped.positions).all(axis=(1, 2))
    assert gone.sum() == 3
    np.testing.assert_array_equal(gapped.positions[~gone], read.positions[~gone])
    table.write_text("A.x,A.y,A.z,A.x,A.y,A.z\n1,2,3,4,5,6\n")
    assert any("the first was read: A.x." in w for w in mm.read(table).warnings)
