"""``markermend train``: seeded models, and figures of takes left out."""

from __future__ import annotations

import json

import numpy as np
import pytest

from markermend.artifact import Kind
from markermend.cli import main
from markermend.detectors.joint.left_out import leave_one_out
from markermend.detectors.joint.training import KINDS, Examples, performers
from markermend.files import write
from markermend.simulation import contaminate


@pytest.fixture(scope="module")
def hurt(tmp_path_factory):
    """A take with damage nobody tells of: what false flags are learned from."""
    (clean,) = performers(1, seed=3)
    take, _ = contaminate(clean, share=0.15, amplitude_mm=4.0, seed=1)
    path = tmp_path_factory.mktemp("takes") / "hurt.c3d"
    write(take, path)
    return path


def train(tmp_path, hurt, name, *more):
    path = tmp_path / name
    code = main(
        ["train", "sudden", str(hurt), "--performers=1", "--rounds=1", "-o", str(path), *more]
    )
    return code, path


def test_sudden_writes_the_same_curves_twice_and_judges_each_take(tmp_path, hurt, capsys):
    code, first = train(tmp_path, hurt, "a.json")
    said = capsys.readouterr().out
    _, second = train(tmp_path, hurt, "b.json")
    assert code == 0
    assert first.read_bytes() == second.read_bytes()
    assert set(json.loads(first.read_text())["curves"]) == {"peak", "noise", "step"}
    assert "hurt" in said
    assert "performer 1" in said


def test_bad_input_is_refused_in_a_sentence(tmp_path, hurt, capsys):
    assert train(tmp_path, hurt, "c.json", "--rounds=0")[0] == 2
    assert "“0” is below 1" in capsys.readouterr().err
    (tmp_path / "d.json").write_text("mine")
    assert train(tmp_path, hurt, "d.json")[0] == 1
    assert (tmp_path / "d.json").read_text() == "mine"


def test_leaving_out_uses_the_others_only():
    rng = np.random.default_rng(0)

    def examples(flip):
        real = rng.random(300) < 0.5
        measured = rng.standard_normal((300, 4))
        measured[:, 0] += np.where(real ^ flip, 2.0, -2.0)
        return dict.fromkeys(KINDS, Examples(measured, real))

    rows = leave_one_out([*(examples(False) for _ in range(4)), examples(True)])
    area = [r.area for r in rows if r.kind is Kind.STEP]
    error = [r.error for r in rows if r.kind is Kind.STEP]
    assert area[4] < 0.1 < 0.9 < area[0]
    assert error[4] > 0.5
    nothing = {k: Examples(np.zeros((0, 4)), np.zeros(0, dtype=bool)) for k in KINDS}
    assert all(np.isnan(r.area) for r in leave_one_out([nothing, nothing]))
