"""What the file's own residuals and camera counts say about jumps.

A marker mostly jumps when another set of cameras sees it, and then its residual changes in the
same frame. How telling that is differs from system to system, so the take itself is asked: how
often the residual changes at the surest artifacts, and how often at the same intervals moved
elsewhere. The ratio of the two is the weight of this evidence (Bayes' rule on the odds); where
both are alike, as in a smoothed or an edited take, it weighs nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact
from markermend.detectors.finding import in_mm
from markermend.take import Take

UNUSUAL = 0.9
"""A change larger than this share of a marker's changes is one to speak of…"""
LEAST_CHANGE = 0.1
"""…if it is also by a tenth."""
DUST_MM = 0.1
SURE, LEAST_SURE = 0.9, 20
"""How sure artifacts must be to be asked about, and how many there must be."""
TELLING = 0.3
"""Least share of sure artifacts at which the residual changes; below, it is chance."""
SHIFTS_S = (-1.3, -0.7, 0.7, 1.3)
LARGEST_WEIGHT = 5.0


@dataclass(frozen=True, eq=False)
class Witness:
    """Residuals of a take as evidence.

    Attributes
    ----------
    hit : (frames, markers) float64: 1 where residual or camera count changes with that frame, 0
        where not, NaN where it is not known
    at_jumps, elsewhere : how often it changes at an edge of sure artifacts, and of moved ones
    """

    hit: FloatArray
    at_jumps: float
    elsewhere: float


def ask(take: Take, artifacts: Sequence[Artifact]) -> Witness | None:
    """Find out how telling the residuals of a take are.

    Parameters
    ----------
    take : the recording
    artifacts : sudden ones; the surest are believed

    Returns
    -------
    None without residuals, with fewer than 20 sure artifacts, or when the residuals seldom change
    at them
    """
    sure = [a for a in artifacts if a.confidence >= SURE]
    if take.residuals is None or len(sure) < LEAST_SURE:
        return None
    hit = _changes(take)
    here = [h for h in (_hit(take, hit, a, 0) for a in sure) if h is not None]
    shifts = [round(s * take.rate) for s in SHIFTS_S]
    away = [h for a in sure for s in shifts if (h := _hit(take, hit, a, s)) is not None]
    if len(here) < LEAST_SURE or len(away) < LEAST_SURE:
        return None
    witness = Witness(hit, _share(here), _share(away))
    return witness if witness.at_jumps >= max(TELLING, witness.elsewhere) else None


def with_witness(take: Take, artifacts: Sequence[Artifact], witness: Witness) -> list[Artifact]:
    """Believe artifacts more or less by what the residuals say, and say so.

    Parameters
    ----------
    take : the recording
    artifacts : sudden ones
    witness : from :func:`ask`

    Returns
    -------
    The artifacts; the odds of each change fivefold at most
    """
    told = []
    for a in artifacts:
        hit = _hit(take, witness.hit, a, 0)
        if hit is None:
            told.append(a)
            continue
        weight = witness.at_jumps / witness.elsewhere
        if not hit:
            weight = (1 - witness.at_jumps) / (1 - witness.elsewhere)
        weight = float(np.clip(weight, 1 / LARGEST_WEIGHT, LARGEST_WEIGHT))
        sure = a.confidence * weight / (1 - a.confidence + a.confidence * weight)
        words = _words(take, a, witness.hit) if hit and weight > 1 else ""
        told.append(replace(a, confidence=sure, why=a.why + words))
    return told


def _changes(take: Take) -> FloatArray:
    """Where residual or camera count changes, see :class:`Witness`."""
    assert take.residuals is not None
    level = np.log(take.residuals.astype(np.float64) + DUST_MM)
    change = np.full(level.shape, np.nan)
    change[1:] = np.abs(np.diff(level, axis=0))
    known = np.isfinite(change)
    hit = np.full(level.shape, np.nan)
    for marker in np.flatnonzero(known.any(axis=0)):
        column = change[:, marker]
        limit = max(float(np.nanquantile(column, UNUSUAL)), LEAST_CHANGE)
        hit[:, marker] = np.where(known[:, marker], column > limit, np.nan)
    if take.cameras is not None:
        other = np.zeros(level.shape, dtype=bool)
        other[1:] = take.cameras[1:] != take.cameras[:-1]
        hit = np.where(known & other, 1.0, hit)
    return hit


def _edges(take: Take, a: Artifact, shift: int) -> list[int]:
    """Frames with which an artifact begins and has ended, moved by some frames."""
    return [f for f in (a.start + shift, a.stop + shift) if 0 < f < take.frames]


def _hit(take: Take, hit: FloatArray, a: Artifact, shift: int) -> bool | None:
    """Whether the residual changes at an edge; None when that is not known."""
    values = hit[_edges(take, a, shift), take.index(a.marker)]
    values = values[np.isfinite(values)]
    return bool(values.any()) if len(values) else None


def _share(hits: Sequence[bool]) -> float:
    """Share of hits, never quite none or all."""
    return (sum(hits) + 1) / (len(hits) + 2)


def _words(take: Take, a: Artifact, hit: FloatArray) -> str:
    """What changes, at the first edge where something does."""
    assert take.residuals is not None
    marker = take.index(a.marker)
    frame = next(f for f in _edges(take, a, 0) if hit[f, marker] == 1.0)
    before, after = (float(r) for r in take.residuals[frame - 1 : frame + 1, marker])
    if take.cameras is not None:
        old, new = (int(c) for c in take.cameras[frame - 1 : frame + 1, marker])
        if old != new:
            return f"; {new} cameras see it instead of {old}"
    return f"; its residual changes there from {in_mm(before)} mm to {in_mm(after)} mm"
