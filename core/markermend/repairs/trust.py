"""Which samples of a take a repair may believe."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.artifact import Artifact, Kind, Status, mark_damage, trusted_samples
from markermend.mesh import Mesh
from markermend.progress import Progress, heed, quiet
from markermend.repairs.registry import Evidence
from markermend.take import Take

# A repair this short is as good as measured, and may serve as evidence for the next.
TRUSTED_REPAIR_S = 0.1


def evidence_for(
    take: Take,
    artifacts: Iterable[Artifact] = (),
    mesh: Mesh | None = None,
    *,
    believe_repairs: bool = False,
    progress: Progress | None = None,
) -> Evidence:
    """Say which samples of a take may be believed.

    Not believed are missing samples and those covered by an artifact that was not rejected.
    Repaired ones are believed again where little was invented: swaps, peaks, and intervals of
    up to 0.1 s. Longer repairs are not evidence for others, so that errors do not spread.

    Parameters
    ----------
    take : the recording as it stands
    artifacts : all that are known about it
    mesh : the body's structure, if it was worked out before
    believe_repairs : believe long repairs too; for what cannot be repaired otherwise
    progress : told by methods that take seconds; may raise ``Cancelled``
    """
    doubtful = [
        a
        for a in artifacts
        if a.status is not Status.REPAIRED or not (believe_repairs or as_good_as_new(take, a))
    ]
    trusted = np.empty(take.positions.shape, dtype=bool)
    for axis in range(3):
        trusted[:, :, axis] = take.present
    mark_damage(trusted, take, doubtful, False)
    trusted.flags.writeable = False
    heed()
    evidence = Evidence(take, trusted, mesh, progress or quiet)
    return evidence.with_seen(trusted_samples(take, doubtful))


def as_good_as_new(take: Take, artifact: Artifact) -> bool:
    """Whether a repair of this artifact invents so little that it may be believed."""
    swap = artifact.kind is Kind.STEP and artifact.counterpart is not None
    return swap or artifact.kind is Kind.PEAK or artifact.length <= TRUSTED_REPAIR_S * take.rate


def only_these(evidence: Evidence, marker: str, references: Sequence[str]) -> Evidence:
    """Evidence that believes these markers, and the marker's own samples, only."""
    take = evidence.take
    believed = [take.index(label) for label in {marker, *references}]
    trusted = np.zeros_like(evidence.trusted)
    trusted[:, believed] = evidence.trusted[:, believed]
    return replace(evidence, trusted=trusted)
