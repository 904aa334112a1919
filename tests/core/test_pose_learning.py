"""Who networks learn from, on whom they are tried, and the command that trains them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import markermend as mm
from markermend.bench.poses import CASES, Row, compare
from markermend.bench.poses_network import by_networks
from markermend.bench.poses_paper import TABLES, paper_tables
from markermend.cli import main
from markermend.cli.console import Bar
from markermend.errors import Cancelled, DataError
from markermend.poses.networks.learning_sets import features_of, folds_of, learning_sets
from markermend.poses.networks.network import Network, load_networks, save_networks
from markermend.poses.nuitrack import JOINTS
from markermend.poses.simulated.noise import NOISES
from markermend.repairs.skurowski2021.recurrent import can_learn

needs_extra = pytest.mark.skipif(not can_learn(), reason="the optional extra “deep” is missing")


def numbered(frames, first):
    """Poses that can be told apart."""
    poses = np.zeros((frames, len(JOINTS), 7))
    poses[:, 1, 0] = np.arange(first, first + frames)
    return poses


CLIPS = {"a_1": numbered(40, 0), "a_2": numbered(25, 100), "b_1": numbered(30, 200)}


def names(poses):
    return set(poses[:, 1, 0].tolist())


def answering(value, parts="both", width=112):
    """A network that always gives the same."""
    zero = np.zeros((width, width), dtype=np.float32)
    biases = (np.zeros(width), np.zeros(width), np.full(width, value))
    return Network(
        parts, np.zeros(width), np.ones(width), (zero, zero, zero), tuple(map(np.float32, biases))
    )


def test_folds_divide_all_poses_and_stay():
    sets = list(learning_sets(CLIPS, folds=tuple(range(1, 11))))
    assert [s.name for s in sets][::9] == ["fold1of10", "fold10of10"]
    everything = set().union(*(names(clip) for clip in CLIPS.values()))
    assert set().union(*(names(s.unseen) for s in sets)) == everything
    assert sum(len(s.unseen) for s in sets) == 95
    for learnt in sets:
        assert not names(learnt.seen) & names(learnt.unseen)
        assert len(learnt.seen) + len(learnt.unseen) == 95
    assert (folds_of("a_1", 40) == folds_of("a_1", 40)).all()
    assert (folds_of("a_1", 40) != folds_of("a_2", 40)).any()


def test_who_is_left_out_is_left_out_of_what_is_added_too():
    more = {name: clip + 1000.0 for name, clip in CLIPS.items()}
    first, second = learning_sets(CLIPS, leave_out=True, added=more)
    assert (first.name, second.name) == ("withouta", "withoutb")
    assert names(first.seen) == names(CLIPS["b_1"]) | names(more["b_1"])
    assert names(first.unseen) == names(CLIPS["a_1"]) | names(CLIPS["a_2"])
    (whole,) = learning_sets(CLIPS, added=more)
    assert len(whole.seen) == 190
    with pytest.raises(DataError, match="two or more"):
        list(learning_sets({"a_1": CLIPS["a_1"]}, leave_out=True))


def test_poses_held_out_are_held_out_of_what_is_added_too():
    more = {name: clip[::4] + 1000.0 for name, clip in CLIPS.items()}
    added = set()
    for learnt in learning_sets(CLIPS, folds=tuple(range(1, 11)), added=more):
        held = {pose + 1000.0 for pose in names(learnt.unseen)}
        assert not names(learnt.seen) & held
        added |= {pose for pose in names(learnt.seen) if pose >= 1000.0}
        assert len(learnt.seen) > 95 - len(learnt.unseen)
    assert added == set().union(*(names(part) for part in more.values()))


def test_networks_that_are_not_tried_are_named(shared_data, tmp_path, capsys):
    networks = {f"{group}-both": answering(0.0) for group in ("all", "without09", "without02")}
    save_networks(networks, tmp_path / "n.npz")
    clips = [str(shared_data / "poses" / f"{name}.amc") for name in ("02_03", "03_02")]
    asked = ["bench", "pose", *clips, "--case", "clean, 30 Hz", "--networks"]
    assert main([*asked, str(tmp_path / "n.npz")]) == 0
    said = capsys.readouterr().err
    assert "Not tried: all-both, without09-both; a network is tried only on people" in said


def test_every_table_of_a_sensor_says_that_it_is_simulated():
    titles = [table.title for table in TABLES if "sensor" in table.case]
    assert len(titles) == 2
    assert all("simulated" in title for title in titles)


def test_each_pose_is_judged_by_networks_that_never_saw_it():
    damaged = numbered(40, 0)[::4]
    damaged[..., 6] = 1.0
    known = np.ones(damaged.shape, dtype=bool)
    networks = {f"fold{n}of10-both": answering(float(n)) for n in (2, 5)}
    networks["withouta-both"] = answering(0.5)
    tried = by_networks(networks, "a_1", damaged, known, 40)
    fold = folds_of("a_1", 40)[::4]
    split = tried["network both, random split"]
    assert (split.judged == np.isin(fold, (2, 5))).all()
    assert_allclose(split.features[split.judged, 3, 0], fold[split.judged])
    assert tried["network both"].judged.all()
    assert (tried["network both, where occluded"].features == damaged).all()
    assert "network both, random split, filtered" in tried


def test_published_tables_stand_beside_ours():
    def row(method, kind, error, poses=10):
        return Row("a_1", "a", "frame by frame", kind, method, error, (), (), (), poses)

    rows = [row("network both", "both", 0.05), row("network both", "both", 0.02, 20)]
    rows.append(row("network both, random split", "occlusions", float("nan"), 0))
    text = paper_tables(rows)
    assert text[1] == "Table 2, CMU"
    lines = [line.split() for line in text[3:6]]
    assert lines[0] == ["both", "unseen", "0.0300", "–", "–"]
    assert lines[1] == ["both", "random", "split", "–", "–", "–"]
    assert lines[2] == ["published", "0.0461", "0.0420", "0.0334"]
    assert not any("sensor" in line for line in text)


def test_parts_are_judged_by_what_they_return(shared_data):
    pose = mm.read_pose(shared_data / "poses" / "02_03.amc")
    other = mm.read_pose(shared_data / "poses" / "03_02.amc")
    nothing = answering(0.0, "positions", 48)
    rows = compare(
        {"02_03": pose, "03_02": other},
        cases=[case for case in CASES if case.kind == "displacements" and not case.sensor],
        networks={"without02-both+positions": nothing},
    )
    error = next(r.error for r in rows if r.method == "network both+positions")
    assert_allclose(error, np.abs(features_of(pose)[:, 1:, :3]).mean())


@pytest.mark.deep
@needs_extra
def test_command_trains_stops_and_goes_on(shared_data, tmp_path, capsys, monkeypatch):
    clip = str(shared_data / "poses" / "02_03.amc")
    whole, parted = tmp_path / "whole.npz", tmp_path / "parted.npz"
    asked = ["train", "pose", clip, "--fold", "3", "--noise", "both", "--epochs", "3"]
    asked += ["--parts", "rotations", "--batch", "40"]
    assert main([*asked, "-o", str(whole)]) == 0
    said = capsys.readouterr().out
    assert "Trained: fold3of10-both+rotations, mean absolute error 0." in said
    assert "on 18 poses held out" in said

    def stop(bar, share, doing):
        if share > 0.5:
            raise Cancelled

    with monkeypatch.context() as patch:
        patch.setattr(Bar, "__call__", stop)
        assert main([*asked, "-o", str(parted), "--resume"]) != 0
    assert not parted.exists()
    state = tmp_path / "parted-fold3of10-both+rotations.keras"
    assert state.exists()
    assert main([*asked, "-o", str(parted), "--resume"]) == 0
    one, other = (load_networks(path)["fold3of10-both+rotations"] for path in (whole, parted))
    assert_allclose(one.weights[1], other.weights[1], atol=1e-3)
    assert one.parts == "rotations"
    assert set(NOISES) == {"both", "occlusions", "displacements"}
