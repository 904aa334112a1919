"""Detection of whole takes: gaps, classes, swaps, and how it is driven."""

from __future__ import annotations

import json
import threading
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

import markermend as mm
from markermend.artifact import Artifact, Kind
from markermend.artifact_json import artifacts_of
from markermend.bench.confusion import class_map, confuse
from markermend.detectors import DETECTORS, PaperParams, detect, detect_gaps
from markermend.detectors.joint import JointParams
from markermend.errors import Cancelled, MethodError
from markermend.mesh import Group, Mesh
from markermend.predictors.inputs import Inputs
from markermend.progress import Progress
from markermend.simulation import contaminate, simulate_clean
from markermend.simulation.contamination import triangle
from markermend.simulation.script import Activity
from markermend.take import Take
from markermend_resources import demo_take, demo_truth

RATE = 100.0
SUDDEN = PaperParams(slow=False, confirm=True)
CONFIRMED = PaperParams(confirm=True)
PUBLISHED = PaperParams(slow=False)


def body(frames: int = 1200, seed: int = 3, labels: Sequence[str] = "ABCDEF") -> Take:
    """Six markers of one body that turns, walks and breathes."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames) / RATE
    shape = np.array(
        [[0, 0, 0], [200, 0, 0], [0, 300, 0], [0, 0, 250], [180, 120, 60], [60, 210, 190]], float
    )
    turn, lean = 0.8 * np.sin(1.1 * t), 0.3 * np.sin(0.7 * t + 1)
    c, s, zero, one = np.cos(turn), np.sin(turn), np.zeros_like(t), np.ones_like(t)
    yaw = np.stack([c, -s, zero, s, c, zero, zero, zero, one], axis=1).reshape(-1, 3, 3)
    c, s = np.cos(lean), np.sin(lean)
    roll = np.stack([one, zero, zero, zero, c, -s, zero, s, c], axis=1).reshape(-1, 3, 3)
    walk = np.stack([400 * np.sin(0.5 * t), 250 * np.cos(0.4 * t), 900 + 20 * np.sin(3 * t)], 1)
    positions = np.einsum("fij,mj->fmi", yaw @ roll, shape) + walk[:, None]
    positions += rng.normal(0, 0.1, positions.shape)
    return Take(positions, tuple(labels), RATE)


def mesh_of(take: Take) -> Mesh:
    """One group of all markers."""
    return Mesh(take.labels, (Group("body", "", tuple(range(take.markers))),))


def changed(take: Take, positions: np.ndarray) -> Take:
    return Take(positions, take.labels, take.rate)


def named(found: Sequence[Artifact], kind: Kind) -> list[Artifact]:
    return [a for a in found if a.kind is kind]


def test_a_clean_take_has_nothing() -> None:
    assert detect(body(), params=SUDDEN) == ()


def test_every_sudden_class_is_found_and_named() -> None:
    take = body()
    x = take.positions.copy()
    x[100, 0, 1] += 15
    x[300:360, 1] += np.random.default_rng(0).normal(0, 12, (60, 3))
    x[600:660, 2] += (30, -20, 0)
    x[900:918, 3] = np.nan
    found = detect(changed(take, x), params=SUDDEN)
    (peak,), (noise,), (step,), (gap,) = (
        named(found, k) for k in (Kind.PEAK, Kind.NOISE, Kind.STEP, Kind.GAP)
    )
    assert (peak.marker, peak.axes, peak.start, peak.stop) == ("A", "y", 100, 101)
    assert peak.amplitude_mm == pytest.approx(15, abs=1)
    assert (noise.marker, noise.axes) == ("B", "xyz")
    assert abs(noise.start - 300) < 5
    assert abs(noise.stop - 360) < 5
    assert (step.marker, step.axes, step.start, step.stop) == ("C", "xy", 600, 660)
    assert step.amplitude_mm == pytest.approx(36, abs=2)
    assert "60 frames (600 ms)" in step.why
    assert step.counterpart is None
    assert (gap.marker, gap.start, gap.stop, gap.confidence) == ("D", 900, 918, 1.0)
    assert gap.why == "not seen for 18 frames (180 ms)"
    assert list(found) == sorted(found, key=lambda a: (a.start, a.marker))
    assert all(0.5 <= a.confidence <= 1 and a.why for a in found)


def test_many_peaks_together_are_heavy_noise() -> None:
    take = body()
    x = take.positions.copy()
    x[400:460:4, 1, 2] += 25
    (noise,) = detect(changed(take, x), params=SUDDEN)
    assert (noise.kind, noise.marker, noise.axes) == (Kind.NOISE, "B", "z")
    assert noise.overlaps(400, 401)
    assert noise.overlaps(456, 457)


def test_a_swap_is_one_artifact_that_names_both() -> None:
    take = body()
    x = take.positions.copy()
    x[500:540, [1, 4]] = x[500:540, [4, 1]]
    (swap,) = detect(changed(take, x), params=SUDDEN)
    assert (swap.marker, swap.counterpart, swap.axes) == ("B", "E", "xyz")
    assert (swap.kind, swap.start, swap.stop) == (Kind.STEP, 500, 540)
    distance = np.linalg.norm(take.positions[500, 1] - take.positions[500, 4])
    assert swap.amplitude_mm == pytest.approx(distance, rel=0.05)
    assert "E" in swap.why


def test_a_swap_with_a_trajectory_that_lives_only_then_is_found() -> None:
    take = body(labels=[*"ABCDE", "*1"])
    x = take.positions.copy()
    x[:, 5] = np.nan
    x[700:760, 5] = x[700:760, 0]
    x[700:760, 0] += (0, 80, 30)
    (swap,) = detect(changed(take, x), params=SUDDEN)
    assert (swap.marker, swap.counterpart) == ("A", "*1")
    assert (swap.start, swap.stop) == (700, 760)


def test_nameless_trajectories_are_not_judged() -> None:
    take = body(labels=[*"ABCDE", "*1"])
    x = take.positions.copy()
    x[100, 5] += 50
    x[200:260, 5] = np.nan
    assert detect(changed(take, x), params=SUDDEN) == ()


def test_gaps_at_the_ends_count_only_while_the_body_is_there() -> None:
    take = body()
    x = take.positions.copy()
    x[:40] = np.nan
    x[40:70, 0] = np.nan
    x[1190:, 1] = np.nan
    x[:, 2] = np.nan
    x[30:, 3] = np.nan
    x[30:50, 3] = take.positions[30:50, 3]
    gaps = detect_gaps(changed(take, x))
    assert {(g.marker, g.start, g.stop) for g in gaps} == {("A", 40, 70), ("B", 1190, 1200)}


def test_damage_of_any_size_keeps_its_interval() -> None:
    take = body()
    seen = set()
    for size in (10, 30, 100, 1000):
        x = take.positions.copy()
        x[600:660, 2, 0] += size
        (step,) = detect(changed(take, x), params=SUDDEN)
        seen.add((step.marker, step.axes, step.start, step.stop, step.kind))
    assert len(seen) == 1


def test_gaps_alone_are_never_sudden_artifacts() -> None:
    take = body()
    rng = np.random.default_rng(8)
    x = take.positions.copy()
    for marker in range(5):
        for start in rng.integers(20, 1150, 12):
            x[start : start + rng.integers(1, 40), marker] = np.nan
    found = detect(changed(take, x), params=SUDDEN)
    assert {a.kind for a in found} == {Kind.GAP}


@pytest.mark.parametrize("frames", [1, 2, 5, 20, 60])
def test_short_takes_are_no_trouble(frames: int) -> None:
    take = body(frames)
    assert detect(take, mesh=mesh_of(take), params=CONFIRMED) == ()
    detect(take, mesh=mesh_of(take), params=PaperParams())


def test_a_take_without_markers_or_names_has_nothing() -> None:
    assert detect(Take(np.empty((50, 0, 3)), (), RATE), method="paper") == ()
    nameless = body(labels=[f"*{i}" for i in range(6)])
    assert detect(nameless, method="paper") == ()


def test_a_slow_change_is_found_where_the_body_contradicts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    take = body()
    x = take.positions.copy()
    x[400:500, 2, 1] += 12 * np.hanning(100)
    x[800:900, 4, 2] += 12 * np.hanning(100)
    x[830:870, 4] = np.nan
    where = {id_of(take.positions[:, m]): m for m in range(6)}

    def oracle(inputs: Inputs, rate: float, params: object, seed: int) -> np.ndarray:
        """Know where the marker should be, to a fifth of a millimetre."""
        noise = np.random.default_rng(seed).normal(0, 0.2, (take.frames, 3))
        return take.positions[:, where[id_of(inputs.own)]] + noise

    monkeypatch.setattr("markermend.detectors.slow.fit_and_predict", oracle)
    found = detect(changed(take, x), mesh=mesh_of(take), params=PaperParams(confirm=True, jobs=1))
    (slow,) = named(found, Kind.SLOW)
    assert (slow.marker, slow.axes) == ("C", "y")
    assert 400 <= slow.start < 430
    assert 470 < slow.stop <= 500
    assert slow.amplitude_mm == pytest.approx(12, abs=1)
    assert slow.confidence < 0.5
    assert "up to 12 mm from where its body says it should be" in slow.why


def id_of(trajectory: np.ndarray) -> float:
    """Tell trajectories apart by their first sample."""
    return float(trajectory[0, 0])


def test_networks_find_the_same_in_any_number_of_processes_and_any_thread(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("markermend.detectors.slow.WORTH_PROCESSES", 0)
    whole = mm.read(demo_take())
    chosen = [whole.index(m) for m in ("STRN", "LASI", "LPSI", "RASI", "RPSI")]
    take = Take(whole.positions[:, chosen], tuple(whole.labels[i] for i in chosen), whole.rate)
    results: list[tuple[Artifact, ...]] = []
    for jobs in (1, 2):
        params = PaperParams(jobs=jobs)
        worker = threading.Thread(
            target=lambda p=params: results.append(detect(take, mesh=mesh_of(take), params=p))
        )
        worker.start()
        worker.join()
    assert results[0] == results[1]
    assert named(results[0], Kind.SLOW)


def test_without_slow_changes_no_network_is_trained(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*args: object) -> None:
        raise AssertionError("a network was trained")

    monkeypatch.setattr("markermend.detectors.slow.fit_and_predict", never)
    monkeypatch.setattr("markermend.detectors.paper.infer_mesh", never)
    detect(body(), params=SUDDEN)


@pytest.mark.parametrize("calls", [1, 3, 5])
def test_cancel_stops_at_once(calls: int) -> None:
    told: list[float] = []

    def progress(share: float, doing: str) -> None:
        told.append(share)
        assert doing
        if len(told) == calls:
            raise Cancelled

    take = body(300)
    with pytest.raises(Cancelled):
        detect(take, mesh=mesh_of(take), params=PaperParams(), progress=progress)
    assert len(told) == calls


def test_progress_runs_from_start_to_end() -> None:
    told: list[float] = []
    take = body(300)
    report: Progress = lambda share, doing: told.append(share)  # noqa: E731
    detect(take, mesh=mesh_of(take), params=PaperParams(), progress=report)
    assert told == sorted(told)
    assert told[0] == 0.0
    assert told[-1] == 1.0


def test_unknown_methods_and_foreign_parameters_are_refused() -> None:
    with pytest.raises(MethodError, match="paper"):
        detect(body(50), method="guess")
    with pytest.raises(MethodError, match="“paper” takes PaperParams"):
        detect(body(50), method="paper", params=JointParams())
    with pytest.raises(MethodError, match="no parameter “slw”; it has sensitivity, slow"):
        detect(body(50), slw=False)
    with pytest.raises(MethodError, match=r"“sensitivity” .*between 0 and 1, not 7"):
        detect(body(50), sensitivity=7)
    assert DETECTORS["paper"].params is PaperParams


def test_the_demo_takes_sudden_damage_is_found_as_published() -> None:
    take = mm.read(demo_take())
    truth = artifacts_of(json.loads(demo_truth().read_text()))
    found = detect(take, params=PUBLISHED)
    for kind in (Kind.PEAK, Kind.NOISE, Kind.STEP):
        real = named(truth, kind)
        hit = [a for a in real if any(_same(a, b) for b in named(found, kind))]
        assert len(hit) >= 0.8 * len(real), kind


@pytest.fixture(scope="module")
def standing() -> Take:
    """A person who stands, denoised as recordings for the published experiment were."""
    take = simulate_clean(duration_s=32, activities=(Activity("stand", 32.0),), seed=1)
    low_pass = butter(4, 12, fs=take.rate, output="sos")
    return changed(take, sosfiltfilt(low_pass, take.positions, axis=0))


@pytest.mark.parametrize("amplitude", [5.0, 10.0])
def test_published_rates_are_met_on_a_calm_take(standing: Take, amplitude: float) -> None:
    damaged, truth = contaminate(standing, amplitude_mm=amplitude, seed=0)
    found = detect(damaged, params=PUBLISHED)
    everywhere = np.ones(damaged.positions.shape, dtype=bool)
    rates = confuse(class_map(damaged, truth), class_map(damaged, found), everywhere)
    assert rates.tpr("peak") > 0.9
    assert rates.tpr("noise") > 0.85
    assert rates.tpr("step") > 0.7
    assert rates.ppv("peak") > 0.5
    assert rates.ppv("noise") > 0.6
    assert rates.ppv("step") > 0.7


def test_a_slow_change_is_found_as_published(standing: Take) -> None:
    chosen = list(range(8))
    x = standing.positions[:1600, chosen].copy()
    x[700:780, 3, 2] += 10 * triangle(80)
    take = Take(x, standing.labels[:8], standing.rate)
    body = Mesh(take.labels, (Group("body", "", tuple(chosen)),))
    found = detect(take, mesh=body, params=PaperParams(jobs=1))
    hits = [a for a in named(found, Kind.SLOW) if a.marker == take.labels[3]]
    assert any(a.overlaps(730, 750) and "z" in a.axes for a in hits)
    assert all(a.confidence < 0.5 for a in named(found, Kind.SLOW))


def test_parameters_choose_their_method() -> None:
    take = body(300)
    assert detect(take, params=SUDDEN) == detect(take, method="paper", params=SUDDEN)
    joint = JointParams(slow=False)
    found = detect(take, method="joint", params=joint)
    assert detect(take, params=joint) == found
    assert detect(take, slow=False) == found
    assert detect(take, params={"slow": True}, slow=False) == found


def test_the_demo_take_is_read_as_it_was_damaged() -> None:
    take = mm.read(demo_take())
    truth = artifacts_of(json.loads(demo_truth().read_text()))
    found = detect(take, params=SUDDEN)
    for kind, least in ((Kind.GAP, 1.0), (Kind.PEAK, 0.8), (Kind.NOISE, 0.8), (Kind.STEP, 0.8)):
        real = named(truth, kind)
        hit = [a for a in real if any(_same(a, b) for b in named(found, kind))]
        assert len(hit) >= least * len(real), kind
    alarms = [b for b in found if not any(_same(a, b) for a in truth)]
    assert len(alarms) <= 3


def _same(a: Artifact, b: Artifact) -> bool:
    """Whether two artifacts share frames and a marker."""
    shared = {a.marker, a.counterpart} & {b.marker, b.counterpart} - {None}
    return bool(shared) and a.overlaps(b.start, b.stop)


@pytest.mark.parametrize("name", ["85_02.c3d", "HDM_mm_01-02_03_120.c3d"])
def test_contaminated_real_takes(shared_data: Path, name: str) -> None:
    take = mm.read(shared_data / "bodies" / name)
    assert len(detect(take, params=SUDDEN)) <= 5
    hits = {Kind.NOISE: [0, 0], Kind.STEP: [0, 0], Kind.PEAK: [0, 0]}
    alarms = 0
    for seed in range(3):
        damaged, truth = contaminate(take, amplitude_mm=10, seed=seed)
        found = detect(damaged, params=SUDDEN)
        for a in truth:
            if a.kind in hits:
                hits[a.kind][0] += any(_same(a, b) for b in named(found, a.kind))
                hits[a.kind][1] += 1
        alarms += sum(not any(_same(a, b) for a in truth) for b in found)
    share = {kind: hit / total for kind, (hit, total) in hits.items()}
    assert share[Kind.NOISE] >= 0.8
    assert share[Kind.STEP] >= 0.75
    assert share[Kind.PEAK] >= 0.3
    assert alarms <= 15


@pytest.mark.parametrize("method", ["joint", "paper"])
@pytest.mark.parametrize("shape", [(0, 3, 3), (1, 3, 3), (5, 0, 3), (2, 1, 3), (300, 3, 3)])
def test_what_hardly_is_a_take_or_never_moves_has_no_artifacts(method, shape):
    apart = 100.0 * np.arange(shape[1])[None, :, None]
    take = Take(np.zeros(shape) + apart, tuple("ABC"[: shape[1]]), 100.0)
    assert detect(take, method=method) == ()


def test_a_jump_is_found_at_one_frame_a_second():
    time = np.arange(200.0)[:, None, None]
    apart = 100.0 * np.arange(4)[None, :, None]
    moving = 50 * np.sin(time / 40) + apart + np.random.default_rng(1).normal(0, 0.2, (200, 4, 3))
    moving[100:130, 2, 1] += 80.0
    found = detect(Take(moving, tuple("ABCD"), 1.0))
    assert any(a.marker == "C" and a.start <= 100 < a.stop for a in found)
