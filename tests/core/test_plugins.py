"""Plugins beside our own methods: those that work, and those that do harm."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import tomllib
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import markermend as mm
from markermend.take import Take

ROOT = Path(__file__).resolve().parents[2]
TEMPLATE = ROOT / "docs" / "plugin-template"

HARMFUL = """
import os, time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from markermend.artifact import Artifact, Kind
from markermend.detectors.registry import Detector
from markermend.patch import Patch
from markermend.plugins.formats import Format
from markermend.repairs.registry import Method, Repair
from markermend.smoothers.registry import Smoother
from markermend.take import Take


@dataclass(frozen=True)
class Nothing:
    pass


def dies(*arguments):
    os._exit(3)


def raises(*arguments):
    raise ValueError("out of luck")


def chats(*arguments):
    print("prattle")
    return lambda: None


def greedy(evidence, artifact, params):
    values = np.zeros((artifact.length + 1, 3))
    stop = artifact.stop + 1
    return Repair("greedy", (Patch(artifact.marker, "xyz", artifact.start, stop, values),))


def hangs(take, params, mesh, progress):
    progress(0.5, "hanging")
    time.sleep(600)


def dawdles(evidence, artifact, params):
    Path(__file__).with_name("begun").touch()
    time.sleep(600)


def invents(signals, params):
    return np.nan_to_num(signals.values)


def outside(take, params, mesh, progress):
    return [Artifact("NOBODY", "x", 0, 1, Kind.PEAK)]


def method(name, run):
    return Method(name, name, name, Nothing, run)


dying, raising, greed = method("dying", dies), method("raising", raises), method("greed", greedy)
chatty = method("chatty", chats)
linear, dawdling = method("linear", raises), method("dawdling", dawdles)
hanging = Detector("hanging", "", "", Nothing, hangs)
outsider = Detector("outsider", "", "", Nothing, outside)
inventor = Smoother("inventor", "", "", Nothing, invents)
seen = Format("seen", "Read only", lambda path: Take(np.zeros((9, 3, 3)), ("A", "B", "C"), 100.0))
wrong = 3
"""
HARMFUL_POINTS = {
    "markermend.repairs": {
        "dying": "harmful:dying",
        "raising": "harmful:raising",
        "chatty": "harmful:chatty",
        "greed": "harmful:greed",
        "linear": "harmful:linear",
        "dawdling": "harmful:dawdling",
        "wrong": "harmful:wrong",
        "absent": "nowhere:absent",
    },
    "markermend.detectors": {"hanging": "harmful:hanging", "outsider": "harmful:outsider"},
    "markermend.smoothers": {"inventor": "harmful:inventor"},
    "markermend.formats": {"seen": "harmful:seen"},
}


def installed(folder: Path, name: str, points: dict[str, dict[str, str]]) -> None:
    """Write what an installer would leave of a package: its name and entry points."""
    info = folder / f"{name}-0.1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 0.1.0\n")
    lines = [f"[{g}]\n" + "\n".join(f"{k} = {v}" for k, v in p.items()) for g, p in points.items()]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")


def started(*arguments: str, paths: list[Path], **how: Any) -> subprocess.Popen[str]:
    """Start Python with packages on its path, in a session of its own."""
    rooms = [ROOT / room for room in ("core", "app", "resources")]
    env = os.environ | {"PYTHONPATH": os.pathsep.join(str(p) for p in [*paths, *rooms])}
    words = [sys.executable, *arguments]
    return subprocess.Popen(words, env=env, text=True, start_new_session=True, **how)


def python(*arguments: str, paths: list[Path]) -> subprocess.CompletedProcess[str]:
    """Run Python with packages on its path."""
    pipe = subprocess.PIPE
    with started(*arguments, paths=paths, stdout=pipe, stderr=pipe) as running:
        try:
            out, errors = running.communicate(timeout=120)
        except subprocess.TimeoutExpired:
            running.kill()
            raise
    return subprocess.CompletedProcess(arguments, running.returncode, out, errors)


def commands(*each: list[str], code: int, paths: list[Path]) -> subprocess.CompletedProcess[str]:
    """Run commands one after the other in one Python; all end with this code."""
    lines = [f"assert main({words!r}) == {code}" for words in each]
    return python("-c", "\n".join(["from markermend.cli import main", *lines]), paths=paths)


@pytest.fixture
def template(tmp_path: Path) -> list[Path]:
    """The template package, as an installer would leave it."""
    project = tomllib.loads((TEMPLATE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    installed(tmp_path / "site", "markermend_example", project["entry-points"])
    return [tmp_path / "site", TEMPLATE / "src"]


@pytest.fixture
def harmful(tmp_path: Path) -> list[Path]:
    """A package of plugins that do what they should not."""
    (tmp_path / "bad").mkdir()
    (tmp_path / "bad" / "harmful.py").write_text(HARMFUL)
    installed(tmp_path / "bad", "harmful", HARMFUL_POINTS)
    return [tmp_path / "bad"]


@pytest.fixture
def gappy(tmp_path: Path) -> Path:
    """A take with one gap and one standstill."""
    positions = np.random.default_rng(0).normal(0, 1, (200, 6, 3)).cumsum(axis=0)
    positions[50:60, 2] = np.nan
    positions[100:150, 4] = positions[100, 4]
    path = tmp_path / "take.csv"
    mm.write(Take(positions, tuple("ABCDEF"), 100.0), path)
    return path


def test_every_plugin_of_the_template_works(
    template: list[Path], gappy: Path, tmp_path: Path
) -> None:
    script = f"""
import markermend as mm
from markermend.cli import main
take, out = {str(gappy)!r}, {str(tmp_path)!r}
assert main(["fill", take, "-o", out + "/filled.csv", "--method", "hold"]) == 0
assert main(["smooth", take, "-o", out + "/smooth.csv", "--method", "median"]) == 0
assert main(["detect", take, "--method", "still", "--json", out + "/found.json"]) == 0
assert main(["convert", take, "-o", out + "/take.npz"]) == 0
assert main(["convert", out + "/take.npz", "-o", out + "/again.csv"]) == 0
assert main(["methods", "--json", out + "/methods.json"]) == 0
"""
    # Without asking for its __name__, as a script that knows of no plugins.
    (tmp_path / "drive.py").write_text(script)
    done = python(str(tmp_path / "drive.py"), paths=template)
    assert done.returncode == 0, done.stderr

    filled = mm.read(tmp_path / "filled.csv")
    assert (filled.positions[50:60, 2] == filled.positions[49, 2]).all()
    found = json.loads((tmp_path / "found.json").read_text())["artifacts"]
    still = [a for a in found if a["kind"] == "slow"]
    assert [(a["marker"], a["start"], a["stop"]) for a in still] == [("E", 101, 150)]
    again, original = mm.read(tmp_path / "again.csv"), mm.read(gappy)
    np.testing.assert_array_equal(again.positions, original.positions)
    smooth = mm.read(tmp_path / "smooth.csv")
    assert smooth.present.sum() == original.present.sum()
    assert not np.allclose(smooth.positions[:40], original.positions[:40])
    told = json.loads((tmp_path / "methods.json").read_text())
    hold = next(m for m in told["repair"] if m["name"] == "hold")
    assert hold["plugin"] == "markermend_example"
    assert hold["parameters"][0]["unit"] == "frames"


def test_plugins_that_do_harm_harm_nobody(harmful: list[Path], gappy: Path, tmp_path: Path) -> None:
    script = f"""
import sys
import time
import markermend as mm
from markermend.plugins import faults
from markermend.plugins.worker import Worker
from markermend.progress import heeded
from markermend.repairs import REPAIRS, repair_all, find_gaps

def told(work):
    try:
        work()
    except mm.MarkermendError as error:
        return str(error)
    return "nothing"

def stop(share, doing):
    if doing == "hanging":
        raise mm.Cancelled

take = mm.read({str(gappy)!r})
gap = find_gaps(take)
for name in ("dying", "raising", "chatty", "greed"):
    (_, done), = repair_all(take, gap, method=name)
    assert not done.patches
    print(name, done.reason)
assert repair_all(take, gap, method="linear")[0][1].patches
print(told(lambda: mm.detect(take, method="outsider")))
print(told(lambda: mm.smooth(take, method="inventor")))
began = time.monotonic()
try:
    mm.detect(take, method="hanging", progress=stop)
except mm.Cancelled:
    print("cancelled", time.monotonic() - began < 60)
began, gone = time.monotonic(), lambda share, doing: stop(share, "hanging")
try:
    with heeded(gone):
        repair_all(take, gap, method="dawdling")
except mm.Cancelled:
    print("stopped", time.monotonic() - began < 60)
for fault in faults():
    print(fault.plugin, fault.package, fault.why)
sys.executable = "nowhere"
unstarted = Worker("markermend.repairs", "linear")
print(told(unstarted.call))
unstarted.stop()
"""
    (tmp_path / "drive.py").write_text(script)
    done = python(str(tmp_path / "drive.py"), paths=harmful)

    assert done.returncode == 0, done.stderr
    for sentence in (
        "dying The plugin “dying” broke off: its process died.",
        "raising The plugin “raising” failed (ValueError: out of luck).",
        "chatty The plugin “chatty” failed (its result cannot be passed on, ",
        "greed the plugin wanted to change samples that are not the artifact's",
        "The plugin “outsider” found damage outside the take, on NOBODY.",
        "The plugin “inventor” invented or lost samples; nothing was smoothed.",
        "cancelled True",
        "stopped True",
        "linear harmful there is a method “linear” already",
        "wrong harmful it is a int, not a Method",
        "The plugin “linear” cannot run, since no process can be started (",
        "absent harmful it cannot be loaded (ModuleNotFoundError: No module named 'nowhere')",
    ):
        assert sentence in done.stdout
    # What a plugin prints is no result of ours.
    assert "prattle" in done.stderr
    assert "prattle" not in done.stdout


RECIPE = """
[detect]
method = "{}"

[repair]
method = "{}"

[output]
format = "{}"
"""


def batch(folder: Path, detector: str, repair: str, kind: str) -> list[str]:
    """Words for a batch over a folder "shoot", into one of the kind's name."""
    recipe = folder / f"{kind}.toml"
    recipe.write_text(RECIPE.format(detector, repair, kind))
    words = ["batch", str(folder / "shoot"), "-o", str(folder / kind)]
    return [*words, "--recipe", str(recipe), "--jobs", "1", "--progress", "json"]


def test_a_batch_detects_repairs_reads_and_writes_by_plugins(
    template: list[Path], gappy: Path, tmp_path: Path
) -> None:
    (tmp_path / "shoot").mkdir()
    original = mm.read(gappy)
    for name in ("one.npz", "two_clean.npz", "two.npz"):
        stored = {"positions": original.positions, "labels": original.labels, "rate": 100.0}
        np.savez(tmp_path / "shoot" / name, **stored)
    endings = {"npz": "npz", "same": "npz", "c3d": "c3d"}
    batches = [batch(tmp_path, "still", "hold", kind) for kind in endings]
    done = commands(*batches, code=0, paths=template)
    assert done.returncode == 0, done.stdout + done.stderr
    for kind, ending in endings.items():
        results = (tmp_path / kind / "takes").glob(f"*.{ending}")
        assert {p.name for p in results} == {f"one_clean.{ending}", f"two_clean.{ending}"}
    with np.load(tmp_path / "npz" / "takes" / "one_clean.npz") as clean:
        filled = clean["positions"][50:60, 2]
    np.testing.assert_array_equal(filled, np.tile(original.positions[49, 2], (10, 1)))
    found = json.loads((tmp_path / "npz" / "takes" / "one.json").read_text())["artifacts"]
    assert {a["kind"]: a["repair"]["method"] for a in found} == {"gap": "hold", "slow": "hold"}

    # What was cleaned is known again by its file, and goes into a review.
    script = f"""
import markermend as mm
from markermend.batch.review import take_over, takes_to_review, ToReview
from markermend.batch.work import sha256
from markermend.review.session import Session
source, takes = {str(tmp_path / "shoot" / "one.npz")!r}, {str(tmp_path / "npz" / "takes")!r}
from pathlib import Path
item = ToReview(Path(source), "one", Path(takes, "one.json"), Path(takes, "one_clean.npz"),
    sha256(Path(source)))
take = mm.read(source)
assert take_over(Session(take), item)
assert [t.path.name for t in takes_to_review([{str(tmp_path / "shoot")!r}])] == [
    "one.npz", "two.npz"]
try:
    mm.write(take, source)
except mm.ExportError:
    print("kept")
"""
    done = python("-c", script, paths=template)
    assert done.stdout == "kept\n", done.stderr


def test_a_batch_tells_at_once_what_a_plugin_cannot_write(
    harmful: list[Path], tmp_path: Path
) -> None:
    (tmp_path / "shoot").mkdir()
    (tmp_path / "shoot" / "a.seen").write_text("something")
    batches = [batch(tmp_path, "joint", "auto", kind) for kind in ("same", "seen")]
    done = commands(*batches, code=1, paths=harmful)
    assert done.returncode == 0, done.stderr
    why = json.loads(done.stdout.splitlines()[-2])["why"]
    assert why == (
        "a.seen cannot be written in the format it came in; let the recipe's output format be"
        " c3d, trc or csv."
    )
    assert done.stderr.endswith("must be one of same, c3d, trc, csv, not “seen”.\n")


@pytest.mark.skipif(os.name != "posix", reason="sends what Ctrl-C and a crash send")
@pytest.mark.parametrize("how", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_nothing_outlives_a_batch_that_ends_early(
    how: str, harmful: list[Path], gappy: Path, tmp_path: Path
) -> None:
    (tmp_path / "shoot").mkdir()
    mm.write(mm.read(gappy), tmp_path / "shoot" / "take.trc")
    words = ["-m", "markermend", *batch(tmp_path, "paper", "dawdling", "same")]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    # Tests that run in the background were told not to heed Ctrl-C.
    heeds = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    with started(*words, paths=harmful, preexec_fn=heeds, **pipes) as running:
        end = time.monotonic() + 60
        while not (tmp_path / "bad" / "begun").exists() and time.monotonic() < end:
            time.sleep(0.05)
        if how == "SIGINT":
            # As a terminal does: to all.
            os.killpg(running.pid, signal.SIGINT)
        else:
            running.send_signal(getattr(signal, how))
        # Ends once nobody is left who could write: neither worker nor plugin, which dawdles on.
        _, errors = running.communicate(timeout=30)
    assert (tmp_path / "bad" / "begun").exists(), errors
    if how == "SIGINT":
        assert errors == "Stopped.\n"


def test_what_a_plugin_reads_is_not_judged_by_how_text_begins(
    harmful: list[Path], tmp_path: Path
) -> None:
    """Text in two bytes a letter, or numbers that happen to begin alike."""
    paths = [tmp_path / "a.seen", tmp_path / "b.seen"]
    for path, beginning in zip(paths, (b"\xff\xfe", b"\xfe\xff"), strict=True):
        path.write_bytes(beginning + b"\x01\x02\x03")
    done = commands(*(["info", str(path)] for path in paths), code=0, paths=harmful)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("9 frames") == 2
