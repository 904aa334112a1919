"""What cannot be made clean, said in a sentence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from command_line import run

import markermend as mm

HEAD = "frame,time,joint,parent,x,y,z,confidence\n"


def table(folder, frames, knee=1):
    lines = [
        f"{n},{n / 30:.4f},hip,,0,900,0,1\n{n},{n / 30:.4f},knee,hip,{n},500,5,{knee}\n"
        for n in range(frames)
    ]
    (folder / "k.csv").write_text(HEAD + "".join(lines))
    return folder / "k.csv"


@pytest.mark.parametrize("given", ["k.csv", Path("k.csv"), None, 3])
def test_what_is_no_recording_is_one_sentence(given):
    with pytest.raises(mm.DataError, match=r"is no skeleton recording; give what read_pose makes"):
        mm.denoise(given)


def test_a_take_of_markers_is_no_recording():
    take = mm.Take(np.zeros((9, 2, 3)), ("a", "b"), 100.0)
    with pytest.raises(mm.DataError, match="A Take is no skeleton recording"):
        mm.denoise(take)


@pytest.mark.parametrize("given", ["x", "", 3])
def test_what_is_no_prior_is_one_sentence(tmp_path, given):
    pose = mm.read_pose(table(tmp_path, 20))
    with pytest.raises(mm.MethodError, match="is no prior; give what own_prior makes of a file"):
        mm.denoise(pose, prior=given)


@pytest.mark.parametrize(
    ("frames", "knee", "why"),
    [
        (2, 1, "The recording is too short: it takes 3 poses, and has 2; take a longer one."),
        (9, 0, "No bone of this recording was ever seen whole; a joint and the one that it hangs"),
    ],
)
def test_what_cannot_be_made_clean_names_the_file(tmp_path, capsys, frames, knee, why):
    assert run("denoise", table(tmp_path, frames, knee), "-o", tmp_path / "out.csv") == 1
    assert f"k.csv: {why}" in capsys.readouterr().err
