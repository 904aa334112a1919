"""A room's list of methods: ours, and what plugins bring, by name."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Protocol, TypeVar

from markermend.errors import MethodError
from markermend.plugins.discover import loaded


class Named(Protocol):
    """What every entry has."""

    @property
    def name(self) -> str:
        """Short name for command line and files."""

    @property
    def plugin(self) -> str:
        """The package that brings it, empty for ours."""


T = TypeVar("T", bound=Named)
_loading = threading.RLock()
"""One for all rooms: a plugin of one may ask for another when it is imported."""


class Registry(Mapping[str, T]):
    """Methods by name; plugins are loaded when it is first looked at.

    Not earlier, since plugins import the rooms whose methods they are.

    Parameters
    ----------
    what : one of them in words, for messages
    kind : their type, a frozen dataclass
    group : of the entry points of plugins
    guard : makes what runs instead of a plugin's own ``run``
    order : what ours are sorted by; as added without it. Plugins come last
    """

    def __init__(
        self,
        what: str,
        kind: type[T],
        group: str,
        guard: Callable[[T], Callable[..., Any]],
        order: Callable[[T], Any] | None = None,
    ) -> None:
        self._what, self._kind, self._group, self._guard = what, kind, group, guard
        self._order = order
        self._entries: dict[str, T] = {}
        self._begun = self._complete = False

    def add(self, entry: T) -> None:
        """Add one of ours."""
        self._entries[entry.name] = entry
        if self._order is not None:
            ordered = sorted(self._entries.values(), key=self._order)
            self._entries = {e.name: e for e in ordered}

    def find(self, name: str) -> T:
        """Look one up.

        Raises
        ------
        MethodError
            when there is none of that name; the message lists those there are
        """
        try:
            return self[name]
        except KeyError:
            known = ", ".join(self)
            raise MethodError(
                f"There is no {self._what} “{name}”; choose one of {known}."
            ) from None

    def _all(self) -> dict[str, T]:
        if not self._complete:
            # Another thread waits until all are there; a plugin that asks meanwhile gets ours.
            with _loading:
                if not self._begun:
                    self._begun = True
                    found = loaded(self._group, self._kind, tuple(self._entries), self._guard)
                    self._entries.update({e.name: e for e in found})
                    self._complete = True
        return self._entries

    def __getitem__(self, name: str) -> T:
        return self._entries[name] if name in self._entries else self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())
