"""Markers that slide to another place of the body and stay there.

No frame of such damage looks wrong, and nothing comes back. What is left is that the marker lies
elsewhere among its neighbours from some moment on. So does any marker when the posture changes;
therefore its place in the frame of its most rigid neighbours is regressed on the posture, theirs
and the whole body's, together with one lasting shift. Posture that changes at the same moment
takes the shift upon itself. What is told about must be the only shift the marker needs: skin and
postures never seen before leave several.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
    median_of_seen,
    quantile_of_seen,
)
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import in_mm
from markermend.detectors.joint.body import belief
from markermend.predictors.local import align
from markermend.take import AXES, Take

RATE_HZ, MOST_FRAMES = 10.0, 600
"""What is looked at: a place on the body needs no more."""
LEAST_SIDE, LEAST_FRAMES = 15, 90
"""Of those frames, how many must lie on either side of a shift, and how many in all."""
MATES, WITNESSES = 6, 16
"""Neighbours that hold the frame, and markers that tell the posture of the body."""
LAG, USUAL, FAR = 10, 0.75, 0.005
"""Neighbours are rigid when distances change little from frame to frame so far on, in most of
the frames; of equals the nearer."""
TERMS = 4
"""Principal components of either, each with its square."""
RAMP = 10
"""Frames, of those looked at, that a marker is supposed to slide."""
LEAST_MM, LEAST_SCORE = 8.0, 6.0
"""A shift, and how many times what the regression leaves over it is."""
LARGEST_REST_MM = 7.0
"""A frame that leaves more over holds no place to speak of."""
OWN = 0.3
"""Share of a shift that posture does not share; with less it may be posture's altogether."""
ONCE = 2.0
"""It must be so many times the next shift that would explain most."""
DUST_MM = 0.3


@dataclass(frozen=True)
class Shift:
    """A lasting shift of one marker.

    Attributes
    ----------
    marker : its position among those looked at
    frame : at which it begins, of the thinned take
    size_mm : how far
    score : that over what the regression leaves over in its direction
    again : the same of the next shift that would explain most
    own : share of the shift that posture does not share
    rest_mm : root mean square of what is left over on an axis
    """

    marker: int
    frame: int
    size_mm: float
    score: float
    again: float
    own: float
    rest_mm: float

    @property
    def lasting(self) -> bool:
        """Whether it is beyond doubt."""
        return (
            self.score >= max(LEAST_SCORE, ONCE * self.again)
            and self.size_mm >= LEAST_MM
            and self.own >= OWN
            and self.rest_mm <= LARGEST_REST_MM
        )


def find_shifted(take: Take, markers: Sequence[int], trusted: BoolArray) -> list[Artifact]:
    """Find markers that slid to another place of the body and stay there.

    Parameters
    ----------
    take : the recording
    markers : columns looked at
    trusted : (frames, markers of the take) bool, samples to be believed

    Returns
    -------
    Slow changes of all axes, from the beginning of the slide to the end of the take
    """
    thin = max(1, round(take.rate / RATE_HZ), -(-take.frames // MOST_FRAMES))
    x = take.positions[::thin, markers].copy()
    x[~trusted[::thin, markers]] = np.nan
    if len(x) < LEAST_FRAMES:
        return []
    found: list[Artifact] = []
    change, steady = _changes(x), np.ones(len(markers), dtype=bool)
    while True:
        shifts = [
            shift
            for m in np.flatnonzero(steady).tolist()
            if (shift := shift_of(x, change, steady, m))
        ]
        lasting = [s for s in shifts if s.lasting]
        if not lasting:
            return found
        # A neighbour's frame is drawn along; so the surest first, then the others without it.
        surest = max(lasting, key=lambda s: s.score)
        steady[surest.marker] = False
        found.append(_artifact(take, markers[surest.marker], surest, thin))


def _changes(x: FloatArray) -> FloatArray:
    """(markers, markers) how much a distance usually changes in a second; a slide hardly counts.

    Infinite where the two are seldom seen together.
    """
    count = x.shape[1]
    change = np.full((count, count), np.inf)
    seen = ~np.isnan(x[:, :, 0])
    often = (seen.T.astype(np.float64) @ seen) >= 0.5 * len(x)
    for i in range(count - 1):
        apart = np.sqrt(((x[:, i + 1 :] - x[:, [i]]) ** 2).sum(axis=2))
        moved = quantile_of_seen(np.abs(apart[LAG:] - apart[:-LAG]), USUAL)
        moved += FAR * median_of_seen(apart)
        moved = np.where(often[i, i + 1 :], np.nan_to_num(moved, nan=np.inf), np.inf)
        change[i, i + 1 :] = change[i + 1 :, i] = moved
    return change


def shift_of(x: FloatArray, change: FloatArray, steady: BoolArray, marker: int) -> Shift | None:
    """The lasting shift that explains most of a marker's place on the body.

    Parameters
    ----------
    x : (frames, markers, 3) mm, thinned
    change : (markers, markers) how much their distances vary
    steady : (markers,) bool, those that may tell where the body is
    marker : column

    Returns
    -------
    None when too little is seen
    """
    others = np.where(steady, change[marker], np.inf)
    mates = np.argsort(others, kind="stable")[:MATES]
    mates = mates[np.isfinite(others[mates])]
    seen = ~np.isnan(x[:, :, 0])
    often = np.flatnonzero(steady & (seen.mean(axis=0) > 0.95) & (np.arange(len(steady)) != marker))
    body = often[np.linspace(0, len(often) - 1, min(WITNESSES, len(often))).astype(int)]
    at = np.flatnonzero(seen[:, [marker, *mates, *body]].all(axis=1))
    if len(mates) < MATES or len(body) < MATES or len(at) < LEAST_FRAMES:
        return None
    inner = align(x[at][:, mates]).to_local(x[at][:, [*mates, marker]])
    i, j = np.triu_indices(len(body), 1)
    whole = np.linalg.norm(x[at][:, body[i]] - x[at][:, body[j]], axis=2)
    posture = [_components(inner[:, :-1].reshape(len(at), -1)), _components(whole)]
    bent = [np.clip(p, -3.0, 3.0) ** 2 for p in posture]
    design = np.hstack([np.ones((len(at), 1)), *posture, *bent])
    return _judged(marker, at, inner[:, -1], design)


def _components(values: FloatArray) -> FloatArray:
    """(frames, k) first principal components, of variance 1."""
    centred = values - values.mean(axis=0)
    power, turn = np.linalg.eigh(centred.T @ centred)
    most = np.maximum(power[-TERMS:], np.finfo(np.float64).tiny)
    return np.asarray(centred @ (turn[:, -TERMS:] * np.sqrt(len(values) / most)))


def _judged(marker: int, at: IntArray, place: FloatArray, design: FloatArray) -> Shift | None:
    """The best shift beside a regression, and the best one after that."""
    begin = np.arange(LEAST_SIDE, int(at[-1]) - RAMP, 2)
    ramps = np.clip((at[:, None] - begin) / RAMP, 0.0, 1.0)
    inside = ((ramps == 0).sum(axis=0) >= LEAST_SIDE) & ((ramps == 1).sum(axis=0) >= LEAST_SIDE)
    begin, ramps = begin[inside], ramps[:, inside]
    if not len(begin):
        return None
    raw = ((ramps - ramps.mean(axis=0)) ** 2).sum(axis=0)
    base, _ = np.linalg.qr(design)
    ramps, rest = ramps - base @ (base.T @ ramps), place - base @ (base.T @ place)
    free = len(at) - design.shape[1] - 1
    power = (ramps**2).sum(axis=0)
    size = (ramps.T @ rest) / power[:, None]
    left = rest.T @ rest - power[:, None, None] * size[:, :, None] * size[:, None]
    covariance = left / free + DUST_MM**2 * np.eye(3)
    score = np.sqrt(np.einsum("si,sij,sj->s", size, np.linalg.inv(covariance), size))
    # Where the likelihood is largest, not the score: few frames make large ones by chance.
    best = int(np.argmax(score**2 * power))
    # The same again, with this one taken out.
    unit = ramps[:, best] / np.sqrt(power[best])
    ramps, rest = ramps - np.outer(unit, unit @ ramps), rest - np.outer(unit, unit @ rest)
    other = (ramps**2).sum(axis=0)
    tells = other > 0.1 * raw
    more = (ramps.T @ rest)[tells] / other[tells, None]
    again = np.sqrt(np.einsum("si,ij,sj->s", more, np.linalg.inv(covariance[best]), more))
    again = again[np.argsort(-(again**2) * other[tells])][:1]
    return Shift(
        marker=int(marker),
        frame=int(begin[best]),
        size_mm=float(np.linalg.norm(size[best])),
        score=float(score[best]),
        again=float(again.max(initial=0.0)),
        own=float(power[best] / raw[best]),
        rest_mm=float(np.sqrt(np.trace(covariance[best]) / 3)),
    )


def _artifact(take: Take, marker: int, shift: Shift, thin: int) -> Artifact:
    """The shift in words."""
    start = shift.frame * thin
    return Artifact(
        take.labels[marker],
        AXES,
        start,
        take.frames,
        Kind.SLOW,
        confidence=belief(shift.score, 0.5 * LEAST_SCORE),
        amplitude_mm=shift.size_mm,
        why=(
            f"lies {in_mm(shift.size_mm)} mm from its place among its neighbours from here to the "
            f"end of the take, {shift.score:.0f} times what posture leaves open: it slid on the "
            "body or is coming off"
        ),
    )
