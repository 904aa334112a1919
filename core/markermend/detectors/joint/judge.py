"""How sure a possible slow change is, seen beside all others of its take.

Trees say what a drift looks like, on the takes they learned from. How far hills of the body look
like drifts differs from take to take, and the take itself tells: nearly all its candidates are
hills. So log odds are read against those that a few candidates a minute reach on the same take, an
empirical null (Efron, 2004), and beside how unlike a drift a candidate is once its frames are
filled from the body.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.detectors.joint.measures import FEATURES
from markermend.detectors.joint.trees import Trees, tree_arrays, trees_from
from markermend.files.npz import read_arrays, write_arrays

RATES = (2.0, 10.0)
"""Candidates a marker and minute whose log odds tell how the take's hills look: so many that
drifts hardly move them, so few that they lie in the tail."""
LIKELY = -1.0
"""Log odds of the trees from which on a candidate is filled and judged. What lies below is never
believed, and so plentiful that filling it would take longer than the search."""
KIND = FEATURES.index("kind")


@dataclass(frozen=True, eq=False)
class Judge:
    """Boosted trees and how to read them.

    Attributes
    ----------
    trees : log odds of a candidate by itself
    weights : (8,) of 1 and of the columns of :func:`evidence`, for the log odds on its take
    """

    trees: Trees
    weights: FloatArray

    def confidence(self, evidence: FloatArray) -> FloatArray:
        """Probability that each candidate is a drift, (n,), from :func:`evidence`."""
        return np.asarray(1.0 / (1.0 + np.exp(-(self.weights[0] + evidence @ self.weights[1:]))))

    def save(self, path: Path) -> None:
        """Write the arrays as one ``.npz``."""
        write_arrays(path, {"weights": self.weights, **tree_arrays(self.trees)})


def load_judge(path: Path) -> Judge:
    """Read what :meth:`Judge.save` wrote; nothing in it is executed."""
    stored = read_arrays(path)
    return Judge(trees_from(stored), stored["weights"].astype(np.float64))


def is_sharp(features: FloatArray) -> BoolArray:
    """Whether each candidate has sharp kinks, which hills of bodies seldom have, (n,)."""
    return np.asarray(features[:, KIND] == 0)


def quiet_levels(odds: FloatArray, minutes: float) -> FloatArray:
    """Log odds that :data:`RATES` candidates a marker minute reach; 0 without candidates, (2,)."""
    if not len(odds):
        return np.zeros(len(RATES))
    ranked = np.sort(odds)[::-1]
    return np.asarray([ranked[min(int(rate * minutes), len(odds) - 1)] for rate in RATES])


def evidence(
    odds: FloatArray, sharp: BoolArray, levels: FloatArray, uneven: FloatArray
) -> FloatArray:
    """Gather what confidence follows from.

    Parameters
    ----------
    odds : (n,) of the trees
    sharp : (n,) from :func:`is_sharp`
    levels : (2,) from :func:`quiet_levels`, of all candidates of the take
    uneven : (n,) from :func:`markermend.detectors.joint.refilled.unevenness`

    Returns
    -------
    (n, 7) log odds, sharpness, both together, the levels, unevenness, and that of the sharp
    """
    beside = np.broadcast_to(levels, (len(odds), len(levels)))
    return np.column_stack([odds, sharp, sharp * odds, beside, uneven, sharp * uneven])
