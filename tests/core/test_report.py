"""Reports: whole, safe and self-contained HTML, and pictures that show what is there."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import markermend as mm
from markermend.artifact import Artifact, Kind, Status
from markermend.cli import main
from markermend.outcome import Outcome, cleaned_document, outcomes
from markermend.patch import patched
from markermend.repairs import REPAIRS, repair_all
from markermend.report import batch_parts, quality, take_report
from markermend.report.svg import damage_map, decimate, path, ticks, worst
from markermend.review.file import open_session
from markermend.review.hand import cut
from markermend.review.pace import Stopwatch
from markermend.review.session import Session

EMPTY = {"meta", "link", "br", "hr", "img", "input"}
HOSTILE = "</script><b>&\"LFHD'"


class Reader(HTMLParser):
    """Follow a page's elements, refusing any that closes out of turn."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def embedded(text: str, kind: str) -> list[dict]:
    found = re.findall(rf'<script type="application/json" class="{kind}">(.*?)</script>', text)
    return [json.loads(one) for one in found]


@pytest.fixture(scope="module")
def cleaned() -> tuple[mm.Take, mm.Take, tuple[Outcome, ...]]:
    take, truth = mm.simulate(duration_s=6, seed=3)
    labels = (HOSTILE, *take.labels[1:])
    take = replace(take, labels=labels)
    truth = tuple(replace(a, marker=HOSTILE) if a.marker not in labels else a for a in truth)
    unsure = Artifact(HOSTILE, "xy", 20, 30, Kind.PEAK, 0.3, 4.0, "looks <odd>")
    false = Artifact(labels[5], "z", 40, 60, Kind.NOISE, 0.9, status=Status.REJECTED)
    found = (*truth, unsure, false)
    pairs = repair_all(take, found)
    after = patched(take, (p for _, repair in pairs for p in repair.patches))
    return take, after, outcomes(found, pairs, 0.5)


def report(cleaned: tuple[mm.Take, mm.Take, tuple[Outcome, ...]]) -> str:
    return take_report(*cleaned, method="truth", name="walk <1>.c3d")


def test_page_is_whole_safe_and_needs_no_network(cleaned) -> None:
    text = report(cleaned)
    reader = Reader(text)
    assert not any("src" in attrs for _, attrs in reader.seen)
    assert all((attrs.get("href") or "#").startswith("#") for _, attrs in reader.seen)
    assert "http" not in re.sub(r"http-equiv", "", text)
    assert "<b>&" not in text.replace("<b>&lt;", "")
    assert "looks &lt;odd&gt;" in text
    assert text == report(cleaned)


def test_methods_go_by_their_labels(cleaned) -> None:
    _, _, done = cleaned
    html = report(cleaned)
    table = html[html.index("What was repaired") :].split('<script type="application/json"')[0]
    used = {o.method for o in done if o.method}
    assert used
    assert all(REPAIRS[name].label in table for name in used)
    assert "local_regression" not in table


@pytest.mark.parametrize(
    ("method", "said"),
    [
        ("joint", "Detected by “joint”"),
        ("sudden", "Searched for gaps, peaks, noise and steps"),
        ("sudden, all kinds", "noise and steps and for artifacts of all classes"),
        ("hand", "Detected by “hand”"),
    ],
)
def test_it_says_what_was_searched_for(method: str, said: str) -> None:
    take = mm.Take(np.zeros((20, 2, 3)), ("A", "B"), 100.0)
    assert said in take_report(take, take, (), method=method, name="t")


def test_json_inside_tells_the_same(cleaned) -> None:
    take, _, done = cleaned
    (values,) = embedded(report(cleaned), "take")
    inside = values.pop("quality")
    expected = cleaned_document(take, done, "truth", mm.__version__, name="walk <1>.c3d")
    assert values == expected
    assert any(item["marker"] == HOSTILE for item in values["artifacts"])
    assert inside["gap_before"] > inside["gap_after"]
    assert inside["review"] == sum(
        o.method is None and o.artifact.status is Status.PENDING for o in done
    )
    assert sum(inside["repaired"].values()) == sum(o.method is not None for o in done)


def test_quality_counts_named_markers_only(cleaned) -> None:
    take, _, _ = cleaned
    starred = replace(take, labels=("*1", *take.labels[1:]))
    mine = quality("a", starred, starred, ())
    assert mine.markers == take.markers - 1
    assert mine.gap_before == pytest.approx(1 - take.present[:, 1:].mean())
    assert mine.worst_mm is None


def test_damage_map_draws_every_artifact_in_its_place(cleaned) -> None:
    take, _, done = cleaned
    picture = ET.fromstring(damage_map(take, done))
    drawn = [r for r in picture.iter("rect") if r.get("class") not in ("odd", "even")]
    assert len(drawn) == len(done)
    row = {label: 11.0 * i for i, label in enumerate(take.labels)}
    for shape, o in zip(drawn, done, strict=True):
        kind, state = str(shape.get("class")).split()
        assert (kind, state) == (o.artifact.kind.value, "mended" if o.method else "left")
        assert row[o.artifact.marker] <= float(shape.get("y", "")) < row[o.artifact.marker] + 11
        share = (float(shape.get("x", "")) - 130) / (1000 - 130 - 14)
        assert share == pytest.approx(o.artifact.start / take.frames, abs=1e-3)
        assert o.artifact.marker in str(shape.findtext("title"))


def test_curves_are_valid_and_the_worst_come_first(cleaned) -> None:
    _, _, done = cleaned
    text = report(cleaned)
    pictures = re.findall(r"<svg.*?</svg>", text, re.S)
    assert len(pictures) == 1 + min(6, sum(o.method is not None for o in done))
    for picture in pictures:
        assert "nan" not in re.sub(r"<title>.*?</title>", "", picture).lower()
        ET.fromstring(picture)
    # No label of a time is cut off at the right edge.
    labels = re.findall(r'<text x="([\d.]+)" y="181" text-anchor="(\w+)">', "".join(pictures[1:]))
    assert labels
    assert all(float(x) + 14 * (anchor == "middle") <= 480 for x, anchor in labels)
    errors = [o.error_mm or 0.0 for o in worst(done, 99)]
    assert errors == sorted(errors, reverse=True)


def test_nothing_damaged_is_said() -> None:
    take, _ = mm.simulate(duration_s=2, damaged=False)
    text = take_report(take, take, (), method="joint", name="still")
    Reader(text)
    assert "Nothing is damaged" in text


def test_batch_joins_index_and_takes(cleaned) -> None:
    take, after, done = cleaned
    good = [quality(name, take, after, done) for name in ("a", "b<c")]
    pages = [take_report(take, after, done, method="truth", name=q.name) for q in good]
    text = "".join(batch_parts(good, {"bad&": "It is “<broken>”."}, iter(pages)))
    reader = Reader(text)
    links = {str(a["href"])[1:] for tag, a in reader.seen if tag == "a"}
    assert links == {str(a["id"]) for _, a in reader.seen if "id" in a}
    assert len(links) == 2
    assert "bad&amp;</b>: It is “&lt;broken&gt;”." in text
    (index,) = embedded(text, "index")
    assert [q["name"] for q in index["takes"]] == ["a", "b<c"]
    assert index["failed"] == [{"name": "bad&", "why": "It is “<broken>”."}]
    assert len(embedded(text, "take")) == 2


@given(
    st.lists(st.one_of(st.floats(-1e3, 1e3), st.just(np.nan)), min_size=1, max_size=500),
    st.integers(9, 60),
)
def test_decimation_keeps_extremes_and_gaps(values: list[float], most: int) -> None:
    y = np.array(values)
    kept = y[decimate(y, most)]
    assert len(kept) <= max(most + 2, 3)
    if np.isfinite(y).any():
        assert np.nanmin(kept) == np.nanmin(y)
        assert np.nanmax(kept) == np.nanmax(y)
    assert np.isnan(kept).any() == np.isnan(y).any()


@given(st.floats(-1e4, 1e4), st.floats(1e-3, 1e4), st.integers(2, 12))
def test_ticks_are_few_and_inside(low: float, span: float, about: int) -> None:
    marks = ticks(low, low + span, about)
    assert len(marks) <= 2 * about + 1
    assert all(low - 1e-6 * span <= m <= low + span * (1 + 1e-6) for m in marks)


def test_path_breaks_where_nothing_was_seen() -> None:
    x = np.arange(5.0)
    assert path(x, np.array([1, 2, np.nan, 3, 4.0])) == "M0.0 1.0h0L1.0 2.0M3.0 3.0h0L4.0 4.0"
    assert path(x, np.array([np.nan, 1, np.nan, 3, np.nan])) == "M1.0 1.0h0M3.0 3.0h0"
    assert path(x, np.full(5, np.nan)) == ""


def test_clean_writes_a_report(tmp_path: Path) -> None:
    take, _ = mm.simulate(duration_s=3, seed=2)
    source, out, html = (tmp_path / n for n in ("t.c3d", "o.c3d", "o.html"))
    mm.write(take, source)
    words = ["clean", str(source), "-o", str(out), "--no-slow", "--report", str(html)]
    assert main(words) == 0
    text = html.read_text(encoding="utf-8")
    Reader(text)
    assert embedded(text, "take")[0]["take"] == "t.c3d"
    assert main(words) == 1


@pytest.fixture
def review(tmp_path: Path) -> tuple[Path, Session]:
    """Review a take: one of each decision, a note, samples cut by hand; then save."""
    take, truth = mm.simulate(duration_s=4, seed=3)
    path = tmp_path / "walk.c3d"
    mm.write(take, path)
    file = open_session(mm.read(path))
    session, clock = file.session, iter(range(0, 100, 2))
    session.stopwatch = Stopwatch(lambda: next(clock))
    session.add_detected(truth, "truth")
    accepted, rejected, mended = (a.id for a in session.artifacts[:3])
    session.set_status([accepted], Status.ACCEPTED)
    session.annotate(accepted, f"the marker fell off {HOSTILE}")
    session.set_status([rejected], Status.REJECTED)
    others = [a for a in session.artifacts if a.id == mended]
    session.repair([(a.id, r) for a, r in repair_all(session.take, others, min_confidence=0)])
    cut(session, take.labels[0], 5, 9)
    file.save()
    file.close()
    return path, session


def test_a_review_is_reported_with_notes_hand_work_and_pace(
    review: tuple[Path, Session], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, session = review
    page, facts = tmp_path / "walk.html", tmp_path / "walk.json"
    assert main(["report", str(path), "-o", str(page), "--json", str(facts)]) == 0
    assert "3 of" in capsys.readouterr().out
    text = page.read_text(encoding="utf-8")
    Reader(text)
    values = json.loads(re.findall(r'class="take">(.*?)</script>', text)[0])
    told = json.loads(facts.read_text(encoding="utf-8"))
    assert values["pace"] == told["pace"]
    assert told["pace"] == session.pace.to_dict()
    assert told["pace"]["decided"] == 3
    assert told["pace"]["spent_s"] > 0
    assert told["by_hand"] == list(session.by_hand)
    assert len(told["by_hand"]) == 1
    by_status = {a["status"]: a for a in told["artifacts"]}
    assert by_status["accepted"]["note"].startswith("the marker fell off")
    (mended,) = session.notes.values()
    assert by_status["repaired"]["repair"]["method"] == mended.method
    assert mended.band_mm is not None
    assert by_status["repaired"]["repair"]["band_mm"] == list(mended.band_mm)
    assert len(mended.band_mm) == by_status["repaired"]["stop"] - by_status["repaired"]["start"]
    assert "the marker fell off &lt;/script&gt;" in text
    assert "Rejected as a false alarm." in text
    assert told["by_hand"][0] in text


def test_a_take_without_a_review_is_not_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mm.write(mm.simulate(duration_s=3)[0], tmp_path / "walk.c3d")
    assert main(["report", str(tmp_path / "walk.c3d"), "-o", str(tmp_path / "r.html")]) == 1
    assert "no review of “walk.c3d”" in capsys.readouterr().err
    assert not (tmp_path / "r.html").exists()


@pytest.mark.parametrize(("method", "who"), [("swap", "A ↔ B"), (None, "A ↔ B"), ("spline", "A")])
def test_a_mix_up_is_named_by_the_markers_that_its_repair_changed(method, who):
    mixed = Artifact("A", "xyz", 1, 5, Kind.STEP, counterpart="B")
    assert Outcome(mixed, method, None, "").who == who
