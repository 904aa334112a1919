"""Boosted decision trees as plain arrays, with a forward pass of our own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import FloatArray, IntArray


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
        trees = np.arange(len(self.feature))
        node = np.zeros((len(rows), len(trees)), dtype=np.int64)
        while True:
            column = self.feature[trees, node]
            if (column < 0).all():
                break
            asked = np.take_along_axis(rows, np.maximum(column, 0), axis=1)
            step = np.where(
                asked <= self.threshold[trees, node],
                self.left[trees, node],
                self.right[trees, node],
            )
            node = np.where(column < 0, node, step)
        return np.asarray(self.bias + self.value[trees, node].sum(axis=1))


def tree_arrays(trees: Trees) -> dict[str, NDArray[Any]]:
    """Give the arrays by name, as small as they may be."""
    return {
        "feature": trees.feature.astype(np.int16),
        "threshold": trees.threshold,
        "left": trees.left.astype(np.int16),
        "right": trees.right.astype(np.int16),
        "value": trees.value.astype(np.float32),
        "bias": np.array(trees.bias),
    }


def trees_from(stored: Mapping[str, NDArray[Any]]) -> Trees:
    """Make trees of the arrays that :func:`tree_arrays` gave."""
    return Trees(
        stored["feature"].astype(np.int64),
        stored["threshold"].astype(np.float64),
        stored["left"].astype(np.int64),
        stored["right"].astype(np.int64),
        stored["value"].astype(np.float64),
        float(stored["bias"]),
    )


def from_scikit(models: Sequence[Any]) -> Trees:
    """Take the trees out of fitted ``HistGradientBoostingClassifier``s of two classes.

    Their log odds are averaged.
    """
    inner = [tree.nodes for model in models for (tree,) in model._predictors]
    nodes = max(len(t) for t in inner)
    share = 1.0 / len(models)

    def padded(column: str, fill: float) -> FloatArray:
        values = [np.asarray(t[column], dtype=np.float64) for t in inner]
        return np.stack([np.pad(v, (0, nodes - len(v)), constant_values=fill) for v in values])

    leaf = padded("is_leaf", 1.0) > 0
    return Trees(
        np.where(leaf, -1, padded("feature_idx", 0)).astype(np.int64),
        np.where(leaf, 0.0, padded("num_threshold", 0)),
        padded("left", 0).astype(np.int64),
        padded("right", 0).astype(np.int64),
        np.where(leaf, share * padded("value", 0), 0.0),
        share * sum(float(model._baseline_prediction[0, 0]) for model in models),
    )
