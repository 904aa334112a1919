"""The recurrent networks: counts, training, cancelling; and what is said without the extra."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.errors import Cancelled
from markermend.repairs import propose
from markermend.repairs.skurowski2021 import recurrent
from markermend.repairs.skurowski2021.network import Training
from markermend.repairs.skurowski2021.recurrent import build, can_learn, fit
from markermend.take import Take

NAMES = ["lstm", "gru", "bilstm"]
GAP = Artifact("M2", "xyz", 300, 340, Kind.GAP)
needs_extra = pytest.mark.skipif(not can_learn(), reason="the optional extra “deep” is missing")


@pytest.fixture(scope="module")
def truth() -> Take:
    """Markers that share three movements."""
    rng = np.random.default_rng(0)
    t = np.arange(600)[:, None] / 100.0
    shared = 100 * np.sin(rng.uniform(1, 6, 3) * t + rng.uniform(0, 6, 3))
    positions = shared[:, None] + rng.normal(size=(6, 3)) * 150
    positions = positions + 5 * np.sin(3 * t[:, :, None] + rng.uniform(0, 6, (6, 3)))
    return Take(positions, tuple(f"M{i}" for i in range(6)), 100.0)


@pytest.fixture(scope="module")
def holed(truth: Take) -> Take:
    positions = truth.positions.copy()
    positions[GAP.start : GAP.stop, 2] = np.nan
    return Take(positions, truth.labels, truth.rate)


@pytest.mark.parametrize("name", NAMES)
def test_without_the_extra_it_says_how_to_get_it(
    name: str, holed: Take, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recurrent, "find_spec", lambda module: None)
    done = propose(holed, GAP, method=name)
    assert not done.patches
    assert 'pip install "markermend[deep]"' in done.reason
    assert done.reason.count(".") == 1


@pytest.mark.deep
@needs_extra
@pytest.mark.parametrize(
    ("name", "plain", "dense"),
    # Table 4 of skurowski2021 for 30 inputs; for BiLSTM what its formula gives.
    [("lstm", 22_023, 22_355), ("gru", 16_563, 16_895), ("bilstm", 44_043, 44_675)],
)
def test_thirty_inputs_make_the_papers_parameters(name: str, plain: int, dense: int) -> None:
    assert build(name, 30).count_params() == plain
    assert build(name, 30, dense=True).count_params() == dense


@pytest.mark.deep
@needs_extra
@pytest.mark.parametrize("name", NAMES)
def test_it_learns_what_the_marker_does(name: str, truth: Take, holed: Take) -> None:
    done = propose(holed, GAP, method=name, params={"epochs": 80})
    values, own = done.patches[0].values, truth.positions[:, 2]
    miss = np.linalg.norm(values - own[GAP.start : GAP.stop], axis=1).mean()
    moved = np.linalg.norm(own - own.mean(axis=0), axis=1).mean()
    assert miss < 0.5 * moved
    again = propose(holed, GAP, method=name, params={"epochs": 80})
    np.testing.assert_array_equal(values, again.patches[0].values)


@pytest.mark.deep
@needs_extra
def test_frames_without_weight_teach_nothing() -> None:
    rng = np.random.default_rng(0)
    inputs, targets = rng.normal(size=(50, 6)), rng.normal(size=(50, 3))
    rows = np.arange(50) < 40
    found = []
    for rest in (0.0, 100.0):
        changed = np.where(rows[:, None], targets, rest)
        model = build("gru", 6)
        found.append(fit(model, inputs, changed, rows, Training(5), lambda share, doing: None))
    np.testing.assert_array_equal(found[0], found[1])


@pytest.mark.deep
@needs_extra
def test_every_epoch_is_told_and_can_stop_it(holed: Take) -> None:
    told: list[tuple[float, str]] = []

    def report(share: float, doing: str) -> None:
        told.append((share, doing))
        if doing.startswith("Epoch 3 "):
            raise Cancelled

    with pytest.raises(Cancelled):
        propose(holed, GAP, method="gru", params={"epochs": 10}, progress=report)
    epochs = [(share, doing.split(",")[0]) for share, doing in told if doing.startswith("Epoch")]
    assert epochs == [(k / 10, f"Epoch {k} of 10") for k in (1, 2, 3)]
