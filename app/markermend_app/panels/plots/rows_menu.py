"""The menu of what the plots show: quantities of the markers, and channels below them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from markermend.take import Take
from markermend_app import settings
from markermend_app.document import Document
from markermend_app.panels.markers.naming import short_names
from markermend_app.panels.plots.beside import analog_key, kind_name, point_key
from markermend_app.panels.plots.quantity import COORDINATES, QUANTITIES, can_show
from markermend_app.panels.staying_menu import StayingMenu
from markermend_app.telling import told_group
from markermend_app.words import tr as _tr

if TYPE_CHECKING:
    from markermend_app.panels.plots.trajectories import TrajectoryPanel


def fill_rows_menu(menu: QMenu, panel: TrajectoryPanel) -> None:
    """Offer every row, and what there is to measure to and to show beside."""
    menu.clear()
    session = panel.document.session
    take = None if session is None else session.original

    checks: dict[str, QAction] = {}

    def toggle(name: str) -> None:
        panel.choose_rows(sorted(set(panel.chosen) ^ {name}))
        # The last row stays, whatever its check mark says.
        for other, check in checks.items():
            check.setChecked(other in panel.chosen)

    for name, quantity in QUANTITIES.items():
        if name == "speed":
            menu.addSeparator()
        text = _tr(quantity.meaning)
        if name == "distance" and panel.partner is not None and take is not None:
            text = _tr("Distance to {0}").format(short_names(take.labels)[panel.partner])
        action = _check(menu, text, name in panel.chosen, partial(toggle, name))
        action.setEnabled(can_show(take, name))
        checks[name] = action
    if take is None:
        return
    partners = menu.addMenu(_tr("Measure the distance to"))
    _check(
        partners,
        _tr("A marker that suits"),
        panel.chosen_partner is None,
        partial(panel.choose_partner, None),
    )
    partners.addSeparator()
    _partners(partners, panel)
    menu.addSeparator()
    plain = menu.addAction(_tr("X, Y and Z only"))
    plain.triggered.connect(lambda _=False: _reset(panel))
    _beside(menu, panel.document, take)


def _partners(menu: QMenu, panel: TrajectoryPanel) -> None:
    """Every marker to measure to, by group: a long list would not fit the screen."""
    document = panel.document
    session, mesh = document.session, document.mesh
    if session is None:
        return
    labels = session.original.labels
    short = short_names(labels)
    groups = [] if mesh is None else [(told_group(g.name), g.markers) for g in mesh.groups]
    placed = {m for _, members in groups for m in members}
    rest = tuple(m for m in range(len(labels)) if m not in placed)
    if rest:
        groups.append((_tr("Others"), rest))
    for name, members in groups:
        sub = menu.addMenu(name)
        for label in (labels[m] for m in members):
            chosen = label == panel.chosen_partner
            _check(sub, short[label], chosen, partial(panel.choose_partner, label))


def _beside(menu: QMenu, document: Document, take: Take) -> None:
    """Analog channels, and points that are no markers, by kind."""
    analog = () if take.analog is None else take.analog.labels
    points = () if take.points is None else take.points.labels
    if not analog and not points:
        return
    menu.addSeparator()
    if analog:
        sub = _submenu(menu, _tr("Analog channels"))
        _channels(sub, document, ((analog_key(i), label) for i, label in enumerate(analog)))
    if take.points is not None and points:
        for kind in dict.fromkeys(take.points.kinds):
            sub = _submenu(menu, _tr("Model outputs: {0}").format(kind_name(kind)))
            _channels(
                sub,
                document,
                (
                    (point_key(i), label)
                    for i, label in enumerate(points)
                    if take.points.kinds[i] == kind
                ),
            )
    clear = menu.addAction(_tr("Hide all channels"))
    clear.setEnabled(bool(document.beside))
    clear.triggered.connect(lambda _=False: document.show_beside(()))


def _submenu(menu: QMenu, title: str) -> QMenu:
    """A menu of check marks below another one."""
    sub = StayingMenu(title, menu)
    menu.addMenu(sub)
    return sub


def _channels(menu: QMenu, document: Document, channels: Iterable[tuple[str, str]]) -> None:
    """An entry for each channel: key and label."""

    def toggle(key: str) -> None:
        shown = document.beside
        rest = tuple(k for k in shown if k != key)
        document.show_beside(rest if key in shown else (*shown, key))

    for key, label in channels:
        _check(menu, label, key in document.beside, partial(toggle, key))


def _reset(panel: TrajectoryPanel) -> None:
    """Show the coordinates alone."""
    panel.choose_rows(COORDINATES)
    panel.document.show_beside(())


def _check(menu: QMenu, text: str, checked: bool, do: Callable[[], object]) -> QAction:
    """An entry with a check mark."""
    action = menu.addAction(text)
    action.setCheckable(True)
    action.setChecked(checked)
    action.triggered.connect(lambda _=False: do())
    return action


def remembered_rows() -> tuple[str, ...]:
    """Rows chosen last time."""
    names = settings.text("plots", " ".join(COORDINATES)).split()
    return tuple(n for n in QUANTITIES if n in names) or COORDINATES
