"""The inspector under real clicks: what it says, and that each control does its verb."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication

from markermend.artifact import Artifact, Kind, Status
from markermend.mesh import Mesh
from markermend.patch import Patch
from markermend.repairs.registry import REPAIRS, Repair
from markermend.review.file import open_session
from markermend.take import Take
from markermend_app import units
from markermend_app.document import Document
from markermend_app.looking import Selection
from markermend_app.panels.inspector.inspector import Inspector
from markermend_app.rows import Rows


@pytest.fixture
def document(tmp_path, damaged, qtbot):
    take, found = damaged
    take = Take(
        take.positions,
        take.labels,
        take.rate,
        take.first_frame,
        warnings=("The header says 401 frames, the file holds 400.",),
    )
    document = Document()
    document.open(open_session(take, folder=tmp_path), Mesh(take.labels, ()))
    document.decisions.add_detected(found, "paper")
    document.set_queue(Rows([[a.id] for a in document.session.artifacts]))
    yield document
    document.open(None, None)
    document.proposals.close()


@pytest.fixture
def inspector(document, qtbot):
    inspector = Inspector(document)
    qtbot.addWidget(inspector)
    inspector.resize(400, 700)
    inspector.show()
    return inspector


def select(document, kind):
    artifact = next(a for a in document.session.artifacts if a.kind is kind)
    document.select(artifact.id)
    return artifact.id


def press(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton, pos=QPoint(10, button.height() // 2))


def test_without_artifact_it_tells_about_the_take(inspector, document):
    assert inspector.page is inspector.take
    texts = [w.text() for w in inspector.take.findChildren(type(inspector.take.title))]
    assert "400 (101–500)" in texts
    assert "100 Hz" in texts
    assert "The header says 401 frames, the file holds 400." in texts
    assert not inspector.decisions.isVisible()


def test_unlabelled_trajectories_are_counted_apart(inspector, document, tmp_path, damaged):
    positions = damaged[0].positions[:, :3].copy()
    positions[:200, 2] = np.nan
    positions[:100, 0] = np.nan
    take = Take(positions, ("CLAV", "STRN", "*7"), 100.0)
    document.open(open_session(take, folder=tmp_path / ".."), None)
    facts = inspector.take.facts
    told = [facts.itemAt(i, facts.ItemRole.FieldRole).widget().text() for i in range(6)]
    names = [facts.itemAt(i, facts.ItemRole.LabelRole).widget().text() for i in range(6)]
    facts = dict(zip(names, told, strict=True))
    assert (facts["Markers"], facts["Unlabelled"]) == ("2", "1")
    share = np.isnan(positions[:, :2, 0]).mean()
    assert facts["Missing"] == f"{100 * share:.2f} % of all samples"


def test_it_shows_the_artifact_in_the_numbers_of_the_file(inspector, document):
    select(document, Kind.STEP)
    page = inspector.artifact
    assert inspector.page is page
    assert page.title.text() == "LWRA"
    assert (page.first.value(), page.last.value()) == (381, 430)
    assert page.kind.currentText() == "Step"
    assert [a for a, b in page.axes.items() if b.isChecked()] == ["z"]
    assert page.why.text() == "jumps 30 mm in one frame and comes back 50 frames (500 ms) later"
    assert page.sureness.text() == "80 %, likely"


def test_axes_class_and_edges_change_the_artifact(qtbot, inspector, document):
    i = select(document, Kind.STEP)
    page = inspector.artifact
    press(qtbot, page.axes["x"])
    assert document.session.artifact(i).axes == "xz"
    press(qtbot, page.axes["x"])
    press(qtbot, page.axes["z"])
    assert document.session.artifact(i).axes == "z", "the last axis stays"
    assert page.axes["z"].isChecked()
    qtbot.keyClick(page.last, Qt.Key.Key_Up)
    assert document.session.artifact(i).stop == 331
    page.first.selectAll()
    qtbot.keyClicks(page.first, "390")
    qtbot.keyClick(page.first, Qt.Key.Key_Return)
    assert document.session.artifact(i).start == 289
    page.kind.setCurrentIndex(list(Kind).index(Kind.NOISE))
    page.kind.activated.emit(page.kind.currentIndex())
    assert document.session.artifact(i).kind is Kind.NOISE
    while document.session.history[1:]:
        document.undo()
    qtbot.waitUntil(lambda: (page.first.value(), page.last.value()) == (381, 430))


def test_only_of_what_was_not_recorded_a_gap_is_certain(inspector, document):
    select(document, Kind.GAP)
    sureness = inspector.artifact.sureness
    assert sureness.text() == "certain: nothing was recorded"
    marker = document.session.original.labels[1]
    document.decisions.mark(Artifact(marker, "xyz", 300, 310, Kind.NOISE, why="marked by hand"))
    assert sureness.text() == "marked by hand"
    document.decisions.change(document.current.id, kind=Kind.GAP)
    assert "certain:" not in sureness.text()


def test_methods_stand_in_the_order_of_their_keys_and_can_be_chosen(qtbot, inspector, document):
    select(document, Kind.PEAK)
    methods = inspector.artifact.methods
    keyed = sorted((m for m in REPAIRS.values() if m.key), key=lambda m: m.key)
    assert list(methods.buttons) == ["auto", *(m.name for m in keyed)]
    assert [m.key for m in keyed] == list(range(1, 10))
    assert methods.buttons["auto"].isChecked()
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=10_000)
    press(qtbot, methods.buttons["linear"])
    assert document.method == "linear"
    qtbot.waitUntil(lambda: document.proposal is not None, timeout=10_000)
    assert methods.outcome.text().startswith(REPAIRS["linear"].label)


def test_the_error_of_a_model_picked_by_hand_is_measured_unless_that_takes_long(
    qtbot, inspector, document
):
    methods = inspector.artifact.methods
    gap = select(document, Kind.GAP)
    for name, said in (
        ("ffnn_lin", ", expected error not measured"),
        ("pma", ", expected error "),
    ):
        document.choose_method(name)
        qtbot.waitUntil(lambda: document.proposal is not None, timeout=20_000)
        text = methods.outcome.text()
        assert text.startswith(REPAIRS[name].label + said)
        assert ("not measured" in text) == ("not measured" in said)
    error = document.proposal.error_mm
    document.decisions.repair_current()
    assert document.session.notes[gap].error_mm == error > 0
    document.select(gap)
    # It stands beside the repair for whoever comes back to it.
    said = f"Repaired: {REPAIRS['pma'].label}, ± {units.length(error)}"
    assert inspector.artifact.status.text() == said


def test_the_other_methods_stand_in_one_list(qtbot, inspector, document):
    inspector.resize(300, 700)
    select(document, Kind.GAP)
    methods = inspector.artifact.methods
    listed = [methods.more.itemData(row) for row in range(methods.more.count())]
    assert set(listed) == {m.name for m in REPAIRS.values() if m.key is None}
    assert methods.more.currentText() == "", "nothing of it is chosen yet"
    row = listed.index("kalman")
    tip = methods.more.itemData(row, Qt.ItemDataRole.ToolTipRole)
    assert tip == REPAIRS["kalman"].summary
    qtbot.mouseClick(methods.more, Qt.MouseButton.LeftButton)
    view = methods.more.view()
    qtbot.waitUntil(view.isVisible)
    view.scrollTo(methods.more.model().index(row, 0))
    at = view.visualRect(methods.more.model().index(row, 0)).center()
    qtbot.mouseMove(view.viewport(), at)
    qtbot.wait(QApplication.doubleClickInterval() + 50)  # the list ignores a click too soon
    qtbot.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert document.method == "kalman"
    assert methods.more.currentText() == REPAIRS["kalman"].label
    assert not any(b.isChecked() for b in methods.buttons.values())
    press(qtbot, methods.buttons["linear"])
    assert document.method == "linear"
    assert methods.more.currentIndex() == -1
    assert [n for n, b in methods.buttons.items() if b.isChecked()] == ["linear"]
    assert inspector.artifact.minimumSizeHint().width() <= 300


def test_the_list_of_methods_is_reached_and_used_by_keys(qtbot, inspector, document):
    select(document, Kind.GAP)
    more = inspector.artifact.methods.more
    more.setFocus(Qt.FocusReason.TabFocusReason)
    assert more.focusPolicy() & Qt.FocusPolicy.TabFocus
    qtbot.keyClick(more, Qt.Key.Key_Down)
    assert document.method == more.itemData(0)
    qtbot.keyClick(more, Qt.Key.Key_Down)
    assert document.method == more.itemData(1)


def test_a_method_without_answer_says_why_and_the_flag_can_be_accepted(
    inspector, document, monkeypatch
):
    nothing = Repair("swap", (), "no marker carries the other half of this step")
    monkeypatch.setattr(Document, "proposal", property(lambda self: nothing))
    select(document, Kind.STEP)
    said = inspector.artifact.methods.outcome.text()
    assert said.splitlines()[0] == "No repair: no marker carries the other half of this step"
    assert inspector.decisions.repair.isEnabled(), "it accepts the flag and goes on, as F does"
    assert inspector.decisions.accept.isEnabled()


@pytest.mark.parametrize(("name", "error"), [("swap", 0.0), ("leave_empty", None)])
def test_what_invents_nothing_promises_no_error(inspector, document, monkeypatch, name, error):
    step = document.session.artifact(select(document, Kind.STEP))
    patch = Patch(step.marker, "xyz", step.start, step.stop, np.zeros((step.length, 3)))
    repair = Repair(name, (patch,), error_mm=error)
    monkeypatch.setattr(Document, "proposal", property(lambda self: repair))
    document.proposal_changed.emit()
    assert inspector.artifact.methods.outcome.text() == REPAIRS[name].label


def test_what_a_repair_leaves_is_told_before_and_after(inspector, document, monkeypatch):
    gap = select(document, Kind.GAP)
    a = document.session.artifact(gap)
    values = np.zeros((a.length, 3))
    left = (Artifact(a.marker, "x", a.start, a.stop, Kind.STEP, amplitude_mm=12.0),)
    spoiled = Repair(
        "linear", (Patch(a.marker, "xyz", a.start, a.stop, values),), error_mm=3.0, leaves=left
    )
    monkeypatch.setattr(Document, "proposal", property(lambda self: spoiled))
    document.proposal_changed.emit()
    shown = inspector.artifact.methods.outcome
    assert "still finds damage there: a step of 12 mm" in shown.text()
    assert shown.property("role") == "warning"
    document.decisions.repair_many([(gap, spoiled)], "Repair")
    document.select(gap)
    assert "still finds damage there: a step of 12 mm" in shown.text()
    assert shown.property("role") == "warning", "that it is done makes it no better"
    buttons = inspector.artifact.methods.buttons
    checked = [name for name, button in buttons.items() if button.isChecked()]
    assert checked == ["linear"], "the method that repaired it"
    document.decisions.reopen([gap])
    assert buttons["auto"].isChecked()


def test_buttons_decide_and_move_on(qtbot, inspector, document):
    i = select(document, Kind.GAP)
    press(qtbot, inspector.decisions.accept)
    assert document.session.artifact(i).status is Status.ACCEPTED
    second = document.current.id
    assert second != i
    press(qtbot, inspector.decisions.reject)
    assert document.session.artifact(second).status is Status.REJECTED
    third = document.current.id
    press(qtbot, inspector.decisions.repair)
    qtbot.waitUntil(
        lambda: document.session.artifact(third).status is Status.REPAIRED, timeout=10_000
    )
    document.select(third)
    assert inspector.artifact.status.text().startswith("Repaired: ")
    assert inspector.decisions.reopen.isVisible()
    press(qtbot, inspector.decisions.reopen)
    assert document.session.artifact(third).status is Status.PENDING
    assert not inspector.decisions.reopen.isVisible()


def test_a_swept_range_can_be_marked(qtbot, inspector, document):
    document.sweep(Selection("C7", 10, 30))
    assert inspector.page is inspector.selection
    assert inspector.selection.about.text() == "Frames 111 to 130: 20 frames, 0.20 s"
    with qtbot.waitSignal(inspector.mark_requested) as asked:
        press(qtbot, inspector.selection.buttons[Kind.NOISE])
    assert asked.args == [Kind.NOISE]
    document.sweep(None)
    assert inspector.page is inspector.take


def test_what_was_chosen_last_is_seen(inspector, document):
    select(document, Kind.GAP)
    document.sweep(Selection("C7", 10, 30))
    assert inspector.page is inspector.selection
    assert not inspector.decisions.isVisible()
    select(document, Kind.STEP)
    assert inspector.page is inspector.artifact
    assert inspector.decisions.isVisible()
    document.sweep(Selection("C7", 10, 40))
    assert inspector.page is inspector.selection


@pytest.mark.parametrize("height", [250, 700])
def test_a_long_reason_leaves_room_for_the_methods(inspector, document, monkeypatch, height, qtbot):
    nothing = Repair("auto", (), " ".join(f"Of {i} markers none is seen here." for i in range(12)))
    monkeypatch.setattr(Document, "proposal", property(lambda self: nothing))
    inspector.resize(300, height)
    select(document, Kind.GAP)
    outcome, promise = inspector.artifact.methods.outcome, inspector.promise
    qtbot.waitUntil(lambda: promise.width() == 300)
    line = outcome.fontMetrics().lineSpacing()
    assert promise.height() >= 3 * line
    assert promise.height() < 0.25 * height + line
    assert promise.height() < outcome.height()
    assert outcome.toolTip() == outcome.text()
    # The rest is scrolled to; another reason is read from its beginning.
    bar = promise.verticalScrollBar()
    bar.setValue(bar.maximum())
    assert bar.value() > 0
    document.proposal_changed.emit()
    assert bar.value() > 0, "the same as before"
    monkeypatch.setattr(Document, "proposal", property(lambda self: Repair("auto", (), "No.")))
    document.proposal_changed.emit()
    assert bar.value() == 0
    qtbot.waitUntil(lambda: promise.height() == outcome.heightForWidth(promise.width()))
