"""Markers on the performer: where they sit, how skin moves them, what the cameras make of it."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from markermend.arrays import Float32Array, FloatArray
from markermend.errors import MethodError
from markermend.simulation.performer import wander
from markermend.simulation.skeleton import PARENTS, Motion, turned

# Segment, place in its axes as shares of body height, softness of the tissue in [0, 1].
_MIDDLE = {
    "C7": ("thorax", (-0.045, 0.0, 0.155), 0.3),
    "T10": ("thorax", (-0.066, 0.0, 0.035), 0.3),
    "CLAV": ("thorax", (0.036, 0.0, 0.128), 0.2),
    "STRN": ("thorax", (0.066, 0.0, 0.030), 0.5),
    "RBAK": ("thorax", (-0.062, -0.052, 0.090), 0.5),
}
_PAIRED = {
    "FHD": ("head", (0.052, 0.038, 0.060), 0.05),
    "BHD": ("head", (-0.055, 0.038, 0.056), 0.05),
    "SHO": ("clavicle", (-0.018, 0.090, 0.038), 0.7),
    "UPA": ("upperarm", (0.004, 0.031, -0.085), 0.8),
    "ELB": ("upperarm", (-0.004, 0.024, -0.184), 0.4),
    "ELM": ("upperarm", (-0.002, -0.023, -0.183), 0.4),
    "FRM": ("forearm", (0.003, 0.023, -0.068), 0.5),
    "WRA": ("forearm", (0.019, 0.004, -0.143), 0.2),
    "WRB": ("forearm", (-0.018, 0.003, -0.144), 0.2),
    "FIN": ("hand", (0.002, 0.012, -0.052), 0.15),
    "THM": ("hand", (0.026, 0.000, -0.034), 0.2),
    "ASI": ("pelvis", (0.046, 0.070, 0.048), 0.6),
    "PSI": ("pelvis", (-0.062, 0.027, 0.058), 0.3),
    "THI": ("thigh", (0.006, 0.052, -0.125), 1.0),
    "THF": ("thigh", (0.047, 0.010, -0.150), 1.0),
    "KNE": ("thigh", (-0.002, 0.034, -0.242), 0.5),
    "KNM": ("thigh", (0.000, -0.033, -0.241), 0.5),
    "TIB": ("shank", (-0.004, 0.030, -0.105), 0.5),
    "SHN": ("shank", (0.029, 0.004, -0.150), 0.3),
    "ANK": ("shank", (-0.006, 0.023, -0.246), 0.15),
    "MED": ("shank", (-0.003, -0.022, -0.243), 0.15),
    "HEE": ("foot", (-0.041, 0.000, -0.014), 0.05),
    "TOE": ("foot", (0.074, 0.006, -0.014), 0.05),
    "MT5": ("foot", (0.056, 0.031, -0.024), 0.05),
}
_STAGGERED = {"UPA": -0.016, "FRM": -0.018, "THI": -0.022, "TIB": -0.020}
"""Technical markers sit lower on the right, so that sides cannot be confused."""
_WOBBLE_S2 = 2.6e-4
_SLIDE_MM = 7.0


def _marker_set() -> dict[str, tuple[str, tuple[float, float, float], float]]:
    """All 53 markers: label to segment, place and softness."""
    head = {k: v for k, v in _PAIRED.items() if v[0] == "head"}
    rest = {k: v for k, v in _PAIRED.items() if v[0] != "head"}
    result: dict[str, tuple[str, tuple[float, float, float], float]] = {}
    for name, (segment, place, softness) in head.items():
        result["L" + name] = (segment, place, softness)
        result["R" + name] = (segment, (place[0], -place[1], place[2]), softness)
    result |= _MIDDLE
    for side, sign in (("L", 1.0), ("R", -1.0)):
        for name, (segment, (x, y, z), softness) in rest.items():
            home = segment if segment in PARENTS else side + segment
            lower = _STAGGERED.get(name, 0.0) if side == "R" else 0.0
            result[side + name] = (home, (x, sign * y, z + lower), softness)
    return result


MARKER_SET = MappingProxyType(_marker_set())
"""Label to segment, place in the segment's axes (shares of body height) and softness."""


def place_markers(
    motion: Motion,
    rate: float,
    *,
    labels: Sequence[str] | None = None,
    soft_tissue: bool = True,
    rng: np.random.Generator,
) -> tuple[tuple[str, ...], FloatArray]:
    """Put markers on a moving body.

    Parameters
    ----------
    motion : the body
    rate : frames per second
    labels : part of :data:`MARKER_SET`; all 53 when not given
    soft_tissue : let skin move the markers; without it they are fixed to the bones
    rng : placement (a few mm from the textbook place) and skin

    Returns
    -------
    labels and positions (frames, markers, 3) float64, mm

    Raises
    ------
    MethodError
        for a label that is not in the set

    Notes
    -----
    Skin lags behind the bone's acceleration (up to some 5 mm on the thigh at heel strike), slides
    with the rotation of its segment against the parent (up to 10 mm), and creeps by tenths of a
    millimetre.
    """
    wanted = tuple(MARKER_SET if labels is None else labels)
    for label in wanted:
        if label not in MARKER_SET:
            raise MethodError(f"The performer has no marker called “{label}”.")
    frames = len(motion.origins["pelvis"])
    result = np.empty((frames, len(wanted), 3))
    # Drawn for the whole set, so that a subset shows the same motion.
    offsets = {label: rng.normal(0.0, 3.5, 3) for label in MARKER_SET}
    slides = {label: rng.standard_normal((3, 3)) for label in MARKER_SET}
    seeds = dict(zip(MARKER_SET, rng.spawn(len(MARKER_SET)), strict=True))
    for i, label in enumerate(wanted):
        segment, place, softness = MARKER_SET[label]
        frame = motion.rotations[segment]
        local = np.array(place) * motion.height_mm + offsets[label]
        rigid = motion.origins[segment] + turned(frame, local)
        if soft_tissue:
            moved = _skin(motion, segment, rigid, rate, slides[label], seeds[label]) * softness
            rigid = rigid + turned(frame, moved)
        result[:, i] = rigid
    return wanted, result


def _skin(
    motion: Motion,
    segment: str,
    rigid: FloatArray,
    rate: float,
    slide: FloatArray,
    rng: np.random.Generator,
) -> FloatArray:
    """Displacement of skin over the bone in the segment's axes, (frames, 3) mm."""
    from scipy.ndimage import gaussian_filter1d

    frame = motion.rotations[segment]
    velocity = np.gradient(gaussian_filter1d(rigid, 0.03 * rate, axis=0), 1 / rate, axis=0)
    acceleration = np.gradient(velocity, 1 / rate, axis=0)
    # Skin reaches its bone about 30 ms late.
    late = max(1, round(0.03 * rate))
    acceleration = np.concatenate([np.repeat(acceleration[:1], late, axis=0), acceleration])[:-late]
    wobble = -_WOBBLE_S2 * np.einsum("fji,fj->fi", frame, acceleration)
    creep = 0.25 * wander(len(rigid), rate, 0.7, rng, 3)
    parent = PARENTS[segment]
    sliding = np.zeros_like(rigid)
    if parent:
        bent = np.einsum("fji,fjk->fik", motion.rotations[parent], frame)
        turn = np.stack([bent[:, 2, 1], bent[:, 0, 2], bent[:, 1, 0]], axis=1)
        sliding = _SLIDE_MM * turn @ slide / np.sqrt(3)
    total = wobble + sliding
    # Tissue stops at some 12 mm.
    return np.asarray(12.0 * np.tanh(total / 12.0) + creep)


def camera_noise(
    positions: FloatArray, rate: float, rng: np.random.Generator
) -> tuple[FloatArray, Float32Array]:
    """Noise of reconstruction, and the residuals a system would report.

    Parameters
    ----------
    positions : (frames, markers, 3) float64, mm
    rate : frames per second
    rng : the noise

    Returns
    -------
    positions with noise of 0.05 to 0.12 mm, up to three times as much in short bursts while few
    cameras see the marker, and residuals (frames, markers) float32, mm
    """
    frames, markers, _ = positions.shape
    burst = np.maximum(wander(frames, rate, 0.12, rng, markers) - 2.1, 0.0)
    level = rng.uniform(0.05, 0.12, markers) * (1 + np.minimum(2.0 * burst, 2.0))
    noisy = positions + rng.standard_normal(positions.shape) * level[:, :, None]
    spread = np.abs(1 + 0.25 * rng.standard_normal((frames, markers)))
    residuals = (0.25 + 3.0 * level) * spread
    return noisy, residuals.astype(np.float32)
