"""The report of the open review: written as it stands, then shown."""

from __future__ import annotations

import re
from html import unescape

import numpy as np
from PySide6.QtGui import QDesktopServices

from markermend.artifact import Kind, Status
from markermend_app import languages, settings
from markermend_app.telling import told

WAIT = 30_000


def test_the_open_review_is_reported_and_shown(review, damaged, qtbot, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: shown.append(url.toLocalFile()))
    window = review(*damaged)
    document, target = window.document, tmp_path / "page.html"
    first = document.current.id
    before = document.session.positions.copy()
    document.do(lambda s: s.annotate(first, "seen in the video"))
    document.decisions.reject([first])
    window.reporting.report_to(target)
    document.decisions.reject([a.id for a in document.session.artifacts])
    qtbot.waitUntil(lambda: bool(shown), timeout=WAIT)
    assert shown == [str(target)]
    text = target.read_text(encoding="utf-8")
    # What was decided while it was written is not in it.
    assert text.count("Rejected as a false alarm.") == 2  # in the table and in the JSON
    assert "seen in the video" in text
    assert np.array_equal(document.session.positions, before, equal_nan=True)
    assert len(document.session.with_status(Status.REJECTED)) == len(damaged[1])


def test_a_folder_that_refuses_is_named(review, damaged, qtbot, tmp_path, monkeypatch):
    told = []
    monkeypatch.setattr(
        "markermend_app.dialogs.ask.show_problem", lambda _, error: told.append(str(error))
    )
    window = review(*damaged)
    window.reporting.report_to(tmp_path / "nowhere" / "page.html")
    qtbot.waitUntil(lambda: bool(told), timeout=WAIT)
    assert "page.html could not be written" in told[0]


def test_a_report_is_told_in_the_language_of_the_window(
    review, damaged, qtbot, tmp_path, monkeypatch, qapp
):
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: None)
    monkeypatch.setattr(languages, "language", lambda: "de")
    loaded = languages.install(qapp)
    try:
        window = review(*damaged)
        document, target = window.document, tmp_path / "Mark {0} on tape.html"
        gap = next(a for a in document.session.artifacts if a.kind is Kind.GAP)
        document.select(gap.id)
        document.do(lambda s: s.annotate(gap.id, "Repair it & see"))
        qtbot.waitUntil(lambda: document.proposal is not None, timeout=WAIT)
        document.decisions.repair_current()
        document.decisions.reject([document.current.id])
        window.reporting.report_to(target)
        qtbot.waitUntil(lambda: target.exists(), timeout=WAIT)
    finally:
        for translator in loaded:
            qapp.removeTranslator(translator)
    page = target.read_text(encoding="utf-8")
    read = re.sub(r"<(script|style).*?</\1>", "", page, flags=re.DOTALL)
    words = [unescape(text).strip() for text in re.findall(r">([^<]+)<", read)]
    assert '<html lang="de">' in page
    assert {"Was repariert wurde", "Lücke", "Örtliche Regression", "2 von 4"} <= set(words)
    assert "Als Fehlalarm abgelehnt." in words
    # Names and what the operator wrote stay, and so do the values for programs.
    assert "Mark {0} on tape" in words
    assert any(text.startswith("✎ Repair it & see") for text in words)
    assert '"status": "rejected"' in page
    english = ("repaired", "gap", "Missing", "expected", "frames", "Found", "jumps", "Local")
    given = {a.why for a in damaged[1]}
    told = [text for text in words if "✎" not in text and text not in given]
    assert [text for text in told if any(word in text for word in english)] == []
    assert any("Spitze, Frame 251: belassen" in text for text in told)


def test_lengths_in_a_report_are_in_its_own_unit(
    review, damaged, qtbot, tmp_path, monkeypatch, qapp
):
    """Its figures are in millimetres; what it says of artifacts is not in another unit."""
    settings.remember("unit", "cm")
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: None)
    monkeypatch.setattr(languages, "language", lambda: "de")
    loaded = languages.install(qapp)
    try:
        window, target = review(*damaged), tmp_path / "page.html"
        assert "2.5 cm" in told(damaged[1][1].why)
        window.reporting.report_to(target)
        qtbot.waitUntil(lambda: target.exists(), timeout=WAIT)
    finally:
        for translator in loaded:
            qapp.removeTranslator(translator)
    read = re.sub(r"<(script|style).*?</\1>", "", target.read_text("utf-8"), flags=re.DOTALL)
    assert "25 mm" in read
    assert not re.search(r"\d cm\b", read)
