"""Boosted decision trees as plain arrays, with a forward pass of our own."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.arrays import FloatArray, IntArray

DEPTH = 3


@dataclass(frozen=True, eq=False)
class Trees:
    """Boosted trees for two classes.

    Attributes
    ----------
    feature : (trees, nodes) int64 column asked about, −1 in a leaf
    threshold : (trees, nodes) go left where the feature is at most this
    left, right : (trees, nodes) int64 next node
    value : (trees, nodes) what a leaf adds to the log odds, learning rate included
    bias : log odds to begin with
    """

    feature: IntArray
    threshold: FloatArray
    left: IntArray
    right: IntArray
    value: FloatArray
    bias: float

    def log_odds(self, rows: FloatArray) -> FloatArray:
        """Log odds of each row: (n, features) to (n,)."""
        # Thresholds were learned on numbers rounded so.
        rows = rows.astype(np.float32)
        trees = np.arange(len(self.feature))
        node = np.zeros((len(rows), len(trees)), dtype=np.int64)
        for _ in range(DEPTH):
            column = self.feature[trees, node]
            asked = np.take_along_axis(rows, np.maximum(column, 0), axis=1)
            step = np.where(
                asked <= self.threshold[trees, node],
                self.left[trees, node],
                self.right[trees, node],
            )
            node = np.where(column < 0, node, step)
        return np.asarray(self.bias + self.value[trees, node].sum(axis=1))

    def save(self, path: Path) -> None:
        """Write the arrays as one ``.npz``."""
        np.savez_compressed(
            path,
            feature=self.feature.astype(np.int16),
            threshold=self.threshold,
            left=self.left.astype(np.int16),
            right=self.right.astype(np.int16),
            value=self.value,
            bias=np.array(self.bias),
        )


def load_trees(path: Path) -> Trees:
    """Read what :meth:`Trees.save` wrote; nothing in it is executed."""
    with np.load(path, allow_pickle=False) as stored:
        return Trees(
            stored["feature"].astype(np.int64),
            stored["threshold"].astype(np.float64),
            stored["left"].astype(np.int64),
            stored["right"].astype(np.int64),
            stored["value"].astype(np.float64),
            float(stored["bias"]),
        )


def from_scikit(model: Any) -> Trees:
    """Take the trees out of a fitted ``GradientBoostingClassifier`` of two classes."""
    inner = [tree.tree_ for tree in model.estimators_[:, 0]]
    nodes = max(t.node_count for t in inner)

    def padded(values: Any, fill: float) -> FloatArray:
        return np.pad(
            np.asarray(values, dtype=np.float64), (0, nodes - len(values)), constant_values=fill
        )

    prior = float(model.init_.class_prior_[1])
    return Trees(
        np.stack([np.maximum(padded(t.feature, -1), -1) for t in inner]).astype(np.int64),
        np.stack([padded(t.threshold, 0) for t in inner]),
        np.stack([np.maximum(padded(t.children_left, 0), 0) for t in inner]).astype(np.int64),
        np.stack([np.maximum(padded(t.children_right, 0), 0) for t in inner]).astype(np.int64),
        np.stack([padded(t.value[:, 0, 0] * model.learning_rate, 0) for t in inner]),
        float(np.log(prior / (1 - prior))),
    )
