"""Every action of the app, declared once.

Menus, toolbar, context menus, command palette and shortcut sheet are made from this table by
:mod:`markermend_app.menus`, :mod:`markermend_app.palette` and :mod:`markermend_app.shortcut_sheet`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from markermend_app.document import Document


def _anything(document: Document) -> bool:
    return True


def _opened(document: Document) -> bool:
    return document.session is not None


def _editable(document: Document) -> bool:
    return document.editable


def _current(document: Document) -> bool:
    return document.editable and document.current is not None


def _artifacts(document: Document) -> bool:
    return document.session is not None and bool(document.session.artifacts)


def _undoable(document: Document) -> bool:
    return document.editable and document.session is not None and bool(document.session.history)


def _redoable(document: Document) -> bool:
    return document.editable and document.session is not None and bool(document.session.undone)


def _swept(document: Document) -> bool:
    return document.editable and document.selection is not None


@dataclass(frozen=True)
class Action:
    """One action.

    Attributes
    ----------
    name : also the name of the verb of :class:`markermend_app.commands.Commands` that does it
    text : as menus show it
    menu : the menu it stands in, ``Menu/Submenu`` for one below; a leading ``|`` puts a separator
        before it
    keys : shortcuts unless the operator chose others, the first one is shown
    icon : name in ``resources/markermend_resources/icons``; empty for none
    tip : one sentence for the tooltip; the text when empty
    enabled : whether it can be used, given the document
    checkable : it switches something on and off
    toolbar : not empty when it also stands in the toolbar; ``|`` after a separator
    """

    name: str
    text: str
    menu: str
    keys: tuple[str, ...] = ()
    icon: str = ""
    tip: str = ""
    enabled: Callable[[Document], bool] = _opened
    checkable: bool = False
    toolbar: str = ""


METHOD_KEYS = range(1, 10)

ACTIONS: tuple[Action, ...] = (
    Action("open", "Open take…", "File", ("Ctrl+O",), "open", "Open a take", _anything, False, "+"),
    Action("open_demo", "Open the demo take", "File", (), "", "", _anything),
    Action(
        "export",
        "Export repaired take…",
        "|File",
        ("Ctrl+S",),
        "export",
        "Write a copy in which only repaired samples differ",
        _opened,
        False,
        "+",
    ),
    Action("close_take", "Close take", "|File", ("Ctrl+W",)),
    Action("quit", "Quit", "|File", ("Ctrl+Q",), "", "", _anything),
    Action("undo", "Undo", "Edit", ("Ctrl+Z",), "undo", "", _undoable, False, "|"),
    Action("redo", "Redo", "Edit", ("Ctrl+Shift+Z", "Ctrl+Y"), "redo", "", _redoable, False, "+"),
    Action(
        "clear_selection",
        "Clear selection",
        "|Edit",
        ("Esc",),
        "",
        "Forget the swept range",
        _swept,
    ),
    Action(
        "palette",
        "Find a command, marker or artifact…",
        "|Edit",
        ("Ctrl+K",),
        "search",
        "Type a few letters to do anything or go anywhere",
        _anything,
    ),
    Action(
        "detect",
        "Detect artifacts",
        "Review",
        ("D",),
        "detect",
        "Look for gaps, peaks, heavy noise and steps in the whole take",
        _editable,
        False,
        "|",
    ),
    Action(
        "detect_slow",
        "Detect slow drifts too",
        "Review",
        ("Shift+D",),
        "slow",
        "Look for every class; slow drifts take some seconds longer than all the others",
        _editable,
    ),
    Action(
        "detect_on_open",
        "Detect after opening",
        "Review",
        tip="Look for gaps, peaks, noise and steps as soon as a take is open",
        enabled=_anything,
        checkable=True,
    ),
    Action(
        "accept",
        "Accept",
        "|Review",
        ("A",),
        "accept",
        "The flag is right; the samples stay for now",
        _current,
        False,
        "|",
    ),
    Action("reject", "Reject", "Review", ("R",), "reject", "A false alarm", _current, False, "+"),
    Action(
        "repair",
        "Repair",
        "Review",
        ("F",),
        "repair",
        "Replace the samples by the repair shown",
        _current,
        False,
        "+",
    ),
    *(
        Action(
            f"method_{key}",
            f"Repair method {key}",
            "Review/Repair method",
            (str(key),),
            "",
            "Preview this repair method for the artifact under review",
            _current,
        )
        for key in METHOD_KEYS
    ),
    Action("reopen", "Reopen", "Review", ("U",), "undo", "Take the decision back", _current),
    Action("remove", "Remove from the list", "Review", ("Delete",), "delete", "", _current),
    Action(
        "repair_accepted",
        "Repair all accepted",
        "|Review",
        ("Ctrl+R",),
        "repair-all",
        "Repair every accepted artifact with its best method, as one step",
        _editable,
        False,
        "+",
    ),
    Action(
        "repair_alike",
        "Repair all like this…",
        "Review",
        ("Ctrl+Shift+R",),
        "repair-all",
        "List the open artifacts of its class, and repair them in one step",
        _current,
    ),
    Action(
        "reject_alike",
        "Reject all like this…",
        "Review",
        ("Shift+R",),
        "reject",
        "List the open artifacts of its class, and reject them in one step",
        _current,
    ),
    Action(
        "lower_doubted",
        "Lower what was rejected several times",
        "Review",
        ("Y",),
        "",
        "Answer yes when asked whether the rest of a sort is to come last",
        _editable,
    ),
    Action(
        "previous",
        "Previous artifact",
        "|Review",
        ("P", "Ctrl+Left"),
        "previous",
        "",
        _artifacts,
        False,
        "|",
    ),
    Action(
        "next", "Next artifact", "Review", ("N", "Ctrl+Right"), "next", "", _artifacts, False, "+"
    ),
    Action("note", "Write a note", "|Review", ("T",), "", "Say something about it", _current),
    Action(
        "mark_selection",
        "Mark selection",
        "|Review",
        ("M",),
        "mark",
        "Make an artifact of the swept range",
        _swept,
    ),
    Action(
        "repair_selection",
        "Repair selection",
        "Review",
        ("Shift+F",),
        "repair",
        "Replace the swept range of the marker by the best repair",
        _swept,
    ),
    Action("play", "Play or pause", "Time", ("Space",), "play"),
    Action("frame_forward", "One frame forward", "|Time", ("Right",), "step-forward"),
    Action("frame_back", "One frame back", "Time", ("Left",), "step-back"),
    Action("frames_forward", "Ten frames forward", "Time", ("Shift+Right",)),
    Action("frames_back", "Ten frames back", "Time", ("Shift+Left",)),
    Action("to_start", "To the first frame", "|Time", ("Home",), "first"),
    Action("to_end", "To the last frame", "Time", ("End",), "last"),
    Action("fit", "Show the whole take", "View", ("Ctrl+0",), "frame"),
    Action("zoom_in", "Zoom in", "View", ("Ctrl++", "Ctrl+="), "zoom-in"),
    Action("zoom_out", "Zoom out", "View", ("Ctrl+-",), "zoom-out"),
    Action(
        "before_after",
        "Show the samples before repair",
        "|View",
        ("B",),
        "eye",
        "Swap the curves before and after repair",
        _opened,
        True,
        "|",
    ),
    Action(
        "prediction",
        "Show the body's prediction",
        "View",
        ("L",),
        "body",
        "Where the rest of the body says the marker should be",
        _opened,
        True,
        "+",
    ),
    Action(
        "overview_mode",
        "Change the overview",
        "View",
        ("H",),
        "overview",
        "Overview of damage, of gaps, or of distances to the body's prediction",
    ),
    Action("plots", "Choose plots…", "View", ("Shift+P",), "curves", "Choose what the plots show"),
    Action("theme_light", "Light theme", "|View", enabled=_anything, checkable=True),
    Action("theme_dark", "Dark theme", "View", enabled=_anything, checkable=True),
    Action("theme_system", "Theme of the system", "View", enabled=_anything, checkable=True),
    Action("reset_layout", "Reset the layout", "|View", enabled=_anything),
    Action("shortcuts", "Keyboard and mouse…", "Help", ("?", "F1"), "keyboard", "", _anything),
    Action("about", "About Markermend", "Help", (), "", "", _anything),
)
