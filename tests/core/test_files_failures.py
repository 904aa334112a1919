"""A full disk, a folder that may not be written, a limit: said in one sentence, nothing left."""

from __future__ import annotations

import contextlib
import os
import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import markermend as mm
from markermend.files import atomic


@pytest.fixture
def take(shared_data: Path) -> mm.Take:
    return mm.read(shared_data / "bodies/85_02.c3d")


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 256 KiB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(folder)]
    try:
        done = subprocess.run(mount, capture_output=True, check=False)
    except FileNotFoundError:
        pytest.skip("there is no mount here")
    if done.returncode:
        pytest.skip("a file system can only be mounted by root")
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


@contextlib.contextmanager
def not_root(folder: Path) -> Iterator[None]:
    """Take away the right to write into a folder, which root would keep."""
    folder.chmod(0o555)
    root = os.geteuid() == 0
    if root:
        os.seteuid(65534)
    try:
        yield
    finally:
        if root:
            os.seteuid(0)
        folder.chmod(0o755)


def test_full_disk(take: mm.Take, small_disk: Path) -> None:
    with pytest.raises(mm.ExportError, match="no space left"):
        mm.write(take, small_disk / "out.c3d")
    assert list(small_disk.iterdir()) == []


def test_full_disk_keeps_what_was_there(take: mm.Take, small_disk: Path) -> None:
    there = small_disk / "out.c3d"
    there.write_bytes(b"what was there before")
    with pytest.raises(mm.ExportError, match="no space left"):
        mm.write(take, there)
    assert list(small_disk.iterdir()) == [there]
    assert there.read_bytes() == b"what was there before"


def test_read_only_folder(take: mm.Take, tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    with not_root(tmp_path), pytest.raises(mm.ExportError, match="permission denied"):
        mm.write(take, tmp_path / "out.c3d")
    assert list(tmp_path.iterdir()) == []


def test_no_such_folder(take: mm.Take, tmp_path: Path) -> None:
    with pytest.raises(mm.ExportError, match="no such file or directory"):
        mm.write(take, tmp_path / "none" / "out.c3d")


def test_file_size_limit(shared_data: Path, tmp_path: Path) -> None:
    script = (
        "import resource, signal, sys, markermend as mm\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "take = mm.read(sys.argv[1])\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))\n"
        "try:\n    mm.write(take, sys.argv[2])\n"
        "except mm.ExportError as error:\n    print(error)\n"
    )
    assert resource.RLIMIT_FSIZE >= 0
    source = shared_data / "bodies/85_02.c3d"
    done = subprocess.run(
        [sys.executable, "-c", script, str(source), str(tmp_path / "out.c3d")],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "file too large" in done.stdout
    assert list(tmp_path.iterdir()) == []


def test_rename_that_fails_leaves_source_and_no_backup(
    shared_data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "take.c3d"
    source.write_bytes((shared_data / "bodies/85_02.c3d").read_bytes())
    before = source.read_bytes()

    def locked(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(atomic.os, "replace", locked)
    with pytest.raises(mm.ExportError, match="nothing was changed"):
        mm.write(mm.read(source), source, overwrite=True)
    assert list(tmp_path.iterdir()) == [source]
    assert source.read_bytes() == before


def test_permissions_of_the_file_stay(take: mm.Take, tmp_path: Path) -> None:
    target = tmp_path / "out.c3d"
    target.write_bytes(b"old")
    target.chmod(0o640)
    mm.write(take, target)
    assert target.stat().st_mode & 0o777 == 0o640


def test_killed_in_the_middle_leaves_the_target(shared_data: Path, tmp_path: Path) -> None:
    target = tmp_path / "take.c3d"
    target.write_bytes((shared_data / "bodies/HDM_mm_01-02_03_120.c3d").read_bytes())
    before = target.read_bytes()
    script = (
        "import os, signal, sys, markermend as mm\n"
        "take = mm.read(sys.argv[1])\n"
        "def die(share, doing):\n"
        "    if share > 0.5:\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "mm.write(take, sys.argv[1], overwrite=True, progress=die)\n"
    )
    done = subprocess.run([sys.executable, "-c", script, str(target)], check=False)
    assert done.returncode == -9
    assert target.read_bytes() == before
    mm.write(mm.read(target), target, overwrite=True)
    assert target.read_bytes() == before


def test_reading_can_be_cancelled(shared_data: Path) -> None:
    def stop(share: float, doing: str) -> None:
        raise mm.Cancelled

    for name in ("bodies/85_02.c3d", "trc/markers_walk.trc"):
        with pytest.raises(mm.Cancelled):
            mm.read(shared_data / name, progress=stop)
