"""Swaps: a jump whose complement another trajectory carries.

When the labels of markers are mixed up for a while, their trajectories jump at the same two
frames, and giving each its own samples back makes all continuous. Starting from one that jumps,
the chain is followed: under which name its own samples are, under which name those of that one
are, until it closes. Trajectories without a name take part; one that exists only during the swap
ends the chain. Names are mostly mixed up where markers were lost, so a gap at either end is
looked across.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm, overlap
from markermend.take import Take, is_unlabelled

# What is left of each jump after the exchange, at most.
LARGEST_REST = 0.3
# All trajectories jump at the same frames; intervals this much alike are one swap.
SAME_STEP = 0.5
MOST_MARKERS = 5
ACROSS_S = 0.25
"""Longest gap at an end of the swap that is looked across."""
SUDDEN = (Kind.STEP, Kind.PEAK)


@dataclass(frozen=True)
class _Side:
    """Where all trajectories are next to a border, as seen from one side of it.

    Attributes
    ----------
    frame : (markers,) of the sample nearest to the border
    place, speed : (markers, 3) mm, mm a frame; NaN where nothing is seen, or only one frame
    """

    frame: FloatArray
    place: FloatArray
    speed: FloatArray


@dataclass(frozen=True)
class _Border:
    """Either side of one end of a swap."""

    inside: _Side
    outside: _Side


def name_swaps(take: Take, artifacts: list[Artifact]) -> list[Artifact]:
    """Turn steps and peaks that are swaps into one artifact a swap, naming all its markers.

    Parameters
    ----------
    take : the recording
    artifacts : of any kinds; only steps and peaks are looked at

    Returns
    -------
    The artifacts; a swap is a step of all axes with its counterparts, as sure as the surest of
    what else was read from the same jumps (steps, peaks or noise of its markers over the same
    interval), which is gone. The one named first in the take is the artifact's marker, a
    labelled one before a nameless one.
    """
    jumps = [a for a in artifacts if a.kind in SUDDEN]
    found = {s.id: s for s in (_swap(take, jump) for jump in jumps) if s is not None}
    named: list[Artifact] = []
    explained: set[str] = set()
    for swap in _in_turn(found.values(), take.frames):
        same = [a for a in artifacts if a.marker in swap.markers and _same_jumps(a, swap)]
        explained |= {a.id for a in same}
        sure = max(a.confidence for a in same)
        named.append(replace(swap, confidence=sure))
    return [a for a in artifacts if a.id not in explained] + named


def _same_jumps(a: Artifact, swap: Artifact) -> bool:
    """Whether something on one of a swap's markers was read from the swap's jumps."""
    if overlap((a.start, a.stop), (swap.start, swap.stop)) >= SAME_STEP:
        return a.kind in (*SUDDEN, Kind.NOISE)
    # A gap may cut it short, or it is where the names are right, between two swaps.
    ends = {swap.start, swap.stop}
    return a.kind is Kind.STEP and bool({a.start, a.stop} & ends)


def _in_turn(swaps: Iterable[Artifact], frames: int) -> list[Artifact]:
    """Of swaps of the same markers that follow each other without a break, every other one.

    Between two swaps the names are right, yet both ends jump just the same. The turn that
    explains more jumps is right, of equals that in which names are wrong for a shorter time.
    """
    kept = []
    together: dict[frozenset[str], list[Artifact]] = {}
    for swap in swaps:
        together.setdefault(frozenset(swap.markers), []).append(swap)
    for same in together.values():
        jumps = sorted({e for s in same for e in (s.start, s.stop)} - {0, frames})
        ends = [0, *jumps, frames]
        turns: list[list[Artifact]] = [[], []]
        for s in same:
            place = ends.index(s.start)
            if ends[place + 1] == s.stop:
                turns[place % 2].append(s)
        kept += max(
            turns,
            key=lambda turn: (
                len({e for s in turn for e in (s.start, s.stop)} & set(jumps)),
                -sum(s.length for s in turn),
            ),
        )
    return kept


def _swap(take: Take, jump: Artifact) -> Artifact | None:
    """Describe a jump as a swap with the trajectories that explain it, if they do."""
    first = take.index(jump.marker)
    borders = _borders(take, jump.start, jump.stop)
    chain, rests = [first], []
    size = _jump(borders, first)
    while len(chain) <= MOST_MARKERS:
        own = _jump(borders, chain[-1])
        if np.isnan(own) and len(chain) > 1:
            break
        rest = _rests(borders, chain[-1])
        fits = rest <= LARGEST_REST * own
        fits[chain[1:]] = False
        if len(chain) > 1 and fits[first]:
            rests.append(rest[first])
            break
        fits[first] = False
        if not fits.any():
            return None
        donor = int(np.argmin(np.where(fits, rest, np.inf)))
        chain.append(donor)
        rests.append(rest[donor])
    else:
        return None
    return _described(take, jump, chain, size, float(max(rests)))


def _described(
    take: Take, jump: Artifact, chain: Sequence[int], size: float, rest: float
) -> Artifact:
    """The swap as an artifact."""
    first = min(range(len(chain)), key=lambda i: (is_unlabelled(take.labels[chain[i]]), chain[i]))
    marker, *others = (take.labels[i] for i in (*chain[first:], *chain[:first]))
    return replace(
        jump,
        kind=Kind.STEP,
        marker=marker,
        axes="xyz",
        counterpart=others[0],
        further_counterparts=tuple(others[1:]),
        amplitude_mm=size,
        why=(
            f"changes places with {' and '.join(others)} for {how_long(jump.length, take.rate)}: "
            f"once exchanged, {in_mm(rest)} mm of the {in_mm(size)} mm jump are left"
        ),
        id="",
    )


def _borders(take: Take, start: int, stop: int) -> list[_Border]:
    """The ends of a swap that lie within the take."""
    reach = 2 + round(ACROSS_S * take.rate)
    x = take.positions
    before, after = x[max(0, start - reach) : start], x[stop : stop + reach]
    early, late = x[start : min(stop, start + reach)], x[max(start, stop - reach) : stop]
    borders = []
    if start > 0:
        borders.append(_Border(_side(early, start, 1), _side(before, start - 1, -1)))
    if stop < take.frames:
        borders.append(_Border(_side(late, stop - 1, -1), _side(after, stop, 1)))
    return borders


def _side(rows: FloatArray, nearest: int, way: int) -> _Side:
    """Look at some frames from a border: ``nearest`` is next to it, ``way`` leads off it."""
    rows = rows[::way]
    seen: BoolArray = ~np.asarray(np.isnan(rows).any(axis=2))
    at, every = seen.argmax(axis=0), np.arange(rows.shape[1])
    place = rows[at, every]
    following = np.minimum(at + 1, len(rows) - 1)
    speed = np.where((following > at)[:, None], way * (rows[following, every] - place), np.nan)
    return _Side(nearest + way * at.astype(np.float64), place, speed)


def _jump(borders: list[_Border], marker: int) -> float:
    """How far a trajectory jumps at the ends, their mean; NaN where it is seen on one side only."""
    return float(np.mean([_breaks(b, marker)[marker] for b in borders])) if borders else np.nan


def _rests(borders: list[_Border], marker: int) -> FloatArray:
    """What is left of a trajectory's jump when each other fills in, (markers,), NaN if unknown.

    The larger of both ends, so that one that fits by chance at one of them does not count.
    """
    return np.asarray(np.max([_breaks(b, marker) for b in borders], axis=0))


def _breaks(border: _Border, marker: int) -> FloatArray:
    """How far each trajectory inside is from where one marker goes outside, (markers,) mm."""
    inside, outside = border.inside, border.outside
    across = inside.frame - outside.frame[marker]
    own = np.broadcast_to(outside.speed[marker], inside.speed.shape)
    known = np.stack([own, inside.speed])
    count = np.maximum((~np.isnan(known)).sum(axis=0), 1)
    speed = np.nansum(known, axis=0) / count
    return np.asarray(
        np.linalg.norm(
            inside.place - outside.place[marker] - speed * across[:, None],
            axis=1,
        )
    )
