"""A tour of the window in five steps: each is done by doing it, on the demo take or another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication, QDockWidget, QScrollArea, QWidget

from markermend.artifact import Status
from markermend_app import settings
from markermend_app.actions import shortcuts
from markermend_app.panels.tour_card import TourCard
from markermend_app.words import tr

if TYPE_CHECKING:
    from markermend_app.window import MainWindow

SEEN = "tour_seen"
FOLLOW_MS = 100

Done = Callable[[], bool]


@dataclass(frozen=True)
class Step:
    """One step of the tour.

    Attributes
    ----------
    title, text : what the card says; ``{0}``, ``{1}`` in it are keys
    keys : names of the actions whose keys these are
    target : the widget that the card points at
    begin : called when the step begins; gives a function that tells whether it is done
    """

    title: str
    text: str
    keys: tuple[str, ...]
    target: Callable[[MainWindow], QWidget | None]
    begin: Callable[[MainWindow], Done]


class Tour(QObject):
    """Leads through the steps, beside the widgets they speak of, while the window works as ever.

    Parameters
    ----------
    window : what is shown around
    """

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.card = TourCard(window)
        self.card.skip.clicked.connect(self._next)
        self.card.end.clicked.connect(self.end)
        self.steps: tuple[Step, ...] = ()
        self.place = 0
        self._done: Done = _never
        self._brought_up = False
        # Docks, scrolling and splitters move a target in many ways, and tell of few.
        self._following = QTimer(self, interval=FOLLOW_MS)
        self._following.timeout.connect(self._follow)
        document = window.document
        for signal in (
            document.current_changed,
            document.history_changed,
            window.comparison.changed,
        ):
            signal.connect(self._look)
        document.opened.connect(self._opened)
        shortcuts.watcher.changed.connect(self._tell)

    @property
    def running(self) -> bool:
        """Whether the tour is under way."""
        return self._following.isActive()

    def start(self) -> None:
        """Begin with the first step."""
        self.steps = _steps()
        self._following.start()
        self._go(0)

    def end(self) -> None:
        """Leave the tour, which does not begin by itself again."""
        self._following.stop()
        self._done = _never
        focus = QApplication.focusWidget()
        if focus is not None and self.card.isAncestorOf(focus):
            self._window.walk.home()
        self.card.leave()
        settings.remember(SEEN, True)

    def _go(self, place: int) -> None:
        """Begin a step; after the last one say where to find more."""
        if place > len(self.steps):
            self.end()
            return
        self.place = place
        self._done = _never
        if place < len(self.steps):
            self._done = self.steps[place].begin(self._window)
            self._brought_up = False
        else:
            settings.remember(SEEN, True)
        self._tell()

    def _next(self) -> None:
        """Go on to the next step."""
        self._go(self.place + 1)

    def _look(self) -> None:
        """Go on when the step is done."""
        if self.running and self._done():
            self._next()

    def _opened(self) -> None:
        """Begin anew when the take is closed: every other step needs one."""
        if self.running and self._window.document.session is None and self.place:
            self._go(0)
        self._look()

    def _tell(self) -> None:
        """Write the card."""
        if not self.running:
            return
        if self.place == len(self.steps):
            keys = [shortcuts.way_to(name) for name in ("manual", "shortcuts", "palette")]
            text = self.tr(
                "{0} opens the manual at the panel in use, {1} lists every key, and {2} finds any "
                "command by a few letters. The tour is in the Help menu."
            )
            self.card.say(self.tr("That is the whole round"), text.format(*keys), "", last=True)
        else:
            step = self.steps[self.place]
            text = step.text.format(*map(shortcuts.way_to, step.keys))
            count = self.tr("{0} of {1}").format(self.place + 1, len(self.steps))
            self.card.say(step.title, text, count, last=False)
        self._follow()

    def _follow(self) -> None:
        """Stand beside the target, wherever it is now."""
        last = self.place == len(self.steps)
        target = None if last else self.steps[self.place].target(self._window)
        if target is not None and not self._brought_up:
            _bring_up(target)
            # Later it is not fetched back when the operator puts it away.
            self._brought_up = not target.visibleRegion().isEmpty()
        self.card.point_at(target)


def _steps() -> tuple[Step, ...]:
    """What is shown, in the language of the app."""
    return (
        Step(
            tr("Open the demo take"),
            tr(
                "It is damaged on purpose: 53 markers, gaps, jumps and noise. File › Open the demo "
                "take does the same, and a take of your own will do too."
            ),
            (),
            _way_to_demo,
            _a_take_is_opened,
        ),
        Step(
            tr("Look at why"),
            tr(
                "Detection starts by itself; the worst artifact comes first. Here you read what "
                "is wrong, how sure that is, and why. Then go on to the next with {0}."
            ),
            ("next",),
            lambda window: window.inspector.artifact.why,
            _another_is_looked_at,
        ),
        Step(
            tr("Repair it with one key"),
            tr(
                "The thick curve in the plots is the repair that is expected to err least. {0} "
                "takes it and moves on; {1} says that the flag is a false alarm."
            ),
            ("repair", "reject"),
            lambda window: window.inspector.decisions,
            lambda window: _grew(lambda: _repaired(window)),
        ),
        Step(
            tr("Take it back"),
            tr("Nothing is final, and your file is never changed. Undo the repair with {0}."),
            ("undo",),
            lambda window: window.toolbar.widgetForAction(window.actions_by_name["undo"]),
            lambda window: _grew(lambda: _undone(window)),
        ),
        Step(
            tr("Compare, or export"),
            tr(
                "Hold {0} to see what every method would do, choose with ↑ and ↓, and let go. Or "
                "write a copy with {1}, in which only repaired samples differ."
            ),
            ("compare", "export"),
            lambda window: window.inspector.artifact.methods.outcome,
            _compared_or_exported,
        ),
    )


def _never() -> bool:
    """A step that is done by its button alone."""
    return False


def _grew(measure: Callable[[], int]) -> Done:
    """Done when a number rises above the least it was."""
    least = measure()

    def done() -> bool:
        nonlocal least
        now = measure()
        least = min(least, now)
        return now > least

    return done


def _way_to_demo(window: MainWindow) -> QWidget:
    """The button that opens the demo take, or the menus while a take is open."""
    return window.welcome.demo if window.welcome.isVisible() else window.menuBar()


def _a_take_is_opened(window: MainWindow) -> Done:
    """Done when a take is open that was not before."""
    before = id(window.document.session)
    document = window.document
    return lambda: document.session is not None and id(document.session) != before


def _another_is_looked_at(window: MainWindow) -> Done:
    """Done when a second artifact is under review."""
    seen: set[str] = set()

    def done() -> bool:
        current = window.document.current
        if current is not None:
            seen.add(current.id)
        return len(seen) > 1

    done()
    return done


def _compared_or_exported(window: MainWindow) -> Done:
    """Done when the comparison is closed again, or when a copy was written."""
    session = window.document.session
    exported = _grew(lambda: int(session is not None and session.exported))
    compared = False

    def done() -> bool:
        nonlocal compared
        compared = compared or window.comparison.shown
        return exported() or (compared and not window.comparison.shown)

    return done


def _repaired(window: MainWindow) -> int:
    """How many artifacts are repaired."""
    session = window.document.session
    return 0 if session is None else len(session.with_status(Status.REPAIRED))


def _undone(window: MainWindow) -> int:
    """How many steps can be brought back."""
    session = window.document.session
    return 0 if session is None else len(session.undone)


def _bring_up(target: QWidget) -> None:
    """Show the dock that a widget stands in, and scroll to it."""
    above = target.parentWidget()
    while above is not None:
        if isinstance(above, QDockWidget):
            above.show()
            above.raise_()
        elif isinstance(above, QScrollArea):
            above.ensureWidgetVisible(target, 0, 0)
        above = above.parentWidget()
