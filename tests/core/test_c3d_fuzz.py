"""A moment of the fuzzing that ``fuzz_c3d.py`` does for an hour."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import markermend as mm
from markermend.files.labels import unique_labels


def load_fuzz() -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "fuzz_c3d", Path(__file__).with_name("fuzz_c3d.py")
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


fuzz = load_fuzz()


@pytest.mark.parametrize("path", fuzz.samples(), ids=lambda p: p.name)
def test_damaged_bytes_break_no_promise(path: Path, tmp_path: Path) -> None:
    raw = path.read_bytes()
    # The largest files take longest and say no more.
    if len(raw) > 1_000_000:
        raw = raw[:300_000]
    rng = np.random.default_rng(len(raw))
    for _ in range(4):
        fuzz.check(fuzz.mutate(raw, rng), tmp_path / "damaged.c3d")


@pytest.mark.parametrize("share", [0.3, 0.6, 0.999])
def test_truncated_file_opens_to_look_at(shared_data: Path, tmp_path: Path, share: float) -> None:
    raw = (shared_data / "bodies/85_02.c3d").read_bytes()
    path = tmp_path / "cut.c3d"
    path.write_bytes(raw[: round(len(raw) * share)])
    take = mm.read(path)
    assert take.read_only
    assert take.frames < 810
    assert any("810 frames" in w and str(take.frames) in w for w in take.warnings)
    with pytest.raises(mm.ExportError, match="damaged"):
        mm.write(take, path, overwrite=True)


def test_truncated_before_the_first_frame(shared_data: Path, tmp_path: Path) -> None:
    raw = (shared_data / "bodies/85_02.c3d").read_bytes()
    path = tmp_path / "cut.c3d"
    for size in (1, 100, 511, 512, 600, 5000, 9216, 9300):
        path.write_bytes(raw[:size])
        with pytest.raises(mm.FileFormatError, match=r"cut\.c3d"):
            mm.read(path)


def test_absurd_counts_take_no_memory(shared_data: Path, tmp_path: Path) -> None:
    raw = bytearray((shared_data / "formats/MyCube.c3d").read_bytes())
    raw[2:4] = b"\xff\xff"
    path = tmp_path / "absurd.c3d"
    fuzz.check(bytes(raw), path)
    raw[8:10] = b"\xff\xff"
    fuzz.check(bytes(raw), path)


def test_many_equal_labels_stay_quick() -> None:
    labels, repeated = unique_labels(["A", "A_2"] + ["A"] * 30_000, 30_002)
    assert len(set(labels)) == 30_002
    assert labels[:3] == ("A", "A_2", "A_3")
    assert repeated == ("A",)
