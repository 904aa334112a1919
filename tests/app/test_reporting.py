"""The report of the open review: written as it stands, then shown."""

from __future__ import annotations

import numpy as np
from PySide6.QtGui import QDesktopServices

from markermend.artifact import Status

WAIT = 30_000


def test_the_open_review_is_reported_and_shown(review, damaged, qtbot, tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: shown.append(url.toLocalFile()))
    window = review(*damaged)
    document, target = window.document, tmp_path / "page.html"
    first = document.current.id
    before = document.session.positions.copy()
    document.do(lambda s: s.annotate(first, "seen in the video"))
    document.reject([first])
    window.reporting.report_to(target)
    document.reject([a.id for a in document.session.artifacts])
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
