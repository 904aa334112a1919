"""The damage map and the curves, as inline SVG that scales and prints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, axis_columns
from markermend.outcome import Outcome
from markermend.take import AXES, Take, is_unlabelled

_WIDTH = 1000.0
_NAMES = 130.0
_MARGIN = 14.0
_ROW = 11.0
# Beyond this many rows only damaged markers are drawn, so that names stay readable.
_MOST_ROWS = 80
_CURVE_WIDTH, _CURVE_HEIGHT = 480.0, 190.0
# Twice the pixels a curve is drawn on: each of them may need its highest and lowest sample.
_POINTS = 800


def damage_map(take: Take, done: Sequence[Outcome]) -> str:
    """Draw markers over time with every artifact in its class's colour.

    Parameters
    ----------
    take : the recording
    done : artifacts with what became of them; repaired ones are filled, others outlined

    Returns
    -------
    An ``<svg>`` element.
    """
    damaged = {o.artifact.marker for o in done}
    rows = [label for label in take.labels if not is_unlabelled(label) or label in damaged]
    if len(rows) > _MOST_ROWS:
        rows = [label for label in rows if label in damaged]
    where = {label: i for i, label in enumerate(rows)}
    bottom = _ROW * len(rows)
    across = _WIDTH - _NAMES - _MARGIN
    per_frame = across / take.frames
    parts = [
        f'<svg class="map" role="img" aria-label="Damage over time" '
        f'viewBox="0 0 {_WIDTH:g} {bottom + 26:g}">'
    ]
    for label, i in where.items():
        y = i * _ROW
        shade = ' class="odd"' if i % 2 else ' class="even"'
        parts.append(
            f'<rect{shade} x="{_NAMES:g}" y="{y:g}" width="{across:g}" height="{_ROW:g}"/>'
            f'<text x="{_NAMES - 6:g}" y="{y + 9:g}" text-anchor="end">{escape(label[-22:])}</text>'
        )
    for o in done:
        a = o.artifact
        x, width = _NAMES + a.start * per_frame, max(a.length * per_frame, 1.2)
        state = "mended" if o.method else "left"
        parts.append(
            f'<rect class="{a.kind.value} {state}" x="{x:.1f}" y="{where[a.marker] * _ROW + 1:g}" '
            f'width="{width:.1f}" height="{_ROW - 2:g}"><title>{escape(_caption(take, o))}</title>'
            "</rect>"
        )
    for second in ticks(0.0, take.duration_s, 10):
        x = _NAMES + second * take.rate * per_frame
        parts.append(
            f'<line class="tick" x1="{x:.1f}" x2="{x:.1f}" y1="0" y2="{bottom + 4:g}"/>'
            f'<text x="{x:.1f}" y="{bottom + 16:g}" text-anchor="middle">{second:g} s</text>'
        )
    return "".join(parts) + "</svg>"


def worst(done: Sequence[Outcome], number: int = 6) -> list[Outcome]:
    """Choose the repairs most worth a look: the largest expected error, then the largest damage."""
    mended = [o for o in done if o.method is not None]

    def order(o: Outcome) -> tuple[float, float, int, str]:
        size = o.artifact.amplitude_mm
        size = size if math.isfinite(size) else float(o.artifact.length)
        return (-(o.error_mm or 0.0), -size, o.artifact.start, o.artifact.id)

    return sorted(mended, key=order)[:number]


def curves(before: Take, after: Take, outcome: Outcome) -> str:
    """Draw the most changed axis of one repair, as it was and as it is, with some time around it.

    Parameters
    ----------
    before, after : the same recording as read and as repaired
    outcome : a repaired artifact; where its deviation is known it is drawn as a band

    Returns
    -------
    A ``<figure>`` element; NaN breaks the lines.
    """
    a = outcome.artifact
    margin = max(round(0.5 * before.rate), a.length)
    first, stop = max(0, a.start - margin), min(before.frames, a.stop + margin)
    axis = _axis(before, after, a)
    column = before.index(a.marker)
    time = np.arange(first, stop) / before.rate
    was = before.positions[first:stop, column, axis]
    now = after.positions[first:stop, column, axis]
    band = _band(now, a, first, outcome)
    shown = np.concatenate([was, now, *band])
    shown = shown[np.isfinite(shown)]
    if not shown.size:
        return ""
    low, high = float(shown.min()), float(shown.max())
    low, high = (low - 1.0, high + 1.0) if high - low < 1e-6 else (low, high)
    left, bottom = 52.0, _CURVE_HEIGHT - 24.0

    def x(seconds: FloatArray | float) -> FloatArray:
        span = max(time[-1] - time[0], 1.0 / before.rate)
        return np.asarray(left + (seconds - time[0]) / span * (_CURVE_WIDTH - left - 6.0))

    def y(mm: FloatArray | float) -> FloatArray:
        return np.asarray(bottom - (mm - low) / (high - low) * (bottom - 8.0))

    parts = [f'<svg viewBox="0 0 {_CURVE_WIDTH:g} {_CURVE_HEIGHT:g}" role="img">']
    edges = x(np.array([a.start - 0.5, a.stop - 0.5]) / before.rate)
    parts.append(
        f'<rect class="where" x="{edges[0]:.1f}" y="4" '
        f'width="{edges[1] - edges[0]:.1f}" height="{bottom - 4:.1f}"/>'
    )
    for mm in ticks(low, high, 4):
        parts.append(
            f'<line class="tick" x1="{left:g}" x2="{_CURVE_WIDTH - 6:g}" '
            f'y1="{y(mm):.1f}" y2="{y(mm):.1f}"/>'
            f'<text x="{left - 5:g}" y="{y(mm) + 3:.1f}" text-anchor="end">{mm:g}</text>'
        )
    for second in ticks(float(time[0]), float(time[-1]), 5):
        at = float(x(second))
        anchor = "middle" if at < _CURVE_WIDTH - _MARGIN else "end"
        parts.append(
            f'<text x="{at:.1f}" y="{bottom + 15:g}" text-anchor="{anchor}">{second:g} s</text>'
        )
    if band:
        around = time[a.start - first : a.stop - first]
        outline = [*zip(x(around), y(band[0]), strict=True)]
        outline += [*zip(x(around), y(band[1]), strict=True)][::-1]
        points = " ".join(f"{px:.1f},{py:.1f}" for px, py in outline if math.isfinite(py))
        parts.append(f'<polygon class="band" points="{points}"/>')
    parts.append(f'<path class="was" d="{path(x(time), y(was))}"/>')
    parts.append(f'<path class="now" d="{path(x(time), y(now))}"/></svg>')
    caption = escape(f"{_caption(before, outcome)} – {AXES[axis]} in mm")
    return f"<figure>{''.join(parts)}<figcaption>{caption}</figcaption></figure>"


def path(x: FloatArray, y: FloatArray, most: int = _POINTS) -> str:
    """Write a line as SVG path data, broken where a value is NaN.

    Parameters
    ----------
    x, y : (n,) in drawing units
    most : beyond this many points only the lowest and highest of each stretch are drawn
    """
    keep = decimate(y, most)
    commands, drawing = [], False
    for px, py in zip(x[keep], y[keep], strict=True):
        seen = math.isfinite(py)
        if seen:
            # With round caps a line of no length is a dot: a lone sample between gaps.
            commands.append(f"L{px:.1f} {py:.1f}" if drawing else f"M{px:.1f} {py:.1f}h0")
        drawing = seen
    return "".join(commands)


def decimate(y: FloatArray, most: int) -> list[int]:
    """Indices that keep a line's look: the first NaN and both extremes of each stretch."""
    if len(y) <= most:
        return list(range(len(y)))
    kept: set[int] = {0, len(y) - 1}
    for stretch in np.array_split(np.arange(len(y)), max(1, most // 3)):
        seen = stretch[np.isfinite(y[stretch])]
        if seen.size:
            kept.add(int(seen[np.argmin(y[seen])]))
            kept.add(int(seen[np.argmax(y[seen])]))
        if seen.size < stretch.size:
            kept.add(int(stretch[~np.isfinite(y[stretch])][0]))
    return sorted(kept)


def ticks(low: float, high: float, about: int) -> list[float]:
    """Round numbers between two values, about as many as asked for."""
    if not high > low:
        return [low]
    raw = (high - low) / about
    power = 10.0 ** math.floor(math.log10(raw))
    step = min((m * power for m in (1.0, 2.0, 5.0, 10.0)), key=lambda s: abs(s - raw))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [float(f"{n * step:.10g}") for n in range(first, last + 1)]


def _axis(before: Take, after: Take, a: Artifact) -> int:
    """The axis that the repair changed most, in a gap the one that moves most."""
    column = before.index(a.marker)
    was = before.positions[a.start : a.stop, column]
    now = after.positions[a.start : a.stop, column]
    change = np.nan_to_num(np.abs(now - was)).max(axis=0)
    if not change.any():
        change = np.ptp(np.nan_to_num(now), axis=0)
    axes = axis_columns(a.axes)
    return axes[int(np.argmax(change[axes]))]


def _band(now: FloatArray, a: Artifact, first: int, outcome: Outcome) -> list[FloatArray]:
    """Lower and upper edge of the expected deviation over the interval, or nothing."""
    if outcome.band_mm is None or len(outcome.band_mm) != a.length:
        return []
    middle = now[a.start - first : a.stop - first]
    return [middle - outcome.band_mm, middle + outcome.band_mm]


def _caption(take: Take, o: Outcome) -> str:
    """What an artifact is and what was done about it, in one line."""
    a = o.artifact
    first, last = take.frame_number(a.start), take.frame_number(a.stop - 1)
    frames = f"frame {first}" if first == last else f"frames {first}–{last}"
    done = o.method_label or "left"
    # A swap, which invents nothing, has none.
    error = f", expected error {o.error_mm:.2f} mm" if o.error_mm else ""
    error = ", expected error not measured" if o.unmeasured else error
    return f"{o.who} {a.axes}, {a.kind.value}, {frames}: {done}{error}"
