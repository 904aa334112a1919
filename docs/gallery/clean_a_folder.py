"""Clean every C3D take below a folder, and list what was left for an operator.

python clean_a_folder.py FOLDER OUT
"""

import sys
from pathlib import Path

import markermend as mm
from markermend.patch import patched
from markermend.repairs import repair_all

folder, out = map(Path, sys.argv[1:3])
for path in sorted(p for p in folder.rglob("*") if p.suffix.lower() == ".c3d"):
    name = path.relative_to(folder)
    try:
        take = mm.read(path)
    except mm.MarkermendError as error:
        print(f"{name}: {error}")
        continue
    found = mm.detect(take)
    repairs = repair_all(take, found, min_confidence=0.9)
    clean = patched(take, [patch for _, repair in repairs for patch in repair.patches])
    (out / name).parent.mkdir(parents=True, exist_ok=True)
    mm.write(clean, out / name)
    done = [a for a, repair in repairs if repair.patches]
    left = [a for a in found if a not in done]
    print(f"{name}: {len(done)} repaired, {len(left)} left")
    for artifact in left:
        print("   ", artifact)
