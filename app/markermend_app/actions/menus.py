"""Makes menus, toolbar and context menus from the table of actions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu, QMenuBar, QToolBar, QWidget

from markermend_app.actions import shortcuts
from markermend_app.actions.action import MethodOffered, current, repairable
from markermend_app.actions.joints import TEXTS, text_of, tip_of
from markermend_app.actions.table import ACTIONS
from markermend_app.document import Document
from markermend_app.method_words import label_of
from markermend_app.style import theme
from markermend_app.words import tr

_JOINTS = "joints"
_SPEC = {spec.name: spec for spec in ACTIONS}


def is_about_current(name: str) -> bool:
    """Whether an action does something to the artifact under review."""
    rule = _SPEC[name].enabled
    return rule in (current, repairable) or isinstance(rule, MethodOffered)


def build(owner: QWidget, document: Document, run: Callable[[str], None]) -> dict[str, QAction]:
    """Make a QAction for each entry; ``run`` gets the name of the one that was triggered."""
    made: dict[str, QAction] = {}
    for spec in ACTIONS:
        action = QAction(tr(spec.text), owner)
        action.setObjectName(spec.name)
        action.setCheckable(spec.checkable)
        action.triggered.connect(lambda _checked=False, name=spec.name: run(name))
        owner.addAction(action)
        made[spec.name] = action

    by_rule: dict[Callable[[Document], bool], list[QAction]] = defaultdict(list)
    for spec in ACTIONS:
        by_rule[spec.enabled].append(made[spec.name])

    def refresh() -> None:
        # Some hundred actions, each decision four times, but a score of rules.
        for rule, actions in by_rule.items():
            enabled = rule(document)
            for action in actions:
                action.setEnabled(enabled)

    def name_methods() -> None:
        """Call the methods by their names, once an artifact is looked at: repairs load late."""
        if document.current is not None:
            from markermend.repairs import REPAIRS

            for method in REPAIRS.values():
                if method.key is not None:
                    text = label_of(method.name, joints=document.joints)
                    made[f"method_{method.key}"].setText(text)

    document.opened.connect(lambda: _speak(made, joints=document.joints))
    document.current_changed.connect(name_methods)
    for signal in (
        document.opened,
        document.history_changed,
        document.current_changed,
        document.proposal_changed,
        document.selection_changed,
        document.shown_changed,
        document.artifacts_changed,
    ):
        signal.connect(refresh)
    refresh()
    give_icons(made)
    give_keys(made)
    return made


def _speak(made: Mapping[str, QAction], *, joints: bool) -> None:
    """Speak of joints, or of markers, once another kind of take is open."""
    if joints == bool(made["detect"].property(_JOINTS)):
        return
    for name, action in made.items():
        action.setProperty(_JOINTS, joints)
        if name in TEXTS:
            action.setText(text_of(_SPEC[name], joints=joints))
    give_keys(made)


def give_icons(made: dict[str, QAction]) -> None:
    """Draw the actions' icons in the theme's colour."""
    for spec in ACTIONS:
        if spec.icon:
            made[spec.name].setIcon(theme.icon(spec.icon))


def give_keys(made: Mapping[str, QAction]) -> None:
    """Give the actions the keys in effect, and name them in their tooltips."""
    keys = shortcuts.table()
    for spec in ACTIONS:
        action = made[spec.name]
        action.setShortcuts([QKeySequence(key) for key in keys[spec.name]])
        action.setToolTip(hint_of(spec.name, joints=bool(action.property(_JOINTS))))


def hint_of(name: str, *, joints: bool = False) -> str:
    """What an action does to markers or joints, in one sentence, and its key."""
    spec, key = _SPEC[name], shortcuts.first(name)
    tip = tip_of(spec, joints=joints)
    return f"{tip}  ({key})" if key else tip


def fill_menus(bar: QMenuBar, made: dict[str, QAction]) -> dict[str, QMenu]:
    """Put the actions into menus; returns the menus by the path of their names."""
    menus: dict[str, QMenu] = {}
    taken: set[str] = set()
    for spec in ACTIONS:
        path = spec.menu.lstrip("|")
        if path not in menus:
            above, _, name = path.rpartition("/")
            title = tr(name)
            menus[path] = (
                menus[above].addMenu(title) if above else bar.addMenu(_opened_by_alt(title, taken))
            )
            menus[path].setToolTipsVisible(True)
        if spec.menu.startswith("|"):
            menus[path].addSeparator()
        menus[path].addAction(made[spec.name])
    return menus


def _opened_by_alt(title: str, taken: set[str]) -> str:
    """A menu's title with its first letter marked that is not ``taken``; from now on it is."""
    for at, letter in enumerate(title):
        if letter.isalpha() and letter.lower() not in taken:
            taken.add(letter.lower())
            return f"{title[:at]}&{title[at:]}"
    return title


def fill_toolbar(bar: QToolBar, made: Mapping[str, QAction]) -> None:
    """Put those meant for it into the toolbar."""
    for spec in ACTIONS:
        if spec.toolbar:
            if spec.toolbar == "|":
                bar.addSeparator()
            bar.addAction(made[spec.name])


def entry(
    menu: QMenu, name: str, do: Callable[[], object], text: str = "", *, joints: bool = False
) -> QAction:
    """Put an action into a context menu, done to what the menu was opened on.

    Text, icon and key are those of the table; the key itself belongs to the window's action.
    """
    spec = _SPEC[name]
    key = shortcuts.first(name)
    words = text or text_of(spec, joints=joints)
    action = menu.addAction(theme.icon(spec.icon), f"{words}\t{key}" if key else words)
    action.setObjectName(name)
    action.triggered.connect(lambda _checked=False: do())
    return action
