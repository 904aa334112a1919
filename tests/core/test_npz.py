"""Arrays of models: kept under the very name given, and refused where a file holds none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from markermend.errors import FileFormatError
from markermend.files.npz import read_arrays, write_arrays


def test_arrays_are_kept_under_the_name_given(tmp_path: Path) -> None:
    beside = tmp_path / "model.npz"
    beside.write_bytes(b"another's")
    write_arrays(tmp_path / "model", {"a": np.arange(3), "b": np.array("name")})
    back = read_arrays(tmp_path / "model")
    assert back["a"].tolist() == [0, 1, 2]
    assert str(back["b"]) == "name"
    assert beside.read_bytes() == b"another's"
    assert len(list(tmp_path.iterdir())) == 2


def test_what_holds_no_arrays(tmp_path: Path) -> None:
    path = tmp_path / "model.npz"
    write_arrays(path, {"a": np.arange(3000)})
    whole = path.read_bytes()
    np.save(tmp_path / "one.npy", np.arange(3))
    one = (tmp_path / "one.npy").read_bytes()
    for contents in (b"", b"text", b"PK\x03\x04 no archive", whole[: len(whole) // 2], one):
        path.write_bytes(contents)
        with pytest.raises(ValueError):  # noqa: PT011 - the caller says what is wrong
            read_arrays(path)
    with pytest.raises(FileFormatError, match=r"no\.npz”; check its name"):
        read_arrays(tmp_path / "no.npz")
