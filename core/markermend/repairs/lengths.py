"""Repaired markers, put back at their usual distances from each other and from those beside them.

Each was repaired by itself, from what was still seen. Where that took it further from a marker
beside it or nearer to it than they otherwise are, it gives way; so do both, the less sure one the
more, where both were repaired.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import gaussian_filter1d

from markermend.arrays import FloatArray, IntArray
from markermend.artifact import Artifact
from markermend.patch import Patch, write_patches
from markermend.repairs.look_again import looked_at
from markermend.repairs.registry import Evidence, Repair
from markermend.take import AXES, Take, is_unlabelled

Pair = tuple[Artifact, Repair]

NEAREST = 3
"""Distances to this many others are held, those that vary least."""
UNUSUAL, NEVER = 0.01, 0.0
"""Outer shares of the distances seen that count as unusual (as Tits and others, 2018, eq. 25).

Where one marker alone was gone, only what never was seen: its neighbours tell well where it is,
also in a rare pose, and to draw it back from there errs more than it mends.
"""
LOOSEST_MM = 60.0
"""Distances that vary more are none of a body part."""
LEAST_SLACK_MM, SLACK, ROUNDS = 0.3, 0.5, 6
"""How exactly they are held, at most and by how much they vary, and steps towards it."""
SMOOTH_S = 0.04
"""Over which a move is spread, so that it sets in and ends smoothly."""
LEAST_SEEN, LOOKED_AT = 20, 400
"""Frames in which two are seen together, at least and about at most."""
SUREST_MM2, FIXED, LEAST_MM = 1e-4, 1e6, 1e-9


@dataclass(frozen=True)
class Tie:
    """Two columns, the limits of their usual distance, and how exactly it is held, in mm."""

    first: int
    second: int
    low: float
    high: float
    slack: float


def at_usual_distances(evidence: Evidence, pairs: Sequence[Pair]) -> list[Pair]:
    """Move repairs so that distances to the markers beside them stay as they are elsewhere.

    Parameters
    ----------
    evidence : the take, with these repairs or without, and the samples that tell what is usual
    pairs : artifacts and their repairs; those of three axes that tell their deviation are moved,
        those that share frames together

    Returns
    -------
    The pairs in their order, with new values where a distance was unusual. The expected errors
    stay: what is gained is not promised.
    """
    take = evidence.take
    result = list(pairs)
    for together in _together([artifact for artifact, _ in pairs]):
        group = [n for n in together if _movable(pairs[n][1])]
        if not group:
            continue
        columns = {take.index(pairs[n][0].marker) for n in group}
        unusual = UNUSUAL if len({pairs[n][0].marker for n in together}) > 1 else NEVER
        wanted = {
            (min(t.first, t.second), max(t.first, t.second)): t
            for column in columns
            for t in ties_of(evidence, column, unusual)
        }
        if not wanted:
            continue
        put = [patch for n in sorted(together) for patch in pairs[n][1].patches]
        moved = _settled(take, put, [pairs[n] for n in group], list(wanted.values()))
        for n, values in zip(group, moved, strict=True):
            artifact, repair = pairs[n]
            if values is not None:
                patch = replace(repair.patches[0], values=values)
                result[n] = artifact, looked_at(take, replace(repair, patches=(patch,)), put)
    return result


def _movable(repair: Repair) -> bool:
    """Whether a repair puts whole samples of one marker, and tells how sure they are."""
    whole = len(repair.patches) == 1 and repair.patches[0].axes == AXES
    return whole and repair.band_mm is not None


def _together(artifacts: Sequence[Artifact]) -> list[list[int]]:
    """Groups of artifacts that share frames, directly or by way of others."""
    groups: list[list[int]] = []
    stop = 0
    for n in sorted(range(len(artifacts)), key=lambda n: artifacts[n].start):
        if not groups or artifacts[n].start >= stop:
            groups.append([])
        groups[-1].append(n)
        stop = max(stop, artifacts[n].stop)
    return groups


def ties_of(evidence: Evidence, column: int, unusual: float = UNUSUAL) -> list[Tie]:
    """The distances of a marker that vary least, with what is usual for them.

    Parameters
    ----------
    evidence : the take, and which of its samples are looked at
    column : of the marker; it is the first of each tie
    unusual : outer share of the distances seen that is not usual, on either side

    Returns
    -------
    At most three, the steadiest first, to named markers of the same subject
    """
    take = evidence.take
    rows = np.flatnonzero(evidence.seen[:, column])
    rows = rows[:: max(1, len(rows) // LOOKED_AT)]
    apart = np.zeros((len(rows), take.markers))
    for axis in range(3):
        near = take.positions[rows, :, axis]
        apart += (near - near[:, [column]]) ** 2
    np.sqrt(apart, out=apart)
    apart[~evidence.seen[rows]] = np.nan
    subject = take.subject(take.labels[column])
    strangers = [is_unlabelled(n) or take.subject(n) != subject for n in take.labels]
    apart[:, strangers] = np.nan
    often = np.flatnonzero((~np.isnan(apart)).sum(axis=0) >= LEAST_SEEN)
    often = often[often != column]
    spread = np.nanstd(apart[:, often], axis=0)
    best = np.argsort(spread, kind="stable")[:NEAREST]
    best = best[spread[best] < LOOSEST_MM]
    steady, slack = often[best], np.maximum(LEAST_SLACK_MM, SLACK * spread[best])
    limits = np.nanquantile(apart[:, steady], [unusual, 1.0 - unusual], axis=0)
    return [
        Tie(column, int(other), float(low), float(high), float(loose))
        for other, low, high, loose in zip(steady, *limits, slack, strict=True)
    ]


def _settled(
    take: Take, put: Sequence[Patch], group: Sequence[Pair], ties: Sequence[Tie]
) -> list[FloatArray | None]:
    """New values for each repair of a group, None where nothing moves.

    The likeliest places, frame by frame, by Gauss and Newton: near to where each was put, by its
    own deviation, with distances outside their limits drawn to these.
    """
    first, stop = min(a.start for a, _ in group), max(a.stop for a, _ in group)
    own = sorted({take.index(a.marker) for a, _ in group})
    columns = [*own, *sorted({c for t in ties for c in (t.first, t.second)} - set(own))]
    place = {column: i for i, column in enumerate(columns)}
    start = take.positions[first:stop, columns]
    write_patches(start, first, {take.labels[c]: i for c, i in place.items()}, put)
    stiffness = np.full((stop - first, len(own)), FIXED)
    for artifact, repair in group:
        assert repair.band_mm is not None
        rows = slice(artifact.start - first, artifact.stop - first)
        variance = np.maximum(repair.band_mm**2 / len(AXES), SUREST_MM2)
        stiffness[rows, place[take.index(artifact.marker)]] = 1.0 / variance
    ends = np.array([[place[t.first], place[t.second]] for t in ties]).reshape(-1, 2)
    limits = np.array([[t.low, t.high] for t in ties]).reshape(-1, 2)
    firmness = np.array([t.slack**-2 for t in ties])
    moved = start.copy()
    for _ in range(ROUNDS):
        way = moved[:, ends[:, 0]] - moved[:, ends[:, 1]]
        length = np.sqrt((way**2).sum(axis=2))
        off = np.nan_to_num(np.clip(length, limits[:, 0], limits[:, 1]) - length)
        at = np.flatnonzero(off.any(axis=1))
        if not len(at):
            break
        towards = np.nan_to_num(way[at] / np.maximum(length[at], LEAST_MM)[:, :, None])
        back = np.nan_to_num(start[at, : len(own)] - moved[at, : len(own)])
        moved[at, : len(own)] += _step(towards, off[at], firmness, ends, stiffness[at], back)
    values: list[FloatArray | None] = []
    for artifact, _ in group:
        rows = slice(artifact.start - first, artifact.stop - first)
        column = place[take.index(artifact.marker)]
        away = moved[rows, column] - start[rows, column]
        # Where a distance becomes unusual, and at the borders, it would set in with a kink.
        away = gaussian_filter1d(away, SMOOTH_S * take.rate, axis=0, mode="constant")
        values.append(start[rows, column] + away if away.any() else None)
    return values


def _step(
    towards: FloatArray,
    off: FloatArray,
    firmness: FloatArray,
    ends: IntArray,
    stiffness: FloatArray,
    back: FloatArray,
) -> FloatArray:
    """One step of all markers that move.

    Parameters
    ----------
    towards : (frames, ties, 3) unit vectors from the second end to the first
    off : (frames, ties) mm by which distances have to grow
    firmness : (ties,) inverse variance of a distance, mm⁻²
    ends : (ties, 2) columns; those from ``markers`` on do not move
    stiffness : (frames, markers) inverse variance of each coordinate, mm⁻²
    back : (frames, markers, 3) mm to where each was put

    Returns
    -------
    (frames, markers, 3) mm
    """
    frames, count = stiffness.shape
    slope = np.zeros((frames, len(ends), count, 3))
    for end, sign in ((0, 1.0), (1, -1.0)):
        moving = np.flatnonzero(ends[:, end] < count)
        slope[:, moving, ends[moving, end]] = sign * towards[:, moving]
    slopes = slope.reshape(frames, len(ends), 3 * count)
    held = np.where(off != 0.0, firmness, 0.0)
    stiff = np.repeat(stiffness, 3, axis=1)
    normal = np.einsum("fta,ft,ftb->fab", slopes, held, slopes, optimize=True)
    normal[:, np.arange(3 * count), np.arange(3 * count)] += stiff
    right = np.einsum("fta,ft->fa", slopes, held * off) + stiff * back.reshape(frames, -1)
    return np.asarray(np.linalg.solve(normal, right[:, :, None])[:, :, 0].reshape(back.shape))
