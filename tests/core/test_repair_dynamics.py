"""Linear dynamical systems: exactness of inference, what EM gains, bones, and blackouts."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind
from markermend.errors import Cancelled
from markermend.repairs import advise, evidence_for, propose, propose_from
from markermend.repairs.dynamics.bones import find_bones, pull
from markermend.repairs.dynamics.system import System, improve, infer, learn, start_from
from markermend.take import Take

NAMES = ["dynammo", "bolero"]


def random_system(seed: int = 0) -> System:
    rng = np.random.default_rng(seed)
    step = np.array([[0.95, 0.2], [-0.2, 0.95]])
    root = rng.normal(size=(2, 2))
    return System(
        step, 0.05 * (root @ root.T + np.eye(2)), rng.normal(size=(4, 2)),
        rng.uniform(0.05, 0.2, 4), rng.normal(size=2), np.eye(2),
    )  # fmt: skip


def sequence(system: System, n: int, seed: int = 1) -> FloatArray:
    rng = np.random.default_rng(seed)
    state, values = rng.multivariate_normal(system.first, system.first_spread), []
    for _ in range(n):
        values.append(system.output @ state + rng.normal(size=4) * np.sqrt(system.noise))
        state = system.step @ state + rng.multivariate_normal(np.zeros(2), system.motion)
    return np.array(values)


def body(frames: int = 500) -> Take:
    """Two rigid triangles that swing against each other and wander."""
    t = np.arange(frames)[:, None] / 100.0
    corner = np.array([[0.0, 0, 0], [90, 10, 0], [20, 80, 30]])
    found = []
    for speed, far in ((2.0, 0.0), (3.1, 400.0)):
        angle = 0.5 * np.sin(speed * t)
        c, s = np.cos(angle), np.sin(angle)
        turned = np.stack(
            [c * corner[:, 0] - s * corner[:, 1], s * corner[:, 0] + c * corner[:, 1],
             np.broadcast_to(corner[:, 2], (frames, 3))], axis=2,
        )  # fmt: skip
        found.append(turned + far + 100 * np.sin(speed * t / 2 + np.arange(3))[:, None])
    positions = np.concatenate(found, axis=1)
    return Take(positions, tuple("ABCDEF"), 100.0)


def test_states_are_those_of_the_joint_gaussian() -> None:
    system, n = random_system(), 12
    values = sequence(system, n)
    known = np.random.default_rng(2).random(values.shape) < 0.7
    known[5] = False
    # All states at once: precision of the chain, plus what each observation adds.
    precision, pull_, h = np.zeros((2 * n, 2 * n)), np.zeros(2 * n), 2
    inverse = np.linalg.inv(system.motion)
    precision[:h, :h] = np.linalg.inv(system.first_spread)
    pull_[:h] = precision[:h, :h] @ system.first
    for t in range(1, n):
        a, b = slice(h * (t - 1), h * t), slice(h * t, h * (t + 1))
        precision[a, a] += system.step.T @ inverse @ system.step
        precision[b, b] += inverse
        precision[a, b] -= system.step.T @ inverse
        precision[b, a] -= inverse @ system.step
    for t in range(n):
        at, c = slice(h * t, h * (t + 1)), system.output[known[t]]
        precision[at, at] += c.T @ (c / system.noise[known[t], None])
        pull_[at] += c.T @ (values[t, known[t]] / system.noise[known[t]])
    covariance = np.linalg.inv(precision)
    states = infer(system, values, known)
    np.testing.assert_allclose(states.mean.ravel(), covariance @ pull_, atol=1e-9)
    for t in range(n):
        at = slice(h * t, h * (t + 1))
        np.testing.assert_allclose(states.spread[t], covariance[at, at], atol=1e-9)
    for t in range(n - 1):
        a, b = slice(h * t, h * (t + 1)), slice(h * (t + 1), h * (t + 2))
        np.testing.assert_allclose(states.lagged[t], covariance[b, a], atol=1e-9)


def _likelihood(system: System, values: FloatArray, known: np.ndarray) -> float:
    """Log likelihood of what is known, from one joint Gaussian."""
    n, h, d = len(values), 2, 4
    spread = np.zeros((n, h, n, h))
    mean, own, m = np.zeros((n, h)), system.first_spread, system.first
    for t in range(n):
        mean[t], block = m, own
        for s in range(t, n):
            spread[s, :, t] = block
            spread[t, :, s] = block.T
            block = system.step @ block
        own = system.step @ own @ system.step.T + system.motion
        m = system.step @ m
    seen = np.einsum("ah,thsk,bk->tasb", system.output, spread, system.output)
    total = seen.reshape(n * d, n * d) + np.diag(np.tile(system.noise, n))
    at = known.ravel()
    miss = (values - mean @ system.output.T).ravel()[at]
    total = total[np.ix_(at, at)]
    return float(-0.5 * (miss @ np.linalg.solve(total, miss) + np.linalg.slogdet(total)[1]))


def test_every_round_makes_what_is_known_likelier() -> None:
    values = sequence(random_system(), 60)
    known = np.random.default_rng(3).random(values.shape) < 0.8
    system = start_from(np.where(known, values, 0.0), 2)
    found = [_likelihood(system, values, known)]
    for _ in range(8):
        system = improve(system, infer(system, values, known), values, known)
        found.append(_likelihood(system, values, known))
    assert np.all(np.diff(found) > -1e-8)
    assert found[-1] > found[0] + 1.0


def test_rounds_are_told_and_can_stop_it() -> None:
    values = sequence(random_system(), 60)

    def stop(share: float, doing: str) -> None:
        if share > 0.5:
            raise Cancelled

    with pytest.raises(Cancelled):
        learn(values, np.ones(values.shape, dtype=bool), start_from(values, 2), 10, stop)


def test_bones_are_the_rigid_pairs_and_guesses_are_pulled_to_their_lengths() -> None:
    take = body()
    everywhere = np.ones((take.frames, 6), dtype=bool)
    bones = find_bones(take.positions, everywhere)
    pairs = {tuple(int(e) for e in ends) for ends in bones.ends}
    assert pairs == {(0, 1), (0, 2), (1, 2), (3, 4), (3, 5), (4, 5)}
    guess, missing = take.positions.copy(), ~everywhere
    missing[100:150, 1] = True
    rng = np.random.default_rng(0)
    guess[100:150, 1] += rng.normal(size=(50, 3)) * 10
    pulled = pull(guess, np.full(everywhere.shape, 20.0), missing, bones)
    np.testing.assert_array_equal(pulled[~missing], guess[~missing])
    usual = np.linalg.norm(take.positions[0, 1] - take.positions[0, 0])
    off = [
        np.abs(np.linalg.norm((p[:, 1] - p[:, 0])[100:150], axis=1) - usual).mean()
        for p in (guess, pulled)
    ]
    assert off[1] < 0.15 * off[0]
    off = [np.linalg.norm((p - take.positions)[100:150, 1], axis=1).mean() for p in (guess, pulled)]
    assert off[1] < off[0]


@pytest.mark.parametrize("name", NAMES)
def test_it_crosses_a_blackout(name: str) -> None:
    take = body()
    positions = take.positions.copy()
    positions[200:230] = np.nan
    holed, gap = Take(positions, take.labels, take.rate), Artifact("B", "xyz", 200, 230, Kind.GAP)
    assert not propose(holed, gap, method="local_regression").patches
    done = propose(holed, gap, method=name)
    off = np.linalg.norm(done.patches[0].values - take.positions[200:230, 1], axis=1).mean()
    straight = propose(holed, gap, method="linear").patches[0].values
    assert off < 0.5 * np.linalg.norm(straight - take.positions[200:230, 1], axis=1).mean()


def test_advice_measures_them_in_a_blackout_only() -> None:
    take = body(320)
    gap = Artifact("B", "xyz", 200, 230, Kind.GAP)
    for gone, offered in (([1], False), ([0, 1, 2, 3, 4, 5], True), ([1, 2, 3, 4], True)):
        positions = take.positions.copy()
        positions[200:230, gone] = np.nan
        advice = advise(evidence_for(Take(positions, take.labels, take.rate)), gap, trials=1)
        assert ({*NAMES} <= {a.method for a in advice}) == offered
    assert advice[0].repair.patches
    assert advice[0].error_mm is not None


@pytest.mark.parametrize("name", NAMES)
def test_a_blackout_is_learnt_once_for_all_markers(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    from markermend.repairs.dynamics import methods

    take, rounds = body(), []
    positions = take.positions.copy()
    positions[200:230] = np.nan
    holed = Take(positions, take.labels, take.rate)
    gaps = [Artifact(label, "xyz", 200, 230, Kind.GAP) for label in take.labels]
    some = gaps[::5]
    alone = [propose(Take(positions, take.labels, take.rate), g, method=name) for g in some]

    def counted(*given: object) -> object:
        rounds.append(given)
        return learn(*given)

    monkeypatch.setattr(methods, "learn", counted)
    evidence = evidence_for(holed)
    together = [propose_from(evidence, g, method=name) for g in gaps]
    assert len(rounds) == 1
    for one, other in zip(alone, together[::5], strict=True):
        np.testing.assert_array_equal(one.patches[0].values, other.patches[0].values)
