"""A review without a window: your own rules decide, every step can be undone.

python review_by_rule.py TAKE OUT.c3d
"""

import sys

import markermend as mm
from markermend.repairs import propose

path, out = sys.argv[1:3]
take = mm.read(path)
session = mm.Session(take)
session.add_detected(mm.detect(take), "joint")

for artifact in session.artifacts:
    if artifact.kind is mm.Kind.SLOW and artifact.amplitude_mm < 5:
        session.set_status([artifact.id], mm.Status.REJECTED)
        continue
    repair = propose(session.take, artifact, session.artifacts)
    # Not worth a repair that is off by more than a centimetre.
    if repair.patches and (repair.error_mm is None or repair.error_mm < 10):
        session.repair([(artifact.id, repair)])
    else:
        session.set_status([artifact.id], mm.Status.ACCEPTED)

print(session)
print("\n".join(session.history[-3:]))
mm.write(session.take, out, record=session.repairs_in_words())
