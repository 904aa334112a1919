"""Batches on a real Dask scheduler, whose workers are killed."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

import markermend as mm
from markermend.batch import Recipe, Source, find_takes, run_batch
from markermend.batch.cluster import alone
from markermend.batch.pool import Message
from markermend.cli import main
from markermend.detectors import find_detector

distributed = pytest.importorskip("distributed")
RECIPE = Recipe(detector="joint", detector_params=find_detector("joint").params(slow=False))


def contents(folder: Path) -> dict[str, bytes]:
    files = (p for p in folder.rglob("*") if p.is_file())
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in files}


@pytest.fixture(scope="module")
def cluster() -> Iterator[distributed.LocalCluster]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as running:
        yield running


@pytest.fixture(scope="module")
def shoot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("shoot")
    for seed in range(3):
        mm.write(mm.simulate(duration_s=2, seed=seed)[0], folder / f"{seed}.c3d")
    (folder / "short.c3d").write_bytes((folder / "0.c3d").read_bytes()[:3000])
    return folder


def test_killed_workers_change_no_byte(
    cluster: distributed.LocalCluster, shoot: Path, tmp_path: Path
) -> None:
    takes = find_takes([shoot])
    alone_here = run_batch(takes, tmp_path / "here", RECIPE, jobs=1)
    killed: set[int] = set()
    told: list[tuple[str, str]] = []

    def kill(message: Message, take: Source, overall: float) -> None:
        told.append((take.name, message.what))
        if not killed:
            killed.update(worker.pid for worker in cluster.workers.values())
            for pid in killed:
                os.kill(pid, signal.SIGTERM if os.name == "nt" else signal.SIGKILL)

    there = run_batch(
        takes, tmp_path / "there", RECIPE, cluster=cluster.scheduler_address, listener=kill
    )
    assert killed.isdisjoint(worker.pid for worker in cluster.workers.values())
    assert there == alone_here
    assert set(there.failures) == {"short"}
    assert sorted(told) == sorted([(str(n), "done") for n in range(3)] + [("short", "failed")])
    assert contents(tmp_path / "there") == contents(tmp_path / "here")
    with distributed.Client(cluster) as client:
        again = run_batch(takes, tmp_path / "there", RECIPE, cluster=client, resume=True)
        assert again.skipped == 3
        assert client.status == "running"


def test_worker_of_another_version_is_refused() -> None:
    what, sentence = alone(lambda job, progress: job, 1, "0.0.1")
    assert what == "failed"
    assert mm.__version__ in sentence


def test_address_without_cluster_is_one_sentence(
    shoot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("markermend.batch.cluster._CONNECT_S", 0.5)
    words = ["batch", str(shoot), "-o", str(tmp_path / "out"), "--cluster", "tcp://127.0.0.1:9"]
    assert main(words) == 1
    shown = capsys.readouterr().err
    assert shown.startswith("No cluster answers at “tcp://127.0.0.1:9”")
    assert len(shown.splitlines()) == 1
    assert not (tmp_path / "out").exists()
