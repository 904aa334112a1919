"""How many markers that slide off and stay off are found, and how many are accused wrongly."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.artifact import trusted_samples
from markermend.bench.columns import aligned, number
from markermend.detectors import detect
from markermend.detectors.joint import JointParams
from markermend.detectors.joint.shifted import find_shifted
from markermend.errors import MethodError
from markermend.processes import in_processes
from markermend.progress import Progress, quiet
from markermend.simulation.slides import slide_off
from markermend.take import Take, is_unlabelled

SIZES_MM = (10.0, 20.0, 40.0)
LASTING_S = (0.3, 1.0, 3.0)
"""How long a marker slides, one of these."""
FIRST, LAST = 0.3, 0.6
"""Part of the take in which it sets out."""


@dataclass(frozen=True)
class SlideRow:
    """A take with one marker at a time that slides off; as it was, where the size is 0.

    Attributes
    ----------
    take : its name
    size_mm : how far
    simulations : how many
    found : simulations whose marker is flagged to the end of the take
    others : other markers that are
    late_s : mean over those found, from setting out to where the flag begins; NaN without any
    """

    take: str
    size_mm: float
    simulations: int
    found: int
    others: int
    late_s: float


def slides(
    takes: Mapping[str, Take],
    *,
    sizes_mm: Sequence[float] = SIZES_MM,
    simulations: int = 8,
    seed: int = 0,
    n_jobs: int = -1,
    progress: Progress | None = None,
) -> tuple[SlideRow, ...]:
    """Let one marker slide off, at a random moment and in a random direction, and look for it.

    Parameters
    ----------
    takes : recordings by name
    sizes_mm : how far
    simulations : for each take and size
    seed : same seed, same slides
    n_jobs : processes; −1 for one a core
    progress : told the share of simulations done; may raise ``Cancelled``

    Returns
    -------
    For each take a row as it was, then one for each size

    Raises
    ------
    DataError
        when a marker has no three others to slide among
    MethodError
        when no simulation is asked for, or a size is not positive
    """
    if simulations < 1:
        raise MethodError("At least one simulation is needed.")
    if not all(size > 0 for size in sizes_mm):
        raise MethodError("A marker has to slide by more than 0 mm.")
    settings = [
        (name, size, simulations if size else 1) for name in takes for size in (0.0, *sizes_mm)
    ]
    tasks = [(name, size, number) for name, size, count in settings for number in range(count)]
    report = progress or quiet
    each = ((takes[name], size, [seed, round(1000 * size), number]) for name, size, number in tasks)
    rows: dict[tuple[str, float], list[SlideRow]] = {}
    with in_processes(_simulated, each, n_jobs) as done:
        for count, ((name, size, _), row) in enumerate(zip(tasks, done, strict=True)):
            rows.setdefault((name, size), []).append(row)
            report((count + 1) / len(tasks), f"{name}, {size:g} mm")
    return tuple(_joined(name, parts) for (name, _), parts in rows.items())


def _simulated(take: Take, size_mm: float, seed: Sequence[int]) -> SlideRow:
    """One slide, or none for a size of 0."""
    named = [m for m, label in enumerate(take.labels) if not is_unlabelled(label)]
    rng = np.random.default_rng(seed)
    marker, start = "", take.frames
    if size_mm:
        marker = take.labels[int(rng.choice(named))]
        start = round(rng.uniform(FIRST, LAST) * take.frames)
        away = rng.standard_normal(3)
        take, _ = slide_off(
            take,
            marker,
            start=start,
            frames=round(rng.choice(LASTING_S) * take.rate),
            away_mm=size_mm * away / np.linalg.norm(away),
        )
    # What else slow changes are made of costs fifty times as much, and finds none of these.
    sudden = detect(take, params=JointParams(slow=False))
    flags = find_shifted(take, named, trusted_samples(take, sudden))
    own = [a for a in flags if a.marker == marker]
    late = (own[0].start - start) / take.rate if own else np.nan
    return SlideRow("", size_mm, 1, bool(own), len(flags) - len(own), late)


def _joined(name: str, parts: Sequence[SlideRow]) -> SlideRow:
    """The simulations of one setting together."""
    late = [p.late_s for p in parts if p.found]
    return SlideRow(
        name,
        parts[0].size_mm,
        len(parts),
        sum(p.found for p in parts),
        sum(p.others for p in parts),
        float(np.mean(late)) if late else np.nan,
    )


def slides_table(rows: Iterable[SlideRow]) -> list[str]:
    """Lines to print."""
    cells = [["take", "slides, mm", "found", "others flagged", "late, s"]]
    for r in rows:
        found = f"{r.found} of {r.simulations}" if r.size_mm else "–"
        size = f"{r.size_mm:g}" if r.size_mm else "none"
        cells.append([r.take, size, found, str(r.others), number(r.late_s, 1)])
    return aligned(cells)
