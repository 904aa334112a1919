"""Fill what was not seen from the rest of the body and from time, all gaps at once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.filling.bridging import (
    SIDE,
    arch,
    around,
    bridge,
    bridged,
    straight,
    time_variance,
)
from markermend.poses.filling.covariance import Moments, learn, pooled
from markermend.poses.filling.crossing import cross_short
from markermend.poses.filling.ends import gone_on
from markermend.poses.filling.gaps import Gap, by_lasting, gaps_of
from markermend.poses.filling.lasting import Look, Moves, fill_lasting
from markermend.poses.filling.likeness import FEW_MOMENTS, moving
from markermend.poses.filling.paces import lengths_of_paces, paces_of
from markermend.poses.filling.regressing import regress
from markermend.poses.filling.remembered import Performances
from markermend.poses.filling.sides import Mirror, of_both_sides

# Gaps up to this long are many and alike, and are crossed all at once; a rough result crosses gaps
# up to this long by time alone.
_SHORT_S, _ROUGH_S = 0.02, 0.1
BRIEF_S = 0.3
"""Gaps that last longer are told by alike moments."""

# Share of the deviations' estimate beside the levels', in brief gaps and in longer ones.
_BRIEF, _LONG = 0.85, 0.5
# Added to variances before regressing: absolute, and of a channel hidden part of the time.
_RIDGE, _LEVEL_RIDGE, _DOUBT = 1e-4, 1e-3, 0.1
_MOSTLY_HIDDEN = 0.999
# How much movement within a gap counts beside whole poses where levels are regressed.
_PASSING = 1.5
# Without a prior so many frames for each channel keep regressions from fitting these too well.
_FIRM = 20


@dataclass(frozen=True, eq=False)
class Filled:
    """What was filled, and how sure it is.

    Attributes
    ----------
    values : (frames, channels), the known ones as they were
    variance : (frames, channels) expected squared error, 0 where known
    base : (frames, channels) all gaps crossed by what stands beside them
    gaps : all that there are
    lasting : number of gaps that pay to be filled again from a better estimate
    """

    values: FloatArray
    variance: FloatArray
    base: FloatArray
    gaps: list[Gap]
    lasting: int

    def and_more(self, known: FloatArray) -> Filled:
        """The same with some channels more, which are known."""
        values, base = (np.hstack([own, known]) for own in (self.values, self.base))
        variance = np.pad(self.variance, ((0, 0), (0, known.shape[1])))
        return replace(self, values=values, variance=variance, base=base)

    def but(self, count: int) -> Filled:
        """The same without the last channels."""
        values, variance, base = (x[:, :-count] for x in (self.values, self.variance, self.base))
        return replace(self, values=values, variance=variance, base=base)


def fill(
    values: FloatArray,
    known: BoolArray,
    rate: float,
    prior: Moments | None = None,
    *,
    beside: FloatArray | None = None,
    mirror: Mirror | None = None,
    noise: float = 0.0,
    rough: bool = False,
    begun: Filled | None = None,
    near: Filled | None = None,
    compared: tuple[int, int, int] = FEW_MOMENTS,
    joints: IntArray | None = None,
    performed: Performances | None = None,
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
    mirror : of a body whose other side tells of its gaps, and of what stands beside it
    noise : standard deviation of what is left of noise in the known values
    rough : to look for noise: once, and short gaps by time alone
    begun : what a rough look made, which gaps that last are filled from
    near : what was made of an earlier result, to fill lasting gaps once more from it
    compared : moments of the recording that are compared with such a gap, as it is and mirrored,
        and of what is performed
    joints : (channels,) number of the joint that each is of; what tells more of a gap by a
        regression counts more in comparing moments, all of a joint alike. None where each channel
        stands for itself
    performed : other recordings, of the same body or of strangers, with what stands beside it

    Notes
    -----
    Each gap is bridged by time; how far its channels stray from the bridge is regressed on how far
    the visible ones stray from theirs, with covariances within a time as long as the gap. Where
    values are noisy bridges are straight, since curves carry on what two frames do at a side. A
    regression on the levels of the visible channels, its residual bridged, is mixed in. Channels
    hidden part of the time enter with what the pass before made of them. A second pass fills gaps
    that last, where what moves faster than a moment is regressed by itself
    (:mod:`markermend.poses.filling.paces`), and what regressions leave is told by alike moments
    (:func:`markermend.poses.filling.likeness.by_likeness`).
    """
    joints = np.arange(values.shape[1]) if joints is None else joints
    if beside is not None:
        more, there = beside.shape[1], np.ones(beside.shape, dtype=bool)
        whole = fill(
            np.hstack([values, beside]),
            np.hstack([known, there]),
            rate,
            prior.and_more(more) if prior is not None else None,
            mirror=mirror,
            noise=noise,
            rough=rough,
            begun=begun and begun.and_more(beside),
            near=near and near.and_more(beside),
            compared=compared,
            joints=np.append(joints, np.full(more, joints.max() + 1)),
            performed=performed,
        )
        return whole.but(more)

    def learnt(whole: NDArray[Any], lengths: Iterable[int]) -> Moments:
        own = learn(whole, rate, lengths)
        return pooled(of_both_sides(own, mirror) if mirror is not None else own, prior)

    cross = straight if rough or noise > 0 else bridge
    short = max(round((_ROUGH_S if rough else _SHORT_S) * rate), 1)
    if near is None:
        base, gaps = bridged(values, known), begun.gaps if begun is not None else gaps_of(known)
        variance = time_variance(base, known, rate)
    else:
        base, gaps, variance = near.base, near.gaps, near.variance.copy()
    if not rough and near is None:
        shortest = [gap for gap in gaps if _crossed_at_once(gap, short, len(known))]
        moments = learnt(base, range(1, short + 1))
        cross_short(base, variance, known, shortest, moments, rate, cross)
    lengthy = [gap for gap in gaps if not _crossed_at_once(gap, short, len(known))]
    brief, again = (lengthy, []) if rough else by_lasting(lengthy, len(known), BRIEF_S * rate)
    estimate = base.copy() if near is None else np.where(known, base, near.values)
    first = lengthy if near is None else []
    if begun is not None:
        first = brief
        for part in (gap.part for gap in again):
            estimate[part], variance[part] = begun.values[part], begun.variance[part]
    seen_by_channel = np.ascontiguousarray(known.T)
    so_far = np.cumsum(np.pad(seen_by_channel, ((0, 0), (1, 0))), axis=1, dtype=np.float32)
    for some in filter(len, [first, again]):
        single = np.asarray(estimate, dtype=np.float32)
        lengths = {gap.length for gap in some}
        alike = some is again
        moments = learnt(single, lengths | (lengths_of_paces(rate) if alike else set()))
        look = Look(
            single,
            Moves(moving(single, rate), paces_of(single, rate, moments)) if alike else None,
            base,
            seen_by_channel,
            so_far,
            _covariances(moments, lengths, rate),
            rate,
            cross,
            noise,
            compared,
            joints,
            mirror,
            performed,
            prior is not None or len(known) >= _FIRM * known.shape[1],
        )
        estimate = estimate.copy()
        for gap in some:
            estimate[gap.part], variance[gap.part] = _fill_gap(gap, look)
    return Filled(np.where(known, values, estimate), variance, base, gaps, len(again))


def _crossed_at_once(gap: Gap, short: int, frames: int) -> bool:
    """Whether a gap is one of the many short ones that lie between known frames."""
    return gap.length <= short and gap.start >= SIDE and gap.stop + SIDE <= frames


def _covariances(
    moments: Moments, lengths: Iterable[int], rate: float
) -> dict[int, tuple[Float32Array, Float32Array]]:
    """Of levels and of deviations, for each length of a gap."""
    found: dict[int, tuple[Float32Array, Float32Array]] = {}
    nearest: dict[int, tuple[Float32Array, Float32Array]] = {}
    for length in lengths:
        place = moments.nearest(length / rate)
        if place not in nearest:
            within = moments.within[place]
            levels = moments.whole + _PASSING * within
            nearest[place] = levels.astype(np.float32), within.astype(np.float32)
        found[length] = nearest[place]
    return found


def _fill_gap(gap: Gap, look: Look) -> tuple[NDArray[Any], NDArray[Any]]:
    """(length, channels) values of a gap and their variances; by alike moments if so wished."""
    start, stop, length = gap.start, gap.stop, gap.length
    frames, rate = len(look.estimate), look.rate
    hidden = 1 - (look.so_far[:, stop] - look.so_far[:, start]) / np.float32(length)
    telling = np.asarray(hidden < _MOSTLY_HIDDEN)
    telling[gap.channels] = False
    others = np.flatnonzero(telling)
    doubt = _DOUBT * hidden[others]
    levels_by, strays_by = look.covariances[length]
    ridge = _LEVEL_RIDGE * float(np.trace(levels_by)) / len(levels_by)
    weights, left = regress(levels_by, others, gap.channels, ridge, doubt)
    if length >= BRIEF_S * rate:
        lasting = fill_lasting(gap, look, weights, others, hidden, doubt)
        if lasting is not None:
            return lasting
    seen = look.estimate[start:stop, others]
    inside = seen @ weights
    ends = np.array([start - 1, stop]).clip(0, frames - 1)
    beside = look.base[ends[:, None], gap.channels] - look.estimate[ends[:, None], others] @ weights
    if start == 0 or stop == frames:
        if start == 0 and stop == frames:
            raise ValueError("A channel is never known.")
        onwards = _gone_on(gap, look, look.estimate[:, others] @ weights if look.firm else None)
        if onwards is not None:
            return onwards
        return inside + beside[1 if start == 0 else 0], np.tile(left, (length, 1))
    levels = inside + straight(length)[:, [SIDE - 1, SIDE]] @ beside
    shape = arch(length)[:, None]
    if start < SIDE or stop + SIDE > frames:
        return levels, shape * left
    weights, left = regress(strays_by, others, gap.channels, _RIDGE, doubt)
    bridges = look.cross(length) @ look.estimate[around(start, stop)]
    told = (seen - bridges[:, others]) @ weights
    share = _BRIEF if length < BRIEF_S * rate else _LONG
    return (
        share * (bridges[:, gap.channels] + told) + (1.0 - share) * levels,
        shape * left,
    )


def _gone_on(
    gap: Gap, look: Look, told: Float32Array | None
) -> tuple[FloatArray, FloatArray] | None:
    """Of a gap at an end of a recording: where what stands beside it goes."""
    known: BoolArray = np.asarray(look.known[gap.channels].all(axis=0))
    if gap.stop == len(known):
        before = slice(0, gap.start)
        return gone_on(look.base[before, gap.channels], told, known[before], gap.length, look.rate)
    after = slice(None, gap.stop - 1, -1)
    told = told[::-1] if told is not None else None
    back = gone_on(look.base[after, gap.channels], told, known[after], gap.length, look.rate)
    return None if back is None else (back[0][::-1], back[1][::-1])
