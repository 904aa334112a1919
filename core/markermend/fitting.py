"""Which marker a trajectory may belong to: free where it is seen, and near where they meet."""

from __future__ import annotations

import numpy as np

from markermend.take import Take, is_unlabelled

REACH_S = 0.5
"""How far apart in time the ends of two trajectories may be to be compared in space."""


def receivers(take: Take, donor: str, start: int, stop: int) -> tuple[str, ...]:
    """Rank the markers that samples of another one may be given to.

    Parameters
    ----------
    take : as it stands
    donor : whose samples they are
    start, stop : half-open interval of 0-based frames

    Returns
    -------
    Labels of all others that are missing wherever the donor is seen in the interval. Named ones
    come before unlabelled ones, and then those that were last seen, or are seen next, nearest to
    the donor's first or last sample there; within half a second of it.
    """
    own = take.index(donor)
    seen = np.flatnonzero(take.present[start:stop, own]) + start
    if not len(seen):
        return ()
    away = np.full(take.markers, np.inf)
    free = ~take.present[seen].any(axis=0)
    reach = round(REACH_S * take.rate)
    first, last = int(seen[0]), int(seen[-1])
    for at, rows in (
        (first, slice(max(0, first - reach), first)),
        (last, slice(last + 1, last + 1 + reach)),
    ):
        present = take.present[rows]
        if at == first:
            present = present[::-1]
        for column in np.flatnonzero(free & present.any(axis=0)):
            step = int(np.argmax(present[:, column]))
            frame = at - 1 - step if at == first else at + 1 + step
            apart = np.linalg.norm(take.positions[frame, column] - take.positions[at, own])
            away[column] = min(away[column], float(apart))
    found = [i for i in np.flatnonzero(free) if i != own]
    found.sort(key=lambda i: (is_unlabelled(take.labels[i]), away[i]))
    return tuple(take.labels[i] for i in found)
