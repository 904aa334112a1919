"""How bodies move, chosen in the preferences: a file, or what is learnt from recordings."""

from __future__ import annotations

import time

import pytest
from arms import arm
from driving import WAIT
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox

import markermend as mm
from markermend.batch import Recipe, find_takes, run_batch
from markermend.batch.review import ToReview, takes_to_review
from markermend.poses import own_prior as engine
from markermend.poses.prior import load_prior, save_prior, shipped_prior
from markermend.poses.take import prior_of
from markermend.progress import quiet
from markermend_app import own_prior, settings
from markermend_app.background import loading
from markermend_app.dialogs.file_filters import skeleton_filter
from markermend_app.dialogs.preferences import Preferences
from markermend_app.telling import told


@pytest.fixture
def page(qtbot, window):
    """The page, as the window opens it."""
    made = Preferences(window)
    qtbot.addWidget(made)
    made.show()
    return made


@pytest.fixture
def prior(tmp_path):
    """A prior in a file."""
    path = tmp_path / "anna.npz"
    save_prior(shipped_prior(), path)
    return path


def choose(page, text):
    """Choose an entry as a hand does."""
    box = page.prior.box
    place = box.findText(text)
    assert place >= 0
    box.setCurrentIndex(place)
    box.activated.emit(place)


def press(qtbot, button):
    """Press a button as a hand does."""
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def answer(monkeypatch, **answers):
    """What is answered to each file dialog."""
    for name, given in answers.items():
        monkeypatch.setattr(QFileDialog, name, lambda *_, given=given: (given, ""))


def test_at_first_it_is_as_markermend_knows_it(page):
    assert page.prior.box.currentText() == "As Markermend knows it"
    assert settings.text(own_prior.SETTING, "") == ""


def test_a_file_is_kept_and_named_and_left_again(page, prior, qtbot, monkeypatch):
    answer(monkeypatch, getOpenFileName=str(prior))
    with qtbot.waitSignal(page.changed, timeout=WAIT) as changed:
        press(qtbot, page.prior.file)
    assert changed.args == [own_prior.SETTING]
    assert settings.text(own_prior.SETTING, "") == str(prior)
    assert page.prior.box.currentText() == "As anna.npz tells"
    assert "opened from now on" in page.prior.about.text()
    choose(page, "As Markermend knows it")
    assert settings.text(own_prior.SETTING, "") == ""
    assert "ten minutes" in page.prior.about.text()
    # It can be taken up again.
    choose(page, "As anna.npz tells")
    assert settings.text(own_prior.SETTING, "") == str(prior)


def test_what_is_no_prior_is_refused_and_what_was_kept_stays(
    page, prior, tmp_path, qtbot, monkeypatch
):
    settings.remember(own_prior.SETTING, str(prior))
    page.prior.read()
    (tmp_path / "other.npz").write_bytes(b"nothing")
    answer(monkeypatch, getOpenFileName=str(tmp_path / "other.npz"))
    said = []
    monkeypatch.setattr(QMessageBox, "exec", lambda box: said.append(box.text()))
    press(qtbot, page.prior.file)
    qtbot.waitUntil(lambda: bool(said), timeout=WAIT)
    assert "holds no prior" in said[0]
    assert settings.text(own_prior.SETTING, "") == str(prior)
    assert page.prior.box.currentText() == "As anna.npz tells"
    assert page.prior.box.isEnabled()


def test_who_names_no_file_changes_nothing(page, qtbot, monkeypatch):
    answer(monkeypatch, getOpenFileName="", getOpenFileNames=[], getSaveFileName="")
    for button in (page.prior.file, page.prior.learn):
        press(qtbot, button)
        assert page.prior.box.currentText() == "As Markermend knows it"
        assert page.prior.box.isEnabled()


def test_a_file_that_is_gone_is_told(page, prior):
    settings.remember(own_prior.SETTING, str(prior))
    prior.unlink()
    page.prior.read()
    assert page.prior.box.currentText() == "As anna.npz told, which is gone"


def test_recordings_are_learnt_from_and_used_for_what_is_opened_next(
    page, window, broken, shared_data, tmp_path, qtbot, monkeypatch
):
    names = [str(shared_data / "poses" / name) for name in ("02_02.amc", "02_03.amc")]
    target = tmp_path / "learnt"
    answer(monkeypatch, getOpenFileNames=names, getSaveFileName=str(target))
    with qtbot.waitSignal(page.changed, timeout=WAIT):
        press(qtbot, page.prior.learn)
        assert not page.prior.box.isEnabled()
    target = target.with_suffix(".npz")
    assert len(load_prior(target).remembered) == 2
    assert page.prior.box.currentText() == "As learnt.npz tells"
    page.close()
    window.commands.open_path(broken)
    qtbot.waitUntil(lambda: window.document.current is not None, timeout=3 * WAIT)
    pose = window.document.session.original.source.layout
    assert len(prior_of(pose).remembered) == 2


def test_learning_is_cancelled_by_the_button_and_by_leaving(
    page, shared_data, tmp_path, qtbot, monkeypatch
):
    names = [str(shared_data / "poses" / "02_02.amc")]
    target = tmp_path / "learnt.npz"
    answer(monkeypatch, getOpenFileNames=names, getSaveFileName=str(target))
    begun = []

    def wait(paths, target, *, progress):
        begun.append(paths)
        while True:
            progress(0.5, "")
            time.sleep(0.01)

    monkeypatch.setattr(engine, "learn_files", wait)
    for leave in (
        lambda: qtbot.mouseClick(page.prior.cancel, Qt.MouseButton.LeftButton),
        page.reject,
    ):
        begun.clear()
        press(qtbot, page.prior.learn)
        qtbot.waitUntil(lambda: bool(begun) and page.prior.bar.value() == 500, timeout=WAIT)
        leave()
        qtbot.waitUntil(lambda: not page.prior._lane.busy, timeout=WAIT)
        assert page.prior.box.isEnabled()
        assert settings.text(own_prior.SETTING, "") == ""
    assert not target.exists()


def test_a_file_whose_ending_is_added_is_not_replaced_unasked(
    page, prior, broken, qtbot, monkeypatch
):
    target = prior.with_suffix("")
    answer(monkeypatch, getOpenFileNames=[str(broken)], getSaveFileName=str(target))
    before, asked = prior.read_bytes(), []

    def question(_parent, _title, text):
        asked.append(text)
        return QMessageBox.StandardButton.No

    monkeypatch.setattr(QMessageBox, "question", question)
    press(qtbot, page.prior.learn)
    assert asked == ["anna.npz is there already. Replace it?"]
    assert prior.read_bytes() == before
    assert page.prior.box.isEnabled()


def test_defaults_are_markermends_own(page, prior):
    settings.remember(own_prior.SETTING, str(prior))
    page.prior.read()
    page._restore()
    assert page.prior.box.currentText() == "As Markermend knows it"


def test_keys_walk_through_what_there_is_and_ask_nothing(page, prior, qtbot, monkeypatch):
    def unasked(*_):
        raise AssertionError("a file dialog opened")

    for name in ("getOpenFileName", "getOpenFileNames", "getSaveFileName"):
        monkeypatch.setattr(QFileDialog, name, unasked)
    settings.remember(own_prior.SETTING, str(prior))
    page.prior.read()
    box = page.prior.box
    for pressed, shown in (
        (Qt.Key.Key_Up, "As Markermend knows it"),
        (Qt.Key.Key_Down, "As anna.npz tells"),
        (Qt.Key.Key_End, "As anna.npz tells"),
        (Qt.Key.Key_Home, "As Markermend knows it"),
    ):
        qtbot.keyClick(box, pressed)
        assert box.currentText() == shown
    assert settings.text(own_prior.SETTING, "") == ""


def test_a_recording_that_it_does_not_fit_says_so_when_it_is_opened(broken, tmp_path):
    path = tmp_path / "arms.npz"
    mm.write_pose(arm(), tmp_path / "arm.csv")
    engine.learn_files([tmp_path / "arm.csv"], path)
    for name, why in ((path, "arms.npz does not fit"), (tmp_path / "x.npz", "is gone")):
        settings.remember(own_prior.SETTING, str(name))
        file = loading.load(broken, quiet)
        file.close()
        take = file.session.original
        assert why in take.warnings[0]
        assert told(take.warnings[0]) == take.warnings[0]
        assert prior_of(take.source.layout) is shipped_prior()


def test_what_was_made_ahead_with_another_prior_is_made_anew(broken, prior):
    ahead = loading.prepare(ToReview(broken, broken.name), quiet)

    def taken_as_it_is():
        opened = loading.open_prepared(ahead, quiet)
        opened.file.close()
        return opened.file.session.original is ahead.take

    assert taken_as_it_is()
    settings.remember(own_prior.SETTING, str(prior))
    assert not taken_as_it_is()


def test_what_a_batch_left_is_restored_as_by_the_batch(broken, prior, tmp_path):
    settings.remember(own_prior.SETTING, str(tmp_path / "chosen.npz"))
    for recipe in (Recipe(min_confidence=1.0), Recipe(min_confidence=1.0, prior=str(prior))):
        out = tmp_path / f"out{bool(recipe.prior)}"
        run_batch(find_takes([broken]), out, recipe, jobs=1)
        (item,) = takes_to_review([out])
        assert item.prior == (prior if recipe.prior else None)
        opened = loading.load_item(item, quiet)
        opened.file.close()
        take = opened.file.session.original
        assert not any("chosen" in warning for warning in take.warnings)
        assert (prior_of(take.source.layout) is shipped_prior()) == (not recipe.prior)


def test_recordings_are_offered_to_learn_from_and_no_poses_at_rest():
    assert "CSV, BVH, AMC" in skeleton_filter()
    assert "*.AMC" in skeleton_filter()
    assert "asf" not in skeleton_filter().lower()
