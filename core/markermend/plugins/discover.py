"""Find what installed packages bring, and say what could not be used."""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass, replace
from importlib.metadata import EntryPoint, entry_points
from typing import Any, TypeVar

DETECTORS, REPAIRS = "markermend.detectors", "markermend.repairs"
SMOOTHERS, FORMATS = "markermend.smoothers", "markermend.formats"


@dataclass(frozen=True)
class Fault:
    """A plugin that could not be used.

    Attributes
    ----------
    plugin : name of its entry point
    package : the distribution that brings it
    why : one sentence
    """

    plugin: str
    package: str
    why: str


_faults: dict[tuple[str, str], Fault] = {}
T = TypeVar("T")


def faults() -> tuple[Fault, ...]:
    """Plugins that could not be used, of the rooms that were entered so far."""
    return tuple(_faults.values())


def loaded(
    group: str, kind: type[T], taken: Container[str], guard: Callable[[T], Callable[..., Any]]
) -> list[T]:
    """Load the plugins of one group.

    Parameters
    ----------
    group : of the entry points
    kind : what they have to be: a frozen dataclass with ``name``, ``run`` and ``plugin``
    taken : names that are ours already
    guard : makes what runs instead of a plugin's own ``run``, in another process

    Returns
    -------
    one per plugin that can be used, by name; what is wrong with the others :func:`faults` tells
    """
    found: dict[str, Any] = {}
    for point in sorted(entry_points(group=group), key=lambda p: p.name):
        package = point.dist.name if point.dist else "?"
        plugin: Any
        fault, plugin = _load(point, kind)
        if plugin is not None and (plugin.name in taken or plugin.name in found):
            fault = f"there is a method “{plugin.name}” already"
        if fault:
            _faults[group, point.name] = Fault(point.name, package, fault)
        else:
            found[plugin.name] = replace(plugin, run=guard(plugin), plugin=package)
    return list(found.values())


def _load(point: EntryPoint, kind: type[Any]) -> tuple[str, Any]:
    """Import one plugin; returns what is wrong, or empty, and the plugin."""
    try:
        plugin = point.load()
    except Exception as error:  # whatever a stranger's module does when it is imported
        return f"it cannot be loaded ({type(error).__name__}: {error})", None
    if not isinstance(plugin, kind):
        return f"it is a {type(plugin).__name__}, not a {kind.__name__}", None
    if plugin.name != point.name:  # the worker finds it by this name
        return f"its entry point should be called “{plugin.name}”", None
    return "", plugin
