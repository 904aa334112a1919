"""Batches: same bytes however they are run, whatever is killed, and nothing lost or overwritten."""

from __future__ import annotations

import json
import multiprocessing
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

import markermend as mm
from markermend.batch import Recipe, Source, find_takes, read_recipe, run_batch
from markermend.batch.pool import Message
from markermend.batch.work import Job, is_done, sha256
from markermend.cli import main
from markermend.detectors import find_detector
from markermend.errors import Cancelled, ExportError, FileFormatError, MarkermendError, MethodError

Workers = Callable[[], list[multiprocessing.Process]]
SLOWLESS = find_detector("paper").params(slow=False)
RECIPE = Recipe(detector="paper", detector_params=SLOWLESS, min_confidence=0.95, record=True)


def contents(folder: Path) -> dict[str, bytes]:
    """Return every file below a folder, hidden ones too."""
    files = (p for p in folder.rglob("*") if p.is_file())
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in files}


class Heard(list[tuple[Message, Source, float]]):
    """A listener that remembers."""

    def __call__(self, message: Message, take: Source, overall: float) -> None:
        self.append((message, take, overall))

    def count(self, what: str) -> Counter[str]:  # type: ignore[override]
        """How often something happened to each take."""
        return Counter(take.name for message, take, _ in self if message.what == what)


@pytest.fixture(scope="module")
def shoot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Record three takes, one of them in a folder below."""
    folder = tmp_path_factory.mktemp("shoot")
    (folder / "day2").mkdir()
    for seed, name in enumerate(("walk", "run", "day2/walk")):
        take, _ = mm.simulate(duration_s=3 + 0.5 * seed, seed=seed)
        mm.write(take, folder / f"{name}.c3d")
    return folder


@pytest.fixture(scope="module")
def undisturbed(shoot: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Heard]:
    """Clean the takes with two processes."""
    folder, heard = tmp_path_factory.mktemp("clean") / "out", Heard()
    result = run_batch(find_takes([shoot]), folder, RECIPE, jobs=2, listener=heard)
    assert (len(result.takes), result.failures, result.skipped) == (3, {}, 0)
    return folder, heard


def test_results_and_what_is_told(undisturbed: tuple[Path, Heard], shoot: Path) -> None:
    folder, heard = undisturbed
    names = ("walk", "run", "day2/walk")
    products = {f"takes/{n}{end}" for n in names for end in ("_clean.c3d", ".json", ".html")}
    whole = {"recipe.toml", "report.html", "review.json", "index.json"}
    assert set(contents(folder)) == products | whole | {f"state/{n}.json" for n in names}
    assert heard.count("started") == heard.count("done") == Counter(names)
    overall = [share for _, _, share in heard]
    assert overall == sorted(overall)
    assert overall[-1] == pytest.approx(1.0)
    before, after = (mm.read(f) for f in (shoot / "run.c3d", folder / "takes/run_clean.c3d"))
    assert after.present.sum() > before.present.sum()


def test_review_lists_what_is_not_sure(undisturbed: tuple[Path, Heard], shoot: Path) -> None:
    folder, _ = undisturbed
    review = json.loads((folder / "review.json").read_text(encoding="utf-8"))
    assert review["min_confidence"] == 0.95
    listed = {item["name"]: item for item in review["takes"]}
    unsure = 0
    for name in ("walk", "run", "day2/walk"):
        found = json.loads((folder / f"takes/{name}.json").read_text(encoding="utf-8"))
        left = [a for a in found["artifacts"] if a["repair"]["method"] is None]
        unsure += sum(a["confidence"] < 0.95 for a in left)
        assert (name in listed) == bool(left)
        if left:
            assert [a["id"] for a in listed[name]["artifacts"]] == [a["id"] for a in left]
            assert Path(listed[name]["source"]) == (shoot / f"{name}.c3d").resolve()
            assert (folder / listed[name]["cleaned"]).exists()
    assert unsure > 0


@pytest.fixture
def workers() -> Workers:
    """Tell this test's processes; others may have left some that idle."""
    before = multiprocessing.active_children()
    return lambda: [p for p in multiprocessing.active_children() if p not in before]


def test_one_process_and_its_death_change_no_byte(
    undisturbed: tuple[Path, Heard], shoot: Path, tmp_path: Path, workers: Workers
) -> None:
    killed: list[int] = []

    class Killer(Heard):
        def __call__(self, message: Message, take: Source, overall: float) -> None:
            super().__call__(message, take, overall)
            if message.what == "progress" and message.share >= 0.1 and not killed:
                (worker,) = workers()
                worker.kill()
                killed.append(1)

    heard = Killer()
    run_batch(find_takes([shoot]), tmp_path / "out", RECIPE, jobs=1, listener=heard)
    assert killed
    assert contents(tmp_path / "out") == contents(undisturbed[0])
    assert sorted(heard.count("started").values()) == [1, 1, 2]


def test_killed_parent_is_resumed(
    undisturbed: tuple[Path, Heard], shoot: Path, tmp_path: Path
) -> None:
    out, recipe = tmp_path / "out", tmp_path / "my.toml"
    recipe.write_text(RECIPE.to_toml(), encoding="utf-8")
    words = ["batch", str(shoot), "-o", str(out), "--recipe", str(recipe), "--jobs", "1"]
    code = "import sys; from markermend.cli import main; sys.exit(main())"
    with subprocess.Popen(
        [sys.executable, "-c", code, *words, "--progress", "json"],
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout is not None
        events = []
        for line in process.stdout:
            events.append(json.loads(line))
            second = sum(e["event"] == "started" for e in events) == 2
            if second and events[-1].get("share", 0) >= 0.1:
                process.kill()
                break
    assert [e["event"] for e in events].count("done") == 1
    time.sleep(0.5)
    (out / "takes" / ".markermend-0.part").write_bytes(b"half")
    heard = Heard()
    result = run_batch(find_takes([shoot]), out, RECIPE, jobs=1, resume=True, listener=heard)
    # The worker outlives its parent for a moment and may finish the take it was at.
    assert result.skipped in (1, 2)
    assert contents(out) == contents(undisturbed[0])


def test_resume_does_what_is_left_or_changed(
    undisturbed: tuple[Path, Heard], shoot: Path, tmp_path: Path
) -> None:
    takes, out = find_takes([shoot]), tmp_path / "out"
    for name, data in contents(undisturbed[0]).items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_bytes(data)
    (out / "takes/run_clean.c3d").write_bytes(b"gone wrong")
    (out / "state/walk.json").write_text("{", encoding="utf-8")
    result = run_batch(takes, out, RECIPE, jobs=1, resume=True)
    assert result.skipped == 1
    assert contents(out) == contents(undisturbed[0])
    (walk,) = (s for s in takes if s.name == "walk")
    job, digest = Job(walk, out, RECIPE), sha256(walk.path)
    assert is_done(job, digest)
    assert not is_done(replace(job, recipe=replace(RECIPE, record=False)), digest)
    assert not is_done(job, sha256(out / "report.html"))


def test_what_kills_every_worker_fails_and_the_rest_goes_on(
    shoot: Path, tmp_path: Path, workers: Workers
) -> None:
    (tmp_path / "short.c3d").write_bytes((shoot / "walk.c3d").read_bytes()[:3000])
    deaths: list[int] = []

    def kill(message: Message, take: Source, overall: float) -> None:
        if take.name == "run" and message.what == "started":
            (worker,) = workers()
            worker.kill()
            deaths.append(1)

    takes = find_takes([shoot / "run.c3d", shoot / "walk.c3d", tmp_path / "short.c3d"])
    result = run_batch(takes, tmp_path / "out", RECIPE, jobs=1, listener=kill)
    assert len(deaths) == 2
    assert set(result.takes) == {"walk"}
    assert "ended 2 times" in result.failures["run"]
    assert "damaged" in result.failures["short"]
    index = json.loads((tmp_path / "out/index.json").read_text(encoding="utf-8"))
    assert {f["name"]: f["why"] for f in index["failed"]} == result.failures
    assert "ended 2 times" in (tmp_path / "out/report.html").read_text(encoding="utf-8")


def test_listener_can_stop_it(shoot: Path, tmp_path: Path, workers: Workers) -> None:
    def stop(message: Message, take: Source, overall: float) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        run_batch(find_takes([shoot]), tmp_path / "out", RECIPE, jobs=2, listener=stop)
    assert workers() == []


def test_command_line_tells_failures_and_ends_with_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("odd.c3d").write_bytes(b"no take at all")
    assert main(["batch", "odd.c3d", "-o", "out", "--jobs", "1", "--min-confidence", "0.7"]) == 1
    shown = capsys.readouterr()
    assert shown.err.startswith("odd: ")
    assert len(shown.err.splitlines()) == 1
    assert "1 take failed" in shown.out
    assert read_recipe("out/recipe.toml").min_confidence == 0.7
    assert main(["batch", "odd.c3d", "-o", "out"]) == 1
    assert "--resume" in capsys.readouterr().err
    assert main(["batch", "nothing.c3d", "-o", "out2"]) == 1
    said = capsys.readouterr().err
    assert said == "There is no take at “nothing.c3d”; check its name and folder.\n"
    assert not Path("out2").exists()


def test_takes_are_found_and_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("a.c3d", "b/a.c3d", "b/a.TRC", "b/table.csv", "b/.hidden.c3d", "out/takes/a.c3d"):
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).touch()

    def names(*given: str) -> list[str]:
        return [s.name for s in find_takes(given, leave_out="out")]

    assert names(".") == ["a", "b/a_TRC", "b/a_c3d"]
    assert names("b") == ["a_TRC", "a_c3d"]
    assert names("b/*.csv", "a.c3d", "./a.c3d") == ["a", "table"]
    assert names("**/*.c3d") == ["a", "b/a"]
    with pytest.raises(MarkermendError, match="same name"):
        names("a.c3d", "b/a.c3d")
    with pytest.raises(MarkermendError, match="name another folder"):
        names("out")
    with pytest.raises(MarkermendError, match="no take at “c”"):
        names("c")
    for named in ("a.c3d", "b/table.csv"):
        found = find_takes([named], leave_out="b/table.csv")
        with pytest.raises(ExportError, match="is a file; name a folder"):
            run_batch(found, "b/table.csv", jobs=1)
    for name in ("tables/a.csv", "poses/02.asf", "poses/02_01.amc", "poses/02_01_clean.amc"):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).touch()
    Path("poses/dance.BVH").touch()
    with pytest.raises(MarkermendError, match=r"“tables” holds no take ending in \.c3d, \.trc"):
        names("tables")
    assert names("tables/*.csv") == ["a"]
    assert names("poses") == ["02_01", "dance"]


def test_exports_beside_their_source_are_not_takes(tmp_path: Path) -> None:
    for name in ("walk.C3D", "walk_clean.c3d", "run.trc", "run_clean.c3d", "room_clean.c3d"):
        (tmp_path / name).touch()
    assert [s.name for s in find_takes([tmp_path])] == ["room_clean", "run", "walk"]
    assert [s.name for s in find_takes([tmp_path / "walk_clean.c3d"])] == ["walk_clean"]


def test_results_never_replace_takes_or_each_other(tmp_path: Path) -> None:
    source = tmp_path / "takes" / "a.c3d"
    source.parent.mkdir()
    source.write_bytes(b"mine")
    plain = replace(RECIPE, name="{name}")
    with pytest.raises(ExportError, match="one of the takes"):
        run_batch([Source(source, "a")], tmp_path, plain, force=True)
    twins = [Source(source, "a"), Source(tmp_path / "b.c3d", "A")]
    with pytest.raises(ExportError, match="both be written"):
        run_batch(twins, tmp_path / "out", plain)
    (tmp_path / "out/takes").mkdir(parents=True)
    (tmp_path / "out/takes/a_clean.c3d").touch()
    with pytest.raises(ExportError, match="--force"):
        run_batch(twins[:1], tmp_path / "out", RECIPE)
    assert source.read_bytes() == b"mine"


def test_recipe_says_everything_and_comes_back(tmp_path: Path) -> None:
    paper = find_detector("paper").params(slow=False, peak_k=2.5, seed=4)
    output, prior = ("trc", 'x"{name}ü', True, True, True), str(tmp_path.resolve() / "p.npz")
    recipe = Recipe("paper", paper, "spline", 1.0, *output, prior)
    path = tmp_path / "r.toml"
    path.write_text(recipe.to_toml(), encoding="utf-8")
    assert read_recipe(path) == recipe
    assert read_recipe(path).hash == recipe.hash != replace(recipe, method="pchip").hash
    path.write_text("", encoding="utf-8")
    assert read_recipe(path) == Recipe()
    path.write_text("[repair]\nmin_confidence = 1\n", encoding="utf-8")
    assert read_recipe(path).hash == Recipe(min_confidence=1.0).hash


@pytest.mark.parametrize(
    ("text", "error", "words"),
    [
        ("[detect", FileFormatError, "not TOML"),
        ("[detect]\nmetod = 'joint'", FileFormatError, "detect.metod"),
        ("[detect.params]\njobs = 2", FileFormatError, "detect.params.jobs"),
        ("[detect.params]\nslow = 'no'", FileFormatError, "like true"),
        ("detect = 1", FileFormatError, "should be a table"),
        ("[repair]\nmin_confidence = true", FileFormatError, "like 0.5"),
        ("[repair]\nmin_confidence = 2", MethodError, "between 0 and 1"),
        ("[repair]\nmethod = 'magic'", MethodError, "magic"),
        ("[output]\nformat = 'avi'", MethodError, "avi"),
        ("[output]\nname = '../{name}'", MethodError, "no folder"),
    ],
)
def test_recipe_refuses_what_it_does_not_know(
    text: str, error: type[MarkermendError], words: str, tmp_path: Path
) -> None:
    path = tmp_path / "r.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(error, match=words):
        read_recipe(path)
