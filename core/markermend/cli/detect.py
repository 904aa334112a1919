"""``markermend detect``: list the damaged intervals."""

from __future__ import annotations

import argparse
import csv
import io
import math
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.artifact import Artifact, Kind, within
from markermend.artifact_json import document
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_outputs,
    chosen_frames,
    count,
    read_take,
    say,
    table,
    write_json,
    write_text,
)
from markermend.cli.detection import choose, refuse_choice
from markermend.cli.recordings import heed_prior
from markermend.mesh import Mesh
from markermend.progress import Progress
from markermend.take import Take

_NOUN = {
    Kind.GAP: "gap",
    Kind.PEAK: "peak",
    Kind.NOISE: "noisy stretch",
    Kind.STEP: "step",
    Kind.SLOW: "slow change",
}


_COLUMNS = (
    *("marker", "axes", "kind", "start", "stop", "first_frame", "last_frame", "start_s"),
    *("stop_s", "confidence", "amplitude_mm", "counterpart", "status", "why"),
)


def run(options: argparse.Namespace) -> int:
    """Detect, and show or write what was found."""
    check_outputs([options.json, options.csv], source=options.take, force=options.force)
    chosen = choose(options)
    take = read_take(options.take)
    heed_prior(take, options.prior)
    frames = chosen_frames(take, options)
    with Bar() as bar:
        found = find(take, None, options, chosen, bar)
    found = found if frames is None else within(found, frames)
    if options.json is not None:
        name = Path(options.take).name
        described = document(take, found, chosen[0], mm.__version__, name=name, region=frames)
        write_json(options.json, described)
    if options.csv is not None:
        write_text(options.csv, to_csv(take, found))
    if STDOUT not in (options.json, options.csv):
        for line in _listing(take, found):
            say(line)
        say(summary(found, part=frames is not None))
        for line in never_seen(take, frames):
            say(line)
    return 0


def never_seen(take: Take, frames: tuple[int, int] | None) -> list[str]:
    """Name what cannot be damaged, since it is not there at all."""
    rows = slice(*(frames or (0, take.frames)))
    missing = [take.labels[i] for i in take.named if not take.present[rows, i].any()]
    if not missing:
        return []
    names = ", ".join(missing[:5]) + ("…" if len(missing) > 5 else "")
    where = "" if frames is None else " in these frames"
    return [f"Never seen{where}: {count(len(missing), 'marker')} ({names})."]


def find(
    take: Take,
    mesh: Mesh | None,
    options: argparse.Namespace,
    chosen: tuple[str, Any],
    progress: Progress,
) -> tuple[Artifact, ...]:
    """Detect as :func:`markermend.cli.detection.choose` chose from the options."""
    if take.skeleton:
        refuse_choice(options, f"{Path(options.take).name} holds joints, found wrong in one way")
    method, params = chosen
    return mm.detect(take, method=method, params=params, mesh=mesh, progress=progress)


def when(take: Take, artifact: Artifact) -> tuple[str, str]:
    """An interval as people read it: C3D frame numbers, last one included, and seconds."""
    first, last = take.frame_number(artifact.start), take.frame_number(artifact.stop - 1)
    frames = f"{first}" if first == last else f"{first}–{last}"
    return frames, f"{artifact.start / take.rate:.2f}–{artifact.stop / take.rate:.2f}"


def summary(artifacts: Sequence[Artifact], *, part: bool = False) -> str:
    """How many of each class, in one sentence; of a ``part`` of a take only."""
    if not artifacts:
        where = " in these frames" if part else ""
        return f"Nothing is damaged{where} as far as can be seen."
    kinds = Counter(a.kind for a in artifacts)
    parts = (f"{_counted(n, kind)}" for kind in Kind if (n := kinds[kind]))
    return f"{count(len(artifacts), 'artifact')}: {', '.join(parts)}."


def to_csv(take: Take, artifacts: Iterable[Artifact]) -> str:
    """Write artifacts as CSV, one a row, under a row of names.

    Frames are given twice: 0-based and half-open as everywhere in Markermend, and as the C3D
    frame numbers of the first and the last damaged frame.
    """
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(_COLUMNS)
    for a in artifacts:
        amplitude = f"{a.amplitude_mm:.4g}" if math.isfinite(a.amplitude_mm) else ""
        where = (a.start, a.stop, take.frame_number(a.start), take.frame_number(a.stop - 1))
        seconds = (f"{a.start / take.rate:.6g}", f"{a.stop / take.rate:.6g}")
        about = (f"{a.confidence:.4g}", amplitude, "; ".join(a.markers[1:]), a.status.value, a.why)
        rows.writerow((a.marker, a.axes, a.kind.value, *where, *seconds, *about))
    return text.getvalue()


def _listing(take: Take, artifacts: Sequence[Artifact]) -> list[str]:
    """All artifacts as an aligned table, with an empty line after it."""
    if not artifacts:
        return []
    rows = [
        [
            *when(take, a),
            a.marker,
            a.axes,
            a.kind.value,
            f"{a.amplitude_mm:.1f}" if math.isfinite(a.amplitude_mm) else "",
            f"{a.confidence:.0%}",
            a.why,
        ]
        for a in artifacts
    ]
    head = ["Frames", "Seconds", "Marker", "Axes", "Class", "mm", "Sure", "Why"]
    return [*table(head, rows, "rrlllrrl"), ""]


def _counted(number: int, kind: Kind) -> str:
    """A number of artifacts of one class in words."""
    noun = _NOUN[kind]
    return f"{number:,} {noun}" + ("" if number == 1 else "es" if noun.endswith("ch") else "s")
