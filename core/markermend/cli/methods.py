"""``markermend methods``: every method there is, with its parameters."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import Any

from markermend.cli.console import STDOUT, check_outputs, say, table, write_json
from markermend.detectors import DETECTORS, Detector
from markermend.errors import MethodError
from markermend.plugins import faults
from markermend.plugins.formats import formats
from markermend.repairs import REPAIRS, Method
from markermend.smoothers import SMOOTHERS, Smoother

Entry = Detector | Method | Smoother


def run(options: argparse.Namespace) -> int:
    """List methods on the terminal, or as JSON."""
    check_outputs([options.json], source=None, force=options.force)
    rooms: dict[str, Mapping[str, Entry]] = {
        "detection": DETECTORS,
        "repair": REPAIRS,
        "smoothing": SMOOTHERS,
    }
    chosen = {room: _named(methods, options.name) for room, methods in rooms.items()}
    if options.name is not None and not any(chosen.values()):
        raise MethodError(f"There is no method “{options.name}”; “markermend methods” lists all.")
    if options.json is not None:
        write_json(options.json, {room: [describe(m) for m in ms] for room, ms in chosen.items()})
    if options.json != STDOUT:
        for room, methods in chosen.items():
            for line in _lines(room, methods, in_full=bool(options.name)):
                say(line)
        if not options.name:
            for line in _strangers():
                say(line)
    return 0


def describe(method: Entry) -> dict[str, Any]:
    """Turn a method into plain values for JSON.

    Returns
    -------
    dict: ``name``, ``label``, ``summary``, ``source``, ``plugin`` (the package that brings it,
    empty for ours) and ``parameters`` with ``name``, ``default``, ``unit``, ``help``
    """
    return {
        "name": method.name,
        "label": method.label,
        "summary": method.summary,
        "source": method.source,
        "plugin": method.plugin,
        "parameters": [
            {
                "name": f.name,
                "default": None if f.default is MISSING else f.default,
                "unit": f.metadata.get("unit", ""),
                "help": f.metadata.get("help", ""),
            }
            for f in fields(method.params)
        ],
    }


def _named(methods: Mapping[str, Entry], name: str | None) -> list[Entry]:
    """All methods, or that of one name."""
    return [m for m in methods.values() if name in (None, m.name)]


def _lines(room: str, methods: list[Entry], *, in_full: bool) -> list[str]:
    """One room on the terminal; in full each method's parameters too."""
    if not methods:
        return []
    if not in_full:
        brief = [(m.name, m.summary + (f" ({m.plugin})" if m.plugin else "")) for m in methods]
        return [*table([room.capitalize(), ""], brief), ""]
    lines = []
    for method in methods:
        told = describe(method)
        lines += [f"{method.name} – {method.label} ({room})", f"  {method.summary}"]
        if method.source:
            lines.append(f"  Source: {method.source}.")
        rows: list[tuple[str, ...]] = [
            (f"  {p['name']}", f"{p['default']} {p['unit']}".rstrip(), str(p["help"]))
            for p in told["parameters"]
        ]
        lines += table(["  parameter", "default", ""], rows) if rows else []
    return lines


def _strangers() -> list[str]:
    """What plugins bring besides methods, and which could not be used."""
    lines = [f"Files ending in {end}: {f.label} ({f.plugin})" for end, f in formats().items()]
    lines += [f"Left out: {f.plugin} of {f.package}, {f.why}." for f in faults()]
    return lines
