"""What becomes of gaps where much is missing at once: of four markers one or two, eight together.

Repaired together, as `fill` does, and one at a time, as a review does.

python tests/benchmarks/bench_missing.py TAKE.c3d ... (recordings with little missing)
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.artifact import Artifact, Status
from markermend.bench.gaps import BAND_90, only_named
from markermend.patch import patched
from markermend.repairs import Repair, find_gaps, propose, repair_all
from markermend.repairs.tits2018.local_frame import rank_by_spread
from markermend.take import Take

Pairs = list[tuple[Artifact, Repair]]
SECONDS, DRAWS, SEED, BESIDE = (0.1, 0.5, 1.0, 2.0), 3, 34, 5
# Markers kept of the take (None for all), and how many of the first are hidden.
KINDS: dict[str, tuple[int | None, int]] = {
    "one of four": (4, 1),
    "two of four": (4, 2),
    "eight of a body": (None, 8),
}
HEAD = "filled, mm off, mm expected, in the band, damage found, off in length"


def whole(path: str) -> Take:
    """The markers that are seen all through a take."""
    take = only_named(mm.read(path))
    always = np.flatnonzero(take.present.all(axis=0))
    return Take(take.positions[:, always], tuple(take.labels[i] for i in always), take.rate)


def judged(
    truth: Take, after: Take, artifact: Artifact, done: Repair
) -> tuple[float, float, float, bool, bool]:
    """Error, expected error, share in the band, whether damage is found, and lengths off 10 mm."""
    rows, column = slice(artifact.start, artifact.stop), truth.index(artifact.marker)
    miss = np.linalg.norm(after.positions[rows, column] - truth.positions[rows, column], axis=1)
    band = np.nan if done.band_mm is None else float(np.mean(miss <= BAND_90 * done.band_mm))
    ranked, _ = rank_by_spread(truth.positions, column)
    seen = [c for c in ranked if not np.isnan(after.positions[rows, c]).any()][:3]
    lengths = np.linalg.norm(after.positions[:, seen] - after.positions[:, [column]], axis=2)
    outside = np.delete(lengths, np.arange(artifact.start, artifact.stop), axis=0)
    beyond = np.maximum(
        np.nanmin(outside, axis=0) - lengths[rows].min(axis=0),
        lengths[rows].max(axis=0) - np.nanmax(outside, axis=0),
    )
    expected = np.nan if done.error_mm is None else done.error_mm
    return float(miss.mean()), expected, band, bool(done.leaves), bool((beyond > 10.0).any())


def together(holed: Take) -> Pairs:
    """All gaps repaired at once."""
    return list(repair_all(holed, find_gaps(holed)))


def by_turns(holed: Take) -> Pairs:
    """The gaps repaired one at a time, in their order; those that could not be once more."""
    take, known = holed, {a.id: a for a in find_gaps(holed)}
    pairs = {}
    for artifact in 2 * tuple(known.values()):
        if known[artifact.id].status is not Status.REPAIRED:
            errors = {n: r.error_mm for n, (_, r) in pairs.items() if r.error_mm is not None}
            repair = propose(take, artifact, known.values(), errors=errors)
            pairs[artifact.id] = artifact, repair
            if repair.patches:
                take = patched(take, repair.patches)
                known[artifact.id] = artifact.with_status(Status.REPAIRED)
    return list(pairs.values())


def main() -> None:
    """Hide, repair, and print."""
    found: dict[tuple[str, str, float], list[tuple[float, float, float, bool, bool] | None]] = {}
    for path in sys.argv[1:]:
        full = whole(path)
        rng = np.random.default_rng([SEED, sum(map(ord, Path(path).stem))])
        for seconds in SECONDS:
            length = round(seconds * full.rate)
            if length + 20 > 0.9 * full.frames:
                continue
            for kind in [k for _ in range(DRAWS) for k in KINDS]:
                kept, hidden = KINDS[kind]
                marker = int(rng.integers(full.markers))
                start = BESIDE + int(rng.random() * (full.frames - length - 2 * BESIDE))
                columns = [marker, *rank_by_spread(full.positions, marker)[0][: (kept or 0) - 1]]
                names = tuple(full.labels[c] for c in columns)
                truth = Take(full.positions[:, columns], names, full.rate) if kept else full
                positions = truth.positions.copy()
                positions[start : start + length, [truth.index(n) for n in names[:hidden]]] = np.nan
                holed = Take(positions, truth.labels, truth.rate)
                for way in (together, by_turns):
                    pairs = way(holed)
                    after = patched(holed, (p for _, r in pairs for p in r.patches))
                    found.setdefault((way.__name__, kind, seconds), []).extend(
                        judged(truth, after, a, r) if r.patches else None for a, r in pairs
                    )
    sys.stdout.write(HEAD + "\n")
    for (way_name, kind, seconds), results in sorted(found.items()):
        filled = np.array([r for r in results if r is not None], dtype=float).reshape(-1, 5)
        off, expected, band, damage, lengths = np.nanmean(filled, axis=0)
        sys.stdout.write(
            f"{way_name:<9} {kind:<15}{seconds:4} s "
            f"{100 * len(filled) / len(results):4.0f} % {off:6.1f} "
            f"(median {np.median(filled[:, 0]):.1f}) {expected:6.1f} {100 * band:4.0f} % "
            f"{100 * damage:4.0f} % {100 * lengths:4.0f} %\n"
        )


if __name__ == "__main__":
    main()
