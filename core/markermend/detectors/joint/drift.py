"""Candidates for slow changes: where a shape of the bank stands out of a whitened residual."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d, median_filter

from markermend.arrays import BoolArray, FloatArray
from markermend.detectors.joint.bank import LONGEST, bank, local_level, scores
from markermend.detectors.joint.whiten import CLIP, LAGS, White, whiten
from markermend.predictors.local import predict_local

LEAST = 4.4
APART = 15
PARTS = 5
FEATURES = (
    *("score", "raw score", "reweighted score", "chi²", "level", "length", "sharp", "hann"),
    *("size over spread", "other axes", "own alone", "own sign", "competitor", "left over"),
    *("speed", "acceleration", "crowd", "neighbours"),
)


@dataclass(frozen=True, eq=False)
class Candidates:
    """Possible slow changes of one marker.

    Attributes
    ----------
    axis, start, stop : (n,) where
    size_mm : (n,) signed fitted height
    features : (n, 18) see :data:`FEATURES`; the last, what its neighbours do, is still 0
    """

    axis: FloatArray
    start: FloatArray
    stop: FloatArray
    size_mm: FloatArray
    features: FloatArray


@dataclass(frozen=True, eq=False)
class Scan:
    """One marker looked at.

    Attributes
    ----------
    candidates : possible slow changes
    loudness : (frames,) the highest score of any axis and shape whose middle lies there
    """

    candidates: Candidates
    loudness: FloatArray


def scan(positions: FloatArray, marker: int, known: BoolArray, trusted: BoolArray) -> Scan:
    """Look for slow changes of one marker.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN only where the target is not ``known``
    marker : column
    known : (frames, 3) bool, samples of the target that are measured and not damaged
    trusted : (frames, markers) bool, samples that may be learned from

    Returns
    -------
    Scan; without candidates where the body says nothing about the marker
    """
    frames = len(positions)
    predicted = predict_local(positions, marker, trusted=trusted)
    judged = known & ~np.isnan(predicted)
    if judged.all(axis=1).sum() < 3 * LONGEST:
        return Scan(_none(), np.zeros(frames))
    own = _held(positions[:, marker], judged)
    body = _held(predicted, judged)
    residual = own - body
    whites = [
        _muted(whiten(residual[:, a], body[:, a], judged[:, a]), judged[:, a]) for a in range(3)
    ]
    alone = [
        _muted(whiten(own[:, a], np.zeros(frames), judged[:, a]), judged[:, a]) for a in range(3)
    ]
    fits = [scores(w) for w in whites]
    levels = [local_level(s) for s, _ in fits]
    motion = _motion_of(body)
    lengths = np.array([n for _, n in bank()[1]])
    loudness = np.zeros(frames)
    parts = []
    for axis in range(3):
        score, size = fits[axis]
        relative = np.abs(score) / levels[axis][:, None]
        best = relative.argmax(axis=1)
        height = relative[np.arange(frames), best]
        middle = np.minimum(np.arange(frames) + lengths[best] // 2, frames - 1)
        np.maximum.at(loudness, middle, height)
        at = np.flatnonzero((height >= LEAST) & (height == maximum_filter1d(height, 2 * APART + 1)))
        for t in at:
            one = _measure(
                int(t),
                int(best[t]),
                axis,
                fits,
                whites[axis],
                alone[axis],
                levels[axis],
                residual[:, axis],
                motion,
                len(at),
            )
            parts.append((axis, int(t), int(t + lengths[best[t]]), float(size[t, best[t]]), one))
    if not parts:
        return Scan(_none(), loudness)
    axes, start, stop, size_mm, rows = (np.array(v) for v in zip(*parts, strict=True))
    return Scan(Candidates(axes, start, stop, size_mm, rows), loudness)


def _measure(
    start: int,
    template: int,
    axis: int,
    fits: list[tuple[FloatArray, FloatArray]],
    white: White,
    alone: White,
    level: FloatArray,
    residual: FloatArray,
    motion: tuple[FloatArray, FloatArray],
    count: int,
) -> FloatArray:
    """Features of one candidate."""
    shapes, names = bank()
    kind, length = names[template]
    shape = shapes[:length, template]
    raw = float(fits[axis][0][start, template])
    chi, left_over = _consistency(white, shape, start, raw)
    softened = chi / (1.0 + (0.15 * raw) ** 2 / 4)
    rho = abs(raw) / max(1.0, ((1 + (softened / 4) ** 3) / 2) ** (1 / 6))
    near = slice(max(0, start - 3), start + 4)
    others = max(float(np.abs(fits[a][0][near, template]).max()) for a in range(3) if a != axis)
    own = _score_of(alone, shape, start)
    stop = start + length
    around = np.concatenate(
        [residual[max(0, start - 2 * length) : start], residual[stop : stop + 2 * length]]
    )
    spread = float(np.median(np.abs(around - np.median(around)))) if len(around) > 10 else 1.0
    size = float(fits[axis][1][start, template])
    jump = abs(_score_of(white, np.ones(length), start))
    speed, bend = motion
    return np.array(
        [
            abs(raw) / level[start],
            abs(raw),
            rho / level[start],
            chi,
            level[start],
            length / LONGEST,
            kind == "sharp",
            kind == "hann",
            np.log((abs(size) + 0.1) / (spread + 0.1)),
            others / abs(raw),
            abs(own) / abs(raw),
            np.sign(own) * np.sign(raw),
            jump / abs(raw),
            left_over,
            np.log(speed[start:stop].mean()),
            np.log(bend[start:stop].mean()),
            count / len(residual) * 1000,
            0.0,
        ]
    )


def _consistency(white: White, shape: FloatArray, start: int, raw: float) -> tuple[float, float]:
    """χ² of five parts of a shape against the whole, and the share of power the fit leaves."""
    seen, precision, error = _in_window(white, shape, start)
    weight = seen**2 * precision
    total = max(float(weight.sum()), 1e-12)
    cumulated = np.cumsum(weight) / total
    part = np.minimum((cumulated * PARTS).astype(int), PARTS - 1)
    push = np.bincount(part, seen * error * precision, minlength=PARTS)
    mass = np.maximum(np.bincount(part, weight, minlength=PARTS), 1e-12)
    height = float(push.sum()) / total
    chi = float((push**2 / mass).sum() - push.sum() ** 2 / total)
    power = float((error**2 * precision).sum())
    rest = float(((error - height * seen) ** 2 * precision).sum())
    return max(chi, 0.0), rest / max(power, 1e-9)


def _score_of(white: White, shape: FloatArray, start: int) -> float:
    """Signal-to-noise ratio of one shape at one place."""
    seen, precision, error = _in_window(white, shape, start)
    norm = float((seen**2 * precision).sum())
    return float((seen * error * precision).sum()) / max(math.sqrt(norm), 1e-9)


def _in_window(
    white: White, shape: FloatArray, start: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """What the filter makes of a shape, precision and clipped innovations, on the same frames."""
    stop = min(start + len(shape) + LAGS, len(white.error))
    padded = np.pad(shape, (LAGS, LAGS))[: stop - start + LAGS]
    rows = np.arange(stop - start)
    seen = sum(white.habit[start:stop, k] * padded[rows + LAGS - k] for k in range(LAGS + 1))
    sigma = white.sigma[start:stop]
    error = np.clip(white.error[start:stop], -CLIP * sigma, CLIP * sigma)
    return np.asarray(seen), 1.0 / sigma**2, error


def _muted(white: White, judged: BoolArray) -> White:
    """The same without innovations that unknown samples have a part in."""
    touched = maximum_filter1d((~judged).view(np.uint8), 2 * LAGS + 1) > 0
    return White(np.where(touched, 0.0, white.error), white.sigma, white.habit)


def _held(values: FloatArray, judged: BoolArray) -> FloatArray:
    """Bridge samples that are not judged by straight lines."""
    frames = np.arange(len(values))
    return np.column_stack(
        [np.interp(frames, frames[ok], v[ok]) for v, ok in zip(values.T, judged.T, strict=True)]
    )


def _motion_of(body: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Speed and acceleration of the predicted marker, over the take's own medians."""
    velocity = np.gradient(body, axis=0)
    return _relative(velocity), _relative(np.gradient(velocity, axis=0))


def _relative(vectors: FloatArray) -> FloatArray:
    """Lengths, single frames smoothed away, over their median; never 0."""
    length = np.linalg.norm(vectors, axis=1)
    smooth = median_filter(length, 9, mode="nearest")
    return np.asarray(smooth / (np.median(length) + 1e-6) + 1e-3)


def _none() -> Candidates:
    """No candidates."""
    nothing = np.zeros(0)
    return Candidates(nothing, nothing, nothing, nothing, np.zeros((0, len(FEATURES))))
