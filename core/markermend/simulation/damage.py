"""Damage as a real recording has it: every class, at plausible places and of plausible size."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Kind
from markermend.errors import DataError
from markermend.simulation.contamination import triangle
from markermend.simulation.truth import Damage, added, apply_damage, hidden, swapped
from markermend.take import Origin, Take, is_unlabelled

_TRIES = 400
_APART_S = 0.25
_EDGE_S = 0.4
_FROZEN_MM = 30.0
_SWAP_MM = (25.0, 130.0)


@dataclass(frozen=True)
class Amounts:
    """How much damage 40 seconds get; scaled with the length of the take.

    Attributes
    ----------
    short_gaps : of 0.03 to 0.25 s, one marker
    long_gaps : of 0.6 to 1.6 s, one marker
    occlusions : of 0.3 to 0.9 s, three neighbouring markers at once
    peaks : of one frame, 8 to 70 mm
    bursts : heavy noise for 0.2 to 0.7 s, standard deviation 3 to 9 mm on all axes
    swaps : two neighbours exchanged for 0.2 to 1.2 s
    steps : constant offset for 0.15 to 0.9 s, 8 to 45 mm
    drifts : slow change for 0.3 to 1.2 s, 8 to 35 mm, with sharp, rounded or no kinks
    swaps_of_three : three neighbours take turns for 0.2 to 1.2 s
    brief_swaps : two neighbours exchanged for one frame
    swaps_with_gap : two neighbours exchanged for 0.3 to 1.2 s, one of them lost meanwhile
    ghosts : a few frames 15 to 80 mm off inside a gap
    frozen : a moving marker repeats its position for 0.15 to 0.6 s
    falls : a marker jumps 20 to 80 mm and stays off to the end of the take
    peaks_on_drifts : a slow change as of ``drifts`` with a peak of 8 to 70 mm on it
    """

    short_gaps: float = 9
    long_gaps: float = 3
    occlusions: float = 2
    peaks: float = 11
    bursts: float = 5
    swaps: float = 3
    steps: float = 5
    drifts: float = 8
    swaps_of_three: float = 0
    brief_swaps: float = 0
    swaps_with_gap: float = 0
    ghosts: float = 0
    frozen: float = 0
    falls: float = 0
    peaks_on_drifts: float = 0


def hann(length: int) -> FloatArray:
    """Return a raised cosine of height 1 that is nowhere zero, (length,) float64."""
    curve = 1 - np.cos(2 * np.pi * np.arange(1, length + 1) / (length + 1))
    return np.asarray(curve / curve.max())


def rounded_triangle(length: int, kink: int) -> FloatArray:
    """Return a triangle of height 1 whose kinks are rounded over ``kink`` frames."""
    from scipy.ndimage import gaussian_filter1d

    reach = min(kink // 2, (length - 1) // 2)
    padded = np.pad(triangle(length - 2 * reach), reach + kink)
    curve = gaussian_filter1d(padded, kink / 4)[kink : kink + length]
    return np.asarray(curve / curve.max())


def damage(
    take: Take, *, amounts: Amounts | None = None, seed: int
) -> tuple[Take, tuple[Artifact, ...]]:
    """Damage a clean take the way real recordings are.

    Parameters
    ----------
    take : clean; NaN = missing, such samples are never touched
    amounts : how many of each, for every 40 s; see :class:`Amounts`
    seed : same seed, same damage

    Returns
    -------
    the damaged take and the truth in order of start; two artifacts of one marker are at least
    a quarter of a second apart, different markers may be wrong at once. The amplitude is the
    length of the largest deviation; for noise the standard deviation per axis, for a swap the
    median distance between the two

    Raises
    ------
    DataError
        when the take is too short, or has too few markers seen long enough
    """
    amounts = amounts or Amounts()
    rng = np.random.default_rng(seed)
    site = _Site(take, rng)
    many = take.duration_s / 40.0
    # The largest first, while there is room.
    damages: list[Damage] = []
    for count, make in (
        (amounts.long_gaps, _long_gap),
        (amounts.occlusions, _occlusion),
        (amounts.swaps, _swap),
        (amounts.drifts, _drift),
        (amounts.steps, _step),
        (amounts.bursts, _burst),
        (amounts.short_gaps, _short_gap),
        (amounts.peaks, _peak),
        (amounts.swaps_of_three, _swap_of_three),
        (amounts.swaps_with_gap, _swap_with_gap),
        (amounts.brief_swaps, _brief_swap),
        (amounts.ghosts, _ghost),
        (amounts.frozen, _frozen),
        (amounts.peaks_on_drifts, _peak_on_drift),
        (amounts.falls, _fall),
    ):
        for i in range(max(1, round(count * many)) if count else 0):
            damages.append(make(site, i))
    return apply_damage(take, damages)


class _Site:
    """A take under damage: draws places that are seen and still clean."""

    def __init__(self, take: Take, rng: np.random.Generator) -> None:
        self.take, self.rng = take, rng
        self._free = take.present.copy()
        self._free[:, [i for i, s in enumerate(take.labels) if is_unlabelled(s)]] = False

    def frames(self, low_s: float, high_s: float) -> int:
        """Draw a length, shorter ones more often."""
        length_s = np.exp(self.rng.uniform(np.log(low_s), np.log(high_s)))
        return max(1, round(float(length_s) * self.take.rate))

    def size(self, low_mm: float, high_mm: float) -> float:
        """Draw an amplitude, smaller ones more often."""
        return float(np.exp(self.rng.uniform(np.log(low_mm), np.log(high_mm))))

    def place(self, length: int) -> tuple[int, str]:
        """First frame and marker for ``length`` damaged frames, marked as used."""
        start, (label,) = self.neighbours(length, 1, (0.0, np.inf))
        return start, label

    def neighbours(
        self, length: int, count: int, distances: tuple[float, float]
    ) -> tuple[int, list[str]]:
        """First frame, one marker and the nearest others within a range of distances (mm)."""
        edge = round(_EDGE_S * self.take.rate)
        if self.take.frames > length + 2 * edge:
            for _ in range(_TRIES):
                start = int(self.rng.integers(edge, self.take.frames - length - edge + 1))
                able = self._open(start, length)
                if not able.any():
                    continue
                first = int(self.rng.choice(np.flatnonzero(able)))
                rows = self.take.positions[start : start + length]
                apart = np.linalg.norm(rows - rows[:, first : first + 1], axis=2).min(axis=0)
                able &= (apart >= distances[0]) & (apart <= distances[1])
                able[first] = False
                near = [int(i) for i in np.argsort(apart) if able[i]][: count - 1]
                if len(near) == count - 1:
                    return start, [self._use(start, length, i) for i in (first, *near)]
        raise DataError("The take is too short or too damaged already to put more damage in.")

    def _open(self, start: int, length: int) -> BoolArray:
        """Markers that are seen and clean over an interval and some time around it."""
        apart = round(_APART_S * self.take.rate)
        rows = self._free[max(0, start - apart) : start + length + apart]
        return np.asarray(rows.all(axis=0))

    def place_at_end(self, length: int) -> tuple[int, str]:
        """First frame and marker that is clean for the last ``length`` frames of the take."""
        start = self.take.frames - length
        able = np.flatnonzero(self._open(start, length)) if start > 0 else np.zeros(0, np.int64)
        if not len(able):
            raise DataError("The take is too short or too damaged already to put more damage in.")
        return start, self._use(start, length, int(self.rng.choice(able)))

    def free(self, start: int, length: int, marker: str) -> None:
        """Give a place back that turned out not to serve."""
        self._free[start : start + length, self.take.index(marker)] = True

    def _use(self, start: int, length: int, column: int) -> str:
        """Mark samples as damaged."""
        self._free[start : start + length, column] = False
        return self.take.labels[column]

    def direction(self, axes: str) -> FloatArray:
        """Unit vector within the named axes, none of its parts negligible."""
        parts = self.rng.uniform(0.35, 1.0, len(axes))
        parts *= self.rng.choice([-1.0, 1.0], len(parts))
        return np.asarray(parts / np.linalg.norm(parts))

    def axes(self) -> str:
        """One, two or mostly all three axes."""
        return str(self.rng.choice(["x", "y", "z", "xy", "yz", "xyz", "xyz", "xyz"]))


def _long_gap(site: _Site, i: int) -> Damage:
    length = site.frames(0.6, 1.6)
    start, marker = site.place(length)
    return hidden(marker, start, start + length, "simulated long gap")


def _short_gap(site: _Site, i: int) -> Damage:
    length = site.frames(0.03, 0.25)
    start, marker = site.place(length)
    return hidden(marker, start, start + length, "simulated short gap")


def _occlusion(site: _Site, i: int) -> Damage:
    """Hide neighbours together, each a little longer or shorter."""
    length = site.frames(0.3, 0.9)
    start, markers = site.neighbours(length, 3, (0.0, np.inf))
    parts = []
    for marker in markers:
        late, early = site.rng.integers(0, max(1, length // 6), 2)
        first, last = start + int(late), start + length - int(early)
        parts.append(hidden(marker, first, last, "simulated occlusion"))
    return _together(*parts)


def _swap(site: _Site, i: int) -> Damage:
    length = site.frames(0.2, 1.2)
    start, pair = site.neighbours(length, 2, _SWAP_MM)
    return swapped(site.take, pair, start, start + length, "simulated swap")


def _swap_of_three(site: _Site, i: int) -> Damage:
    length = site.frames(0.2, 1.2)
    start, three = site.neighbours(length, 3, _SWAP_MM)
    return swapped(site.take, three, start, start + length, "simulated swap of three")


def _brief_swap(site: _Site, i: int) -> Damage:
    start, pair = site.neighbours(1, 2, _SWAP_MM)
    return swapped(site.take, pair, start, start + 1, "simulated swap of one frame")


def _swap_with_gap(site: _Site, i: int) -> Damage:
    """Lose one of two markers where they change places, or while they are exchanged."""
    length, lost = site.frames(0.3, 1.2), site.frames(0.05, 0.15)
    start, pair = site.neighbours(length, 2, _SWAP_MM)
    swap = swapped(site.take, pair, start, start + length, "simulated swap with a gap")
    first = 0 if i % 2 else length // 3
    holed, second = swap.patches
    values, origin = holed.values.copy(), np.full(length, Origin.MEASURED, dtype=np.uint8)
    values[first : first + lost], origin[first : first + lost] = np.nan, Origin.MISSING
    holed = replace(holed, values=values, origin=origin)
    gap = hidden(pair[0], start + first, start + first + lost, "simulated gap in a swap")
    return Damage((holed, second), (*swap.artifacts, *gap.artifacts))


def _ghost(site: _Site, i: int) -> Damage:
    """Hide a marker but for a few frames, which are far off."""
    length, size = site.frames(0.2, 0.6), site.size(15.0, 80.0)
    start, marker = site.place(length)
    kept = min(site.frames(0.01, 0.06), length // 3)
    first = start + (length - kept) // 2
    before = hidden(marker, start, first, "simulated gap before a ghost")
    after = hidden(marker, first + kept, start + length, "simulated gap after a ghost")
    offset = np.tile(size * site.direction("xyz"), (kept, 1))
    ghost = added(site.take, marker, "xyz", first, offset, Kind.STEP, size, "simulated ghost")
    return _together(before, ghost, after)


def _frozen(site: _Site, i: int) -> Damage:
    """Repeat a position while the marker moves at least 30 mm."""
    length = site.frames(0.15, 0.6)
    for _ in range(_TRIES):
        start, marker = site.place(length)
        rows = site.take.positions[start - 1 : start + length, site.take.index(marker)]
        away = rows[:1] - rows[1:]
        size = float(np.linalg.norm(away, axis=1).max())
        if size >= _FROZEN_MM:
            why = "simulated frozen stretch"
            planned = added(site.take, marker, "xyz", start, away, Kind.STEP, size, why)
            # What is added to each sample rounds; a repeated position is the same to the last bit.
            (patch,) = planned.patches
            same = replace(patch, values=np.repeat(rows[:1], length, axis=0))
            return replace(planned, patches=(same,))
        site.free(start, length, marker)
    raise DataError("No marker of the take moves enough to freeze it.")


def _fall(site: _Site, i: int) -> Damage:
    length, size = site.frames(2.5, 8.0), site.size(20.0, 80.0)
    start, marker = site.place_at_end(length)
    deviation = np.tile(size * site.direction("xyz"), (site.take.frames - start, 1))
    why = "simulated marker that fell off"
    return added(site.take, marker, "xyz", start, deviation, Kind.STEP, size, why)


def _peak_on_drift(site: _Site, i: int) -> Damage:
    length, height, size = site.frames(0.3, 1.2), site.size(8.0, 35.0), site.size(8.0, 70.0)
    start, marker = site.place(length)
    deviation = height * hann(length)[:, None] * site.direction("xyz")
    top = length // 2
    deviation[top] += size * site.direction("xyz")
    why = "simulated slow change under a peak"
    drift = added(site.take, marker, "xyz", start, deviation, Kind.SLOW, height, why)
    peak = Artifact(
        marker,
        "xyz",
        start + top,
        start + top + 1,
        Kind.PEAK,
        amplitude_mm=size,
        why="simulated peak on a slow change",
    )
    return Damage(drift.patches, (*drift.artifacts, peak))


def _together(*parts: Damage) -> Damage:
    """Several as one."""
    return Damage(
        tuple(patch for one in parts for patch in one.patches),
        tuple(artifact for one in parts for artifact in one.artifacts),
    )


def _drift(site: _Site, i: int) -> Damage:
    """Slow change: sharp, rounded and smooth shapes take turns."""
    length, axes, size = site.frames(0.3, 1.2), site.axes(), site.size(8.0, 35.0)
    start, marker = site.place(length)
    kink = max(2, round(0.09 * site.take.rate))
    name, shape = (
        ("sharp", triangle(length)),
        ("rounded", rounded_triangle(length, kink)),
        ("smooth", hann(length)),
    )[i % 3]
    deviation = size * shape[:, None] * site.direction(axes)
    why = f"simulated slow change, {name}"
    return added(site.take, marker, axes, start, deviation, Kind.SLOW, size, why)


def _step(site: _Site, i: int) -> Damage:
    length, axes, size = site.frames(0.15, 0.9), site.axes(), site.size(8.0, 45.0)
    start, marker = site.place(length)
    deviation = np.tile(size * site.direction(axes), (length, 1))
    return added(
        site.take, marker, axes, start, deviation, Kind.STEP, size, "simulated step change"
    )


def _burst(site: _Site, i: int) -> Damage:
    length, size = site.frames(0.2, 0.7), site.size(3.0, 9.0)
    start, marker = site.place(length)
    deviation = size * site.rng.standard_normal((length, 3))
    return added(
        site.take, marker, "xyz", start, deviation, Kind.NOISE, size, "simulated heavy noise"
    )


def _peak(site: _Site, i: int) -> Damage:
    axes, size = site.axes(), site.size(8.0, 70.0)
    start, marker = site.place(1)
    deviation = size * site.direction(axes)[None, :]
    return added(
        site.take, marker, axes, start, deviation, Kind.PEAK, size, "simulated single peak"
    )
