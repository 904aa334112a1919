"""The questions the app asks, and how it tells of a problem."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QLabel,
    QLineEdit,
    QMessageBox,
    QVBoxLayout,
    QWidget,
)

import markermend
from markermend.errors import MarkermendError
from markermend.files import Export
from markermend.take import Take
from markermend_app import units
from markermend_app.background.loading import is_there
from markermend_app.telling import told
from markermend_app.words import tr as _tr

Buttons = QMessageBox.StandardButton
Role = QMessageBox.ButtonRole
Ends = QDialogButtonBox.StandardButton
_MOST_OFF = 8


def show_problem(parent: QWidget, error: Exception) -> None:
    """Show one sentence; where the error is not one of ours, the traceback is folded away."""
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Warning)
    box.setWindowTitle(_tr("Markermend"))
    if isinstance(error, MarkermendError):
        box.setText(told(str(error)))
        if error.__cause__ is not None:
            box.setDetailedText(f"{type(error.__cause__).__name__}: {error.__cause__}")
    else:
        box.setText(_tr("That did not work; nothing was changed. The details tell what happened."))
        box.setDetailedText("".join(traceback.format_exception(error)))
    box.exec()


def ask_skeleton(parent: QWidget, error: Exception) -> bool:
    """Say why a movement has no skeleton, and ask whether to choose one."""
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Warning)
    box.setWindowTitle(_tr("Markermend"))
    box.setText(told(str(error)))
    box.setInformativeText(_tr("What you choose is copied beside it, under its name."))
    choose = box.addButton(_tr("Choose skeleton…"), Role.AcceptRole)
    box.addButton(Buttons.Cancel)
    box.setDefaultButton(choose)
    box.exec()
    return box.clickedButton() is choose


def tell_damaged(parent: QWidget, take: Take) -> None:
    """Say that what was opened is not the whole recording; the work under way goes on."""
    name = take.source.path.name if take.source is not None else _tr("This take")
    box = QMessageBox(parent)
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.setIcon(QMessageBox.Icon.Warning)
    box.setWindowTitle(_tr("Damaged file"))
    box.setText(_tr("{0} is damaged. What can be read of it is shown.").format(name))
    found = " ".join(map(told, take.warnings))
    kept = _tr("The original is never replaced; repairs can be exported to another file.")
    box.setInformativeText(f"{found} {kept}".strip())
    box.open()


def tell_off(parent: QWidget, export: Export, *, wait: bool = False) -> None:
    """Say which joints are not where they were reviewed, in a file whose bones are rigid.

    With ``wait`` until it is answered: what comes next may close the window, and this with it.
    """
    box = QMessageBox(parent)
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.setIcon(QMessageBox.Icon.Warning)
    box.setWindowTitle(_tr("Export"))
    text = _tr("{0} is written, but some joints are not where you reviewed them there.")
    box.setText(text.format(export.path.name))
    told = []
    if export.lost:
        lost = _tr(
            "An angle is told from the bone above it: where that is still missing these are not in "
            "the file: {0}. Repair what they hang on, too."
        )
        told.append(lost.format(_few(export.lost)))
    if export.off:
        why = _tr(
            "Its bones are rigid, so that joints come only as near as these allow, also those "
            "beside a repair that you left as they were. At most they are off by: {0}."
        )
        far = [f"{joint} {units.length(mm)}" for joint, mm in export.off]
        told.append(why.format(_few(far)))
    told.append(_tr("A CSV or C3D file has every joint where you see it."))
    box.setInformativeText("\n\n".join(told))
    if wait:
        box.exec()
    else:
        box.open()


def _few(names: Sequence[str]) -> str:
    """Names, and how many more there are."""
    some, more = list(names[:_MOST_OFF]), len(names) - _MOST_OFF
    if more > 0:
        some.append(_tr("{0} more").format(more))
    return ", ".join(some)


def ask_unexported(
    parent: QWidget, path: Path | None, kept: Path, changed: bool = True, renamed: bool = False
) -> str:
    """Ask what becomes of work not yet exported: ``export, keep, discard`` or ``cancel``.

    Parameters
    ----------
    parent : the window
    path : of the take
    kept : file of the review, which is elsewhere where nothing can be written beside the take
    changed : whether samples were changed, rather than intervals decided and notes written only
    renamed : whether markers were given other names
    """
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Question)
    box.setWindowTitle(_tr("Work not yet exported"))
    name = path.name if path else _tr("this take")
    repaired = _tr("Your repairs of {0} are not exported yet.")
    looked_at = _tr("You changed no sample of {0}, but its review would be lost.")
    if renamed:
        looked_at = _tr(
            "You changed no sample of {0}, but its review and its new names would be lost."
        )
    box.setText((repaired if changed else looked_at).format(name))
    beside = _tr(
        "Keep the review to go on later: it is saved beside the take, with its full history."
    )
    elsewhere = _tr("Keep the review to go on later: it is saved in {0}, with its full history.")
    there = path is not None and kept.parent == path.parent
    box.setInformativeText(beside if there else elsewhere.format(kept.parent))
    export = box.addButton(_tr("Export…"), Role.AcceptRole)
    keep = box.addButton(_tr("Keep review"), Role.AcceptRole)
    discard = box.addButton(_tr("Discard review"), Role.DestructiveRole)
    cancel = box.addButton(Buttons.Cancel)
    box.setDefaultButton(keep)
    box.setEscapeButton(cancel)
    box.exec()
    clicked = box.clickedButton()
    for button, answer in ((export, "export"), (keep, "keep"), (discard, "discard")):
        if clicked is button:
            return answer
    return "cancel"


def ask_float(parent: QWidget, problem: str) -> bool:
    """Ask whether to write floats where the source's integers cannot hold a repair."""
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Question)
    box.setWindowTitle(_tr("Export"))
    box.setText(problem)
    go = box.addButton(_tr("Export as floats"), Role.AcceptRole)
    box.addButton(Buttons.Cancel)
    box.setDefaultButton(go)
    box.exec()
    return box.clickedButton() is go


def ask_replace(parent: QWidget, target: Path) -> bool:
    """Ask before another file is replaced."""
    text = _tr("{0} is there already. Replace it?").format(target.name)
    return QMessageBox.question(parent, _tr("Replace"), text) == Buttons.Yes


def with_ending(parent: QWidget, name: str, ending: str) -> Path | None:
    """The file of a name to be saved under, with its ending; None where another is to stay there.

    Parameters
    ----------
    parent : of what is asked
    name : as a file dialog gave it
    ending : with its dot, in small letters
    """
    target = Path(name)
    if target.suffix.lower() == ending:
        return target
    target = target.with_name(f"{target.name}{ending}")
    # The file dialog has asked about the name without the ending only.
    return None if is_there(target) and not ask_replace(parent, target) else target


def ask_replace_source(parent: QWidget, target: Path) -> bool:
    """Ask before the original is replaced."""
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Warning)
    box.setWindowTitle(_tr("Replace the original"))
    box.setText(_tr("{0} is the take you opened. Replace it?").format(target.name))
    box.setInformativeText(_tr("A backup of the original is kept beside it."))
    go = box.addButton(_tr("Replace"), Role.DestructiveRole)
    cancel = box.addButton(Buttons.Cancel)
    box.setDefaultButton(cancel)
    box.exec()
    return box.clickedButton() is go


def ask_text(
    parent: QWidget, question: str, proposed: str, refuse: Callable[[str], str]
) -> str | None:
    """Ask for a word until there is nothing against it; None when nothing was given.

    Parameters
    ----------
    parent : the window
    question : what is asked
    proposed : what stands there at first
    refuse : says what is wrong with a word, or nothing
    """
    dialog = QDialog(parent)
    dialog.setWindowTitle(question)
    line, problem = QLineEdit(proposed), QLabel()
    line.setAccessibleName(question)
    # The name of a subject before it is seldom what is meant to be changed.
    start = proposed.rfind(":") + 1
    line.setSelection(start, len(proposed) - start)
    problem.setProperty("role", "warning")
    problem.setWordWrap(True)
    problem.hide()
    buttons = QDialogButtonBox(Ends.Ok | Ends.Cancel)
    column = QVBoxLayout(dialog)
    for widget in (QLabel(question), line, problem, buttons):
        column.addWidget(widget)

    def finish() -> None:
        problem.setText(refuse(line.text()))
        problem.setVisible(bool(problem.text()))
        if problem.text():
            # What is wrapped asks for the height of one line only.
            problem.setMinimumHeight(problem.heightForWidth(line.width()))
            dialog.adjustSize()
            line.setFocus()
        else:
            dialog.accept()

    buttons.accepted.connect(finish)
    buttons.rejected.connect(dialog.reject)
    dialog.setMinimumWidth(360)
    given = dialog.exec() == QDialog.DialogCode.Accepted
    dialog.deleteLater()
    return line.text() if given else None


def show_about(parent: QWidget) -> None:
    """Say what this is and which version."""
    QMessageBox.about(
        parent,
        _tr("About Markermend"),
        _tr(
            "<h3>Markermend {0}</h3><p>Finds damaged intervals in optical motion capture takes, "
            "says what they are and how sure it is, and repairs them under your eyes.</p>"
            "<p>Free software under the MIT licence.</p>"
        ).format(markermend.__version__),
    )
