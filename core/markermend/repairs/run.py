"""Proposing repairs for artifacts, and carrying them out on a take."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from threadpoolctl import ThreadpoolController

from markermend.artifact import Artifact, Kind, Status, damage_mask, in_order
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.patch import Patch, patched
from markermend.progress import Progress, quiet
from markermend.repairs.advice import MODELS, with_expected_error
from markermend.repairs.automatic import best_repair, counting_references, follow_one, if_good
from markermend.repairs.lengths import at_usual_distances
from markermend.repairs.look_again import looked_at
from markermend.repairs.registry import Evidence, Repair, find_method
from markermend.repairs.result import read_params, refuse, without_own
from markermend.take import Take

AUTO = "auto"
# A repair this short is as good as measured, and may serve as evidence for the next.
TRUSTED_REPAIR_S = 0.1
# Known stretches that are filled as well, to measure a named model of the body: so many for each
# artifact, fewer where a take has many, so that it takes at most twice as long then.
TRIALS, TRIALS_IN_ALL = 3, 300
# The last stage of repairing: what is neither a swap nor short.
LONG = 2


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
        if a.status is not Status.REPAIRED or not (believe_repairs or _as_good_as_new(take, a))
    ]
    trusted = take.present[:, :, None] & ~damage_mask(take, doubtful)
    trusted.flags.writeable = False
    return Evidence(take, trusted, mesh, progress or quiet)


def propose(
    take: Take,
    artifact: Artifact,
    artifacts: Iterable[Artifact] = (),
    *,
    method: str = AUTO,
    params: Mapping[str, Any] | object | None = None,
    mesh: Mesh | None = None,
    references: Sequence[str] = (),
    progress: Progress | None = None,
) -> Repair:
    """Propose a repair for one artifact, changing nothing.

    Beside what :func:`propose_from` does, models of the body that say nothing of their error are
    measured on known stretches of the marker nearby.

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
        evidence = _only(
            evidence_for(take, known, mesh, progress=progress), artifact.marker, references
        )
        if method == AUTO:
            method = "local_regression" if len(references) > 2 else "pattern"
        if method == "pattern" and params is None:
            params = {"donor": references[0]}
        return _measured(evidence, artifact, method, params)
    evidence = evidence_for(take, known, mesh, progress=progress)
    twin = _mirror(artifact, (a for a in others if a.status is Status.REPAIRED))
    if twin is not None and method in (AUTO, "swap"):
        return refuse("swap", _swapped(twin))
    done = _measured(evidence, artifact, method, params)
    if not done.patches and any(a.status is Status.REPAIRED for a in others):
        believing = evidence_for(take, known, mesh, believe_repairs=True, progress=progress)
        second = _measured(believing, artifact, method, params)
        if second.patches:
            return replace(second, reason=_from_repairs(done.reason))
    if done.patches or method != AUTO:
        return done
    return follow_one(evidence, artifact, done)


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
    if skeleton and method == AUTO:
        method = "skeleton"
    with _threads().limit(limits=1):
        if method != AUTO:
            found = find_method(method)
            done = found.run(evidence, artifact, read_params(found, params))
            if skeleton:
                # The detector that looks again knows markers, which do not tremble as joints do.
                return with_expected_error(evidence, artifact, done)
            return looked_at(evidence.take, with_expected_error(evidence, artifact, done))
        return best_repair(evidence, artifact)


def _measured(
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


def repair_all(
    take: Take,
    artifacts: Iterable[Artifact],
    *,
    others: Iterable[Artifact] = (),
    method: str = AUTO,
    min_confidence: float = 0.5,
    mesh: Mesh | None = None,
    progress: Progress | None = None,
) -> tuple[tuple[Artifact, Repair], ...]:
    """Propose a repair for every artifact that is sure enough and was not rejected.

    First come swaps, then peaks and what is no longer than 0.1 s, then the rest. What an
    earlier stage repaired is evidence for the next as far as :func:`evidence_for` believes it;
    within a stage all see the same evidence, so that their order does not matter. What cannot be
    repaired so, because whole limbs are missing, is tried once more believing all repairs, and
    the repair's reason says so. What is left then follows the one marker that is still seen and
    keeps its distance best, if that is expected to be near enough. Last, repairs of the same moment
    give way to each other where distances between markers would be unusual.

    The other parameters, and the errors, are those of :func:`repair`.

    Parameters
    ----------
    others : further known artifacts that are not repaired now, but not used as evidence either

    Returns
    -------
    Pairs of artifact and repair in the order of the stages: applying their patches one after
    the other gives what :func:`repair` returns. Models of the body that say nothing of their error
    are measured as in :func:`propose`; where there are more than a hundred artifacts on fewer
    known stretches each, on one at least.
    """
    return tuple(_run(take, artifacts, method, min_confidence, mesh, progress, others)[1])


def repair(
    take: Take,
    artifacts: Iterable[Artifact],
    *,
    method: str = AUTO,
    min_confidence: float = 0.5,
    mesh: Mesh | None = None,
    progress: Progress | None = None,
) -> Take:
    """Repair a take: every artifact that is sure enough and was not rejected.

    What cannot be repaired is left as it is, and samples are missing still where no artifact
    says that they should not be; :func:`repair_all` tells in which order it goes.

    Parameters
    ----------
    take : the recording
    artifacts : those to repair; rejected ones are believed, repaired ones not done again
    method : for all of them, ``"auto"`` chooses for each
    min_confidence : below it an artifact is left, though still not used as evidence
    mesh : the body's structure, if it was worked out before
    progress : told the share of artifacts done; may raise ``Cancelled``

    Returns
    -------
    Take
        a new one; only the artifacts' intervals and axes (and the counterparts' of a swap)
        differ, and their samples' origin says filled or edited

    Raises
    ------
    MethodError
        when there is no such method
    DataError
        when an artifact is of another take: no such marker, or an interval beyond its end
    """
    # A take says nothing of expected errors: a named model is not measured for it.
    return _run(take, artifacts, method, min_confidence, mesh, progress, measure=False)[0]


def _run(
    take: Take,
    artifacts: Iterable[Artifact],
    method: str,
    min_confidence: float,
    mesh: Mesh | None,
    progress: Progress | None,
    others: Iterable[Artifact] = (),
    *,
    measure: bool = True,
) -> tuple[Take, list[tuple[Artifact, Repair]]]:
    """Repair stage by stage; returns the repaired take and each artifact with its repair."""
    report = progress or quiet
    if method != AUTO:
        find_method(method)
    chosen = in_order(artifacts)
    ids = {a.id for a in chosen}
    known = [*chosen, *(a for a in others if a.id not in ids)]
    todo = [
        a
        for a in chosen
        if a.status not in (Status.REJECTED, Status.REPAIRED) and a.confidence >= min_confidence
    ]
    trials = min(TRIALS, max(1, TRIALS_IN_ALL // max(1, len(todo)))) if measure else 0
    pairs: list[tuple[Artifact, Repair]] = []
    swapped = [a for a in known if a.status is Status.REPAIRED]
    states = {a.id: a for a in known}

    def inner(share: float, doing: str) -> None:
        report((len(pairs) + share) / (len(todo) + 1), doing)

    for stage in range(LONG + 1):
        evidence = evidence_for(take, states.values(), mesh, progress=inner)
        patches: list[Patch] = []
        for artifact in (a for a in todo if _stage(take, a) == stage):
            report(len(pairs) / len(todo), f"Repairing {artifact.marker}")
            twin = _mirror(artifact, swapped)
            if twin is not None and method in (AUTO, "swap"):
                done = refuse("swap", _swapped(twin))
            else:
                done = _measured(evidence, artifact, method, trials=trials)
            pairs.append((artifact, done))
            if done.patches or twin is not None:
                patches.extend(done.patches)
                repaired = artifact.with_status(Status.REPAIRED)
                states[artifact.id] = repaired
                if done.method == "swap":
                    swapped.append(repaired)
        take = patched(take, patches) if patches else take
    evidence = evidence_for(take, states.values(), mesh, believe_repairs=True, progress=inner)
    errors = {a: r.error_mm or 0.0 for a, r in pairs if r.patches}
    again = [p for p in pairs if states[p[0].id].status is not Status.REPAIRED]
    for artifact, refused in again:
        done = _measured(evidence, artifact, method, trials=trials)
        done = counting_references(evidence, artifact, done, errors)
        done = if_good(done) if method == AUTO else done
        if done.patches:
            pairs.remove((artifact, refused))
            pairs.append((artifact, replace(done, reason=_from_repairs(refused.reason))))
            take = patched(take, done.patches)
    left = [p for p in again if p in pairs and method == AUTO]
    evidence = evidence_for(take, states.values(), mesh, progress=inner) if left else evidence
    for artifact, refused in left:
        pairs.remove((artifact, refused))
        pairs.append((artifact, follow_one(evidence, artifact, refused)))
        take = patched(take, pairs[-1][1].patches)
    if method == AUTO and not take.skeleton:
        take, pairs = _give_way(take, pairs)
    report(1.0, "Repaired")
    return take, pairs


def _give_way(
    take: Take, pairs: list[tuple[Artifact, Repair]]
) -> tuple[Take, list[tuple[Artifact, Repair]]]:
    """Draw long repairs of the same moment to usual distances from each other."""
    long = [n for n, (a, _) in enumerate(pairs) if _stage(take, a) == LONG]
    settled = dict(zip(long, at_usual_distances(take, [pairs[n] for n in long]), strict=True))
    moved = [pair[1] for n, pair in settled.items() if pair is not pairs[n]]
    pairs = [settled.get(n, pair) for n, pair in enumerate(pairs)]
    return patched(take, (p for repair in moved for p in repair.patches)), pairs


@cache
def _threads() -> ThreadpoolController:
    """The numerical libraries, looked for once: it takes as long as a short repair."""
    import scipy.linalg  # noqa: F401, which brings one of its own

    return ThreadpoolController()


def _stage(take: Take, artifact: Artifact) -> int:
    """0 for swaps, 1 for what is short, ``LONG`` for the rest."""
    if artifact.kind is Kind.STEP and artifact.counterpart is not None:
        return 0
    return 1 if _as_good_as_new(take, artifact) else LONG


def _as_good_as_new(take: Take, artifact: Artifact) -> bool:
    """Whether a repair of this artifact invents so little that it may be believed."""
    swap = artifact.kind is Kind.STEP and artifact.counterpart is not None
    return swap or artifact.kind is Kind.PEAK or artifact.length <= TRUSTED_REPAIR_S * take.rate


def _only(evidence: Evidence, marker: str, references: Sequence[str]) -> Evidence:
    """Evidence that believes these markers, and the marker's own samples, only."""
    take = evidence.take
    believed = [take.index(label) for label in {marker, *references}]
    trusted = np.zeros_like(evidence.trusted)
    trusted[:, believed] = evidence.trusted[:, believed]
    return replace(evidence, trusted=trusted)


def _mirror(artifact: Artifact, done: Iterable[Artifact]) -> Artifact | None:
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


def _from_repairs(reason: str) -> str:
    """Why repairs of other markers were believed."""
    return f"Worked out from other repairs; look at it closely. Without them: {reason}"


def _swapped(twin: Artifact) -> str:
    """Why the second half of a swap has nothing left to do."""
    return f"Already exchanged together with {twin.marker}."
