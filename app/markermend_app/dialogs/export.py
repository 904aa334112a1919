"""Before a take is exported: what stays as it is, what will no longer match, what to write down."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QLabel,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from markermend.artifact import PAIRED, Artifact, within
from markermend_app.dialogs.help_key import help_in
from markermend_app.panels.inspector.artifact_text import STATUS_NAME, span
from markermend_app.style import theme
from markermend_app.words import tr


@dataclass(frozen=True)
class ExportChoice:
    """What the operator wants written besides the samples.

    Attributes
    ----------
    record : what was repaired, and how, in a MARKERMEND group of the file
    mark_outputs : the names of model outputs that no longer match, in the same group
    region : only the frames of the region of interest
    """

    record: bool
    mark_outputs: bool
    region: bool = False


class ExportDialog(QDialog):
    """Asks once, with the whole list folded away.

    Parameters
    ----------
    pending, accepted : artifacts whose samples export leaves as they are
    outputs : model outputs that no longer match the repaired markers
    first_frame : the file's number of frame index 0
    record : whether writing down the repairs is proposed
    empty : whether nothing was found or marked at all
    region : the frames that are reviewed, a half-open interval; None for all of the take
    joints : whether it is a skeleton recording, which is seldom written into a C3D file: that
        choice is shown only where it was made, so that nothing holds unseen
    """

    def __init__(
        self,
        parent: QWidget,
        pending: Sequence[Artifact],
        accepted: Sequence[Artifact],
        outputs: Sequence[str],
        first_frame: int,
        record: bool,
        *,
        empty: bool = False,
        region: tuple[int, int] | None = None,
        joints: bool = False,
    ) -> None:
        super().__init__(parent)
        help_in(self)
        self.setWindowTitle(self.tr("Export"))
        self._left = accepted, pending, outputs, first_frame
        self._empty, self._frames = empty, region
        self._heading = QLabel()
        self._heading.setProperty("role", "heading")
        box = QVBoxLayout(self)
        box.setContentsMargins(20, 16, 20, 16)
        box.setSpacing(12)
        box.addWidget(self._heading)
        box.addWidget(
            self._text(self.tr("Export repairs nothing by itself: only what you repaired differs."))
        )
        if outputs:
            text = self.tr(
                "Model outputs in this file (angles, forces, moments…) were computed from the "
                "markers before their repair and no longer match: {0}."
            )
            box.addWidget(self._text(text.format(len(outputs))))
        self._record = QCheckBox(self.tr("Write into a C3D file what was repaired, and how"))
        self._record.setChecked(record)
        self._record.setVisible(record or not joints)
        self._mark = QCheckBox(self.tr("Name in the file the model outputs that no longer match"))
        self._mark.setChecked(bool(outputs))
        self._mark.setVisible(bool(outputs))
        start, stop = region or (0, 1)
        text = self.tr("Write frames {0}–{1} only, the region of interest")
        self._region = QCheckBox(text.format(start + first_frame, stop - 1 + first_frame))
        self._region.setVisible(region is not None)
        self._region.setChecked(region is not None)
        self._region.toggled.connect(self._tell)
        box.addWidget(self._region)
        box.addWidget(self._record)
        box.addWidget(self._mark)

        self._details = QPlainTextEdit()
        self._details.setReadOnly(True)
        self._details.setMinimumHeight(220)
        self._details.hide()
        buttons = QDialogButtonBox()
        go = buttons.addButton(self.tr("Export…"), QDialogButtonBox.ButtonRole.AcceptRole)
        go.setDefault(True)
        # Return exports, wherever the focus went in between, but on a list to be seen first.
        buttons.addButton(QDialogButtonBox.StandardButton.Cancel).setAutoDefault(False)
        if accepted or pending or outputs:
            show = buttons.addButton(self.tr("Show list"), QDialogButtonBox.ButtonRole.ActionRole)
            show.clicked.connect(self._toggle)
            show.setAutoDefault(True)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        box.addWidget(self._details, 1)
        box.addWidget(buttons)
        go.setFocus()
        self.setMinimumWidth(480)
        self._tell()

    @property
    def choice(self) -> ExportChoice:
        """What is checked."""
        return ExportChoice(
            self._record.isChecked(),
            not self._mark.isHidden() and self._mark.isChecked(),
            self._region.isChecked(),
        )

    def _tell(self) -> None:
        """Say what is left of what is to be written."""
        accepted, pending, outputs, first_frame = self._left
        if self._frames is not None and self._region.isChecked():
            accepted, pending = within(accepted, self._frames), within(pending, self._frames)
        nothing = self.tr("Nothing was found or marked. Export the take as it is?")
        self._heading.setText(nothing if self._empty else self._title(pending, accepted))
        self._details.setPlainText("\n".join(_lines(accepted, pending, outputs, first_frame)))

    def _title(self, pending: Sequence[Artifact], accepted: Sequence[Artifact]) -> str:
        """Say what is left as it is, or that nothing is."""
        left = []
        if pending:
            left.append(self.tr("{0} not decided").format(len(pending)))
        if accepted:
            left.append(self.tr("{0} accepted but not repaired").format(len(accepted)))
        if not left:
            return self.tr("Every artifact is decided. Export?")
        return self.tr("Export with artifacts left as they are: {0}?").format(", ".join(left))

    def _text(self, text: str) -> QLabel:
        """A paragraph."""
        label = QLabel(text)
        label.setWordWrap(True)
        return label

    def _toggle(self) -> None:
        """Fold the list out or away."""
        self._details.setVisible(self._details.isHidden())
        self.adjustSize()


def _lines(
    accepted: Sequence[Artifact],
    pending: Sequence[Artifact],
    outputs: Sequence[str],
    first_frame: int,
) -> list[str]:
    """One line for each artifact left, and the outputs by name."""
    lines = [
        f"{PAIRED.join(a.markers)}  {theme.kind_name(a.kind)} {a.axes}"
        f"  {span(a, first_frame)}  {tr(STATUS_NAME[a.status])}"
        for a in (*accepted, *pending)
    ]
    return lines + ([", ".join(outputs)] if outputs else [])


def ask_export(
    parent: QWidget,
    pending: Sequence[Artifact],
    accepted: Sequence[Artifact],
    outputs: Sequence[str],
    first_frame: int,
    record: bool,
    *,
    empty: bool = False,
    region: tuple[int, int] | None = None,
    joints: bool = False,
) -> ExportChoice | None:
    """Ask; None to stay. Where nothing is left to be told of joints, there is no question."""
    if joints and not (pending or accepted or outputs) and region is None:
        return ExportChoice(record, mark_outputs=False)
    dialog = ExportDialog(
        parent,
        pending,
        accepted,
        outputs,
        first_frame,
        record,
        empty=empty,
        region=region,
        joints=joints,
    )
    return dialog.choice if dialog.exec() == QDialog.DialogCode.Accepted else None
