"""Choosing how bodies move: as Markermend knows it, or as the user's own recordings tell."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from markermend.progress import Progress
from markermend_app import settings
from markermend_app.background.jobs import Lane
from markermend_app.background.loading import is_there
from markermend_app.dialogs import ask as dialogs
from markermend_app.dialogs.file_filters import WITHOUT_PATTERNS, skeleton_filter
from markermend_app.own_prior import SETTING

_ENDING = ".npz"


class PriorChoice(QWidget):
    """A choice of priors, and learning one.

    Signals
    -------
    changed(str) : the setting of that name has another value
    """

    changed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._lane, self._last = Lane("learning", self), ""
        self._lane.progressed.connect(self._progressed)
        self.box = QComboBox()
        self.box.setAccessibleName(self.tr("How bodies move"))
        self.box.activated.connect(lambda _: self._keep(self.box.currentData()))
        self.file = QPushButton(self.tr("From a file…"))
        self.file.clicked.connect(self._ask_file)
        self.learn = QPushButton(self.tr("Learn…"))
        self.learn.setToolTip(self.tr("Learn from clean recordings"))
        self.learn.clicked.connect(self._ask_recordings)
        choice = QHBoxLayout()
        choice.setSpacing(8)
        choice.addWidget(self.box, 1)
        choice.addWidget(self.file)
        choice.addWidget(self.learn)
        self.about = QLabel()
        self.about.setProperty("role", "small")
        self.about.setWordWrap(True)
        self.about.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.bar = QProgressBar()
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.cancel = QPushButton(self.tr("Cancel"))
        self.cancel.clicked.connect(self.stop)
        work = QWidget()
        line = QHBoxLayout(work)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(self.bar, 1)
        line.addWidget(self.cancel)
        # They take turns in one place, so that nothing moves.
        self._foot = QStackedWidget()
        self._foot.addWidget(self.about)
        self._foot.addWidget(work)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(choice)
        column.addWidget(self._foot)
        self.setFocusProxy(self.box)

    def read(self) -> None:
        """Show what holds now; what held before can be chosen again."""
        kept = settings.text(SETTING, "")
        self._last = kept or self._last
        self.box.clear()
        self.box.addItem(self.tr("As Markermend knows it"), "")
        if self._last:
            there = is_there(Path(self._last))
            text = self.tr("As {0} tells") if there else self.tr("As {0} told, which is gone")
            self.box.addItem(text.format(Path(self._last).name), self._last)
        self.box.setCurrentIndex(1 if kept else 0)
        self.about.setText(
            self.tr(
                "Used for skeletons with the joints it was learnt from, opened from now on; "
                "for others, what Markermend knows."
            )
            if kept
            else self.tr(
                "Clean recordings of a performer tell most of how that one moves in gaps. "
                "Up to ten minutes of them are kept in the file."
            )
        )

    def stop(self) -> None:
        """Stop learning; what was there before holds on."""
        self._lane.cancel()
        self._work(False)

    # What is chosen

    def _keep(self, path: str) -> None:
        settings.remember(SETTING, path or None)
        self.read()
        self.changed.emit(SETTING)

    def _ask_file(self) -> None:
        """Ask for a prior, and keep it if it is one."""
        kept = settings.text(SETTING, "")
        name, _ = QFileDialog.getOpenFileName(self, self.tr("How bodies move"), kept, self._kinds())
        if not name:
            return

        def work(_: Progress) -> None:
            from markermend.poses.prior import load_prior

            load_prior(Path(name))

        self._submit(self.tr("Reading"), work, name)

    def _ask_recordings(self) -> None:
        """Ask what to learn from and where to keep it, and learn."""
        names, _ = QFileDialog.getOpenFileNames(
            self,
            self.tr("Clean recordings to learn from"),
            "",
            skeleton_filter(),
            "",
            WITHOUT_PATTERNS,
        )
        if not names:
            return
        paths = [Path(name) for name in names]
        target = self._ask_target(paths)
        if target is None:
            return

        def work(progress: Progress) -> None:
            from markermend.poses.own_prior import learn_files

            learn_files(paths, target, progress=progress)

        self._submit(self.tr("Learning"), work, str(target))

    def _ask_target(self, paths: list[Path]) -> Path | None:
        """Ask where to keep what is learnt; never over another file unasked."""
        proposed = paths[0].with_name(f"prior{_ENDING}")
        name, _ = QFileDialog.getSaveFileName(
            self, self.tr("Keep how they move in"), str(proposed), self._kinds()
        )
        return dialogs.with_ending(self, name, _ENDING) if name else None

    def _kinds(self) -> str:
        named = self.tr("Priors")
        return f"{named} (*{_ENDING})"

    # Work

    def _submit(self, label: str, work: Callable[[Progress], None], name: str) -> None:
        """Do something beside the window that ends with a prior to be used."""

        def done(_: object) -> None:
            self._work(False)
            self._keep(name)

        def failed(error: Exception) -> None:
            self._work(False)
            dialogs.show_problem(self, error)

        self._work(True)
        self._lane.submit(label, work, done, failed)

    def _work(self, working: bool) -> None:
        """Show the bar while something is done, else what holds."""
        self.bar.setValue(0)
        for field in (self.box, self.file, self.learn):
            field.setEnabled(not working)
        self._foot.setCurrentIndex(1 if working else 0)

    def _progressed(self, share: float, _doing: str) -> None:
        self.bar.setValue(round(1000 * share))
