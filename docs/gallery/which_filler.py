"""Hide what is known, fill it with several methods, compare the errors.

python which_filler.py TAKE MARKER [SECONDS]
"""

import sys

import numpy as np

import markermend as mm

path, marker = sys.argv[1:3]
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 0.3
take = mm.read(path)
column, length = take.index(marker), round(seconds * take.rate)
seen = np.flatnonzero(take.present[:, column])
places = np.random.default_rng(0).choice(seen[length:-length], 5, replace=False)
places = [p for p in places if take.present[p : p + length, column].all()]

for method in ("linear", "spline", "pchip", "local_regression", "rigid", "auto"):
    errors = []
    for start in places:
        hidden = take.positions.copy()
        hidden[start : start + length, column] = np.nan
        origin = (~np.isnan(hidden[:, :, 0])).astype(np.uint8)
        gap = mm.Artifact(marker, "xyz", start, start + length, mm.Kind.GAP)
        filled = mm.repair(take.with_positions(hidden, origin), [gap], method=method)
        off = (
            filled.positions[start : start + length, column]
            - take.positions[start : start + length, column]
        )
        errors.append(np.linalg.norm(off, axis=1).mean())
    if np.isnan(errors).any():
        print(f"{method:18} cannot fill all of them")
    else:
        print(
            f"{method:18} {np.mean(errors):7.2f} mm   (worst of {len(errors)}: {max(errors):.2f})"
        )
