"""The main window: lays panels out and connects them. It decides nothing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QChildEvent, Qt
from PySide6.QtGui import QActionGroup, QCloseEvent, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import (
    QDockWidget,
    QMainWindow,
    QSplitter,
    QStackedWidget,
    QTabBar,
    QVBoxLayout,
    QWidget,
)

from markermend_app import settings
from markermend_app.actions import menus, shortcuts
from markermend_app.actions.recent_menu import fill_when_shown
from markermend_app.attention import Attention
from markermend_app.background.batch_review import BatchReview
from markermend_app.background.jobs import Lane
from markermend_app.dock_layout import DockLayout
from markermend_app.document import Document
from markermend_app.panel_walk import PanelWalk
from markermend_app.panels.history import HistoryPanel
from markermend_app.panels.inspector.candidates import Candidates
from markermend_app.panels.inspector.inspector import Inspector
from markermend_app.panels.markers.marker_tree import MarkerTree
from markermend_app.panels.notice import Notice
from markermend_app.panels.overview.overview import Overview
from markermend_app.panels.plots.trajectories import TrajectoryPanel
from markermend_app.panels.quality import QualityPanel
from markermend_app.panels.queue.review_queue import ReviewQueue
from markermend_app.panels.scene.scene import Scene
from markermend_app.panels.status import StatusLine
from markermend_app.panels.take_list import TakeList
from markermend_app.panels.toolbar import Toolbar
from markermend_app.panels.transport import Transport
from markermend_app.panels.welcome import Welcome
from markermend_app.preferred import Preferred
from markermend_app.pressing import Pressing
from markermend_app.sight import Sight
from markermend_app.style import theme
from markermend_app.verbs.bulk import Bulk
from markermend_app.verbs.centring import Centring
from markermend_app.verbs.commands import Commands
from markermend_app.verbs.comparison import Comparison
from markermend_app.verbs.detecting import Detecting
from markermend_app.verbs.handwork import HandWork
from markermend_app.verbs.key_sweep import KeySweep
from markermend_app.verbs.references import References
from markermend_app.verbs.region import RegionOfInterest
from markermend_app.verbs.repairing import Repairing
from markermend_app.verbs.reporting import Reporting
from markermend_app.verbs.smoothing import Smoothing
from markermend_app.verbs.view import THEMES, view_verbs, wear

_Verbs = (
    Commands
    | Detecting
    | Repairing
    | Bulk
    | BatchReview
    | HandWork
    | KeySweep
    | Smoothing
    | Reporting
    | Centring
    | RegionOfInterest
)
DECISIONS = ("accept", "reject", "reopen", "remove")
"""Actions that would decide unseen about an artifact whose details a swept range covers."""


class MainWindow(QMainWindow):
    """One window, one take."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("main")
        self.document = Document(self)
        self.lane = Lane("engine", self)
        self.detecting = Detecting(self.document, self.lane, self)
        self.repairing = Repairing(self.document, self.lane, self)
        self.commands = Commands(self.document, self.lane, self.detecting, self)
        self.bulk = Bulk(self.document, self)
        self.batch = BatchReview(self.document, self.commands, self.lane, self)
        self.smoothing = Smoothing(self.document, self)
        self.key_sweep = KeySweep(self.document, self)
        self.reporting = Reporting(self.document, self.lane, self)
        self.centring = Centring(self.document, self)
        self.region = RegionOfInterest(self.document, self)
        self.attention = Attention(self.document, self)
        self.sight = Sight(self.document, self)
        self.setWindowIcon(theme.app_icon())
        self.setAcceptDrops(True)
        self.setDockNestingEnabled(True)
        self._make_panels()
        self.walk = PanelWalk(self)
        self.references = References(self.document, self)
        self.scene.pick, self.scene.do = self.references.toggle, self._run
        self.tree.pick = self.references.toggle
        self.comparison = Comparison(self.document, self)
        self.candidates = Candidates(self.comparison, self.trajectories, self)
        self.hand = HandWork(self.document, self.lane, self, self.queue.selected)
        self._make_actions()
        self._connect()
        self.preferred = Preferred(
            self.document,
            self.commands.save_review,
            self.scene.set_vertical,
            self._take_preference,
            self,
        )
        self.pressing = Pressing(self)
        self.dock_layout.start()
        self._retitle()

    # Construction

    def _make_panels(self) -> None:
        document = self.document
        self.trajectories = TrajectoryPanel(document)
        self.overview = Overview(document, self.lane)
        self.tree = MarkerTree(document)
        self.queue = ReviewQueue(document)
        self.inspector = Inspector(document)
        self.quality = QualityPanel(document)
        self.history = HistoryPanel(document)
        self.scene = Scene(document)
        self.transport = Transport(document)
        self.takes = TakeList(self.batch)
        self.welcome = Welcome()
        self.status = StatusLine(document, self.lane)
        self.setStatusBar(self.status)

        plots = QSplitter(Qt.Orientation.Vertical)
        plots.addWidget(self.trajectories)
        plots.addWidget(self.overview)
        plots.setStretchFactor(0, 1)
        plots.setChildrenCollapsible(False)
        self.centre = QStackedWidget()
        self.centre.addWidget(self.welcome)
        middle = QWidget()
        column = QVBoxLayout(middle)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(Notice(self.bulk))
        column.addWidget(plots, 1)
        self.centre.addWidget(middle)
        self.setCentralWidget(self.centre)

        view = QWidget()
        box = QVBoxLayout(view)
        box.setContentsMargins(0, 0, 0, 0)
        box.setSpacing(0)
        box.addWidget(self.scene, 1)
        box.addWidget(self.transport)

        left, right = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
        bottom = Qt.DockWidgetArea.BottomDockWidgetArea
        self.docks = {
            "markers": self._dock("markers", self.tr("Markers"), self.tree, left),
            "history": self._dock("history", self.tr("History"), self.history, left),
            "takes": self._dock("takes", self.tr("Takes"), self.takes, left),
            "scene": self._dock("scene", self.tr("3D view"), view, right),
            "inspector": self._dock("inspector", self.tr("Details"), self.inspector, right),
            "queue": self._dock("queue", self.tr("Review queue"), self.queue, bottom),
            "quality": self._dock("quality", self.tr("Quality"), self.quality, bottom),
        }
        self.docks["quality"].visibilityChanged.connect(self.quality.set_seen)
        self.dock_layout = DockLayout(self, self.docks, plots)

    def _dock(self, name: str, title: str, panel: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(title, self)
        dock.setObjectName(name)
        dock.setWidget(panel)
        self.addDockWidget(area, dock)
        return dock

    def _make_actions(self) -> None:
        self._own = view_verbs(self)
        self.actions_by_name = menus.build(self, self.document, self._run)
        bar = self.menuBar()
        self.menus = menus.fill_menus(bar, self.actions_by_name)
        short = {
            "open": self.tr("Open"),
            "export": self.tr("Export"),
            "report": self.tr("Report"),
            "detect": self.tr("Detect"),
            "before_after": self.tr("Before"),
            "prediction": self.tr("Prediction"),
        }
        self.toolbar = Toolbar(self.tr("Toolbar"), self.actions_by_name, short, self)
        self.addToolBar(self.toolbar)

        panels = self.menus["View"].addMenu(self.tr("Panels"))
        for dock in self.docks.values():
            panels.addAction(dock.toggleViewAction())
        recent = self.menus["File"].addMenu(self.tr("Recent takes"))
        self.menus["File"].insertMenu(self.actions_by_name["export"], recent)
        fill_when_shown(recent, self.commands.open_path)

        themes = QActionGroup(self)
        for name in THEMES:
            themes.addAction(self.actions_by_name[f"theme_{name}"])
        self._check_chosen()

        shortcuts.watcher.changed.connect(self._give_keys)
        theme.watcher.changed.connect(self._give_icons)

    def _connect(self) -> None:
        document = self.document
        kept = self.queue.kept
        aside = (self.references, self.sight, self.inspector, self.comparison, kept)
        for speaker in (document, *self._verbs, *aside):
            speaker.said.connect(self.status.say)
        for speaker in (self.sight, kept):
            speaker.taken_back.connect(self.status.take_back)
        self.centring.open_wanted.connect(self.commands.open_path)
        self.batch.started.connect(self.dock_layout.show_takes)
        choosing = self.actions_by_name["choose_references"]
        self.references.changed.connect(choosing.setChecked)
        self.references.changed.connect(self.scene.set_choosing)
        self.references.changed.connect(self.tree.set_choosing)
        self.welcome.open_requested.connect(self.commands.open)
        self.welcome.demo_requested.connect(self.commands.open_demo)
        self.welcome.path_requested.connect(self.commands.open_path)
        self.lane.started.connect(self.queue.set_doing)
        self.lane.finished.connect(lambda: self.queue.set_doing(""))
        self.queue.repair_requested.connect(self.repairing.repair_many)
        self.queue.verb_requested.connect(self._run)
        self.trajectories.mark_requested.connect(self.hand.mark_selection)
        self.trajectories.verb_requested.connect(self._run)
        self.tree.verb_requested.connect(self._run)
        self.inspector.mark_requested.connect(self.hand.mark_selection)
        self.inspector.artifact.note.left.connect(self.walk.home)
        self.transport.left.connect(self.walk.home)
        self.inspector.verb_requested.connect(self._run)
        self.trajectories.view_changed.connect(self.overview.set_view)
        self.overview.region_dragged.connect(self.region.choose)
        self.trajectories.view_changed.connect(self.transport.set_view)
        self.trajectories.view_changed.connect(self.sight.set_view)
        self.trajectories.header.follow(self.sight)
        document.opened.connect(self._take_opened)
        document.history_changed.connect(self._retitle)

    # Actions that are the window's own

    def can(self, name: str) -> bool:
        """Whether an action of that name has a verb."""
        return name in self._own or any(hasattr(verbs, name) for verbs in self._verbs)

    def _run(self, name: str) -> None:
        """Do what an action names, but nothing to an artifact that is out of sight."""
        if name not in ("undo", "redo"):
            self.document.going_back.catch_up()
        if name == "repair" and self.inspector.shows_range:
            name = "repair_selection"
        elif (menus.is_about_current(name) and self.sight.bring_back()) or (
            name in DECISIONS and self.inspector.bring_back()
        ):
            return
        verbs = next((verbs for verbs in self._verbs if hasattr(verbs, name)), None)
        (self._own.get(name) or getattr(verbs, name))()

    @property
    def _verbs(self) -> tuple[_Verbs, ...]:
        """What has verbs that actions name."""
        return (
            self.commands,
            self.detecting,
            self.repairing,
            self.bulk,
            self.batch,
            self.hand,
            self.key_sweep,
            self.smoothing,
            self.reporting,
            self.centring,
            self.region,
        )

    def _give_keys(self) -> None:
        menus.give_keys(self.actions_by_name)

    def _give_icons(self) -> None:
        menus.give_icons(self.actions_by_name)

    def _check_chosen(self) -> None:
        """Check the menus' entries that hold."""
        self.actions_by_name[f"theme_{settings.text('theme', 'system')}"].setChecked(True)
        on_open = settings.flag("detect_on_open", True)
        self.actions_by_name["detect_on_open"].setChecked(on_open)

    def _take_preference(self, name: str) -> None:
        """Let a look hold that was chosen in the preferences."""
        self._check_chosen()
        if name == "theme":
            wear(settings.text("theme", "system"))

    # Following the document

    def _take_opened(self) -> None:
        self.centre.setCurrentIndex(0 if self.document.session is None else 1)
        # The review keys work at once, rather than land in a filter.
        self.walk.home()
        self._retitle()

    def _retitle(self) -> None:
        session, path = self.document.session, self.document.path
        if session is None:
            self.setWindowTitle("Markermend")
            self.setWindowModified(False)
            return
        name = path.name if path else self.tr("take")
        suffix = self.tr(" (read-only)") if not self.document.editable else ""
        self.setWindowTitle(f"{name}[*]{suffix} – Markermend")
        self.setWindowModified(not session.exported)

    # Window manners

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Let Tab pass over panels that another one covers as a tab: Qt takes them for visible."""
        while super().focusNextPrevChild(forward):
            focus = self.focusWidget()
            around = [dock for dock in self.docks.values() if dock.isAncestorOf(focus)]
            if not any(dock.visibleRegion().isEmpty() for dock in around):
                return True
        return False

    def childEvent(self, event: QChildEvent) -> None:
        """Keep Tab off the tabs of panels: F6 reaches these, and Qt leaves empty ones behind."""
        bar = event.child()
        if event.polished() and isinstance(bar, QTabBar):
            bar.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        super().childEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take a file that is dragged in."""
        if any(u.isLocalFile() for u in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what is dropped."""
        paths = [Path(u.toLocalFile()) for u in event.mimeData().urls() if u.isLocalFile()]
        if paths:
            event.acceptProposedAction()
            self.open_paths(paths)

    def open_paths(self, paths: Sequence[Path]) -> None:
        """Open a take; or review several, a folder of them, or what a batch left."""
        if len(paths) == 1 and paths[0].is_file() and paths[0].suffix.lower() != ".json":
            self.commands.open_path(paths[0])
        else:
            self.batch.start(paths)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask about unexported work, remember the layout, and stop the workers."""
        if not self.commands.let_go():
            event.ignore()
            return
        self.dock_layout.remember()
        self.document.open(None, None)
        for lane in self.findChildren(Lane):
            lane.close()
        event.accept()
