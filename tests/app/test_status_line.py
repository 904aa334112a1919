"""The status line while something runs."""

from __future__ import annotations

import threading

import pytest
from driving import WAIT

RECOVERED = (
    "An interrupted review was recovered; last step: Reject peak on Subject:RightUpperArmMarker "
    "and 17 more of them."
)


@pytest.fixture
def working(at_gap, qtbot):
    """The window while something long is done."""
    go_on = threading.Event()

    def work(progress):
        # Asked that often, it can be cancelled by closing the window.
        while not go_on.wait(0.01):
            progress(0.5, "poses restored")

    at_gap.lane.submit("Looking at the body", work, lambda _: None, pytest.fail)
    qtbot.waitUntil(lambda: "poses" in at_gap.status._doing.text(), timeout=WAIT)
    yield at_gap
    go_on.set()
    qtbot.waitUntil(lambda: not at_gap.lane.busy, timeout=WAIT)


def test_what_was_said_is_read_whole_while_something_runs(working, qtbot):
    status = working.status
    assert status._counts.isVisible()
    status.say(RECOVERED)
    # As wide as all needs but the counts, and not quite so much as these want, too.
    counts = status._counts.sizeHint().width()
    needed = (status._doing, status._cancel)
    narrow = status._said.wanted + sum(one.sizeHint().width() for one in needed) + 110
    working.resize(narrow + counts // 2, 720)
    qtbot.waitUntil(lambda: status.width() == narrow + counts // 2)
    assert status._said.text() == RECOVERED
    assert status._counts.isHidden()
    assert status._bar.isVisible()
    assert status._cancel.isVisible()
    assert "poses" in status._doing.text()
    # The counts come back with the room for them, be it that nothing is said any more.
    working.resize(narrow + 2 * counts + 200, 720)
    qtbot.waitUntil(status._counts.isVisible)
    assert status._said.text() == RECOVERED
    working.resize(narrow + counts // 2, 720)
    qtbot.waitUntil(status._counts.isHidden)
    status.say("")
    assert status._counts.isVisible()


def test_counts_stay_where_nothing_runs(at_gap, qtbot):
    at_gap.status.say(5 * RECOVERED)
    qtbot.waitUntil(lambda: at_gap.status._said.text().endswith("…"))
    assert at_gap.status._counts.isVisible()
    assert at_gap.status._said.toolTip() == 5 * RECOVERED
