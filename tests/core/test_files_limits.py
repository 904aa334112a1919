"""What a format cannot hold is refused in a sentence before anything is written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import markermend as mm
from markermend.files.restructure import add, crop, relabel
from markermend.take import Points, Take

LETTERS = st.text(st.sampled_from("ab \t\n\r\0\"',;.xyz()*#:é\u00a0\udcff"), max_size=6)


def take_of(*labels: str, frames: int = 4, first_frame: int = 1) -> Take:
    positions = np.arange(1.0, 1 + frames * len(labels) * 3).reshape(frames, len(labels), 3)
    return Take(positions, labels, 100.0, first_frame)


def placed(at_mm: float) -> Take:
    """A take whose second marker is far out in its third frame."""
    take = take_of("A", "B")
    positions = take.positions.copy()
    positions[2, 1, 0] = at_mm
    return take.with_positions(positions, take.origin.copy())


@pytest.mark.parametrize("ending", ["trc", "csv", "c3d"])
@given(st.lists(LETTERS, min_size=1, max_size=4, unique=True))
@settings(max_examples=150, deadline=None)
def test_names_come_back_or_are_refused(
    tmp_path_factory: pytest.TempPathFactory, ending: str, labels: list[str]
) -> None:
    path = tmp_path_factory.getbasetemp() / f"names.{ending}"
    path.unlink(missing_ok=True)
    try:
        mm.write(take_of(*labels), path)
    except mm.ExportError as error:
        said = str(error)
        assert "\n" not in said
        assert "rename" in said
        assert not path.exists()
        return
    back = mm.read(path)
    assert back.labels == tuple(
        (label.strip() if ending == "c3d" else label) or f"*{place}"
        for place, label in enumerate(labels, 1)
    )
    np.testing.assert_allclose(back.positions, take_of(*labels).positions)


@pytest.mark.parametrize(
    ("name", "labels", "said"),
    [
        ("out.csv", ("a", "a ", "b", "c"), "CSV cannot hold a marker called “a ”"),
        ("out.csv", ("b", "a\nb"), r"called “a\nb”"),
        ("out.trc", ("a\tb", "c", "d"), r"TRC cannot hold a marker called “a\tb”"),
        ("out.trc", ("c", " d"), "called “ d”"),
        ("out.c3d", ("a", "a "), "“a” and “a ” would have one name"),
        ("out.c3d", ("c", "a\0b"), r"called “a\x00b”"),
    ],
)
def test_the_name_is_told(name: str, labels: tuple[str, ...], said: str, tmp_path: Path) -> None:
    with pytest.raises(mm.ExportError) as caught:
        mm.write(take_of(*labels), tmp_path / name)
    assert said in str(caught.value)
    assert "rename" in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_names_too_long_for_a_c3d(tmp_path: Path) -> None:
    longest = ["x" * 254 + end for end in "ab"]
    mm.write(take_of(*longest), tmp_path / "a.c3d")
    read = mm.read(tmp_path / "a.c3d")
    assert read.labels == tuple(longest)
    for take in (
        take_of("x" * 255 + "a", "x" * 255 + "b"),
        relabel(read, {longest[0]: "ü" * 128}),
        add(read, "y" * 256, np.ones((4, 3))),
    ):
        with pytest.raises(mm.ExportError, match="256 bytes long and a C3D file holds 255"):
            mm.write(take, tmp_path / "b.c3d")
    mm.write(take_of("A", "B"), tmp_path / "c.c3d")
    with pytest.raises(mm.ExportError, match="one name"):
        mm.write(relabel(mm.read(tmp_path / "c.c3d"), {"A": "B "}), tmp_path / "b.c3d")
    mm.write(take_of(*("x" * 300 + end for end in "ab")), tmp_path / "b.csv")
    assert [len(s) for s in mm.read(tmp_path / "b.csv").labels] == [301, 301]


def test_what_was_done_is_cut_between_letters(tmp_path: Path) -> None:
    mm.write(take_of("A"), tmp_path / "a.c3d", record=["a" + "ü" * 200])
    mm.write(mm.read(tmp_path / "a.c3d"), tmp_path / "b.c3d", record=["a" + "ö" * 200])
    layout = mm.read(tmp_path / "b.c3d").source.layout
    assert layout.strings("MARKERMEND", "CHANGES")[-2:] == ("a" + "ü" * 127, "a" + "ö" * 127)


@pytest.mark.parametrize("name", ["out.c3d", "out.trc", "out.csv"])
def test_takes_that_could_not_be_read_back(name: str, tmp_path: Path) -> None:
    empty = Take(np.empty((0, 2, 3)), ("A", "B"), 100.0)
    with pytest.raises(mm.ExportError, match="no frame"):
        mm.write(empty, tmp_path / name)
    if not name.endswith("c3d"):
        with pytest.raises(mm.ExportError, match="nothing but markers"):
            mm.write(Take(np.empty((5, 0, 3)), (), 100.0), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_analog_alone_is_no_table(shared_data: Path, tmp_path: Path) -> None:
    take = mm.read(shared_data / "formats/1123x01EMG.c3d")
    with pytest.raises(mm.ExportError, match="A CSV holds nothing but markers"):
        mm.write(take, tmp_path / "emg.csv")
    mm.write(take, tmp_path / "emg.c3d")


def test_frame_numbers_a_c3d_has_room_for(tmp_path: Path) -> None:
    for first in (70_000, 2**32 - 4):
        mm.write(take_of("A", first_frame=first), tmp_path / "a.c3d")
        assert mm.read(tmp_path / "a.c3d").first_frame == first
    for first in (2**32 - 3, 2**33):
        with pytest.raises(mm.ExportError, match="up to 4,294,967,295"):
            mm.write(take_of("A", first_frame=first), tmp_path / "b.c3d")
    mm.write(take_of("A", first_frame=2**33), tmp_path / "b.csv")
    assert mm.read(tmp_path / "b.csv").first_frame == 2**33


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("at_mm", [99_999_999.9, -5e9, 1e300])
def test_coordinates_that_would_be_missing(at_mm: float, tmp_path: Path) -> None:
    mm.write(take_of("A", "B"), tmp_path / "a.c3d")
    source, far = mm.read(tmp_path / "a.c3d"), placed(at_mm)
    patched = source.with_positions(far.positions.copy(), far.origin.copy())
    for take in (far, patched, crop(patched, 1, 4), relabel(patched, {"A": "C"})):
        with pytest.raises(mm.ExportError, match=r"B at frame 3 is at .* 100 km"):
            mm.write(take, tmp_path / "b.c3d")
    mm.write(far, tmp_path / "b.csv")
    np.testing.assert_allclose(mm.read(tmp_path / "b.csv").positions, far.positions)


def test_coordinates_just_near_enough(tmp_path: Path) -> None:
    mm.write(placed(9e7), tmp_path / "a.c3d")
    assert mm.read(tmp_path / "a.c3d").positions[2, 1, 0] == 9e7


@pytest.mark.filterwarnings("error")
def test_other_points_may_be_large_but_not_endless(tmp_path: Path) -> None:
    take = take_of("A")
    for value, fits in ((1e12, True), (1e300, False)):
        points = Points(np.full((4, 1, 3), value), ("M",), ("moment",), (-1,))
        with_points = Take(take.positions, take.labels, 100.0, points=points)
        if fits:
            mm.write(with_points, tmp_path / "a.c3d")
            assert mm.read(tmp_path / "a.c3d").points.values[0, 0, 0] == pytest.approx(value)
        else:
            with pytest.raises(mm.ExportError, match="M at frame 1 is 1e"):
                mm.write(with_points, tmp_path / "b.c3d")


def test_a_trc_whose_own_name_has_tabs_and_line_breaks(tmp_path: Path) -> None:
    path = tmp_path / "a\tb\nc.trc"
    mm.write(take_of("A", "B"), path)
    assert mm.read(path).labels == ("A", "B")
