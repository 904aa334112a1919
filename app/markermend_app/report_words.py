"""Forms in which the engine writes reports, and a report in the language of the app.

A report is a page of the engine's, in English. What stands on it between tags is told anew; its
style, its script and the values for programs stay.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from functools import cache
from html import escape, unescape

from markermend_app.telling import compiled, told_in_mm
from markermend_app.words import tr

FORMS = (
    # What the take is.
    "{0} frames at {1} Hz ({2} s), {3} markers. {4}, Markermend {5}.",
    "{0} frames at {1} Hz ({2} s), {3} joints. {4}, Markermend {5}.",
    "This is about frames {0}–{1} only; what lies outside is not counted.",
    "Detected by “{0}”",
    "Searched for {0}",
    "{0} and for {1}",
    "gaps, peaks, noise and steps",
    "artifacts of all classes",
    # Figures at a glance.
    *("Missing before", "Missing after", "Artifacts found", "Repaired", "For review"),
    *("Worst expected error", "Decided", "An artifact", "Time spent on it", "{0} of {1}"),
    # Headings, and what the colours mean.
    *("Damage over time", "Worst repairs, before and after", "What was repaired"),
    *("What was left", "By hand", "repaired", "left", "before"),
    "after, with the expected deviation where it is known",
    "Nothing is damaged as far as can be seen.",
    # Columns.
    *("Class", "Found", "With", "Median expected error", "Worst", "Frames", "Seconds", "Marker"),
    "Joint",
    *("Axes", "Method", "Expected error", "Note", "Sure", "Evidence", "Left because"),
    # What became of an artifact.
    "not measured",
    "by hand",
    "frame {0}",
    "{0}, expected error {1} mm",
    "{0}, expected error not measured",
    "Not decided yet.",
    "Accepted: the flag is right, the samples are left.",
    "Rejected as a false alarm.",
    "…and {0} more; the JSON names them all.",
)
"""Everything on a report that the engine says nowhere else."""

_TEXT = re.compile(r"(<(script|style)\b.*?</\2>|<[^>]*>)|([^<]+)", re.DOTALL)
_CAPTION = re.compile(r"(.+) (\w+), (\w+), (frames? .+?): (.+?)(?: – (\w) in mm)?")
_NOTE = re.compile(r"(✎ .*?)(?: – (.+))?", re.DOTALL)


def told_report(page: str, names: Collection[str], language: str) -> str:
    """Tell a report in the language of the app.

    Parameters
    ----------
    page : as :func:`markermend.report.review_report` makes it
    names : of the take and its markers, which stay as they are
    language : code of the language, put down in the page
    """
    said = {escape(name): escape(name) for name in names}

    def tell(found: re.Match[str]) -> str:
        text = found[3]
        if text is None or not text.strip():
            return found[0]
        if text not in said:
            said[text] = escape(_said(unescape(text)))
        return said[text]

    page = _TEXT.sub(tell, page)
    page = re.sub(r'(aria-label=")([^"]*)', lambda m: m[1] + escape(_said(unescape(m[2]))), page)
    return page.replace('<html lang="en">', f'<html lang="{language}">', 1)


def _said(text: str) -> str:
    """What stands between two tags; what the operator wrote stays as it is."""
    note = _NOTE.fullmatch(text)
    if note is not None:
        return " – ".join((note[1], _said(note[2]))) if note[2] else note[1]
    caption = _CAPTION.fullmatch(text)
    if caption is not None:
        marker, axes, kind, frames, done, axis = caption.groups()
        line = f"{marker} {axes}, {told_in_mm(kind)}, {_said(frames)}: {_said(done)}"
        return line if axis is None else line + tr(" – {0} in mm").format(axis)
    if text in _labels():
        return tr(text)
    for form in FORMS:
        found = compiled(form).fullmatch(text)
        if found is not None:
            return tr(form).format(*map(_said, found.groups()))
    return told_in_mm(text)


@cache
def _labels() -> frozenset[str]:
    """What methods of repair are called."""
    from markermend.repairs import REPAIRS

    return frozenset(method.label for method in REPAIRS.values())
