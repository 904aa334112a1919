"""Batches in which skeletons are restored by a prior of the user's own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from arms import arm, hide

import markermend as mm
from markermend.batch import Recipe, find_takes, read_recipe, run_batch
from markermend.batch.work import Job, clean_one, is_done, sha256, why
from markermend.cli import main
from markermend.errors import FileFormatError, MethodError
from markermend.poses.own_prior import learn_files
from markermend.poses.prior import save_prior, shipped_prior
from markermend.progress import quiet


@pytest.fixture
def shoot(tmp_path):
    """A recording of a skeleton, two joints of which are not seen for a while."""
    folder = tmp_path / "shoot"
    folder.mkdir()
    mm.write_pose(hide(hide(arm(), slice(200, 260), 2), slice(200, 260), 3), folder / "swing.csv")
    return folder


@pytest.fixture
def prior(tmp_path):
    """A prior of that body, in a file."""
    path = tmp_path / "own.npz"
    mm.write_pose(arm(frames=400), tmp_path / "before.csv")
    learn_files([tmp_path / "before.csv"], path)
    return path


def cleaned(shoot, folder, recipe):
    """The skeleton as a batch in this process leaves it, and its report."""
    (source,) = find_takes([shoot / "*.c*"])
    job = Job(source, folder, recipe)
    clean_one(job, quiet)
    return mm.read_pose(job.output).positions, job.report.read_text(encoding="utf-8")


def test_skeletons_are_restored_by_the_recipes_prior(shoot, prior, tmp_path):
    ours, _ = cleaned(shoot, tmp_path / "ours", Recipe())
    own, report = cleaned(shoot, tmp_path / "own", Recipe(prior=str(prior)))
    assert np.abs(own - ours).max() > 1.0
    assert "does not fit" not in report
    # What another batch of the same process asked for is forgotten.
    again, _ = cleaned(shoot, tmp_path / "again", Recipe())
    np.testing.assert_array_equal(again, ours)


def test_a_prior_that_does_not_fit_is_told_in_the_report(shoot, prior, tmp_path):
    save_prior(shipped_prior(), prior)
    _, report = cleaned(shoot, tmp_path / "out", Recipe(prior=str(prior)))
    assert "own.npz does not fit this recording" in report


def test_what_another_prior_made_is_made_anew(shoot, prior, tmp_path):
    take, _ = mm.simulate(duration_s=3, seed=1)
    mm.write(take, shoot / "walk.c3d")
    jobs = [
        Job(s, tmp_path / "out", Recipe(prior=str(prior))) for s in find_takes([shoot / "*.c*"])
    ]
    for job in jobs:
        clean_one(job, quiet)
        assert is_done(job, sha256(job.source.path))
    save_prior(shipped_prior(), prior)
    done = {job.source.name: is_done(job, sha256(job.source.path)) for job in jobs}
    # Of markers it tells nothing.
    assert done == {"swing": False, "walk": True}
    prior.unlink()
    assert not any(is_done(j, sha256(j.source.path)) for j in jobs if j.source.name == "swing")
    (swing,) = (job for job in jobs if job.source.name == "swing")
    with pytest.raises(OSError, match=r"own\.npz") as gone:
        clean_one(swing, quiet)
    assert why(gone.value) == f"{prior} cannot be used: No such file or directory."


def test_a_batch_with_no_such_prior_does_not_begin(shoot, tmp_path):
    for path in (tmp_path / "gone.npz", shoot / "swing.csv"):
        with pytest.raises(FileFormatError, match=path.name):
            run_batch(find_takes([shoot / "*.c*"]), tmp_path / "out", Recipe(prior=str(path)))
    assert not (tmp_path / "out").exists()


def test_the_command_line_takes_one_and_the_recipe_keeps_it(shoot, prior, tmp_path, monkeypatch):
    out = tmp_path / "out"
    monkeypatch.chdir(tmp_path)
    words = ["batch", str(shoot / "*.csv"), "-o", str(out), "--jobs", "1", "--prior", "own.npz"]
    assert main(words) == 0
    recipe = read_recipe(out / "recipe.toml")
    assert recipe == Recipe(prior=str(prior.resolve()))
    own = mm.read_pose(out / "takes" / "swing_clean.csv").positions
    wanted, _ = cleaned(shoot, tmp_path / "own", recipe)
    np.testing.assert_array_equal(own, wanted)


def test_a_recipes_prior_is_looked_for_beside_the_recipe(prior, tmp_path, monkeypatch):
    recipe = tmp_path / "my.toml"
    recipe.write_text('[skeletons]\nprior = "own.npz"\n', encoding="utf-8")
    monkeypatch.chdir("/")
    assert read_recipe(recipe) == replace(Recipe(), prior=str(prior.resolve()))


def test_a_recipe_that_is_resumed_from_elsewhere_names_the_same_prior(
    shoot, prior, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    takes = find_takes([shoot / "*.csv"])
    run_batch(takes, "out", Recipe(prior="own.npz"), jobs=1)
    monkeypatch.chdir("/")
    recipe = read_recipe(tmp_path / "out" / "recipe.toml")
    assert recipe.prior == str(prior.resolve())
    assert run_batch(takes, tmp_path / "out", recipe, jobs=1, resume=True).skipped == 1


def test_a_prior_that_changes_meanwhile_did_not_make_what_was_made(shoot, prior, tmp_path):
    (source,) = find_takes([shoot / "*.csv"])
    job = Job(source, tmp_path / "out", Recipe(prior=str(prior)))
    before = prior.read_bytes()

    def changing(share: float, _: str) -> None:
        if share > 0.5:
            save_prior(shipped_prior(), prior)

    clean_one(job, changing)
    assert not is_done(job, sha256(source.path))
    prior.write_bytes(before)
    assert is_done(job, sha256(source.path))


@pytest.mark.parametrize("name", ["a\0b.npz", "a\udcffb.npz"])
def test_a_prior_that_no_recipe_can_name_is_told(name):
    with pytest.raises(MethodError, match="rename"):
        Recipe(prior=name)
