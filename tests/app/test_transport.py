"""Playback: the frame that is due is shown, whatever was skipped."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

from markermend.review.file import open_session
from markermend_app.document import Document
from markermend_app.panels.transport import SPEEDS, Transport


class Clock:
    """A clock that stands still until it is moved."""

    def __init__(self):
        self.now, self.zero = 0, 0

    def start(self):
        self.zero = self.now

    def elapsed(self):
        return self.now - self.zero


@pytest.fixture
def document(tmp_path, damaged, qtbot):
    document = Document()
    document.open(open_session(damaged[0], folder=tmp_path), None)
    yield document
    document.open(None, None)
    document.proposals.close()


@pytest.fixture
def transport(document, qtbot):
    transport = Transport(document)
    qtbot.addWidget(transport)
    transport.resize(400, 80)
    transport.show()
    transport._clock = Clock()
    return transport


def press(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def after(transport, ms):
    transport._timer.stop()
    transport._timer.start(10_000)
    transport._clock.now += ms
    transport.tick()


def test_buttons_field_and_slider_move_the_cursor(qtbot, transport, document):
    press(qtbot, transport.last)
    assert document.frame == 399
    assert transport.number.value() == 500
    press(qtbot, transport.back)
    assert document.frame == 398
    press(qtbot, transport.first)
    press(qtbot, transport.forward)
    assert document.frame == 1
    transport.number.selectAll()
    qtbot.keyClicks(transport.number, "251")
    qtbot.keyClick(transport.number, Qt.Key.Key_Return)
    assert document.frame == 150
    assert transport.slider.value() == 150
    transport.slider.setValue(20)
    assert document.frame == 20
    assert transport.time.text() == "0.20 / 4.00 s"


def test_plays_at_true_speed_and_stops_at_the_end(qtbot, transport, document):
    press(qtbot, transport.play)
    assert transport.playing
    after(transport, 500)
    assert document.frame == 50
    after(transport, 1000)
    assert document.frame == 150
    after(transport, 9000)
    assert document.frame == 399
    assert not transport.playing
    transport.toggle_play()
    assert document.frame == 0


def test_speed_changes_count_from_where_we_are(transport, document):
    transport.toggle_play()
    after(transport, 1000)
    transport.speed.setCurrentIndex(SPEEDS.index(0.1))
    after(transport, 1000)
    assert document.frame == 110
    transport.speed.setCurrentIndex(SPEEDS.index(2.0))
    after(transport, 1000)
    assert document.frame == 310


def test_loop_repeats_what_is_in_view(qtbot, transport, document):
    press(qtbot, transport.loop)
    transport.set_view(100, 200)
    document.go_to(150)
    transport.toggle_play()
    after(transport, 400)
    assert document.frame == 190
    after(transport, 200)
    assert document.frame == 100
    after(transport, 300)
    assert document.frame == 130
    assert transport.playing


def test_whoever_moves_the_cursor_moves_the_playback(transport, document):
    transport.toggle_play()
    after(transport, 100)
    document.go_to(300)
    after(transport, 100)
    assert document.frame == 310
    transport.step(-1)
    assert document.frame == 309
    assert not transport.playing


def test_what_is_brought_into_view_is_not_played_out_of_it_again(transport, document):
    transport.toggle_play()
    after(transport, 100)
    document.look_at(document.session.take.labels[:1], 290, 310)
    assert not transport.playing
    assert document.frame == 300
    transport.loop.setChecked(True)
    transport.toggle_play()
    document.look_at(document.session.take.labels[:1], 90, 110)
    assert transport.playing


def test_real_time_passes(qtbot, tmp_path, document):
    transport = Transport(document)
    qtbot.addWidget(transport)
    transport.toggle_play()
    qtbot.waitUntil(lambda: document.frame > 10, timeout=5000)
    transport.toggle_play()
    assert not transport.playing


def test_is_off_while_nothing_is_open(transport, document):
    document.open(None, None)
    assert not transport.isEnabled()
    transport.toggle_play()
    assert not transport.playing
