"""What is flagged beside gaps: where nothing is wrong, and where a marker drifts off and back.

python tests/benchmarks/bench_gap_edges.py TAKE.c3d ... (recordings with little missing)

Plain: gaps of 5 to 100 frames in one marker or three neighbours at once; flags that the take as it
is does not have. Ramps: gaps of 10 to 60 frames, a ramp over 1 to 4 frames on either side of them.
Steps: such gaps with 2 to 30 frames beside them that are one step off in a random direction; how
many are found, how many of the axes that are 1 mm off or more are named, and what is left of the
error in these frames once they are repaired.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import only_named
from markermend.patch import patched
from markermend.repairs import repair_all
from markermend.take import AXES, Take

COPIES, MARKERS, SEED, FREE = 8, 6, 5, 60
RAMPS_MM = ((3.0, 6.0), (8.0, 20.0))
STEPS_MM = ((5.0, 10.0), (10.0, 40.0))
NOTICEABLE_MM = 1.0


def flagged_plain(take: Take, together: int) -> tuple[int, int]:
    """Gaps made, and flags other than gaps that were not there before."""
    rng = np.random.default_rng([SEED, together])
    before = {(a.marker, a.start) for a in mm.detect(take, slow=False)}
    apart = np.linalg.norm(take.positions[::7, :, None] - take.positions[::7, None], axis=3)
    near = apart.std(axis=0).argsort(axis=1)
    gaps = flags = 0
    for _ in range(COPIES):
        positions = take.positions.copy()
        gone: BoolArray = np.zeros(positions.shape[:2], dtype=bool)
        for _ in range(MARKERS):
            length = int(rng.integers(5, 100))
            start = int(rng.integers(FREE, take.frames - length - FREE))
            mates = near[int(rng.integers(take.markers)), :together]
            if gone[start - FREE : start + length + FREE, mates].any():
                continue
            gone[start : start + length, mates] = True
            gaps += together
        positions[gone] = np.nan
        found = mm.detect(Take(positions, take.labels, take.rate), slow=False)
        flags += sum(a.kind is not Kind.GAP and (a.marker, a.start) not in before for a in found)
    return gaps, flags


def found_ramps(take: Take, smallest: float, largest: float) -> tuple[float, float]:
    """Share of edges of which anything is flagged, and mean error of the gaps once filled, mm."""
    rng = np.random.default_rng([SEED, round(largest)])
    edges, off = list[bool](), list[float]()
    for _ in range(COPIES):
        positions, gaps = take.positions.copy(), []
        for marker in rng.choice(take.markers, MARKERS, replace=False).tolist():
            length = int(rng.integers(10, 60))
            start = int(rng.integers(100, take.frames - length - 100))
            stop = start + length
            before, after = (_ramp(rng, smallest, largest) for _ in range(2))
            positions[start - len(before) : start, marker] += before
            positions[stop : stop + len(after), marker] += after[::-1]
            positions[start:stop, marker] = np.nan
            gaps.append((marker, start, stop, len(before), len(after)))
        damaged = Take(positions, take.labels, take.rate)
        found = mm.detect(damaged, slow=False)
        fixed = patched(damaged, (p for _, r in repair_all(damaged, found) for p in r.patches))
        for marker, start, stop, before_frames, after_frames in gaps:
            mine = [a for a in found if a.marker == take.labels[marker] and a.kind is not Kind.GAP]
            edges += [
                _any(mine, start - before_frames, start),
                _any(mine, stop, stop + after_frames),
            ]
            away = (fixed.positions - take.positions)[start:stop, marker]
            off.append(float(np.linalg.norm(away, axis=1).mean()))
    return float(np.mean(edges)), float(np.nanmean(off))


def found_steps(take: Take, smallest: float, largest: float) -> tuple[float, float, float, float]:
    """Share of steps found, share of their axes named, mean and largest error left, mm."""
    rng = np.random.default_rng([SEED, round(largest), 1])
    seen, named, off = list[bool](), list[bool](), list[float]()
    for _ in range(COPIES):
        positions, steps = take.positions.copy(), []
        for marker in rng.choice(take.markers, MARKERS, replace=False).tolist():
            length = int(rng.integers(10, 60))
            start = int(rng.integers(100, take.frames - length - 100))
            beside = int(rng.integers(2, 31))
            first = start - beside if rng.random() < 0.5 else start + length
            way = rng.normal(size=3)
            height = rng.uniform(smallest, largest) * way / np.linalg.norm(way)
            positions[first : first + beside, marker] += height
            positions[start : start + length, marker] = np.nan
            steps.append((marker, first, first + beside, height))
        damaged = Take(positions, take.labels, take.rate)
        found = mm.detect(damaged, slow=False)
        fixed = patched(damaged, (p for _, r in repair_all(damaged, found) for p in r.patches))
        for marker, start, stop, height in steps:
            if np.isnan(take.positions[start:stop, marker]).any():
                continue
            mine = [a for a in found if a.marker == take.labels[marker] and a.kind is not Kind.GAP]
            mine = [a for a in mine if a.overlaps(start, stop)]
            seen.append(bool(mine))
            if mine:
                axes = {axis for a in mine for axis in a.axes}
                wrong = np.flatnonzero(np.abs(height) >= NOTICEABLE_MM)
                named += [AXES[n] in axes for n in wrong]
            away = (fixed.positions - take.positions)[start:stop, marker]
            off.append(float(np.linalg.norm(away, axis=1).mean()))
    return float(np.mean(seen)), float(np.mean(named)), float(np.mean(off)), max(off)


def _ramp(rng: np.random.Generator, smallest: float, largest: float) -> FloatArray:
    """(1 to 4, 3) mm, rising in a random direction."""
    frames, way = int(rng.integers(1, 5)), rng.normal(size=3)
    height = rng.uniform(smallest, largest) * way / np.linalg.norm(way)
    return np.asarray(np.arange(1, frames + 1)[:, None] / frames * height)


def _any(artifacts: list[Artifact], start: int, stop: int) -> bool:
    return any(a.overlaps(start, stop) for a in artifacts)


def main() -> None:
    """Measure and print."""
    for path in sys.argv[1:]:
        take, name = only_named(mm.read(path)), Path(path).stem
        for together in (1, 3):
            gaps, flags = flagged_plain(take, together)
            sys.stdout.write(f"{name}: {gaps} plain gaps, {together} at once: {flags} flags\n")
        for smallest, largest in RAMPS_MM:
            share, off = found_ramps(take, smallest, largest)
            sys.stdout.write(
                f"{name}: ramps to {smallest:g} to {largest:g} mm at {share:.0%} of the edges"
                f" found, gaps {off:.1f} mm off\n"
            )
        for smallest, largest in STEPS_MM:
            share, axes, off, most = found_steps(take, smallest, largest)
            sys.stdout.write(
                f"{name}: steps of {smallest:g} to {largest:g} mm beside gaps: {share:.0%} found,"
                f" {axes:.0%} of their axes named, {off:.1f} mm off once repaired ({most:.1f})\n"
            )


if __name__ == "__main__":
    main()
