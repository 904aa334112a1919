"""What a batch left is reviewed from where it ended, with everything it did undoable."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Status
from markermend.batch import Recipe, find_takes, run_batch, take_over, takes_to_review
from markermend.batch.review import ToReview
from markermend.detectors import find_detector
from markermend.errors import DataError, FileFormatError, MarkermendError
from markermend.review.file import open_session, read_review
from markermend.review.session import Session

SLOWLESS = find_detector("paper").params(slow=False)
RECIPE = Recipe(detector="paper", detector_params=SLOWLESS, min_confidence=0.99)


@pytest.fixture(scope="module")
def cleaned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Clean one damaged take; the folder holds the take and the batch's output."""
    folder = tmp_path_factory.mktemp("shoot")
    take, _ = mm.simulate(duration_s=3.5, seed=1)
    mm.write(take, folder / "walk.c3d")
    run_batch(find_takes([folder / "walk.c3d"]), folder / "out", RECIPE, jobs=1)
    return folder


def test_a_review_begins_where_the_batch_ended(cleaned: Path) -> None:
    (item,) = takes_to_review([cleaned / "out"])
    assert takes_to_review([cleaned / "out" / "review.json"]) == (item,)
    session = Session(mm.read(item.path))
    before = session.positions.copy()
    assert take_over(session, item)
    after = mm.read(cleaned / "out" / "takes" / "walk_clean.c3d")
    assert np.array_equal(session.positions, after.positions, equal_nan=True)
    waiting = json.loads((cleaned / "out" / "review.json").read_text())["takes"][0]["artifacts"]
    assert {a.id for a in session.with_status(Status.PENDING)} == {w["id"] for w in waiting}
    repaired = session.with_status(Status.REPAIRED)
    assert repaired
    assert all(session.notes[a.id].method for a in repaired)
    told = json.loads(item.found.read_text())["artifacts"]
    bands = {a["id"]: a["repair"]["band_mm"] for a in told}
    kept = {a.id: session.notes[a.id].band_mm for a in repaired}
    assert any(kept.values())
    assert kept == {i: None if bands[i] is None else tuple(bands[i]) for i in kept}
    session.undo()
    assert np.array_equal(session.positions, before, equal_nan=True)


def test_a_swap_of_three_is_repaired_on_all_of_them(tmp_path: Path) -> None:
    take = mm.simulate(duration_s=5.0, seed=3, damaged=False)[0]
    positions = take.positions.copy()
    three = [take.index(name) for name in ("LFHD", "RFHD", "LBHD")]
    positions[200:260, three] = positions[200:260, [three[1], three[2], three[0]]]
    mm.write(take.with_positions(positions, take.origin), tmp_path / "s.c3d")
    recipe = Recipe(detector_params=find_detector("joint").params(slow=False))
    run_batch(find_takes([tmp_path / "s.c3d"]), tmp_path / "out", recipe, jobs=1)
    takes = tmp_path / "out" / "takes"
    item = ToReview(tmp_path / "s.c3d", "s", takes / "s.json", takes / "s_clean.c3d")
    session = Session(mm.read(item.path))
    assert take_over(session, item)
    assert any(len(a.markers) == 3 for a in session.with_status(Status.REPAIRED))
    after = mm.read(takes / "s_clean.c3d")
    assert np.array_equal(session.positions, after.positions, equal_nan=True)


def test_a_take_that_changed_since_is_not_mixed_with_the_batch(
    cleaned: Path, tmp_path: Path
) -> None:
    (item,) = takes_to_review([cleaned / "out"])
    take = mm.read(item.path)
    positions = take.positions.copy()
    positions[5, 0] += 1.0
    mm.write(take.with_positions(positions, take.origin), tmp_path / "walk.c3d")
    with pytest.raises(DataError, match="no longer the take that was cleaned"):
        take_over(Session(mm.read(tmp_path / "walk.c3d")), item)


def test_folders_and_files_are_listed_as_a_batch_names_them(cleaned: Path) -> None:
    (item,) = takes_to_review([cleaned / "walk.c3d"])
    assert (item.name, item.found) == ("walk", None)
    assert not take_over(Session(mm.read(item.path)), item)


@pytest.mark.parametrize("text", ["{}", "[1]", "no JSON"])
def test_another_json_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "list.json").write_text(text)
    with pytest.raises(FileFormatError, match=r"list\.json"):
        takes_to_review([tmp_path / "list.json"])


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(MarkermendError, match="nowhere"):
        takes_to_review([tmp_path / "nowhere"])


def test_a_review_is_read_while_another_window_holds_it(cleaned: Path) -> None:
    take = mm.read(cleaned / "walk.c3d")
    assert read_review(take).history == ()
    file = open_session(take)
    found = mm.detect(take, method="paper", params=SLOWLESS)
    file.session.add_detected(found, "paper")
    file.save()
    file.session.set_status([found[0].id], Status.REJECTED)
    read = read_review(take)
    assert read.artifacts == file.session.artifacts
    assert read.history == file.session.history
    file.discard()
    assert read_review(take).history == ()


def test_files_are_listed_as_they_are_named(tmp_path, shared_data):
    names = ("b.csv", "c.csv", "a.csv")
    for name in names:
        (tmp_path / name).write_text("frame,time,joint,parent,x,y,z\n0,0,a,,1,2,3\n")
    more = tmp_path / "more"
    more.mkdir()
    (more / "z.trc").touch()
    given = [more, *(tmp_path / name for name in names)]
    assert [item.path.name for item in takes_to_review(given)] == [*names, "z.trc"]
