"""One take's section of a report, and whole reports."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from statistics import median

import markermend as mm
from markermend.artifact import Kind
from markermend.outcome import Outcome, cleaned_document
from markermend.report import page
from markermend.report.index import error, index_section, percent, tiles
from markermend.report.quality import Quality, quality
from markermend.report.svg import curves, damage_map, worst
from markermend.review.pace import Pace
from markermend.take import Take

# Longer lists are cut on the page, worst first; the JSON has them whole.
_MOST_ROWS = 200
# How steps of a review name their searches; other names are those of detectors.
_SEARCHES = {"sudden": "gaps, peaks, noise and steps", "all kinds": "artifacts of all classes"}
_KEY = (
    '<p class="key">'
    + "".join(f'<span><i class="{kind.value}"></i>{kind.value}</span>' for kind in Kind)
    + '<span><i class="mended"></i>repaired</span><span><i class="left"></i>left</span></p>'
)
_CURVES_KEY = (
    '<p class="key"><span><i class="was"></i>before</span><span><i class="now"></i>after, '
    "with the expected deviation where it is known</span></p>"
)


def take_report(
    before: Take,
    after: Take,
    done: Sequence[Outcome],
    *,
    method: str,
    name: str,
    pace: Pace | None = None,
    by_hand: Sequence[str] = (),
    region: tuple[int, int] | None = None,
) -> str:
    """Report on one cleaned or reviewed take.

    Parameters
    ----------
    before, after : the same recording as read and as repaired
    done : what became of every artifact
    method : what found the artifacts
    name : the take's file name
    pace : of the operator who reviewed it, or None
    by_hand : what was done to samples and names by hand, one line each
    region : the frames that were reviewed, a half-open interval; None for all of the take

    Returns
    -------
    An HTML page that needs no other file and no network; the same input gives the same text
    """
    section = _section(before, after, done, method, name, pace, by_hand, region)
    return page.head(name) + section + page.tail()


def batch_parts(
    takes: Sequence[Quality], failures: Mapping[str, str], pages: Iterable[str]
) -> Iterator[str]:
    """Report on many takes: an index, then each take's section, in parts to be written in turn.

    Parameters
    ----------
    takes : one each
    failures : what could not be cleaned, name to reason
    pages : the :func:`take_report` of each take, in the same order; read one by one

    Yields
    ------
    Text
    """
    links = {q.name: f"#take-{number}" for number, q in enumerate(takes)}
    yield page.head("Cleaned takes") + index_section(takes, failures, links)
    for number, text in enumerate(pages):
        yield f'\n<div id="take-{number}">{page.inner(text)}</div>'
    yield page.tail()


def _searched(method: str) -> str:
    """What was looked for, as far as a review tells, else with which detector."""
    searches = [_SEARCHES.get(name) for name in method.split(", ")]
    if None in searches:
        return f"Detected by “{method}”"
    return f"Searched for {' and for '.join(filter(None, searches))}"


def _section(
    before: Take,
    after: Take,
    done: Sequence[Outcome],
    method: str,
    name: str,
    pace: Pace | None,
    by_hand: Sequence[str],
    region: tuple[int, int] | None,
) -> str:
    """Everything about one take."""
    q = quality(name, before, after, done, region)
    found, mended = len(done), sum(o.method is not None for o in done)
    names = "joints" if before.skeleton else "markers"
    facts = (
        f"{before.frames:,} frames at {before.rate:g} Hz ({before.duration_s:.1f} s), "
        f"{q.markers} {names}. {_searched(method)}, Markermend {mm.__version__}."
    )
    narrowed = []
    if region is not None:
        first, last = before.frame_numbers(*region)
        narrowed = [f"This is about frames {first}–{last} only; what lies outside is not counted."]
    shapes = [curves(before, after, o) for o in worst(done)]
    values = cleaned_document(before, done, method, mm.__version__, name=name, region=region)
    parts = [
        f'<section class="take"><h2>{escape(name)}</h2><p class="dim">{escape(facts)}</p>',
        tiles(
            [
                ("Missing before", percent(q.gap_before)),
                ("Missing after", percent(q.gap_after)),
                ("Artifacts found", f"{found:,}"),
                ("Repaired", f"{mended:,}"),
                ("For review", f"{q.review:,}"),
                ("Worst expected error", error(q.worst_mm)),
                *_paced(pace),
            ]
        ),
        *(f'<p class="dim">{escape(said)}</p>' for said in (*narrowed, *before.warnings)),
    ]
    if done:
        parts += [_classes(done), "<h3>Damage over time</h3>", _KEY, damage_map(before, done)]
    else:
        parts.append("<p>Nothing is damaged as far as can be seen.</p>")
    if any(shapes):
        parts += ["<h3>Worst repairs, before and after</h3>", _CURVES_KEY]
        parts.append(f'<div class="figures">{"".join(shapes)}</div>')
    parts += [*_repaired(before, done), *_by_hand(by_hand), *_left(before, done)]
    if pace is not None:
        values |= {"pace": pace.to_dict(), "by_hand": list(by_hand)}
    parts += [page.data("take", values | {"quality": q.to_dict()}), "</section>"]
    return "\n".join(parts)


def _classes(done: Sequence[Outcome]) -> str:
    """Per class: found, repaired, how, and the expected error."""
    rows = []
    for kind in Kind:
        of_kind = [o for o in done if o.artifact.kind is kind]
        if not of_kind:
            continue
        methods = Counter(o.method_label for o in of_kind if o.method)
        errors = [o.error_mm for o in of_kind if o.error_mm]
        unknown = _UNMEASURED if any(o.unmeasured for o in of_kind) else error(None)
        each = (f"<span>{escape(method)}</span> {n}" for method, n in methods.most_common())
        rows.append(
            [
                kind.value,
                str(len(of_kind)),
                str(methods.total()),
                ", ".join(each) or "–",
                error(median(errors)) if errors else unknown,
                error(max(errors)) if errors else unknown,
            ]
        )
    columns = [("Class", ""), ("Found", "n"), ("Repaired", "n"), ("With", "")]
    return page.table([*columns, ("Median expected error", "n"), ("Worst", "n")], rows)


def _repaired(take: Take, done: Sequence[Outcome]) -> list[str]:
    """What was repaired, how, and with what expected error."""
    mended = worst(done, len(done))
    if not mended:
        return []
    columns = [*_places(take), ("Method", ""), ("Expected error", "n"), ("Note", "")]
    rows = [
        [*_where(take, o), escape(o.method_label), *_error_and_note(o)] for o in mended[:_MOST_ROWS]
    ]
    return [
        "<h3>What was repaired</h3>",
        page.table(columns, rows, "sortable"),
        *_cut(len(mended)),
    ]


def _left(take: Take, done: Sequence[Outcome]) -> list[str]:
    """What was left, and why."""
    left = [o for o in done if o.method is None]
    if not left:
        return []
    columns = [*_places(take), ("Sure", "n"), ("Evidence", ""), ("Left because", "why")]
    rows = [
        [
            *_where(take, o),
            page.number(o.artifact.confidence, f"{o.artifact.confidence:.0%}"),
            escape(o.artifact.why),
            _said(o, o.reason),
        ]
        for o in sorted(left, key=lambda o: -o.artifact.confidence)[:_MOST_ROWS]
    ]
    return ["<h3>What was left</h3>", page.table(columns, rows, "sortable"), *_cut(len(left))]


_UNMEASURED = "not measured"


def _places(take: Take) -> tuple[tuple[str, str], ...]:
    """Columns that say where an artifact is and what it is."""
    who = "Joint" if take.skeleton else "Marker"
    return ("Frames", "n"), ("Seconds", "n"), (who, ""), ("Axes", ""), ("Class", "")


def _where(take: Take, o: Outcome) -> list[str]:
    """Their cells."""
    a = o.artifact
    first, last = take.frame_number(a.start), take.frame_number(a.stop - 1)
    frames = f"{first}" if first == last else f"{first}–{last}"
    return [
        page.number(first, frames),
        page.number(a.start / take.rate, f"{a.start / take.rate:.2f}–{a.stop / take.rate:.2f}"),
        escape(o.who),
        a.axes,
        a.kind.value,
    ]


def _error_and_note(o: Outcome) -> list[str]:
    """Cells for a repair's expected error and what else is to be known about it."""
    told = _UNMEASURED if o.unmeasured else error(o.error_mm)
    return [page.number(o.error_mm, told), _said(o, o.note)]


def _paced(pace: Pace | None) -> list[tuple[str, str]]:
    """How the operator's review went, at a glance."""
    if pace is None:
        return []
    cards = [("Decided", f"{pace.decided:,} of {pace.total:,}")]
    if pace.seconds_each is not None and pace.spent_s:
        cards.append(("An artifact", f"{pace.seconds_each:.1f} s"))
        cards.append(("Time spent on it", f"{pace.minutes:.1f} min"))
    return cards


def _by_hand(steps: Sequence[str]) -> list[str]:
    """What was done by hand, step by step."""
    if not steps:
        return []
    lines = "".join(f"<li>{escape(step)}</li>" for step in steps[:_MOST_ROWS])
    return ["<h3>By hand</h3>", f"<ol>{lines}</ol>", *_cut(len(steps))]


def _said(o: Outcome, text: str) -> str:
    """A text about an artifact, after what the operator wrote about it."""
    return escape(" – ".join(filter(None, (o.artifact.note and f"✎ {o.artifact.note}", text))))


def _cut(number: int) -> list[str]:
    """Say that a list goes on, where it does."""
    if number <= _MOST_ROWS:
        return []
    return [f'<p class="dim">…and {number - _MOST_ROWS:,} more; the JSON names them all.</p>']
