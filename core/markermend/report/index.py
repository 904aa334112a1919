"""The index over the takes of a batch, sortable, with quality at a glance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from markermend.artifact import Kind
from markermend.report.page import data, number, table
from markermend.report.quality import Quality

_COLUMNS = (
    ("Take", ""),
    ("Length", "n"),
    ("Markers", "n"),
    ("Missing before", "n"),
    ("after", "n"),
    *((kind.value.capitalize(), "n") for kind in Kind),
    ("Repaired", "n"),
    ("For review", "n"),
    ("Worst expected error", "n"),
)


def index_section(
    takes: Sequence[Quality], failures: Mapping[str, str], links: Mapping[str, str] | None = None
) -> str:
    """Make the index over takes.

    Parameters
    ----------
    takes : one each, in the order shown first
    failures : what could not be cleaned, name to reason
    links : where a take's own section or file is, by name

    Returns
    -------
    HTML: a sentence, the failures, a sortable table, and the same as JSON
    """
    found = sum(sum(q.found.values()) for q in takes)
    mended = sum(sum(q.repaired.values()) for q in takes)
    review = sum(q.review for q in takes)
    cards = [
        ("Takes cleaned", f"{len(takes):,}"),
        ("Failed", f"{len(failures):,}"),
        ("Artifacts found", f"{found:,}"),
        ("Repaired", f"{mended:,}"),
        ("For review", f"{review:,}"),
    ]
    values: dict[str, Any] = {
        "takes": [q.to_dict() for q in takes],
        "failed": [{"name": name, "why": why} for name, why in failures.items()],
    }
    return "\n".join(
        [
            "<section><h1>Cleaned takes</h1>",
            tiles(cards),
            *(
                f'<p class="failed"><b>{escape(name)}</b>: {escape(why)}</p>'
                for name, why in failures.items()
            ),
            table(_COLUMNS, [_row(q, links or {}) for q in takes], "sortable"),
            data("index", values),
            "</section>",
        ]
    )


def tiles(cards: Sequence[tuple[str, str]]) -> str:
    """Figures at a glance: name and value of each."""
    inside = "".join(
        f'<div class="tile"><b>{value}</b><span class="dim">{name}</span></div>'
        for name, value in cards
    )
    return f'<div class="tiles">{inside}</div>'


def percent(share: float) -> str:
    """A share as people read it; what is not quite nothing never looks like nothing."""
    return "&lt; 0.01 %" if 0.0 < share < 0.0001 else f"{100 * share:.2f} %"


def error(mm: float | None) -> str:
    """An expected error as people read it; a swap, which invents nothing, has none."""
    return f"{mm:.2f} mm" if mm else "–"


def _row(q: Quality, links: Mapping[str, str]) -> list[str]:
    """Cells of one take."""
    name = escape(q.name)
    if q.name in links:
        name = f'<a href="{escape(links[q.name])}">{name}</a>'
    mended = sum(q.repaired.values())
    return [
        name,
        number(q.frames / q.rate, f"{q.frames / q.rate:.1f} s"),
        number(q.markers, str(q.markers)),
        number(q.gap_before, percent(q.gap_before)),
        number(q.gap_after, percent(q.gap_after)),
        *(number(q.found[kind.value], str(q.found[kind.value])) for kind in Kind),
        number(mended, str(mended)),
        number(q.review, str(q.review)),
        number(q.worst_mm, error(q.worst_mm)),
    ]
