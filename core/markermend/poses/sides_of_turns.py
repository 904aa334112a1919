"""Which of q and -q a rotation is, where it does not follow from the frame before."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.quaternion import unrolled

# Known rotations that follow each other this far apart, as the cosine of half the angle, do not
# tell the sign of the later one.
_APART = 0.5
# Rotations count by this power of that cosine, odd since -q counts against what q counts for; so
# many of a recording's are asked.
_LIKE, _ASKED = 7, 300


def on_one_side(q: FloatArray) -> FloatArray:
    """Choose signs so that nothing jumps and like rotations are alike; NaN frames are passed over.

    Parameters
    ----------
    q : (frames, joints, 4)

    Notes
    -----
    Where a joint is turned about by more than two thirds of half a turn between a known frame and
    the next known one, because it was not seen or because a sensor turns a hand over, the nearer
    sign is a guess. Taken wrong, the rest of a recording shows the other side of what is before it,
    and what is learnt from both tells nothing. So each stretch has the sign with which it is most
    like the others, beginning with the longest, then with the one that is surest.
    """
    out = unrolled(q)
    for joint in range(q.shape[1]):
        known = np.flatnonzero(~np.isnan(out[:, joint, 3]))
        path = out[known, joint]
        near = np.einsum("ij,ij->i", path[1:], path[:-1])
        breaks = np.flatnonzero(near < _APART) + 1
        if len(breaks):
            starts = np.append(0, breaks)
            lengths = np.diff(np.append(starts, len(known)))
            signs = _signs(path, starts, lengths)
            out[known, joint] = path * signs.repeat(lengths)[:, None]
    return out


def _signs(path: FloatArray, starts: FloatArray, lengths: FloatArray) -> FloatArray:
    """(stretches,) 1 or -1, by what they begin with and how long they are."""
    every = np.arange(0, len(path), -(-len(path) // _ASKED))
    asked = np.union1d(starts, every)
    firsts = np.searchsorted(asked, starts)
    alike = (path[asked] @ path[asked].T) ** _LIKE
    between = np.add.reduceat(np.add.reduceat(alike, firsts, axis=0), firsts, axis=1)
    signs = np.zeros(len(starts))
    told = np.argmax(lengths)
    signs[told] = 1.0
    score = between[told].copy()
    for _ in range(len(starts) - 1):
        told = np.argmax(np.where(signs == 0, np.abs(score), -1.0))
        signs[told] = -1.0 if score[told] < 0 else 1.0
        score += signs[told] * between[told]
    return signs
