"""The page around a report: style, script, and text made safe for HTML."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

from markermend.artifact import Kind
from markermend.class_colours import ON_DARK, ON_LIGHT


def _variables(colours: Mapping[Kind, str]) -> str:
    """Colours of the classes as variables of the style."""
    return "".join(f"--{kind.value}:{colour};" for kind, colour in colours.items())


_STYLE = (
    (
        f":root{{{_variables(ON_LIGHT)}}}"
        f"@media (prefers-color-scheme:dark){{:root{{{_variables(ON_DARK)}}}}}"
        f"@media print{{:root{{{_variables(ON_LIGHT)}}}}}"
    )
    + """
:root{color-scheme:light dark;--bg:#fff;--fg:#1c2430;--dim:#5d6b7c;--line:#d8dee6;--soft:#f3f5f8;
--was:#d55e00;--now:#0072b2}
@media (prefers-color-scheme:dark){:root{--bg:#14181e;--fg:#e4e9ef;--dim:#97a4b4;--line:#323b46;
--soft:#1d232b;--now:#56b4e9;--was:#f0843c}}
*{box-sizing:border-box}
body{margin:0 auto;padding:24px;max-width:1100px;background:var(--bg);color:var(--fg);
font:14px/1.45 system-ui,"Segoe UI",Roboto,sans-serif}
h1{font-size:24px;margin:0 0 4px}h2{font-size:20px;margin:0 0 4px}
h3{font-size:15px;margin:24px 0 8px}
p{margin:4px 0}.dim{color:var(--dim)}a{color:var(--now)}
section.take{border-top:1px solid var(--line);margin-top:32px;padding-top:24px}
main>section.take:first-child{border:0;margin:0;padding:0}
.tiles{display:flex;flex-wrap:wrap;gap:12px;margin:16px 0}
.tile{background:var(--soft);border-radius:8px;padding:10px 16px;min-width:130px}
.tile b{display:block;font-size:20px;font-variant-numeric:tabular-nums}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th,td{padding:4px 8px;text-align:left;border-bottom:1px solid var(--line);vertical-align:top}
th{font-weight:600;color:var(--dim)}.n{text-align:right;white-space:nowrap}.why{min-width:130px}
th button{all:unset;cursor:pointer}th button:focus-visible{outline:2px solid var(--now)}
th[aria-sort=ascending] button::after{content:" ↑"}
th[aria-sort=descending] button::after{content:" ↓"}
.key{display:flex;flex-wrap:wrap;gap:16px;margin:8px 0;color:var(--dim)}
.key i{display:inline-block;width:14px;height:10px;margin-right:6px;border-radius:2px}
svg{display:block;width:100%;height:auto}svg text{fill:var(--dim);font-size:9px}
.map .odd{fill:var(--soft)}.map .even{fill:none}.tick{stroke:var(--line);stroke-width:.6}
.gap{fill:var(--gap);stroke:var(--gap);background:var(--gap)}
.peak{fill:var(--peak);stroke:var(--peak);background:var(--peak)}
.noise{fill:var(--noise);stroke:var(--noise);background:var(--noise)}
.step{fill:var(--step);stroke:var(--step);background:var(--step)}
.slow{fill:var(--slow);stroke:var(--slow);background:var(--slow)}
.mended{stroke:none}.left{fill-opacity:.25;stroke-width:1}
.key .left{background:none;border:1px solid var(--dim)}.key .mended{background:var(--dim)}
.key .was{height:3px;background:var(--was)}.key .now{height:3px;background:var(--now)}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(420px,1fr));gap:16px}
figure{margin:0;break-inside:avoid}figcaption{color:var(--dim);font-size:12px}
path{fill:none;stroke-width:1.4;stroke-linecap:round;stroke-linejoin:round}
path.was{stroke:var(--was);stroke-dasharray:4 3}path.now{stroke:var(--now)}
.where{fill:var(--dim);opacity:.13}.band{fill:var(--now);opacity:.22}
.failed{border-left:4px solid var(--peak);padding:4px 12px;background:var(--soft)}
@media print{:root{color-scheme:light;--bg:#fff;--fg:#000;--dim:#444;--line:#bbb;--soft:#f3f5f8;
--was:#d55e00;--now:#0072b2}
body{max-width:none;padding:0;font-size:10pt;-webkit-print-color-adjust:exact;
print-color-adjust:exact}
section.take{break-before:page;border:0}main>section.take:first-child{break-before:auto}
h2,h3,p.key{break-after:avoid}thead{display:table-header-group}tr,svg.map{break-inside:avoid}
.figures{grid-template-columns:1fr 1fr}a{color:inherit;text-decoration:none}}
"""
)

_SCRIPT = """
for (const head of document.querySelectorAll('table.sortable th')) {
  const button = document.createElement('button');
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener('click', () => {
    const up = head.getAttribute('aria-sort') !== 'ascending';
    for (const other of head.parentNode.children) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const body = head.closest('table').tBodies[0], column = head.cellIndex;
    const value = row => row.cells[column].dataset.v ?? row.cells[column].textContent;
    const compare = (a, b) => value(a).localeCompare(value(b), undefined, {numeric: true});
    const numbers = (a, b) => value(a) - value(b);
    const numeric = head.classList.contains('n');
    const rows = [...body.rows].sort(numeric ? numbers : compare);
    body.append(...(up ? rows : rows.reverse()));
  });
}
"""

_OPEN, _CLOSE = "<main>\n", "\n</main>"


def head(title: str) -> str:
    """Everything before a report's first section."""
    policy = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n{_OPEN}"
    )


def tail() -> str:
    """Everything after a report's last section."""
    return f"{_CLOSE}\n<script>{_SCRIPT}</script>\n</body>\n</html>\n"


def inner(page: str) -> str:
    """Return the sections of a page that was made of :func:`head` and :func:`tail`."""
    return page.partition(_OPEN)[2].rpartition(_CLOSE)[0]


def data(kind: str, values: dict[str, Any]) -> str:
    """Embed values for programs to read: ``<script type="application/json" class=kind>``."""
    # A “<” inside could end the element; JSON knows it by number too.
    text = json.dumps(values, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    return f'<script type="application/json" class="{kind}">{text}</script>'


def table(columns: Sequence[tuple[str, str]], rows: Iterable[Sequence[str]], kind: str = "") -> str:
    """Make a table.

    Parameters
    ----------
    columns : title and class of each column; class ``n`` is for numbers
    rows : cells that are HTML already, either contents or whole ``<td>`` elements
    kind : class of the table
    """
    titles = "".join(f'<th class="{css}" scope="col">{name}</th>' for name, css in columns)
    body = []
    for row in rows:
        cells = (
            cell if cell.startswith("<td") else f'<td class="{css}">{cell}</td>'
            for cell, (_, css) in zip(row, columns, strict=True)
        )
        body.append(f"<tr>{''.join(cells)}</tr>")
    return (
        f'<table class="{kind}"><thead><tr>{titles}</tr></thead>'
        f"<tbody>{''.join(body)}</tbody></table>"
    )


def number(value: float | None, text: str) -> str:
    """A cell that shows a text and sorts by a number; unknown ones come first."""
    return f'<td class="n" data-v="{-1 if value is None else value:g}">{text}</td>'
