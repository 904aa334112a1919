"""Proposing a repair for one artifact, whatever may be done with it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.parameters import read_params
from markermend.progress import Progress, heed
from markermend.repairs.advice import MODELS, with_expected_error
from markermend.repairs.automatic import (
    best_repair,
    counting_references,
    follow_one,
    if_good,
    if_worth_it,
)
from markermend.repairs.lengths import at_usual_distances, ties_of
from markermend.repairs.look_again import looked_at
from markermend.repairs.of_joints import best_of_joint
from markermend.repairs.registry import Evidence, Repair, find_method
from markermend.repairs.result import refuse, without_own
from markermend.repairs.trust import as_good_as_new, evidence_for, only_these
from markermend.take import Take

AUTO = "auto"
# Known stretches that are filled as well, to measure a named model of the body.
TRIALS = 3
# The last stage of repairing: what is neither a swap nor short.
LONG = 2


def propose(
    take: Take,
    artifact: Artifact,
    artifacts: Iterable[Artifact] = (),
    *,
    method: str = AUTO,
    params: Mapping[str, Any] | object | None = None,
    mesh: Mesh | None = None,
    references: Sequence[str] = (),
    errors: Mapping[str, float] | None = None,
    progress: Progress | None = None,
) -> Repair:
    """Propose a repair for one artifact, changing nothing.

    Beside what :func:`propose_from` does, models of the body that say nothing of their error are
    measured on known stretches of the marker nearby. With ``"auto"`` a long repair is drawn to
    usual distances from the markers beside it: those that are seen, that were repaired before, and
    that are missing, too, where they would be put.

    Parameters
    ----------
    take : the recording as it stands
    artifact : what is to be repaired
    artifacts : all others known; what is not rejected is not used as evidence
    method : name in the registry, or ``"auto"`` for :func:`choose` with fallbacks
    params : parameters of a named method, as a mapping or its dataclass; None for the defaults
    mesh : the body's structure, if it was worked out before
    references : the only other markers to be believed; none leaves the choice to the method.
        With ``"auto"`` three or more are followed by the local regression, fewer by the pattern
    errors : how far off repairs that were made before may be, mm, by the artifact's id; a repair
        that has to follow them is no surer. Those not told count as exact
    progress : told by methods that take seconds; may raise ``Cancelled``

    Returns
    -------
    Repair
        without patches, and with the reason, when it cannot be repaired

    Raises
    ------
    DataError
        when the marker is not in the take or the interval reaches beyond its end
    MethodError
        when there is no such method or a parameter is out of range
    """
    others = tuple(artifacts)
    # It may stand among the others with an older status or interval.
    known = (*(a for a in others if a.id != artifact.id), artifact)
    if references:
        evidence = evidence_for(take, known, mesh, progress=progress)
        evidence = only_these(evidence, artifact.marker, references)
        if method == AUTO:
            method = "local_regression" if len(references) > 2 else "pattern"
        if method == "pattern" and params is None:
            params = {"donor": references[0]}
        done = measured(evidence, artifact, method, params)
        if not done.patches:
            chosen = ", ".join(references)
            return replace(done, reason=f"With only {chosen} to follow: {done.reason}")
        return done
    repaired = {
        a: (errors or {}).get(a.id, 0.0)
        for a in known
        if a.status is Status.REPAIRED and a.id != artifact.id
    }
    # Repairs of the same moment are made from the same evidence, as where all are made at once.
    same = {
        a
        for a in repaired
        if a.overlaps(artifact.start, artifact.stop)
        and stage_of(take, a) >= stage_of(take, artifact)
    }
    first = (a.with_status(Status.ACCEPTED) if a in same else a for a in known)
    evidence = evidence_for(take, first, mesh, progress=progress)
    heed()
    done = _alone(evidence, artifact, known, repaired, method, params)
    heed()
    return _among(evidence, artifact, done, known, repaired) if method == AUTO else done


def propose_from(
    evidence: Evidence,
    artifact: Artifact,
    *,
    method: str = AUTO,
    params: Mapping[str, Any] | object | None = None,
) -> Repair:
    """Propose a repair for one artifact from evidence made by :func:`evidence_for`.

    Parameters, result and errors are those of :func:`propose`. The artifact's own samples are
    never believed, whatever the evidence says; nor are a few beside it, unless it is a gap or a
    peak, whose ends are known exactly.
    """
    if artifact.stop > evidence.take.frames:
        raise DataError(
            f"The interval of {artifact.marker} ends at frame {artifact.stop}, "
            f"the take has {evidence.take.frames}."
        )
    evidence = without_own(evidence, artifact)
    skeleton = evidence.take.skeleton
    with _threads().limit(limits=1):
        if skeleton and method == AUTO:
            return best_of_joint(evidence, artifact)
        if method != AUTO:
            found = find_method(method)
            done = found.run(evidence, artifact, read_params(found, params))
            if skeleton:
                # The detector that looks again knows markers, which do not tremble as joints do.
                return with_expected_error(evidence, artifact, done)
            return looked_at(evidence.take, with_expected_error(evidence, artifact, done))
        return best_repair(evidence, artifact)


def _alone(
    evidence: Evidence,
    artifact: Artifact,
    known: Sequence[Artifact],
    repaired: Mapping[Artifact, float],
    method: str = AUTO,
    params: Mapping[str, Any] | object | None = None,
) -> Repair:
    """Propose a repair for one artifact, whatever distances to others come of it."""
    twin = mirror(artifact, repaired)
    if twin is not None and method in (AUTO, "swap"):
        return refuse("swap", swapped_with(twin))
    done = measured(evidence, artifact, method, params)
    if not done.patches and repaired:
        take, mesh, progress = evidence.take, evidence.mesh, evidence.progress
        believing = evidence_for(take, known, mesh, believe_repairs=True, progress=progress)
        second = measured(believing, artifact, method, params)
        second = counting_references(believing, artifact, second, repaired)
        second = if_worth_it(artifact, if_good(second)) if method == AUTO else second
        if second.patches:
            return replace(second, reason=from_repairs(done.reason))
    if done.patches or method != AUTO:
        return done
    return follow_one(evidence, artifact, done)


def _among(
    evidence: Evidence,
    artifact: Artifact,
    done: Repair,
    known: Sequence[Artifact],
    repaired: Mapping[Artifact, float],
) -> Repair:
    """Draw a long repair to usual distances from its neighbours: seen, repaired, or still to be."""
    take = evidence.take
    if take.skeleton or not done.patches or stage_of(take, artifact) != LONG:
        return done
    near = {take.labels[tie.second] for tie in ties_of(evidence, take.index(artifact.marker))}
    missing = (
        a
        for a in known
        if a.marker in near
        and a.status in (Status.PENDING, Status.ACCEPTED)
        and a.overlaps(artifact.start, artifact.stop)
    )
    pairs = [(artifact, done), *((a, _alone(evidence, a, known, repaired)) for a in missing)]
    return at_usual_distances(evidence, pairs)[0][1]


def measured(
    evidence: Evidence,
    artifact: Artifact,
    method: str,
    params: Mapping[str, Any] | object | None = None,
    trials: int = TRIALS,
) -> Repair:
    """Propose a repair, and measure how far off it may be where its method does not say."""
    done = propose_from(evidence, artifact, method=method, params=params)
    if not trials:
        return done
    with _threads().limit(limits=1):
        return with_expected_error(evidence, artifact, done, methods=MODELS, trials=trials)


@cache
def _threads() -> ThreadpoolController:
    """The numerical libraries, looked for once: it takes as long as a short repair."""
    import scipy.linalg  # noqa: F401, which brings one of its own

    return ThreadpoolController()


def stage_of(take: Take, artifact: Artifact) -> int:
    """0 for swaps, 1 for what is short, ``LONG`` for the rest."""
    if artifact.kind is Kind.STEP and artifact.counterpart is not None:
        return 0
    return 1 if as_good_as_new(take, artifact) else LONG


def mirror(artifact: Artifact, done: Iterable[Artifact]) -> Artifact | None:
    """The same swap, told by another of its markers, that was already carried out, or None."""
    for a in done:
        if (
            a.marker != artifact.marker
            and set(a.markers) == set(artifact.markers)
            and a.overlaps(artifact.start, artifact.stop)
            and set(a.axes) & set(artifact.axes)
        ):
            return a
    return None


def from_repairs(reason: str) -> str:
    """Why repairs of other markers were believed."""
    return f"Worked out from other repairs; look at it closely. Without them: {reason}"


def swapped_with(twin: Artifact) -> str:
    """Why the second half of a swap has nothing left to do."""
    return f"Already exchanged together with {twin.marker}."
