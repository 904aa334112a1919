"""Do bands hold: of the usual repair, and of methods whose error is measured on known stretches.

python tests/benchmarks/bench_bands.py TAKE.c3d ... (recordings with little missing)
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from bench_missing import whole

from markermend.artifact import Artifact, Kind
from markermend.bench.gaps import BAND_90
from markermend.repairs import propose

CURVES, MODELS = (
    ("spline", "pchip", "makima", "linear"),
    ("li", "lpr", "lgrnn", "glr", "pca", "pma"),
)
METHODS = ("auto", "kalman", *CURVES, *MODELS)
SECONDS, GAPS, SEED, BESIDE = (0.05, 0.1, 0.2, 0.5, 1.0), 6, 7, 5


def main() -> None:
    """Hide one gap after the other, repair it by each method, and print."""
    held: dict[str, list[float]] = {}
    for path in sys.argv[1:]:
        take = whole(path)
        rng = np.random.default_rng([SEED, sum(map(ord, Path(path).stem))])
        for seconds in SECONDS:
            length = max(2, round(seconds * take.rate))
            if 3 * length + 20 > take.frames:
                continue
            for _ in range(GAPS):
                marker = int(rng.integers(take.markers))
                start = int(rng.integers(BESIDE, take.frames - length - BESIDE))
                gap = Artifact(take.labels[marker], "xyz", start, start + length, Kind.GAP)
                truth = take.positions[start : start + length, marker]
                for method in METHODS:
                    # The artifact's own samples are not looked at, as if they were missing.
                    done = propose(take, gap, method=method)
                    if done.patches and done.band_mm is not None:
                        miss = np.linalg.norm(done.patches[0].values - truth, axis=1)
                        held.setdefault(method, []).append(
                            float(np.mean(miss <= BAND_90 * done.band_mm))
                        )
    for method in METHODS:
        shares = held.get(method, [])
        if shares:
            line = f"{method:<8}{len(shares):4} gaps {100 * np.mean(shares):5.1f} % in the band\n"
            sys.stdout.write(line)


if __name__ == "__main__":
    main()
