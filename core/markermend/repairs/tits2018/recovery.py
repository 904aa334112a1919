"""Recovery of one interval: candidates of several models, averaged by likelihood of distances.

Beyond the paper, as its authors' code has it: markers present in under 30 % of the frames are no
references; references, candidates, weights and result are filtered over 0.07 s; models learn from
every n-th frame. Where the code draws frames at random, here they are evenly spaced.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import ceil

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.repairs.tits2018.constraints import join, keep_distance, weigh
from markermend.repairs.tits2018.local_frame import (
    describe,
    into,
    local_axes,
    out_of,
    rank_by_spread,
)
from markermend.repairs.tits2018.models import coefficients, freedom, grnn, linear, polynomial, thin
from markermend.repairs.tits2018.pca import reconstruct
from markermend.repairs.tits2018.smoothing import WINDOW_S, smooth

MODELS = ("li", "lpr", "lgrnn", "glr", "pca")
# Presence below which a marker is no reference.
LEAST_PRESENCE = 0.3
# Distance spread in mm up to which a marker is an input of the global regression.
LINEAR_SPREAD_MM = 50.0
LINEAR_FRAMES, LOCAL_FRAMES = 500, 1000
# Fewer frames with the marker and its three references teach nothing.
LEAST_FRAMES = 10

# (frames + 2, 3) positions, and how many numbers were learnt for them.
Fit = tuple[FloatArray, int]


@dataclass(frozen=True, eq=False)
class Scene:
    """What a recovery works on.

    Attributes
    ----------
    positions : (frames, markers, 3) relative to the body's mean, NaN where not trusted
    marker : column to recover
    centre : (frames, 3) the body's mean, to be added back
    ranked : references, best first
    spread : (markers,) standard deviation of the distance to each, mm
    window : of the filters, frames
    constrain : hold results to continuity and usual distances
    """

    positions: FloatArray
    marker: int
    centre: FloatArray
    ranked: IntArray
    spread: FloatArray
    window: int
    constrain: bool

    @property
    def own(self) -> FloatArray:
        """(frames, 3) what is known of the marker."""
        return self.positions[:, self.marker]


def make_scene(positions: FloatArray, marker: int, rate: float, *, constrain: bool = True) -> Scene:
    """Centre a sequence and rank the references of a marker.

    Parameters
    ----------
    positions : (frames, markers, 3) of one body, NaN where not trusted
    marker : column to recover
    rate : frames per second
    constrain : hold results to continuity and usual distances
    """
    there = ~np.isnan(positions[:, :, 0])
    positions = positions.copy()
    rare = there.mean(axis=0) < LEAST_PRESENCE
    rare[marker] = False
    positions[:, rare] = np.nan
    always = there.all(axis=0)
    centre = positions[:, always].mean(axis=1) if always.any() else np.zeros(positions[:, 0].shape)
    positions -= centre[:, None]
    ranked, spread = rank_by_spread(positions, marker)
    return Scene(positions, marker, centre, ranked, spread, ceil(WINDOW_S * rate), constrain)


def recover(scene: Scene, start: int, stop: int, models: Sequence[str]) -> tuple[FloatArray, int]:
    """Recover a marker over an interval.

    Parameters
    ----------
    scene : made by :func:`make_scene`; the marker's own samples in the interval must be NaN
    start, stop : half-open interval of frames
    models : of :data:`MODELS`; several are averaged

    Returns
    -------
    (stop - start, 3) mm, NaN where no three references are seen together; and how many numbers
    all models learnt for it, those in the system of three references anew for each three
    """
    track = scene.own.copy()
    fits = {n: WHOLE_BODY[n](scene, start, stop) for n in models if n in WHOLE_BODY}
    whole = {n: None if fit is None else fit[0] for n, fit in fits.items()}
    learnt = sum(fit[1] for fit in fits.values() if fit is not None)
    while True:
        missing = runs(np.isnan(track[start:stop, 0]))
        three = _pick_three(scene, start + missing)
        if three is None:
            break
        local = _Local(scene, three)
        left = int(np.isnan(track[start:stop, 0]).sum())
        if len(local.rows) >= LEAST_FRAMES:
            learnt += sum(local.learnt(name) for name in models)
            for first, last in start + missing:
                _fill_piece(scene, local, whole, models, track, (int(first), int(last), start))
        if int(np.isnan(track[start:stop, 0]).sum()) == left:
            break
    smoothed = smooth(track, scene.window)
    return smoothed[start:stop] + scene.centre[start:stop], learnt


def _pick_three(scene: Scene, pieces: IntArray) -> IntArray | None:
    """The best three references that are seen together in some frame that is still missing."""
    there = ~np.isnan(scene.positions[:, scene.ranked, 0])
    frames = np.concatenate([np.arange(a, b) for a, b in pieces]) if len(pieces) else None
    if frames is None:
        return None
    some = np.flatnonzero(there[frames].any(axis=0))
    for chosen in combinations(some, 3):
        if there[np.ix_(frames, chosen)].all(axis=1).any():
            return scene.ranked[list(chosen)]
    return None


def _fill_piece(
    scene: Scene,
    local: _Local,
    whole: dict[str, FloatArray | None],
    models: Sequence[str],
    track: FloatArray,
    piece: tuple[int, int, int],
) -> None:
    """Fill what can be filled of one missing piece, in place."""
    first, last, origin = piece
    seen = [~np.isnan(reference[first:last, 0]) for reference in local.raw]
    together: BoolArray = np.all(seen, axis=0)
    for a, b in first + runs(together):
        candidates = [local.candidate(name, int(a), int(b)) for name in models if name not in whole]
        for values in whole.values():
            if values is not None:
                # One frame more on either side, as the local candidates have.
                inside = values[a - origin : b - origin + 2]
                candidates.append(_joined(scene, inside, int(a), int(b)))
        usable = [c for c in candidates if not np.isnan(c[1:-1]).any()]
        if usable:
            track[a:b] = _average(scene, local, usable, int(a), int(b))[1:-1]


def _joined(scene: Scene, values: FloatArray, start: int, stop: int) -> FloatArray:
    """Values joined to what is known on both sides, where constraints are on."""
    if not scene.constrain:
        return values
    return join(values, *_borders(scene.own, start, stop))


def _borders(
    track: FloatArray, start: int, stop: int
) -> tuple[FloatArray | None, FloatArray | None]:
    """What is known in the frames before and after an interval."""
    before = track[start - 1] if start > 0 and not np.isnan(track[start - 1, 0]) else None
    after = track[stop] if stop < len(track) and not np.isnan(track[stop, 0]) else None
    return before, after


class _Local:
    """The models that work in the system of three references, for one marker."""

    def __init__(self, scene: Scene, three: IntArray) -> None:
        self.raw = [scene.positions[:, r] for r in three]
        self.scene = scene
        clean = [smooth(r, scene.window) for r in self.raw]
        axes = local_axes(clean[0], clean[1], clean[2])
        self.own = into(axes, clean[0], scene.own)
        self.inputs = describe(clean[0], clean[1], clean[2], axes)
        self.usual = [
            d[~np.isnan(d)]
            for d in (np.linalg.norm(c - smooth(scene.own, scene.window), axis=1) for c in clean)
        ]
        known = ~np.isnan(self.own).any(axis=1) & ~np.isnan(self.inputs).any(axis=1)
        self.rows = thin(np.flatnonzero(known), LOCAL_FRAMES)

    def learnt(self, name: str) -> int:
        """How many numbers a model learns here; none where it only interpolates."""
        if name == "lpr":
            return coefficients(9)
        return freedom(self.inputs[self.rows]) if name == "lgrnn" else 0

    def candidate(self, name: str, start: int, stop: int) -> FloatArray:
        """(stop - start + 2, 3) of one model, the frames on either side included."""
        frames = np.clip(np.arange(start - 1, stop + 1), 0, len(self.own) - 1)
        before, after = _borders(self.own, start, stop)
        if name == "li":
            values = _straight(before, after, len(frames))
        else:
            values = REGRESSIONS[name](
                self.inputs[self.rows], self.own[self.rows], self.inputs[frames]
            )
            values = join(values, before, after) if self.scene.constrain else values
        raw = [r[frames] for r in self.raw]
        return out_of(local_axes(raw[0], raw[1], raw[2]), raw[0], values)


def _straight(before: FloatArray | None, after: FloatArray | None, count: int) -> FloatArray:
    """Straight line between two points; the one that is known is held where the other is not."""
    if before is None and after is None:
        return np.full((count, 3), np.nan)
    first, last = (after if before is None else before), (before if after is None else after)
    assert first is not None
    assert last is not None
    return np.asarray(first + np.linspace(0.0, 1.0, count)[:, None] * (last - first))


def _average(
    scene: Scene, local: _Local, candidates: list[FloatArray], start: int, stop: int
) -> FloatArray:
    """Average candidates by how usual their distances to the references are (eq. 20 to 27)."""
    frames = np.clip(np.arange(start - 1, stop + 1), 0, len(scene.own) - 1)
    references = [r[frames] for r in local.raw]
    result = candidates[0]
    if len(candidates) > 1:
        smoothed = [smooth(c, scene.window) for c in candidates]
        window = min(scene.window, ceil((stop - start) / 2))
        weights = []
        for c in smoothed:
            distances = [np.linalg.norm(c - r, axis=1) for r in references]
            known = [np.where(np.isnan(d), 0.0, d) for d in distances]
            weights.append(smooth(weigh(known, local.usual)[:, None], window))
        total = np.sum(weights, axis=0)
        result = np.sum([w * c for w, c in zip(weights, smoothed, strict=True)], axis=0) / total
    if scene.constrain:
        result = keep_distance(result, references, local.usual)
    return result


def _global_linear(scene: Scene, start: int, stop: int) -> Fit | None:
    """Model 1 over the interval and a frame on either side; None without four markers."""
    frames = np.clip(np.arange(start - 1, stop + 1), 0, len(scene.own) - 1)
    there: BoolArray = np.all(~np.isnan(scene.positions[frames, :, 0]), axis=0)
    there[scene.marker] = False
    if there.sum() <= 3:
        return None
    close = there & (scene.spread <= LINEAR_SPREAD_MM)
    inputs = scene.positions[:, close if close.any() else there].reshape(len(scene.own), -1)
    known = ~np.isnan(scene.own[:, 0]) & ~np.isnan(inputs).any(axis=1)
    rows = thin(np.flatnonzero(known), LINEAR_FRAMES)
    if len(rows) < 2:
        return None
    values = linear(inputs[rows], scene.own[rows], inputs[frames])
    return values, coefficients(inputs.shape[1])


def _components(scene: Scene, start: int, stop: int) -> Fit | None:
    """Weighted PCA over the interval; the frames on either side repeat its first and last."""
    wanted: BoolArray = np.zeros(len(scene.own), dtype=bool)
    wanted[start:stop] = True
    usable = ~np.isnan(scene.positions[:, :, 0]).all(axis=0)
    places = np.flatnonzero(usable)
    column = int(np.searchsorted(places, scene.marker))
    fit = reconstruct(scene.positions[:, places], column, wanted)
    if fit is None:
        return None
    values, learnt = fit
    return np.concatenate([values[:1], values, values[-1:]]), learnt


LocalModel = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
REGRESSIONS: dict[str, LocalModel] = {"lpr": polynomial, "lgrnn": grnn}
WHOLE_BODY: dict[str, Callable[[Scene, int, int], Fit | None]] = {
    "glr": _global_linear,
    "pca": _components,
}
