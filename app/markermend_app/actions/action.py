"""What an action is, and when it can be used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from markermend_app.document import Document
from markermend_app.offered import can_repair, is_offered


def anything(document: Document) -> bool:
    """Always."""
    return True


def opened(document: Document) -> bool:
    """A take is open."""
    return document.session is not None


def editable(document: Document) -> bool:
    """Decisions can be made."""
    return document.editable


def of_markers(document: Document) -> bool:
    """Decisions can be made, and it is no skeleton recording."""
    return document.editable and not document.joints


def with_markers(document: Document) -> bool:
    """A take is open, and it is no skeleton recording."""
    return document.session is not None and not document.joints


def current(document: Document) -> bool:
    """An artifact is under review, to be decided."""
    return document.editable and document.current is not None


def artifacts(document: Document) -> bool:
    """There are artifacts."""
    return document.session is not None and bool(document.session.artifacts)


def undoable(document: Document) -> bool:
    """A step can be taken back: none that came with opening the take."""
    return document.editable and document.session is not None and document.session.undoable


def redoable(document: Document) -> bool:
    """An undone step can be brought back."""
    return document.editable and document.session is not None and bool(document.session.undone)


def swept(document: Document) -> bool:
    """A range is swept."""
    return document.editable and document.selection is not None


def repairable(document: Document) -> bool:
    """What is under review, or the swept range that covers it, can be repaired."""
    return can_repair(document) or swept(document)


def narrowed(document: Document) -> bool:
    """A region of interest is chosen."""
    session = document.session
    return document.editable and session is not None and session.region is not None


def marker(document: Document) -> bool:
    """A marker is shown, to be worked on."""
    return document.editable and bool(document.shown)


@dataclass(frozen=True)
class MethodOffered:
    """A rule: the repair method with this key can be chosen for the artifact under review."""

    key: int

    def __call__(self, document: Document) -> bool:
        """Whether its button can be pressed, too."""
        if document.current is None:
            return False
        # Repairs load late, once an artifact is looked at.
        from markermend.repairs import REPAIRS

        names = (method.name for method in REPAIRS.values() if method.key == self.key)
        return any(is_offered(document, name) for name in names)


@dataclass(frozen=True)
class Action:
    """One action.

    Attributes
    ----------
    name : also the name of the verb that does it, in one of the classes of ``verbs/``
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
    enabled: Callable[[Document], bool] = opened
    checkable: bool = False
    toolbar: str = ""
