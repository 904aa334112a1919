"""How many frames the band holds where one gap takes much of a take.

python tests/benchmarks/bench_long_gaps.py TAKE.c3d ... (recordings with little missing)
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from bench_missing import whole

from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import BAND_90
from markermend.repairs import evidence_for, propose_from
from markermend.take import AXES, Take

SHARES, SECONDS, DRAWS, SEED, BESIDE = (0.05, 0.2, 0.4, 0.6, 0.75), (5, 10, 20, 40), 4, 12, 5
HEAD = "share missing: gaps, mm off, mm expected, in the band, off by over twice as much"


def judged(part: Take, column: int, start: int, stop: int) -> tuple[float, float, float] | None:
    """Error, expected error and share in the band of one hidden stretch, None where not filled."""
    positions = part.positions.copy()
    positions[start:stop, column] = np.nan
    gap = Artifact(part.labels[column], AXES, start, stop, Kind.GAP)
    evidence = evidence_for(Take(positions, part.labels, part.rate))
    repair = propose_from(evidence, gap, method="local_regression")
    if not repair.patches or repair.band_mm is None or repair.error_mm is None:
        return None
    off = np.linalg.norm(repair.patches[0].values - part.positions[start:stop, column], axis=1)
    return float(off.mean()), repair.error_mm, float(np.mean(off <= BAND_90 * repair.band_mm))


def main() -> None:
    """Hide a share of parts of 5 to 40 seconds, repair, and print."""
    found: dict[float, list[tuple[float, float, float]]] = {share: [] for share in SHARES}
    for path in sys.argv[1:]:
        full = whole(path)
        rng = np.random.default_rng([SEED, sum(map(ord, Path(path).stem))])
        for seconds in SECONDS:
            frames = round(seconds * full.rate)
            if frames > full.frames:
                continue
            for share in SHARES * DRAWS:
                first = int(rng.integers(full.frames - frames + 1))
                part = Take(full.positions[first : first + frames], full.labels, full.rate)
                length = round(share * frames)
                start = int(rng.integers(BESIDE, frames - length - BESIDE))
                column = int(rng.integers(full.markers))
                result = judged(part, column, start, start + length)
                if result is not None:
                    found[share].append(result)
    sys.stdout.write(HEAD + "\n")
    for share, results in found.items():
        values = np.array(results).reshape(-1, 3)
        off, expected, band = values.mean(axis=0)
        far = np.mean(values[:, 0] > 2.0 * values[:, 1])
        sys.stdout.write(
            f"{100 * share:3.0f} % {len(values):4} {off:6.1f} {expected:6.1f} "
            f"{100 * band:4.0f} % {100 * far:4.0f} %\n"
        )


if __name__ == "__main__":
    main()
