"""Presets and the dial: how to detect, kept under a name and said on the command line."""

from __future__ import annotations

import json

import pytest

from markermend.batch.recipe import read_recipe
from markermend.cli import main
from markermend.detectors import PaperParams
from markermend.detectors.joint import JointParams
from markermend.errors import FileFormatError, MethodError
from markermend.files import write
from markermend.presets import list_presets, load_preset, save_preset
from markermend.simulation import contaminate, simulate_clean


@pytest.fixture(scope="module")
def take(tmp_path_factory):
    clean = simulate_clean(duration_s=6.0, rate=120.0, seed=2, labels=("LFHD", "RFHD", "C7"))
    hurt, _ = contaminate(clean, share=0.05, amplitude_mm=1.5, kinds=("peak",), seed=3)
    path = tmp_path_factory.mktemp("takes") / "hurt.c3d"
    write(hurt, path)
    return path


def found(take, capsys, *words):
    assert main(["detect", str(take), "--no-slow", "--json", "-", *words]) == 0
    return len(json.loads(capsys.readouterr().out)["artifacts"])


def test_a_preset_comes_back_as_it_was_saved():
    assert list_presets() == ()
    params = JointParams(sensitivity=0.8, least_mm=2.0, slow=False, jobs=1)
    path = save_preset("fast dance", "joint", params)
    save_preset("Ward 3", "paper", PaperParams())
    assert list_presets() == ("Ward 3", "fast dance")
    assert load_preset("fast dance") == ("joint", params)
    assert read_recipe(path).detector_params == params
    save_preset("fast dance", "joint", JointParams(sensitivity=0.1, jobs=1))
    assert load_preset("fast dance")[1].sensitivity == 0.1


@pytest.mark.parametrize("name", ["", "../up", "a/b", " x", "x" * 61, ".hidden"])
def test_names_that_are_no_names_are_refused(name):
    with pytest.raises(MethodError, match="cannot name"):
        save_preset(name, "joint", JointParams())


def test_what_is_wrong_with_a_preset_is_told():
    with pytest.raises(MethodError, match="none is saved yet"):
        load_preset("mine")
    with pytest.raises(MethodError, match="takes"):
        save_preset("mine", "paper", JointParams())
    save_preset("mine", "joint", JointParams()).write_text("[detect")
    with pytest.raises(FileFormatError, match="TOML"):
        load_preset("mine")


def test_the_dial_finds_more(take, capsys):
    low, usual, high = (found(take, capsys, "--sensitivity", s) for s in ("0.02", "0.5", "0.95"))
    assert low < usual <= high
    assert found(take, capsys) == usual


def test_the_command_line_saves_and_uses_presets(take, capsys):
    strict = found(take, capsys, "--set", "least_mm=2.5", "--save-preset", "strict")
    assert strict < found(take, capsys)
    assert found(take, capsys, "--preset", "strict") == strict
    assert found(take, capsys, "--preset", "strict", "--set", "least_mm=0.5") > strict
    method, params = load_preset("strict")
    assert (method, params.least_mm, params.slow) == ("joint", 2.5, False)


def test_a_preset_is_replaced_only_with_force(take, capsys):
    found(take, capsys, "--set", "least_mm=2.5", "--save-preset", "mine")
    again = ["detect", str(take), "--no-slow", "--save-preset", "mine"]
    assert main(again) == 1
    assert "--force" in capsys.readouterr().err
    assert load_preset("mine")[1].least_mm == 2.5
    assert main([*again, "--force"]) == 0
    assert load_preset("mine")[1].least_mm != 2.5


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--set", "speed=3"], "least_mm"),
        (["--set", "least_mm"], "NAME=VALUE"),
        (["--set", "slow=maybe"], "true or false"),
        (["--method", "paper", "--sensitivity", "0.7"], "sensitivity"),
        (["--preset", "nobody"], "nobody"),
    ],
)
def test_bad_choices_are_one_sentence(take, capsys, words, part):
    assert main(["detect", str(take), *words]) == 1
    error = capsys.readouterr().err
    assert part in error
    assert error.count("\n") == 1
