"""The blind questionnaire: the page names no file, the key opens it, votes are counted."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import markermend as mm
from markermend.bench.blind import Version, blind_page
from markermend.cli import main
from markermend.poses.pose import Pose

NAMES = ("sensor", "networkone", "networktwo")
FRAMES, JOINTS = 40, ("Hip", "Chest", "Head")


def recording(offset: float, frames: int = FRAMES) -> Pose:
    """Three joints above each other that sway, one of them hidden for a while."""
    positions = np.zeros((frames, 3, 3))
    positions[:, :, 2] = [900.0, 1300.0, 1600.0]
    positions[:, :, 0] += 100 * np.sin(np.arange(frames) / 10)[:, None] + offset
    positions[5:9, 2] = np.nan
    rotations = np.tile([0.0, 0.0, 0.0, 1.0], (frames, 3, 1))
    return Pose(positions, rotations, JOINTS, (-1, 0, 1), 30.0)


@pytest.fixture
def folders(tmp_path: Path) -> Path:
    """Three versions of two movements, each version 100 mm beside the former."""
    for i, name in enumerate(NAMES):
        (tmp_path / name).mkdir()
        for movement in ("jump", "walk"):
            mm.write_pose(recording(100.0 * i), tmp_path / name / f"{movement}.csv")
    return tmp_path


def ask(folders: Path, *more: str) -> tuple[str, dict[str, Any]]:
    """Page and key of the three folders."""
    page, key = folders / "page.html", folders / "key.json"
    words = [*(str(folders / name) for name in NAMES), "-o", str(page), "--key", str(key)]
    assert main(["bench", "blind", *words, *more]) == 0
    return page.read_text("utf-8"), json.loads(key.read_text("utf-8"))


def content(page: str) -> dict[str, Any]:
    """What the page plays."""
    found = re.search(r"const STUDY = (.*);\n", page)
    assert found is not None
    return dict(json.loads(found[1]))


def first_x(packed: str) -> int:
    """X of the first joint in the first pose, mm."""
    return int(np.frombuffer(base64.b64decode(packed), "<i2")[0])


def answers(folders: Path, key: dict[str, Any], rater: str, *order: str) -> str:
    """A CSV in which somebody finds versions most natural in this order, in every movement."""
    lines = ["study,rater,movement,question,answer"]
    for number, letters in enumerate(key["movements"], 1):
        of = {Path(hidden["version"]).name: letter for letter, hidden in letters.items()}
        for question, name in zip(("most natural", "second most natural"), order, strict=True):
            lines.append(f"{key['study']},{rater},{number},{question},{of[name]}")
    path = folders / f"answers_{rater}.csv"
    path.write_text("\r\n".join(lines) + "\r\n", "utf-8")
    return str(path)


def test_page_stands_alone_and_names_no_version(folders: Path) -> None:
    page, _ = ask(folders)
    for name in (*NAMES, "jump", "walk", str(folders), "seed"):
        assert name not in page
    assert not re.search(r"https?:|src=|<link", page)


def test_key_says_which_letter_plays_which_file(folders: Path) -> None:
    page, key = ask(folders)
    for played, letters in zip(content(page)["movements"], key["movements"], strict=True):
        places = {
            Path(letters[letter]["version"]).name: first_x(packed)
            for letter, packed in zip("ABC", played["versions"], strict=True)
        }
        assert [places[name] - places[NAMES[0]] for name in NAMES] == [0, 100, 200]
        assert {Path(hidden["file"]).parent.name for hidden in letters.values()} == set(NAMES)


def test_joint_not_seen_is_told_from_one_at_zero(folders: Path) -> None:
    packed = content(ask(folders)[0])["movements"][0]["versions"][0]
    points = np.frombuffer(base64.b64decode(packed), "<i2").reshape(FRAMES, 3, 3)
    unseen = (points == -32768).all(axis=2)
    assert unseen[5:9, 2].all()
    assert unseen.sum() == 4


@pytest.mark.filterwarnings("error")
def test_pose_in_which_nothing_was_seen_is_left_empty() -> None:
    lost = recording(0.0)
    positions = lost.positions.copy()
    positions[20:22] = np.nan
    lost = lost.with_samples(positions, lost.rotations)
    versions = [Version(name, f"{name}.csv", lost) for name in ("one", "two")]
    played = content(blind_page([versions], seed=1)[0])["movements"][0]
    points = np.frombuffer(base64.b64decode(played["versions"][0]), "<i2").reshape(FRAMES, 3, 3)
    assert (points[20:22] == -32768).all()
    assert (points[19] != -32768).all()


def test_same_seed_draws_the_same_letters_and_seeds_differ(folders: Path) -> None:
    drawn = [ask(folders, "--seed", str(seed), "--force")[1]["movements"] for seed in (1, 1, 2, 3)]
    assert drawn[0] == drawn[1]
    assert any(other != drawn[0] for other in drawn[2:])


def test_tally_counts_votes_by_version(folders: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, key = ask(folders)
    files = [
        answers(folders, key, "1", "networkone", "networktwo"),
        answers(folders, key, "2", "networkone", "sensor"),
        answers(folders, key, "3", "networktwo", "networkone"),
    ]
    capsys.readouterr()
    assert main(["bench", "blind", "--tally", str(folders / "key.json"), *files]) == 0
    out = capsys.readouterr().out
    rows = {Path(line.split()[0]).name: line.split()[1:] for line in out.splitlines()[1:4]}
    assert rows == {
        "sensor": ["0", "0", "2", "33"],
        "networkone": ["4", "67", "2", "33"],
        "networktwo": ["2", "33", "2", "33"],
    }
    assert "3 people, 2 movements." in out
    assert "by scale" not in out


def test_votes_are_counted_by_how_much_is_occluded(
    folders: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    often = recording(0.0)
    positions = often.positions.copy()
    positions[:30, 1] = np.nan
    mm.write_pose(often.with_samples(positions, often.rotations), folders / NAMES[0] / "walk.csv")
    _, key = ask(folders)
    assert key["unseen"] == [0.1, 0.85]
    path = answers(folders, key, "1", "networkone", "networktwo")
    capsys.readouterr()
    assert main(["bench", "blind", "--tally", str(folders / "key.json"), path]) == 0
    scaled = capsys.readouterr().out.partition("by scale of occlusion")[2].splitlines()
    rows = {Path(line.split()[0]).name: line.split()[1:] for line in scaled[2:5]}
    empty = ["0", "–"] * 3
    assert rows["networkone"] == ["1", "100", *empty, "1", "100"]
    assert rows["sensor"] == ["0", "0", *empty, "0", "0"]
    del key["unseen"]
    (folders / "key.json").write_text(json.dumps(key), "utf-8")
    assert main(["bench", "blind", "--tally", str(folders / "key.json"), path]) == 0
    assert "by scale" not in capsys.readouterr().out


def test_tally_refuses_what_does_not_fit(folders: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, key = ask(folders)
    own = answers(folders, key, "1", "sensor", "networkone")
    other = answers(folders, {**key, "study": "another"}, "2", "sensor", "networkone")
    for files, sentence in (
        ([own, own], "answers twice"),
        ([other], "another page"),
        ([str(folders / "page.html")], "Answers begin with"),
    ):
        assert main(["bench", "blind", "--tally", str(folders / "key.json"), *files]) == 1
        assert sentence in capsys.readouterr().err


@pytest.mark.parametrize(
    ("row", "sentence"),
    [
        ("0,most natural,A", "no version A of movement 0"),
        ("-1,most natural,A", "no version A of movement -1"),
        ("3,most natural,A", "no version A of movement 3"),
        ("1,most natural,D", "no version D of movement 1"),
        ("1", "does not ask “”"),
        ("1,least natural,A", "does not ask “least natural”"),
        ("1,most natural,A\n{study},r,1,second most natural,A", "version A of movement 1 both"),
    ],
)
def test_answers_that_nobody_could_give_are_refused(
    folders: Path, capsys: pytest.CaptureFixture[str], row: str, sentence: str
) -> None:
    _, key = ask(folders)
    path = folders / "answers.csv"
    text = "study,rater,movement,question,answer\n{study},r," + row + "\n"
    path.write_text(text.replace("{study}", key["study"]), "utf-8")
    capsys.readouterr()
    assert main(["bench", "blind", "--tally", str(folders / "key.json"), str(path)]) == 1
    assert sentence in capsys.readouterr().err


@pytest.mark.parametrize(
    "broken",
    [
        {"movements": 5},
        {"movements": []},
        {"movements": [5]},
        {"movements": [{"A": "sensor"}]},
        {"movements": [{"A": {"version": "nobody"}}]},
        {"versions": []},
        {"unseen": "x"},
        {"unseen": ["x", 1]},
        {"study": None},
    ],
)
def test_a_damaged_key_is_said(
    folders: Path, capsys: pytest.CaptureFixture[str], broken: dict[str, Any]
) -> None:
    _, key = ask(folders)
    path = answers(folders, key, "1", "sensor", "networkone")
    (folders / "key.json").write_text(json.dumps({**key, **broken}), "utf-8")
    capsys.readouterr()
    assert main(["bench", "blind", "--tally", str(folders / "key.json"), path]) == 1
    assert "is no key that “bench blind” wrote" in capsys.readouterr().err


def test_versions_that_do_not_match_give_one_sentence(
    folders: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    short = folders / "short.csv"
    mm.write_pose(recording(0.0, FRAMES - 1), short)
    whole = folders / NAMES[0] / "jump.csv"
    page = folders / "page.html"
    assert main(["bench", "blind", str(whole), str(short), "-o", str(page)]) == 1
    said = capsys.readouterr().err
    assert "differ in their number of poses" in said
    assert said.count("\n") == 1
    (folders / NAMES[1] / "walk.csv").unlink()
    words = [str(folders / name) for name in NAMES]
    assert main(["bench", "blind", *words, "-o", str(page)]) == 1
    assert "has no recording called walk" in capsys.readouterr().err
    assert not page.exists()
