from __future__ import annotations

import json

import numpy as np
import pytest

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.artifact_json import artifacts_of
from markermend.simulation import simulate
from markermend_resources import demo_take, demo_truth, manual_folder


def test_the_demo_is_what_its_seed_makes() -> None:
    shipped = mm.read(demo_take())
    made, truth = simulate()
    assert (shipped.labels, shipped.rate, shipped.warnings) == (made.labels, made.rate, ())
    assert shipped.positions.shape == made.positions.shape
    # The file holds 32-bit floats, and processors differ in the last bits.
    assert np.allclose(shipped.positions, made.positions, atol=1e-2, equal_nan=True)
    assert shipped.residuals is not None
    assert made.residuals is not None
    assert np.allclose(shipped.residuals, made.residuals, atol=0.011, equal_nan=True)
    document = json.loads(demo_truth().read_text(encoding="utf-8"))
    told = artifacts_of(document)
    assert [place(a) for a in told] == [place(a) for a in truth]
    for a, b in zip(told, truth, strict=True):
        assert a.amplitude_mm == pytest.approx(b.amplitude_mm, abs=1e-3, nan_ok=True)
    assert (document["take"], document["frames"]) == ("demo.c3d", shipped.frames)


def place(a: Artifact) -> tuple[object, ...]:
    return (a.marker, a.axes, a.start, a.stop, a.kind, a.counterpart)


def test_the_demo_shows_every_class_and_stays_small() -> None:
    told = artifacts_of(json.loads(demo_truth().read_text(encoding="utf-8")))
    assert {a.kind for a in told} == set(Kind)
    assert any(a.counterpart for a in told)
    assert demo_take().stat().st_size < 5_000_000
    places = {
        (a.start, a.stop, frozenset((a.marker, a.counterpart))) for a in told if a.counterpart
    }
    damaged = len(places) + sum(a.counterpart is None for a in told)
    manual = (manual_folder() / "first-ten-minutes.md").read_text(encoding="utf-8")
    assert f"{damaged} places that are damaged on purpose" in manual
