"""Context menus of the plots: what can be done to an artifact and to a swept range."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QMenu, QWidget

from markermend.artifact import PAIRED, Artifact, Kind, Status
from markermend_app.actions.menus import entry
from markermend_app.document import Document
from markermend_app.panels.markers.marker_menu import add_marker_verbs
from markermend_app.style import theme
from markermend_app.words import literal
from markermend_app.words import tr as _tr


def artifact_menu(
    document: Document, artifact: Artifact, do: Callable[[str], None], parent: QWidget
) -> QMenu:
    """Decide about the current artifact and its like, change it, or take it off the list."""
    menu = QMenu(parent)
    name = theme.kind_name(artifact.kind)
    status, ids = artifact.status, document.together
    more = f" +{len(ids) - 1}" if len(ids) > 1 else ""
    _title(menu, f"{name} · {PAIRED.join(artifact.markers)}{more}")
    for verb, decide, done in (
        ("accept", lambda: document.decisions.accept(ids), Status.ACCEPTED),
        ("reject", lambda: document.decisions.reject(ids), Status.REJECTED),
        ("repair", document.decisions.repair_current, Status.REPAIRED),
        ("reopen", lambda: document.decisions.reopen(ids), Status.PENDING),
    ):
        entry(menu, verb, decide).setEnabled(status is not done)
    menu.addSeparator()
    classes = menu.addMenu(theme.icon("labels"), _tr("Class"))
    for kind in Kind:
        action = classes.addAction(theme.icon(kind), theme.kind_name(kind))
        action.setCheckable(True)
        action.setChecked(kind is artifact.kind)
        action.triggered.connect(lambda _=False, k=kind: document.decisions.change_current(kind=k))
    axes = menu.addMenu(theme.icon("curves"), _tr("Damaged axes"))
    for axis in "xyz":
        action = axes.addAction(axis.upper())
        action.setCheckable(True)
        action.setChecked(axis in artifact.axes)
        action.setEnabled(artifact.axes != axis)
        action.triggered.connect(
            lambda _=False, a=axis: document.decisions.change_current(
                axes=_toggled(artifact.axes, a)
            )
        )
    menu.addSeparator()
    for name in ("repair_alike", "reject_alike", "split_artifact", "join_artifacts", "note"):
        entry(menu, name, partial(do, name))
    menu.addSeparator()
    entry(menu, "remove", lambda: document.decisions.remove(ids))
    if not document.editable:
        for action in menu.actions():
            action.setEnabled(False)
    return menu


def sweep_menu(
    document: Document,
    mark: Callable[[Kind], None],
    do: Callable[[str], None],
    parent: QWidget,
) -> QMenu:
    """Mark the swept range as an artifact, or do what an action of that name does to it."""
    menu = QMenu(parent)
    if document.selection is not None:
        _title(menu, _tr("Selection on {marker}").format(marker=document.selection.marker))
    for kind in Kind:
        text = _tr("Mark as {kind}").format(kind=theme.kind_name(kind, within=True))
        action = menu.addAction(theme.icon(kind), text)
        action.triggered.connect(partial(mark, kind))
        action.setEnabled(document.editable)
    menu.addSeparator()
    for name in (
        "repair_selection",
        "smooth",
        "cut_selection",
        "swap_selection",
        "move_selection",
    ):
        entry(menu, name, partial(do, name), joints=document.joints).setEnabled(document.editable)
    menu.addSeparator()
    entry(menu, "region_selection", partial(do, "region_selection")).setEnabled(document.editable)
    entry(menu, "clear_selection", partial(do, "clear_selection"))
    return menu


def plot_menu(do: Callable[[str], None], document: Document, parent: QWidget) -> QMenu:
    """What can be done where there is nothing: to the view, and to the foremost marker."""
    menu = QMenu(parent)
    entry(menu, "fit", partial(do, "fit"))
    menu.addSeparator()
    add_marker_verbs(menu, document, do)
    return menu


def _title(menu: QMenu, text: str) -> None:
    """What the menu is about; a styled menu does not draw the text of sections."""
    menu.addAction(literal(text)).setEnabled(False)
    menu.addSeparator()


def _toggled(axes: str, axis: str) -> str:
    """Axes with one put in or taken out."""
    chosen = set(axes) ^ {axis}
    return "".join(a for a in "xyz" if a in chosen)
