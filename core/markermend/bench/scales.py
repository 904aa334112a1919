"""Movements in five scales of occlusion, as Figure 22 of goncalves2024 groups them."""

from __future__ import annotations

import numpy as np

from markermend.arrays import FloatArray, IntArray

SCALES = 5


def occlusion_scales(occluded: FloatArray) -> tuple[IntArray, FloatArray]:
    """Divide movements, from the one with the fewest occluded joints to that with the most.

    Parameters
    ----------
    occluded : (movements,) joints occluded in a pose, mean over each movement; one or more

    Returns
    -------
    (movements,) scale of each, from 0, and (SCALES,) joints occluded up to which each scale goes;
    scales are equally wide
    """
    edges = np.linspace(occluded.min(), occluded.max(), SCALES + 1)
    return np.asarray(np.digitize(occluded, edges[1:-1])), edges[1:]
