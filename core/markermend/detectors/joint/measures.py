"""What is measured of a possible slow change, to tell a drift from the hills bodies make."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.detectors.joint.bands import HALF
from markermend.detectors.joint.bank import KINDS, LONGEST, SHORTEST, shape_of
from markermend.detectors.joint.explained import explained
from markermend.detectors.joint.views import BODY, EVEN, ODD, OWN, Seen, Views, see, see_whole
from markermend.detectors.joint.whiten import LAGS

KINK = 10
"""Frames over which the filter answers to a kink."""
STILL_MM = 0.02
"""Speed per frame at which a body stands still, as far as setting out goes."""
FEATURES = (
    *("score", "reweighted", "raw score", "chi²", "level", "length", "kind"),
    *("start", "rise", "apex", "fall", "end"),
    *("start share", "apex share", "end share"),
    *("lowest band", "low band", "high band", "highest band"),
    *("lowest share", "low share", "high share"),
    *("without a part", "without a band", "weakest view"),
    *("t ratio", "t gain", "left over", "before", "after"),
    *("even", "odd", "own", "even height", "odd height", "own height"),
    *("other axis", "third axis", "other t", "all axes loud"),
    *("rectangle", "hann", "saw up", "saw down", "step in", "step out", "early", "late", "wide"),
    *("over spread", "inside spread", "speed", "acceleration", "kick"),
    *("sets out", "stops"),
    *("explained", "quieter", "crowd", "take crowd"),
)
CROWDS = (FEATURES.index("crowd"), FEATURES.index("take crowd"))


def refine(
    views: Views, axis: IntArray, start: IntArray, kind: FloatArray, length: IntArray
) -> tuple[IntArray, IntArray, FloatArray]:
    """Find start and length to the frame, as the score says.

    Returns
    -------
    start, length : (n,)
    shapes : (n, longest)
    """
    frames = views.error.shape[3]
    best = np.full(len(axis), -1.0)
    first, longest = start.copy(), length.copy()
    shapes = np.zeros((len(axis), LONGEST))
    for more in (-2, -1, 0, 1, 2):
        one = np.clip(length + more, SHORTEST, LONGEST)
        tried = stack(kind, one)
        for later in (-1, 0, 1):
            at = np.clip(start + later - (more // 2), 0, frames - one)
            score = np.abs(see(views, BODY, axis, at, tried).score)
            wins = score > best
            best[wins], first[wins], longest[wins] = score[wins], at[wins], one[wins]
            shapes[wins] = tried[wins]
    return first, longest, shapes


def stack(kind: FloatArray, length: IntArray) -> FloatArray:
    """Shapes as rows, (n, longest)."""
    rows = np.zeros((len(length), LONGEST))
    for n, (k, one) in enumerate(zip(kind, length, strict=True)):
        rows[n, :one] = shape_of(str(k), int(one))
    return rows


def measure(
    views: Views,
    axis: IntArray,
    start: IntArray,
    length: IntArray,
    kind: FloatArray,
    shapes: FloatArray,
    level: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Measure candidates of one marker.

    Returns
    -------
    size : (n,) mm, signed height by a robust fit
    features : (n, k) see :data:`FEATURES`; the last two, how many others are as loud, are 0
    """
    seen = see(views, BODY, axis, start, shapes)
    push, mass = seen.push, seen.power
    frame = np.arange(seen.shape.shape[2])[None, None, :]
    within = (frame >= HALF) & (frame < (length + LAGS + HALF)[:, None, None])
    raw, sign = seen.score, np.sign(push.sum(axis=1))
    loud = np.maximum(np.abs(raw), 1e-6)
    parts, shares, chi, without_part = _parts(seen, length)
    softened = chi / (1.0 + (0.15 * raw) ** 2 / 4)
    reweighted = loud / np.maximum(1.0, ((1 + (softened / 4) ** 3) / 2) ** (1 / 6))
    size, ratio = _robust(seen, within)
    whole = see_whole(views, axis, start, seen)
    fitted, _ = _robust(replace(seen, error=whole), within)
    clear, quieter = explained(seen, whole, fitted)
    rest = seen.error - size[:, None, None] * seen.shape
    power = (within * seen.error**2 * seen.weight).sum(axis=(1, 2))
    left = (within * rest**2 * seen.weight).sum(axis=(1, 2))
    count = np.maximum((within & (seen.weight[:, :1] > 0)).sum(axis=(1, 2)), 1)
    flank = [_activity(views, axis, at, length) for at in (start - length, start + length + LAGS)]
    views_seen = [see(views, v, axis, start, shapes) for v in (EVEN, ODD, OWN)]
    columns = [
        loud / level,
        reweighted / level,
        loud,
        chi,
        level,
        length / LONGEST,
        np.array([list(KINDS).index(str(k)) for k in kind], dtype=np.float64),
        *(parts * sign[:, None]).T,
        *shares[:, [0, 2, 4]].T,
        *(push * sign[:, None] / np.sqrt(mass)).T,
        *(mass / mass.sum(axis=1, keepdims=True))[:, :3].T,
        without_part / level,
        _without_one(push, mass) / level,
        np.min([v.score * sign for v in views_seen[:2]], axis=0) / level,
        ratio / loud**2,
        np.sqrt(np.maximum(ratio, 0.0)) / level,
        left / np.maximum(power, 1e-9),
        *(np.log((left / count + 0.1) / (f + 0.1)) for f in flank),
    ]
    columns += [v.score * sign / loud for v in views_seen]
    columns += [np.clip(v.height / np.where(size == 0, 1e-6, size), -3, 3) for v in views_seen]
    columns += _other_axes(views, axis, start, shapes, loud)
    columns += _competitors(views, axis, start, length, loud)
    columns += _circumstances(views, axis, start, length, shapes, size)
    columns += [clear / level, quieter]
    columns += [np.zeros(len(axis))] * 2
    return fitted, np.column_stack(columns)


def _parts(seen: Seen, length: IntArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Kinks and flanks: how far each stands from the whole, its share, χ²; score without one."""
    t = np.arange(seen.shape.shape[2])[None, :] - HALF
    middle = length[:, None] // 2 - 2
    end = length[:, None] - 2
    which = (t >= KINK).astype(int) + (t >= middle) + (t >= middle + KINK) + (t >= end)
    num = (seen.shape * seen.error * seen.weight).sum(axis=1)
    den = (seen.shape**2 * seen.weight).sum(axis=1)
    push = np.stack([(num * (which == k)).sum(axis=1) for k in range(5)], axis=1)
    mass = np.stack([(den * (which == k)).sum(axis=1) for k in range(5)], axis=1) + 1e-9
    height = push.sum(axis=1) / mass.sum(axis=1)
    parts = (push - height[:, None] * mass) / np.sqrt(mass)
    chi = (push**2 / mass).sum(axis=1) - push.sum(axis=1) ** 2 / mass.sum(axis=1)
    shares = mass / mass.sum(axis=1, keepdims=True)
    return parts, shares, np.maximum(chi, 0.0), _without_one(push, mass)


def _without_one(push: FloatArray, mass: FloatArray) -> FloatArray:
    """The score that stays without whichever part, or band, it stands on most, (n,)."""
    push = push * np.sign(push.sum(axis=1, keepdims=True))
    rest = np.maximum(mass.sum(axis=1, keepdims=True) - mass, 1e-9)
    return np.asarray(((push.sum(axis=1, keepdims=True) - push) / np.sqrt(rest)).min(axis=1))


def _robust(seen: Seen, within: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Height by Huber's weights, and the likelihood ratio of Student's t with 4 degrees."""
    height = seen.height
    for _ in range(3):
        off = np.abs(seen.error - height[:, None, None] * seen.shape) * np.sqrt(seen.weight)
        w = seen.weight / np.maximum(1.0, off / 1.5)
        mass = np.maximum((seen.shape**2 * w).sum(axis=(1, 2)), 1e-9)
        height = (seen.shape * seen.error * w).sum(axis=(1, 2)) / mass
    rest = (seen.error - height[:, None, None] * seen.shape) ** 2 * seen.weight
    power = seen.error**2 * seen.weight
    gain = np.log1p(power) - np.log1p(rest)
    return height, 2.5 * (gain * within).sum(axis=(1, 2))


def _activity(views: Views, axis: IntArray, start: IntArray, length: IntArray) -> FloatArray:
    """Mean square of the innovations over one length, in their standard deviations."""
    frames = views.error.shape[3]
    square = (views.error[BODY] ** 2 * views.weight[BODY]).sum(axis=1)
    total = np.pad(np.cumsum(square, axis=1), ((0, 0), (1, 0)))
    a, b = np.clip(start, 0, frames), np.clip(start + length, 0, frames)
    return np.asarray((total[axis, b] - total[axis, a] + 1.0) / (b - a + 1.0))


def _other_axes(
    views: Views, axis: IntArray, start: IntArray, shapes: FloatArray, loud: FloatArray
) -> list[FloatArray]:
    """The same shape on the two other axes, the louder first."""
    heard, ratios, activity = [], [], []
    for turn in (1, 2):
        other = (axis + turn) % 3
        best = np.zeros(len(axis))
        for later in (-4, 0, 4):
            seen = see(views, BODY, other, start + later, shapes)
            best = np.maximum(best, np.abs(seen.score))
            if later == 0:
                _, ratio = _robust(seen, np.ones(seen.shape.shape, dtype=bool))
                ratios.append(ratio)
                scaled = (seen.error**2 * seen.weight).sum(axis=1)
                activity.append(scaled.mean(axis=1))
        heard.append(best)
    both = np.stack(heard)
    return [
        both.max(axis=0) / loud,
        both.min(axis=0) / loud,
        np.max(ratios, axis=0) / loud**2,
        np.max(activity, axis=0),
    ]


def _competitors(
    views: Views,
    axis: IntArray,
    start: IntArray,
    length: IntArray,
    loud: FloatArray,
) -> list[FloatArray]:
    """Scores of other shapes over the score, and of what is left after the fit."""
    rows = np.arange(LONGEST)[None, :]
    span = length[:, None]
    on = rows < span
    ramp = np.where(on, (rows + 1.0) / span, 0.0)
    back = np.where(on, 1.0 - rows / span, 0.0)
    round_ = np.where(on, 0.5 - 0.5 * np.cos(2 * np.pi * (rows + 1) / (span + 1)), 0.0)
    ahead = np.ones((len(axis), LONGEST))
    out = [
        np.abs(see(views, BODY, axis, start, s).score) / loud
        for s in (on.astype(np.float64), round_, ramp, back)
    ]
    # Steps are judged by their edge alone: where the whitened step is loudest.
    for at in (start, start + length):
        edge = see(views, BODY, axis, at, ahead[:, :KINK])
        out.append(np.abs(edge.score) / loud)
    half = np.maximum(length // 2, 2)
    short = stack(np.array(["sharp"] * len(length)), np.maximum(length, 2))
    for later in (-half, half):
        other = see(views, BODY, axis, start + later, short)
        out.append(np.abs(other.score) / loud)
    wide = np.zeros((len(axis), 2 * LONGEST))
    for n, one in enumerate(length):
        wide[n, : 2 * one] = shape_of("sharp", 2 * int(one))
    out.append(np.abs(see(views, BODY, axis, start - half, wide).score) / loud)
    return out


def _circumstances(
    views: Views,
    axis: IntArray,
    start: IntArray,
    length: IntArray,
    shapes: FloatArray,
    size: FloatArray,
) -> list[FloatArray]:
    """Height over the residual's usual spread around, and how the body moves meanwhile."""
    residual, frames = views.residual, len(views.residual)
    velocity = np.gradient(views.body, axis=0)
    travelled = _travelled(velocity)
    speed = uniform_filter1d(np.linalg.norm(velocity, axis=1), 9)
    bend = uniform_filter1d(np.linalg.norm(np.gradient(velocity, axis=0), axis=1), 9)
    kick = maximum_filter1d(bend, 9)
    speed, bend, kick = (v / (np.median(v) + 1e-6) + 1e-3 for v in (speed, bend, kick))
    rows = np.zeros((len(axis), 7))
    for n in range(len(axis)):
        a, one = int(start[n]), int(length[n])
        b, x = min(a + one, frames), residual[:, axis[n]]
        around = np.concatenate([x[max(0, a - 2 * one) : a], x[b : b + 2 * one]])
        middle = np.median(around) if len(around) > 10 else np.median(x)
        spread = np.median(np.abs(around - middle)) if len(around) > 10 else 1.0
        inner = x[a:b] - size[n] * shapes[n, : b - a]
        left = np.median(np.abs(inner - np.median(inner)))
        pace = _pace(travelled, a, a + one)
        rows[n] = (
            np.log((abs(size[n]) + 0.1) / (spread + 0.1)),
            np.log((left + 0.1) / (spread + 0.1)),
            np.log(speed[a:b].mean()),
            np.log(bend[a:b].mean()),
            np.log(kick[a:b].max()),
            np.log(pace / _pace(travelled, a - one, a)),
            np.log(pace / _pace(travelled, a + one, a + 2 * one)),
        )
    return list(rows.T)


def _travelled(velocity: FloatArray) -> FloatArray:
    """Path of a body from its (frames, 3) velocity, smoothed over 9 frames, (frames + 1,) mm."""
    smooth = uniform_filter1d(velocity, 9, axis=0)
    return np.pad(np.cumsum(np.linalg.norm(smooth, axis=1)), (1, 0))


def _pace(travelled: FloatArray, start: int, stop: int) -> float:
    """Mean speed between two frames and one more of standing still, in mm per frame."""
    last = len(travelled) - 1
    a, b = min(max(start, 0), last), min(max(stop, 0), last)
    return float((travelled[b] - travelled[a] + STILL_MM) / (b - a + 1)) + STILL_MM
