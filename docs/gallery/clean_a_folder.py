"""Clean every take below a folder, and list what was left for an operator.

python clean_a_folder.py FOLDER OUT
"""

import sys
from pathlib import Path

import markermend as mm
from markermend.patch import patched
from markermend.repairs import repair_all

folder, out = map(Path, sys.argv[1:3])
out.mkdir(parents=True, exist_ok=True)

for path in sorted(folder.rglob("*.c3d")):
    take = mm.read(path)
    found = mm.detect(take)
    repairs = repair_all(take, found, min_confidence=0.9)
    clean = patched(take, [patch for _, repair in repairs for patch in repair.patches])
    mm.write(clean, out / path.name)
    left = [a for a in found if a.confidence < 0.9] + [a for a, r in repairs if not r.patches]
    print(f"{path.name}: {len(repairs)} repaired, {len(left)} left")
    for artifact in left:
        print("   ", artifact)
