"""Which marker a trajectory may belong to: free where it is seen, and near where they meet."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from markermend.arrays import IntArray
from markermend.poses.nuitrack import twins
from markermend.take import Take, is_unlabelled

REACH_S = 0.5
"""How far apart in time the ends of two trajectories may be to be compared in space."""


def receivers(take: Take, donor: str, start: int, stop: int) -> tuple[tuple[str, float], ...]:
    """Rank the markers that samples of another one may be given to.

    Parameters
    ----------
    take : as it stands
    donor : whose samples they are
    start, stop : half-open interval of 0-based frames

    Returns
    -------
    Labels of all others that are missing wherever the donor is seen in the interval, and how far
    from the donor's first or last sample there they were last seen, or are seen next, mm; infinite
    where that is not within half a second. Named ones come before unlabelled ones, then the
    nearest.
    """
    own = take.index(donor)
    seen = np.flatnonzero(take.present[start:stop, own]) + start
    if not len(seen):
        return ()
    free = np.flatnonzero(~take.present[seen].any(axis=0)).tolist()
    return _ranked(take, {i: _apart(take, own, seen, i) for i in free})


def donors(take: Take, receiver: str) -> tuple[tuple[str, float], ...]:
    """Rank the unlabelled trajectories that may belong to a marker.

    Parameters
    ----------
    take : as it stands
    receiver : the marker

    Returns
    -------
    Labels of those that are seen only where the marker is missing, and how far from their ends it
    was last seen, or is seen next, as in :func:`receivers`; the nearest first.
    """
    own, apart = take.index(receiver), {}
    for i in (i for i, label in enumerate(take.labels) if is_unlabelled(label) and i != own):
        seen = np.flatnonzero(take.present[:, i])
        if len(seen) and not take.present[seen, own].any():
            apart[i] = _apart(take, i, seen, own)
    return _ranked(take, apart)


def _apart(take: Take, donor: int, seen: IntArray, receiver: int) -> float:
    """Distance in space from the ends of a donor to a receiver near them in time, mm."""
    reach = round(REACH_S * take.rate)
    first, last = int(seen[0]), int(seen[-1])
    present = take.present[:, receiver]
    before = np.flatnonzero(present[max(0, first - reach) : first])[-1:] + max(0, first - reach)
    after = np.flatnonzero(present[last + 1 : last + 1 + reach])[:1] + last + 1
    x = take.positions
    ends = [(first, f) for f in before.tolist()] + [(last, f) for f in after.tolist()]
    lengths = [float(np.linalg.norm(x[f, receiver] - x[at, donor])) for at, f in ends]
    return min(lengths, default=np.inf)


def _ranked(take: Take, lengths: Mapping[int, float]) -> tuple[tuple[str, float], ...]:
    """Labels and lengths by column: named ones first, then the shortest."""
    order = sorted(lengths, key=lambda i: (is_unlabelled(take.labels[i]), lengths[i]))
    return tuple((take.labels[i], lengths[i]) for i in order)


def exchangers(take: Take, marker: str, start: int, stop: int) -> tuple[tuple[str, float], ...]:
    """Rank the markers that one may have changed places with in an interval.

    Parameters
    ----------
    take : as it stands
    marker : the one
    start, stop : half-open interval of 0-based frames

    Returns
    -------
    Labels of all others, and the longest jump that either would make at an edge of the interval
    if the two were exchanged within it, mm; infinite where one of them is missing there. Named
    ones come before unlabelled ones, then the smallest jump; of joints that of the other side is
    first, which sensors take one for most.
    """
    own = take.index(marker)
    jumps = np.zeros(take.markers)
    for outside, inside in ((start - 1, start), (stop, stop - 1)):
        if 0 <= outside < take.frames:
            out, within = take.positions[outside], take.positions[inside]
            there = np.linalg.norm(within - out[own], axis=1)
            back = np.linalg.norm(within[own] - out, axis=1)
            jumps = np.maximum(jumps, np.maximum(there, back))
    jumps = np.where(np.isnan(jumps), np.inf, jumps)
    ranked = _ranked(take, {i: float(jump) for i, jump in enumerate(jumps) if i != own})
    other = take.labels[twins(take.labels)[own]] if take.skeleton else ""
    return tuple(sorted(ranked, key=lambda pair: pair[0] != other))
