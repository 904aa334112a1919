"""How sure a possible slow change is, seen beside all others of its take.

Trees say what a drift looks like, on the takes they learned from. How far hills of the body look
like drifts differs from take to take, and the take itself tells: nearly all its candidates are
hills. So log odds are read against those that a few candidates a minute reach on the same take, an
empirical null (Efron, 2004).
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
KIND = FEATURES.index("kind")


@dataclass(frozen=True, eq=False)
class Judge:
    """Boosted trees and how to read them.

    Attributes
    ----------
    trees : log odds of a candidate by itself
    weights : (6,) of 1 and of the columns of :func:`evidence`, for the log odds on its take
    """

    trees: Trees
    weights: FloatArray

    def confidence(self, features: FloatArray, minutes: float) -> FloatArray:
        """Probability that each candidate of a take is a drift.

        Parameters
        ----------
        features : (n, k) all candidates of the take
        minutes : marker minutes they come from
        """
        odds = self.trees.log_odds(features)
        columns = evidence(odds, is_sharp(features), quiet_levels(odds, minutes))
        return np.asarray(1.0 / (1.0 + np.exp(-(self.weights[0] + columns @ self.weights[1:]))))

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


def evidence(odds: FloatArray, sharp: BoolArray, levels: FloatArray) -> FloatArray:
    """What confidence follows from, (n, 5): log odds, sharpness, both together, the levels."""
    beside = np.broadcast_to(levels, (len(odds), len(levels)))
    return np.column_stack([odds, sharp, sharp * odds, beside])
