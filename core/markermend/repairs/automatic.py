"""The repair that is made when no method is named: the usual one's, or that of a better one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import in_mm
from markermend.repairs.advice import with_expected_error
from markermend.repairs.body_frame import rank_references
from markermend.repairs.choice import LONGEST_SPLINE_S, alternatives, choose
from markermend.repairs.look_again import looked_at
from markermend.repairs.registry import Evidence, Repair, find_method
from markermend.repairs.result import MEAN_OVER_RMS, without_own
from markermend.take import Take

# What is expected to be further off than this is left, unless a method is named.
MOST_ERROR_MM = 50.0
# A repair that leaves damage gives way to one that leaves none and errs up to this much more: so
# many times, and what no camera can tell on top.
HARDLY_FURTHER, UNTOLD_MM = 1.5, 0.2
# One that is expected to be further off than this gives way to one expected to be so much nearer.
DOUBTFUL_MM, FAR_NEARER = 5.0, 2.0 / 3.0
# How far noise strays at a time, over its scatter along one axis.
NOISE_STRAYS = 2.0
# References that hold the frame in which a marker is looked for.
HOLDING = 4


def best_repair(evidence: Evidence, artifact: Artifact) -> Repair:
    """The usual method's proposal, or that of the first other that does better.

    Another is taken where the usual one cannot repair, where the detector would find damage in its
    result, none in the other's, and the other is expected to be hardly further off, and where over
    more than a moment the other is expected to be far nearer.

    Parameters
    ----------
    evidence : what may be believed
    artifact : what is to be repaired

    Returns
    -------
    Repair
        without patches, and with the reason, when it cannot be repaired well
    """
    usual = _by_defaults(evidence, artifact, choose(artifact))
    doubtful = _doubtful(evidence.take, artifact, usual)
    if usual.patches and not usual.leaves and not doubtful:
        return usual
    best = usual
    for name in alternatives(evidence.take, artifact):
        other = _by_defaults(evidence, artifact, name)
        if not other.patches:
            continue
        if not usual.patches and not (best.patches and other.leaves):
            best = replace(other, reason=_instead_of(usual))
        elif not other.leaves and doubtful and _as_near(other, usual, FAR_NEARER, 0.0):
            further = f"about {usual.error_mm:.0f} mm off"
            best = replace(other, reason=f"{find_method(usual.method).label} may be {further}.")
        elif usual.leaves and not other.leaves and _as_near(other, usual):
            best = replace(other, reason=f"{find_method(usual.method).label} would leave damage.")
        if not best.leaves:
            break
    return best


def follow_one(evidence: Evidence, artifact: Artifact, refused: Repair) -> Repair:
    """The last resort over what no curve reaches: follow the one marker that keeps its distance.

    Parameters
    ----------
    evidence : what may be believed, without repairs that invent much
    artifact : what is to be repaired
    refused : why nothing else repairs it

    Returns
    -------
    Repair
        by the pattern, with the reason why; `refused` where that cannot repair well either, where
        the interval is short, and in skeleton recordings
    """
    take = evidence.take
    if take.skeleton or artifact.length <= LONGEST_SPLINE_S * take.rate:
        return refused
    done = _by_defaults(without_own(evidence, artifact), artifact, "pattern")
    return replace(done, reason=_instead_of(refused)) if done.patches else refused


def _instead_of(refused: Repair) -> str:
    """Why another method than the usual one repairs it."""
    return f"{find_method(refused.method).label} is not used: {refused.reason}"


def _doubtful(take: Take, artifact: Artifact, usual: Repair) -> bool:
    """Whether a proposal is so far off that another may be far nearer."""
    longer = artifact.length > LONGEST_SPLINE_S * take.rate
    return longer and usual.error_mm is not None and usual.error_mm > DOUBTFUL_MM


def _as_near(
    other: Repair, usual: Repair, times: float = HARDLY_FURTHER, more_mm: float = UNTOLD_MM
) -> bool:
    """Whether a proposal is expected to be hardly further off than another, or so much nearer."""
    if other.error_mm is None or usual.error_mm is None:
        return False
    return other.error_mm <= times * usual.error_mm + more_mm


def _by_defaults(evidence: Evidence, artifact: Artifact, name: str) -> Repair:
    """Run a method with its default parameters; none where it would be too far off."""
    method = find_method(name)
    done = method.run(evidence, artifact, method.params())
    done = looked_at(evidence.take, if_good(with_expected_error(evidence, artifact, done)))
    return if_worth_it(artifact, done)


def if_worth_it(artifact: Artifact, proposed: Repair) -> Repair:
    """The proposal, or none with the reason where what is there is expected to be nearer.

    Parameters
    ----------
    artifact : what is to be repaired; of one whose size is not known, as of a gap, nothing is
        known to be nearer
    proposed : its repair, looked at again

    Returns
    -------
    Repair
        without patches, and with the reason, when it may be further off than the artifact is large,
        or would leave something larger in its place
    """
    size = artifact.amplitude_mm
    if not proposed.patches or not math.isfinite(size):
        return proposed
    reason = ""
    # What reaches beyond it was there before.
    made = [a for a in proposed.leaves or () if artifact.start <= a.start < a.stop <= artifact.stop]
    worst = max(made, key=lambda a: a.amplitude_mm, default=None)
    # Noise is measured by its scatter along an axis, and strays further in space.
    most = size * (NOISE_STRAYS if artifact.kind is Kind.NOISE else 1.0)
    if proposed.error_mm is not None and proposed.error_mm > most:
        off = f"{in_mm(proposed.error_mm)} mm off"
        reason = f"The result may be {off}, more than the {in_mm(size)} mm that it would mend."
    elif worst is not None and worst.amplitude_mm > size:
        left = f"a {worst.kind} of {in_mm(worst.amplitude_mm)} mm"
        reason = f"It would leave more damage than it mends: {left}."
    return replace(proposed, patches=(), reason=reason) if reason else proposed


def if_good(proposed: Repair) -> Repair:
    """The proposal, or none with the reason where it is expected to be too far off."""
    if proposed.error_mm is None or proposed.error_mm <= MOST_ERROR_MM:
        return proposed
    reason = f"The result would be about {proposed.error_mm:.0f} mm off; too far to be used."
    return replace(proposed, patches=(), reason=reason)


def counting_references(
    evidence: Evidence, artifact: Artifact, repair: Repair, repaired: Mapping[Artifact, float]
) -> Repair:
    """Say that a repair that follows other repairs is no surer than these.

    Parameters
    ----------
    evidence : on which it rests
    artifact : what is repaired
    repair : the proposal
    repaired : artifacts that were repaired before, and how far off each may be, mm

    Returns
    -------
    Repair
        with the largest error of its four nearest references added to its own and to its band
    """
    if not repair.patches or repair.error_mm is None:
        return repair
    take, interval = evidence.take, slice(artifact.start, artifact.stop)
    nearest, _ = rank_references(take, evidence.seen, take.index(artifact.marker), interval)
    errors = [
        max(
            (
                error
                for a, error in repaired.items()
                if a.marker == take.labels[column] and a.overlaps(artifact.start, artifact.stop)
            ),
            default=0.0,
        )
        for column in nearest[:HOLDING]
    ]
    theirs = max(errors, default=0.0)
    band = repair.band_mm
    return replace(
        repair,
        error_mm=float(np.hypot(repair.error_mm, theirs)),
        band_mm=None if band is None else np.hypot(band, theirs / MEAN_OVER_RMS),
    )
