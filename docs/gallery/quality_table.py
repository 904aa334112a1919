"""One row a marker: seen, damaged, by which class, as a pandas table.

python quality_table.py TAKE [OUT.csv]
"""

import sys

import pandas as pd

import markermend as mm

take = mm.read(sys.argv[1])
found = mm.detect(take)
rows = pd.DataFrame([{"marker": a.marker, "kind": a.kind, "frames": a.length} for a in found])
table = pd.DataFrame({"seen": take.present.mean(axis=0)}, index=take.labels)
if len(rows):
    table = table.join(
        rows.pivot_table(index="marker", columns="kind", values="frames", aggfunc="sum")
    )
table = table.fillna(0).sort_values("seen")
print(table.to_string(float_format="{:.3f}".format))
if len(sys.argv) > 2:
    table.to_csv(sys.argv[2])
