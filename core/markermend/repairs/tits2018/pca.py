"""Weighted principal components (Gløersen & Federolf 2016, strategy R2), as tits2018 uses them."""

from __future__ import annotations

import numpy as np

from markermend.arrays import BoolArray, FloatArray

WEIGHT_SCALE_MM = 200.0
OWN_WEIGHT = 0.02
# Markers with gaps further away than this share of the mean distance are left out.
DISTAL = 0.5
EXPLAINED = 0.99


def reconstruct(
    positions: FloatArray, marker: int, wanted: BoolArray
) -> tuple[FloatArray, int] | None:
    """Rebuild a marker from the principal components of the others.

    Parameters
    ----------
    positions : (frames, markers, 3) relative to the body's mean, mm; NaN where not trusted
    marker : column to rebuild
    wanted : (frames,) frames to rebuild

    Returns
    -------
    (wanted frames, 3) mm, and how many numbers were learnt for them: means, scales and both sets
    of components; None when no other marker is whole or too few frames are complete
    """
    missing = np.isnan(positions[:, :, 0])
    distance = _mean_distance(positions, missing, marker)
    distal = (distance > DISTAL * distance.mean()) & missing.any(axis=0)
    dropped = (distal | missing[wanted].any(axis=0)) & (np.arange(len(distal)) != marker)
    kept = positions.copy()
    kept[:, dropped] = 0.0
    complete = ~np.isnan(kept[:, :, 0]).any(axis=1)
    if dropped.sum() >= len(dropped) - 1 or complete.sum() < 3:
        return None
    weight = np.exp(-(distance**2) / (2.0 * WEIGHT_SCALE_MM**2))
    weight[marker] = OWN_WEIGHT
    weights = np.repeat(weight, 3)
    own = slice(3 * marker, 3 * marker + 3)

    whole = kept[complete].reshape(complete.sum(), -1)
    mean, scale = whole.mean(axis=0), whole.std(axis=0)
    scale[scale == 0] = 1.0
    whole = (whole - mean) / scale * weights
    blind = whole.copy()
    blind[:, own] = 0.0
    asked = (kept[wanted].reshape(wanted.sum(), -1) - mean) / scale * weights
    asked[:, own] = 0.0
    full_axes, full_sizes = _components(whole)
    blind_axes, blind_sizes = _components(blind)
    count = max(_enough(full_sizes), _enough(blind_sizes))
    full_axes, blind_axes = full_axes[:, :count], blind_axes[:, :count]
    rebuilt = asked @ blind_axes @ (full_axes.T @ blind_axes) @ full_axes[own].T
    learnt = 2 * whole.shape[1] * (1 + count)
    return np.asarray(mean[own] + rebuilt * scale[own] / weights[own]), learnt


def _mean_distance(positions: FloatArray, missing: BoolArray, marker: int) -> FloatArray:
    """(markers,) mean distance to the marker over frames in which both are there."""
    distance = np.linalg.norm(positions - positions[:, marker, None], axis=2)
    both = ~(missing | missing[:, marker, None])
    total = np.where(both, distance, 0.0).sum(axis=0)
    return np.asarray(total / np.maximum(both.sum(axis=0), 1))


def _components(data: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Principal axes as columns, largest first, and their standard deviations."""
    values, axes = np.linalg.eigh(data.T @ data / max(len(data) - 1, 1))
    return axes[:, ::-1], np.sqrt(np.maximum(values[::-1], 0.0))


def _enough(sizes: FloatArray) -> int:
    """How many components it takes to reach the share explained."""
    share = np.cumsum(sizes) >= EXPLAINED * sizes.sum()
    return int(np.argmax(share)) + 1
