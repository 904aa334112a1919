"""Fill what was not seen from the rest of the body and from time, all gaps at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.poses.bridging import SIDE, around, bridge, bridged, known_alike, straight
from markermend.poses.covariance import Moments, learn, pooled
from markermend.poses.likeness import by_likeness, moments_to_compare

# Gaps up to this long are many and alike, and are crossed all at once; a rough result crosses gaps
# up to this long by time alone.
_SHORT_S, _ROUGH_S = 0.02, 0.1
_PASSES = 2
# Share of the deviations' estimate beside the levels', in gaps shorter and longer than this.
_BRIEF_S, _BRIEF, _LONG = 0.3, 0.85, 0.5
# Added to variances before regressing: absolute, and of a channel hidden part of the time.
_RIDGE, _LEVEL_RIDGE, _DOUBT = 1e-4, 1e-3, 0.1
_SHORT_RIDGE = 1e-6
_MOSTLY_HIDDEN = 0.999
# How much movement within a gap counts beside whole poses where levels are regressed.
_PASSING = 1.5


@dataclass(frozen=True, eq=False)
class Filled:
    """What was filled, and how sure it is.

    Attributes
    ----------
    values : (frames, channels), the known ones as they were
    variance : (frames, channels) expected squared error, 0 where known
    lasting : some gaps are so long that to fill them again from a better estimate pays
    """

    values: FloatArray
    variance: FloatArray
    lasting: bool


@dataclass(frozen=True, eq=False)
class _Gap:
    """Channels that are unknown over the same frames."""

    start: int
    stop: int
    channels: IntArray


def fill(
    values: FloatArray,
    known: BoolArray,
    rate: float,
    prior: Moments | None = None,
    *,
    beside: FloatArray | None = None,
    noise: float = 0.0,
    rough: bool = False,
    near: FloatArray | None = None,
) -> Filled:
    """Fill the gaps of all channels.

    Parameters
    ----------
    values : (frames, channels); what stands where nothing is known does not matter
    known : (frames, channels) bool, true somewhere in every channel
    rate : frames per second
    prior : moments of the same channels from other recordings
    beside : (frames, n) what else tells of them, known in every frame, of which the prior knows
        nothing
    noise : standard deviation of what is left of noise in the known values
    rough : to look for noise: once, and short gaps by time alone
    near : (frames, channels) what was made of an earlier result, to fill once more from it; short
        gaps keep it

    Notes
    -----
    Each gap is bridged by time; how far its channels stray from the bridge is regressed on how far
    the visible ones stray from theirs, with covariances within a time as long as the gap. Where
    values are noisy bridges are straight, since curves carry on what two frames do at a side. A
    regression on the levels of the visible channels, its residual bridged, is mixed in. Channels
    hidden part of the time enter with what the pass before made of them. In the last pass, what the
    regression on levels leaves in long gaps is told by alike moments instead
    (:func:`markermend.poses.likeness.by_likeness`).
    """
    if beside is not None:
        more, there = beside.shape[1], np.ones(beside.shape, dtype=bool)
        whole = fill(
            np.hstack([values, beside]),
            np.hstack([known, there]),
            rate,
            prior.and_more(more) if prior is not None else None,
            noise=noise,
            rough=rough,
            near=np.hstack([near, beside]) if near is not None else None,
        )
        return Filled(whole.values[:, :-more], whole.variance[:, :-more], whole.lasting)
    base = bridged(values, known)
    cross = straight if rough or noise > 0 else bridge
    short = max(round((_ROUGH_S if rough else _SHORT_S) * rate), 1)
    variance = _time_variance(base, known, rate)
    gaps = _gaps(known)
    if not rough and near is None:
        brief = [gap for gap in gaps if gap.stop - gap.start <= short]
        moments = pooled(learn(base, rate, range(1, short + 1)), prior)
        _cross_short(base, variance, known, brief, moments, rate, cross)
    gaps = [gap for gap in gaps if gap.stop - gap.start > short]
    estimate = base if near is None else np.where(known, base, near)
    lengths = [gap.stop - gap.start for gap in gaps]
    # In brief gaps a second pass changes nothing that shows.
    lasting = max(lengths, default=0) >= _BRIEF_S * rate
    passes = _PASSES if lasting and not rough and near is None else 1
    for last in (False,) * (passes - 1) + (True,) if gaps else ():
        moments = pooled(learn(estimate, rate, lengths), prior)
        better = estimate.copy()
        for gap in gaps:
            alike = last and not rough
            filled, unsure = _fill_gap(
                gap, estimate, base, known, moments, rate, cross, alike, noise
            )
            better[gap.start : gap.stop, gap.channels] = filled
            if last:
                variance[gap.start : gap.stop, gap.channels] = unsure
        estimate = better
    return Filled(np.where(known, values, estimate), variance, lasting)


def _gaps(known: BoolArray) -> list[_Gap]:
    """All gaps, channels with the same frames together."""
    together: dict[tuple[int, int], list[int]] = {}
    for channels in known_alike(known):
        for start, stop in runs(~known[:, channels[0]]).tolist():
            together.setdefault((start, stop), []).extend(channels)
    return [_Gap(*frames, np.sort(columns)) for frames, columns in together.items()]


def _cross_short(
    base: FloatArray,
    variance: FloatArray,
    known: BoolArray,
    gaps: Iterable[_Gap],
    moments: Moments,
    rate: float,
    cross: Callable[[int], FloatArray],
) -> None:
    """Let short gaps of ``base``, crossed by time, stray as the others tell.

    One inverse serves all: with precisions P the unknown given the known is -P_uu⁻¹ P_uk k, of
    covariance P_uu⁻¹, and few channels are unknown at a time.
    """
    frames = len(base)
    for length in sorted({gap.stop - gap.start for gap in gaps}):
        some = [g for g in gaps if g.stop - g.start == length]
        some = [g for g in some if g.start >= SIDE and g.stop + SIDE <= frames]
        covariance = moments.within_s(length / rate)
        precision = np.linalg.inv(covariance + _SHORT_RIDGE * np.eye(len(covariance)))
        starts = np.array([gap.start for gap in some], dtype=int)[:, None]
        inside = starts + np.arange(length)
        hidden: BoolArray = np.any(~known[inside], axis=1)
        bridges = np.einsum("ls,gsc->glc", cross(length), base[starts + around(0, length)])
        told = np.where(hidden[:, None], 0.0, base[inside] - bridges) @ precision
        for n, gap in enumerate(some):
            unknown = np.flatnonzero(hidden[n])
            own = np.searchsorted(unknown, gap.channels)
            left = np.linalg.inv(precision[unknown[:, None], unknown])
            strays = told[n][:, unknown] @ left[:, own]
            base[gap.start : gap.stop, gap.channels] = bridges[n][:, gap.channels] - strays
            variance[gap.start : gap.stop, gap.channels] = np.diag(left)[own]


def _fill_gap(
    gap: _Gap,
    estimate: FloatArray,
    base: FloatArray,
    known: BoolArray,
    moments: Moments,
    rate: float,
    cross: Callable[[int], FloatArray],
    alike: bool,
    noise: float,
) -> tuple[FloatArray, FloatArray]:
    """(length, channels) values of a gap and their variances; by alike moments if so wished."""
    start, stop = gap.start, gap.stop
    length, frames = stop - start, len(estimate)
    hidden = np.mean(~known[start:stop], axis=0)
    telling = hidden < _MOSTLY_HIDDEN
    telling[gap.channels] = False
    others = np.flatnonzero(telling)
    doubt = _DOUBT * hidden[others]
    ends = np.array([start - 1, stop]).clip(0, frames - 1)
    whole = moments.whole + _PASSING * moments.within_s(length / rate)
    ridge = _LEVEL_RIDGE * np.trace(whole) / len(whole)
    weights, left = _regress(whole, others, gap.channels, ridge, doubt)
    if alike and length >= _BRIEF_S * rate:
        told = np.asarray(known[:, gap.channels].all(axis=1))
        chosen = moments_to_compare(told, start, stop, rate)
        if len(chosen):
            trust, by = (
                np.zeros(estimate.shape[1]),
                np.zeros((estimate.shape[1], len(gap.channels))),
            )
            trust[others], by[others] = 1.0 - hidden[others], weights
            levels = estimate[np.ix_(np.append(chosen, np.arange(start, stop)), others)] @ weights
            left = estimate[np.ix_(chosen, gap.channels)] - levels[: len(chosen)]
            strays, variance = by_likeness(
                estimate, trust, by, left, chosen, start, stop, rate, noise
            )
            return levels[len(chosen) :] + strays, variance
    inside = estimate[start:stop][:, others] @ weights
    beside = base[ends][:, gap.channels] - estimate[ends][:, others] @ weights
    if start == 0 or stop == frames:
        if start == 0 and stop == frames:
            raise ValueError("A channel is never known.")
        return inside + beside[1 if start == 0 else 0], np.tile(left, (length, 1))
    levels = inside + straight(length)[:, [SIDE - 1, SIDE]] @ beside
    shape = _arch(length)[:, None]
    if start < SIDE or stop + SIDE > frames:
        return levels, shape * left
    ridge = _RIDGE
    weights, left = _regress(moments.within_s(length / rate), others, gap.channels, ridge, doubt)
    bridges = cross(length) @ estimate[around(start, stop)]
    strays = (estimate[start:stop] - bridges)[:, others] @ weights
    share = _BRIEF if length < _BRIEF_S * rate else _LONG
    return (
        share * (bridges[:, gap.channels] + strays) + (1.0 - share) * levels,
        shape * left,
    )


def _regress(
    covariance: FloatArray, inputs: IntArray, targets: IntArray, ridge: float, doubt: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """(inputs, targets) weights, and the variance of each target that they leave."""
    rows = covariance[inputs]
    among, across = rows[:, inputs], rows[:, targets]
    own = np.asarray(covariance[targets, targets])
    if not len(inputs):
        return across, own
    among[np.diag_indices(len(inputs))] *= 1.0 + doubt
    among[np.diag_indices(len(inputs))] += ridge
    weights = cho_solve(cho_factor(among, check_finite=False), across, check_finite=False)
    return np.asarray(weights), np.maximum(own - np.sum(across * weights, axis=0), 0.0)


def _time_variance(base: FloatArray, known: BoolArray, rate: float) -> FloatArray:
    """Expected squared error of bridges over short gaps, from how far single frames stray."""
    variance = np.zeros_like(base)
    if len(base) > 2:
        bend = base[1:-1] - 0.5 * (base[:-2] + base[2:])
        both = known[:-2] & known[1:-1] & known[2:]
        spread = np.sum(np.where(both, bend, 0.0) ** 2, axis=0) / np.maximum(both.sum(axis=0), 1)
        variance += np.where(known, 0.0, spread)
    return variance


def _arch(length: int) -> FloatArray:
    """(length,) how the variance swells from the sides of a gap to its middle, 1 on average."""
    share = np.arange(1, length + 1) / (length + 1)
    arch = share * (1.0 - share)
    return np.asarray(arch / arch.mean())
