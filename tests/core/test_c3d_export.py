"""Exporting C3D: nothing changes but what was repaired."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.files import c3d_patch
from markermend.files.c3d_layout import C3dLayout, Storage
from markermend.take import Event

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
FILES = sorted(p for p in SHARED.rglob("*") if p.suffix.lower() == ".c3d" and p.stat().st_size)
# An empty origin lets the take work out which samples are missing.
WORK_OUT = np.empty((0, 0), dtype=np.uint8)
every_file = pytest.mark.parametrize("path", FILES, ids=lambda p: p.name)


def edited(take: mm.Take, rng: np.random.Generator) -> tuple[mm.Take, dict[tuple[int, int], str]]:
    """Change random samples; returns the take and, per frame and marker, the axes to be written."""
    positions = take.positions.copy()
    expected: dict[tuple[int, int], str] = {}
    for _ in range(12):
        frame, marker = int(rng.integers(take.frames)), int(rng.integers(take.markers))
        if (frame, marker) in expected:
            continue
        if not take.present[frame, marker]:
            positions[frame, marker] = rng.uniform(1, 900, 3)
            expected[frame, marker] = "xyzr"
        elif rng.random() < 0.25:
            positions[frame, marker] = np.nan
            expected[frame, marker] = "xyzr"
        else:
            axes = [a for a in range(3) if rng.random() < 0.5] or [2]
            positions[frame, marker, axes] += 7.0
            expected[frame, marker] = "".join("xyz"[a] for a in axes)
    return take.with_positions(positions, WORK_OUT), expected


@every_file
def test_without_edits_the_file_is_the_source(path: Path, tmp_path: Path) -> None:
    done = mm.write(mm.read(path), tmp_path / "out.c3d")
    assert done.samples == 0
    assert (tmp_path / "out.c3d").read_bytes() == path.read_bytes()


@every_file
def test_only_edited_words_differ(path: Path, tmp_path: Path) -> None:
    take = mm.read(path)
    if not take.markers:
        pytest.skip("no markers to edit")
    assert take.source is not None
    layout = take.source.layout
    assert isinstance(layout, C3dLayout)
    size = int(layout.storage)
    target = tmp_path / "out.c3d"
    for seed in range(3):
        changed, expected = edited(take, np.random.default_rng(seed))
        done = mm.write(changed, target)
        assert done.samples == len(expected)
        before, after = (np.fromfile(p, np.uint8) for p in (path, target))
        assert len(before) == len(after)
        allowed = np.zeros(len(before), dtype=bool)
        for (frame, marker), axes in expected.items():
            at = layout.data + frame * layout.stride + 4 * size * take.source.columns[marker]
            for axis in axes:
                word = at + size * "xyzr".index(axis)
                allowed[word : word + size] = True
        assert not ((before != after) & ~allowed).any()
        back = mm.read(target)
        step = take.source.scale_mm if layout.storage is Storage.INTEGER else 0.0
        np.testing.assert_array_equal(back.present, changed.present)
        np.testing.assert_allclose(back.positions, changed.positions, rtol=1e-6, atol=step / 2)


@pytest.fixture
def source(shared_data: Path, tmp_path: Path) -> Path:
    """Copy of a real file that may be written over."""
    path = tmp_path / "take.c3d"
    path.write_bytes((shared_data / "bodies/85_02.c3d").read_bytes())
    return path


def test_filled_sample_is_reconstructed_not_measured(shared_data: Path, tmp_path: Path) -> None:
    take = mm.read(shared_data / "gait/Capture0002.c3d")
    frame, marker = np.argwhere(~take.present)[0]
    positions = take.positions.copy()
    positions[frame, marker] = 1.0, 2.0, 3.0
    mm.write(take.with_positions(positions, WORK_OUT), tmp_path / "out.c3d")
    back = mm.read(tmp_path / "out.c3d")
    assert back.residuals is not None
    assert back.cameras is not None
    assert back.residuals[frame, marker] == 0
    assert back.cameras[frame, marker] == 0


def test_integer_overflow_is_refused(shared_data: Path, tmp_path: Path) -> None:
    take = mm.read(shared_data / "formats/Eb015vi.c3d")
    positions = take.positions.copy()
    positions[3, 2, 1] = 5000.0
    with pytest.raises(mm.ExportError, match="floats") as caught:
        mm.write(take.with_positions(positions, take.origin.copy()), tmp_path / "out.c3d")
    assert take.labels[2] in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_never_over_the_source_unless_told(source: Path) -> None:
    before = source.read_bytes()
    take = mm.read(source)
    positions = take.positions.copy()
    positions[0, 0, 0] += 1
    changed = take.with_positions(positions, take.origin.copy())
    link = source.with_name("link.c3d")
    link.symlink_to(source)
    for name in (source, link):
        with pytest.raises(mm.ExportError, match="overwritten"):
            mm.write(changed, name)
    assert source.read_bytes() == before
    done = mm.write(changed, source, overwrite=True)
    assert done.backup is not None
    assert done.backup.read_bytes() == before
    assert source.read_bytes() != before
    second = mm.write(mm.read(source), source, overwrite=True)
    assert second.backup != done.backup


def test_changed_source_is_noticed(source: Path, tmp_path: Path) -> None:
    take = mm.read(source)
    os.utime(source, ns=(1, 1))
    with pytest.raises(mm.ExportError, match="changed on disk"):
        mm.write(take, tmp_path / "out.c3d")
    source.unlink()
    with pytest.raises(mm.ExportError, match="cannot be opened any more"):
        mm.write(take, tmp_path / "out.c3d")
    assert list(tmp_path.iterdir()) == []


def test_second_writer_during_export(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = mm.read(source)
    blocks = c3d_patch.blocks

    def meddle(*args: object) -> object:
        yield from blocks(*args)  # type: ignore[arg-type]
        with source.open("r+b") as file:
            file.write(b"\2P")

    monkeypatch.setattr(c3d_patch, "blocks", meddle)
    with pytest.raises(mm.ExportError, match="changed on disk"):
        mm.write(take, tmp_path / "out.c3d")
    assert list(tmp_path.iterdir()) == [source]


def test_cancelled_export_leaves_nothing(source: Path, tmp_path: Path) -> None:
    def stop(share: float, doing: str) -> None:
        raise mm.Cancelled

    with pytest.raises(mm.Cancelled):
        mm.write(mm.read(source), tmp_path / "out.c3d", progress=stop)
    assert list(tmp_path.iterdir()) == [source]


@pytest.mark.parametrize("name", ["bodies/85_02.c3d", "gait/PiG_Motion-FlatFoot-Full.c3d"])
def test_take_without_source_becomes_a_new_file(
    shared_data: Path, tmp_path: Path, name: str
) -> None:
    ezc3d = pytest.importorskip("ezc3d")
    take = replace(mm.read(shared_data / name), source=None)
    mm.write(take, tmp_path / "new.c3d")
    back = mm.read(tmp_path / "new.c3d")
    assert back.warnings == ()
    assert back.labels == take.labels
    assert back.events == take.events
    assert back.first_frame == take.first_frame
    np.testing.assert_allclose(back.positions, take.positions, rtol=1e-6)
    assert (back.points is None) == (take.points is None)
    if take.points is not None and back.points is not None:
        assert back.points.kinds == take.points.kinds
        assert back.points.units == take.points.units
    theirs = ezc3d.c3d(str(tmp_path / "new.c3d"))
    points = np.transpose(theirs["data"]["points"], (2, 1, 0))[:, : take.markers, :3]
    np.testing.assert_allclose(points, take.positions, rtol=1e-6)
    assert tuple(theirs["parameters"]["POINT"]["LABELS"]["value"][: take.markers]) == take.labels


def test_new_file_with_many_points_frames_and_events(tmp_path: Path) -> None:
    frames, markers = 70_000, 3
    positions = np.arange(frames * markers * 3, dtype=float).reshape(frames, markers, 3) % 900 + 1
    positions[100:200, 1] = np.nan
    events = tuple(Event(f"e{i}", i / 10, "Left") for i in range(300))
    take = mm.Take(positions, ("A", "B", "C"), 240.0, first_frame=66_000, events=events)
    mm.write(take, tmp_path / "long.c3d")
    back = mm.read(tmp_path / "long.c3d")
    assert (back.frames, back.first_frame, len(back.events)) == (frames, 66_000, 300)
    np.testing.assert_array_equal(back.positions, positions.astype(np.float32))
    wide = mm.Take(positions[:5, :1].repeat(300, axis=1), tuple(f"M{i}" for i in range(300)), 50.0)
    mm.write(wide, tmp_path / "wide.c3d")
    assert mm.read(tmp_path / "wide.c3d").labels == wide.labels
