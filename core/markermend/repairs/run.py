"""Repairing many artifacts, stage by stage."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from numbers import Real
from typing import Any

from markermend.artifact import Artifact, Status, in_order
from markermend.errors import MethodError
from markermend.mesh import Mesh
from markermend.parameters import read_params
from markermend.patch import Patch, patched
from markermend.progress import Progress, quiet
from markermend.repairs.automatic import counting_references, follow_one, if_good, if_worth_it
from markermend.repairs.lengths import at_usual_distances
from markermend.repairs.proposing import (
    AUTO,
    LONG,
    TRIALS,
    from_repairs,
    measured,
    mirror,
    stage_of,
    swapped_with,
)
from markermend.repairs.registry import Evidence, Repair, find_method
from markermend.repairs.result import refuse
from markermend.repairs.trust import evidence_for
from markermend.take import Take

# Where a take has many artifacts fewer known stretches are filled for each, so that measuring a
# named model takes at most twice as long.
TRIALS_IN_ALL = 300


def repair_all(
    take: Take,
    artifacts: Iterable[Artifact],
    *,
    others: Iterable[Artifact] = (),
    method: str = AUTO,
    min_confidence: float = 0.5,
    mesh: Mesh | None = None,
    params: Mapping[str, Any] | object | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> tuple[tuple[Artifact, Repair], ...]:
    """Propose a repair for every artifact that is sure enough and was not rejected.

    First come swaps, then peaks and what is no longer than 0.1 s, then the rest. What an
    earlier stage repaired is evidence for the next as far as :func:`evidence_for` believes it;
    within a stage all see the same evidence, so that their order does not matter. What cannot be
    repaired so, because whole limbs are missing, is tried once more believing all repairs, and
    the repair's reason says so. What is left then follows the one marker that is still seen and
    keeps its distance best, if that is expected to be near enough. Last, long repairs are drawn to
    usual distances from markers beside them, and those of the same moment give way to each other.

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
    given = _params_of(method, params, settings)
    return tuple(_run(take, artifacts, method, given, min_confidence, mesh, progress, others)[1])


def repair(
    take: Take,
    artifacts: Iterable[Artifact],
    *,
    method: str = AUTO,
    min_confidence: float = 0.5,
    mesh: Mesh | None = None,
    params: Mapping[str, Any] | object | None = None,
    progress: Progress | None = None,
    **settings: Any,
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
    params : of a named method, as a mapping or its dataclass; None for the defaults
    progress : told the share of artifacts done; may raise ``Cancelled``
    settings : single parameters by name, ``context=50``

    Returns
    -------
    Take
        a new one; only the artifacts' intervals and axes (and the counterparts' of a swap)
        differ, and their samples' origin says filled or edited

    Raises
    ------
    MethodError
        when there is no such method, or a parameter, or ``min_confidence``, is unknown or out of
        range
    DataError
        when an artifact is of another take: no such marker, or an interval beyond its end
    """
    # A take says nothing of expected errors: a named model is not measured for it.
    given = _params_of(method, params, settings)
    return _run(take, artifacts, method, given, min_confidence, mesh, progress, measure=False)[0]


def _params_of(method: str, params: Any, settings: Mapping[str, Any]) -> Any:
    """Parameters of a named method, None where none are given; ``auto`` has none."""
    named = None if method == AUTO else find_method(method)
    if params is None and not settings:
        return None
    if named is None:
        raise MethodError(f"“{AUTO}” has no parameters; name the method that they belong to.")
    return read_params(named, params, settings)


def _run(
    take: Take,
    artifacts: Iterable[Artifact],
    method: str,
    params: Any,
    min_confidence: float,
    mesh: Mesh | None,
    progress: Progress | None,
    others: Iterable[Artifact] = (),
    *,
    measure: bool = True,
) -> tuple[Take, list[tuple[Artifact, Repair]]]:
    """Repair stage by stage; returns the repaired take and each artifact with its repair."""
    report = progress or quiet
    if not (isinstance(min_confidence, Real) and 0.0 <= min_confidence <= 1.0):
        raise MethodError(f"min_confidence goes from 0 to 1, not {min_confidence!r}.")
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
        for artifact in (a for a in todo if stage_of(take, a) == stage):
            report(len(pairs) / len(todo), f"Repairing {artifact.marker}")
            twin = mirror(artifact, swapped)
            if twin is not None and method in (AUTO, "swap"):
                done = refuse("swap", swapped_with(twin))
            else:
                done = measured(evidence, artifact, method, params, trials)
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
        done = measured(evidence, artifact, method, params, trials)
        done = counting_references(evidence, artifact, done, errors)
        done = if_worth_it(artifact, if_good(done)) if method == AUTO else done
        if done.patches:
            pairs.remove((artifact, refused))
            pairs.append((artifact, replace(done, reason=from_repairs(refused.reason))))
            take = patched(take, done.patches)
    left = [p for p in again if p in pairs and method == AUTO]
    evidence = evidence_for(take, states.values(), mesh, progress=inner) if left else evidence
    for artifact, refused in left:
        pairs.remove((artifact, refused))
        pairs.append((artifact, follow_one(evidence, artifact, refused)))
        take = patched(take, pairs[-1][1].patches)
    if method == AUTO and not take.skeleton:
        evidence = evidence_for(take, states.values(), mesh, progress=inner)
        take, pairs = _give_way(evidence, pairs)
    report(1.0, "Repaired")
    return take, pairs


def _give_way(
    evidence: Evidence, pairs: list[tuple[Artifact, Repair]]
) -> tuple[Take, list[tuple[Artifact, Repair]]]:
    """Draw long repairs to usual distances from what is seen, and from each other."""
    take = evidence.take
    long = [n for n, (a, _) in enumerate(pairs) if stage_of(take, a) == LONG]
    settled = dict(zip(long, at_usual_distances(evidence, [pairs[n] for n in long]), strict=True))
    moved = [pair[1] for n, pair in settled.items() if pair is not pairs[n]]
    pairs = [settled.get(n, pair) for n, pair in enumerate(pairs)]
    return patched(take, (p for repair in moved for p in repair.patches)), pairs
