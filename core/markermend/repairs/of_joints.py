"""The repair of a joint of a skeleton recording that is made when no method is named."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from markermend.artifact import Artifact
from markermend.detectors.finding import in_mm
from markermend.repairs.registry import Evidence, Repair, find_method

RESTORING, FOLLOWING = "skeleton", "local_regression"

# Following the joints around may expect half of what restoring expects to be off, or it is not
# taken. Of recordings of 22 movements with a joint hidden for 0.1 to 1 s, of CMU skeletons and of
# 17 joints with and without noise, restoring errs less on limbs (mean 3 to 16 mm, following 4 to
# 33) and says more than it errs. From half on limbs lose nothing.
_SURER = 0.5
# What restoring expects to be off by less, it may: it keeps bones and gives rotations besides.
_MATTERS_MM = 3.0


def best_of_joint(evidence: Evidence, artifact: Artifact) -> Repair:
    """Restoring's proposal, or that of following the joints around where it is far surer.

    A mix-up is restored on both of its sides.

    Parameters
    ----------
    evidence : what may be believed, the artifact's own samples not
    artifact : of a joint of a skeleton recording

    Returns
    -------
    Repair
        without patches, and with the reason, when restoring cannot repair it
    """
    restored = _by_defaults(evidence, artifact, RESTORING)
    if artifact.counterpart is not None or (restored.error_mm or 0.0) < _MATTERS_MM:
        return restored
    followed = _by_defaults(evidence, artifact, FOLLOWING)
    if best_of((restored, followed)) != FOLLOWING:
        return restored
    further = f"about {in_mm(restored.error_mm or 0.0)} mm off"
    return replace(followed, reason=f"{find_method(RESTORING).label} may be {further}.")


def best_of(proposed: Iterable[Repair]) -> str:
    """The method among those proposed for a joint that is best: one that follows only if surer."""
    errors = {r.method: r.error_mm for r in proposed if r.patches}
    restored, followed = errors.get(RESTORING), errors.get(FOLLOWING)
    if restored is None or followed is None or restored < _MATTERS_MM:
        return RESTORING
    return FOLLOWING if followed < _SURER * restored else RESTORING


def _by_defaults(evidence: Evidence, artifact: Artifact, name: str) -> Repair:
    method = find_method(name)
    return method.run(evidence, artifact, method.params())
