"""Controlled contamination of a clean take: skurowski2022, section 4.1.3."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.artifact import Artifact, Kind
from markermend.errors import DataError, MethodError
from markermend.simulation.truth import Damage, added, apply_damage, spread_out
from markermend.take import AXES, Take, is_unlabelled

ALL_KINDS = (Kind.PEAK, Kind.NOISE, Kind.STEP, Kind.SLOW)
_CLEARANCE = 10
"""Frames between two artifacts of the same coordinate, so that a peak stays isolated."""
_TRIES = 200
_WHY = {
    Kind.PEAK: "simulated single peak",
    Kind.NOISE: "simulated heavy noise",
    Kind.STEP: "simulated step change",
    Kind.SLOW: "simulated slow change",
}


def triangle(length: int, rounded: int = 0) -> FloatArray:
    """Return a symmetric triangle of height 1 that is nowhere zero, (length,) float64.

    ``rounded``, less than the length, is over how many frames a Hann window smooths its kinks.
    """
    ramp = np.arange(1, length - max(rounded - 1, 0) + 1, dtype=np.float64)
    sharp = np.minimum(ramp, ramp[::-1]) / ((len(ramp) + 1) // 2)
    if not rounded:
        return np.asarray(sharp)
    smooth = np.convolve(sharp, np.hanning(rounded + 2)[1:-1])
    return np.asarray(smooth / smooth.max())


def contaminate(
    take: Take,
    *,
    share: float = 0.05,
    amplitude_mm: float = 10.0,
    kinds: Sequence[str] = ALL_KINDS,
    mean_length: float = 50.0,
    rounded: int = 0,
    markers: Sequence[str] | None = None,
    seed: int,
) -> tuple[Take, tuple[Artifact, ...]]:
    """Damage a clean take as the published experiments do.

    Every class gets ``share × frames`` samples; one coordinate of one marker is damaged at a
    time, never two in the same frame. Bulk damage (noise, step, slow) is laid out first, with
    Poisson lengths, then peaks of one sample are seeded in the frames left over. Amplitudes are
    the absolute value of N(μ, 0.4 μ) with random sign: the height of the rectangle (step), of
    the triangle (slow) or of the peak, and the standard deviation of the white noise.

    Parameters
    ----------
    take : a clean recording; NaN = missing, such samples are never touched
    share : part of the frames damaged by each class; samples are counted per coordinate
    amplitude_mm : μ
    kinds : any of ``"peak"``, ``"noise"``, ``"step"``, ``"slow"``
    mean_length : mean length of bulk damage in samples, as the paper has it whatever the rate;
        ``0.5 * take.rate`` gives its half second instead
    rounded : over how many frames the kinks of slow changes are rounded; those shorter than
        twice that stay sharp
    markers : labels that may be damaged; every labelled marker when not given
    seed : same seed, same damage

    Returns
    -------
    the damaged take and the truth, in order of start; ``amplitude_mm`` of the truth is
    positive, for noise it is the standard deviation

    Raises
    ------
    MethodError
        for an unknown class, or shares that do not fit into the take
    DataError
        when no marker is seen where damage should go

    Notes
    -----
    skurowski2022, 4.1.3. Two artifacts of the same coordinate keep 10 frames apart.
    """
    wanted = _checked_kinds(kinds)
    if share <= 0 or amplitude_mm <= 0 or mean_length < 2:
        raise MethodError("Share and amplitude must be positive, mean length at least 2 samples.")
    target = round(share * take.frames)
    if target * len(wanted) > 0.95 * take.frames:
        raise MethodError(
            f"{len(wanted)} classes with a share of {share:g} each do not fit into one take."
        )
    rng = np.random.default_rng(seed)
    channels = _Channels(take, markers, rng)
    damages: list[Damage] = []
    taken = np.zeros(take.frames, dtype=bool)
    for kind, start, length in _bulk_layout(wanted, target, mean_length, take.frames, rng):
        marker, axis = channels.draw(start, start + length)
        size = abs(rng.normal(amplitude_mm, 0.4 * amplitude_mm))
        shape = _bulk_shape(kind, length, rounded, rng) * size * rng.choice([-1.0, 1.0])
        damages.append(added(take, marker, axis, start, shape, kind, size, _WHY[kind]))
        taken[start : start + length] = True
    if Kind.PEAK in wanted:
        for frame in np.sort(rng.choice(np.flatnonzero(~taken), size=target, replace=False)):
            marker, axis = channels.draw(int(frame), int(frame) + 1)
            size = abs(rng.normal(amplitude_mm, 0.4 * amplitude_mm))
            height = np.array([size * rng.choice([-1.0, 1.0])])
            why = _WHY[Kind.PEAK]
            damages.append(added(take, marker, axis, int(frame), height, Kind.PEAK, size, why))
    return apply_damage(take, damages)


def _checked_kinds(kinds: Sequence[str]) -> list[Kind]:
    """Turn names into classes, each once, in a fixed order."""
    unknown = [name for name in kinds if name not in ALL_KINDS]
    if unknown or not kinds:
        names = ", ".join(ALL_KINDS)
        raise MethodError(f"Contamination knows the classes {names}, not “{', '.join(unknown)}”.")
    return [kind for kind in ALL_KINDS if kind in set(kinds)]


def _poisson_lengths(total: int, mean: float, rng: np.random.Generator) -> list[int]:
    """Poisson lengths that sum to exactly ``total``; a short remainder joins the last one."""
    lengths: list[int] = []
    left = total
    while left > 0:
        length = min(max(2, int(rng.poisson(mean))), left)
        if lengths and length < mean / 4:
            lengths[-1] += length
        else:
            lengths.append(length)
        left -= length
    return lengths


def _bulk_layout(
    wanted: list[Kind], target: int, mean: float, frames: int, rng: np.random.Generator
) -> list[tuple[Kind, int, int]]:
    """Class, first frame and length of every bulk artifact, in order of time."""
    pieces = [
        (kind, length)
        for kind in wanted
        if kind is not Kind.PEAK
        for length in _poisson_lengths(target, mean, rng)
    ]
    if not pieces:
        return []
    pieces = [pieces[i] for i in rng.permutation(len(pieces))]
    lengths: IntArray = np.array([length for _, length in pieces], dtype=np.int64)
    starts = spread_out(lengths, frames, rng)
    return [
        (kind, int(start), length) for (kind, length), start in zip(pieces, starts, strict=True)
    ]


def _bulk_shape(kind: Kind, length: int, rounded: int, rng: np.random.Generator) -> FloatArray:
    """Deviation of unit amplitude: rectangle, triangle or white noise."""
    if kind is Kind.STEP:
        return np.ones(length)
    if kind is Kind.SLOW:
        return triangle(length, rounded if length >= 2 * rounded else 0)
    return rng.standard_normal(length)


class _Channels:
    """Draws coordinates that are seen over an interval and clear of earlier damage."""

    def __init__(self, take: Take, markers: Sequence[str] | None, rng: np.random.Generator) -> None:
        labels = [s for s in take.labels if not is_unlabelled(s)] if markers is None else markers
        if not labels:
            raise DataError("The take has no labelled marker that could be contaminated.")
        self._labels = tuple(labels)
        self._columns = np.array([take.index(label) for label in labels])
        self._present = take.present
        self._busy = np.zeros((take.frames, len(labels), 3), dtype=bool)
        self._rng = rng

    def draw(self, start: int, stop: int) -> tuple[str, str]:
        """Marker and axis for damage in ``[start, stop)``, marked as used."""
        around = slice(max(0, start - _CLEARANCE), stop + _CLEARANCE)
        for _ in range(_TRIES):
            i, axis = int(self._rng.integers(len(self._labels))), int(self._rng.integers(3))
            seen = self._present[start:stop, self._columns[i]].all()
            if seen and not self._busy[around, i, axis].any():
                self._busy[start:stop, i, axis] = True
                return self._labels[i], AXES[axis]
        raise DataError(
            f"No marker is seen and still clean over frames {start} to {stop}; "
            "lower the share or choose a take with fewer gaps."
        )
