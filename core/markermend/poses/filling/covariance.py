"""How the features of a body move together: over a whole recording, and within a moment."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.filling.bridging import SIDE, bridge
from markermend.poses.normal import FEATURES

# Lengths in seconds for which movement within a gap is learnt.
LENGTHS_S = (0.008, 0.017, 0.033, 0.067, 0.133, 0.25, 0.5, 1.0, 2.0, 4.0)
# Where the rotation begins among a joint's features.
_TURN = 3
_INSIDE = 5
# Added to variances where what is not told of is regressed, of the mean one and at least.
_RIDGE, _TINY = 1e-3, 1e-12
_WINDOWS_A_LENGTH = 8


@dataclass(frozen=True, eq=False)
class Moments:
    """Means and covariances of features ``(channels,)``.

    Attributes
    ----------
    mean : (channels,)
    whole : (channels, channels) covariance over all poses
    within : one (channels, channels) covariance for each of :data:`LENGTHS_S`, of the deviations
        from the bridge over that time
    weight : poses that mean and whole count for when another recording's are added
    counts : the same for each length of ``within``; 0 where nothing is known of it
    told : (channels,) bool, those that anything is known of; None where all are
    """

    mean: FloatArray
    whole: FloatArray
    within: FloatArray
    weight: float
    counts: FloatArray
    told: BoolArray | None = None

    def nearest(self, seconds: float) -> int:
        """Place of the nearest length in :data:`LENGTHS_S`, a known one."""
        near = np.abs(np.log(np.array(LENGTHS_S) / max(seconds, 1e-6)))
        near[self.counts <= 0] = np.inf
        return int(np.argmin(near))

    def within_s(self, seconds: float) -> FloatArray:
        """(channels, channels) of the nearest length in :data:`LENGTHS_S`, a known one."""
        return np.asarray(self.within[self.nearest(seconds)])

    def of(self, channels: BoolArray | IntArray) -> Moments:
        """Moments of some of the channels, or of all in another order."""
        both = np.ix_(channels, channels)
        within = self.within[:, both[0], both[1]]
        told = None if self.told is None else self.told[channels]
        return Moments(
            self.mean[channels], self.whole[both], within, self.weight, self.counts, told
        )

    def signed_like(self, values: FloatArray) -> Moments:
        """Moments of rotations that have the signs of others: of q and -q the nearer one.

        Parameters
        ----------
        values : (channels,) a pose or a mean; 0 where it tells nothing
        """
        flat = signs_like(self.mean, values)
        both = flat[:, None] * flat
        return replace(
            self, mean=flat * self.mean, whole=both * self.whole, within=both * self.within
        )

    def longer(self, times: float) -> Moments:
        """Moments of bodies whose positions are measured in units so many times as short."""
        scale = np.where(np.arange(len(self.mean)) % FEATURES < _TURN, times, 1.0)
        both = scale[:, None] * scale
        return replace(
            self, mean=scale * self.mean, whole=both * self.whole, within=both * self.within
        )

    def and_more(self, count: int) -> Moments:
        """Moments with some channels more, of which nothing is known but that they do not move."""
        more = (0, count)
        within = np.pad(self.within, ((0, 0), more, more))
        whole = np.pad(self.whole, (more, more))
        told = None if self.told is None else np.append(self.told, np.ones(count, dtype=bool))
        return Moments(np.pad(self.mean, more), whole, within, self.weight, self.counts, told)


def signs_like(own: FloatArray, values: FloatArray) -> FloatArray:
    """(channels,) 1 or -1, what features take that rotations have the signs of others.

    Parameters
    ----------
    own, values : (channels,) a pose or a mean each; 0 where it tells nothing
    """
    signs = np.ones((len(own) // FEATURES, FEATURES))
    mine, there = (x.reshape(signs.shape)[:, _TURN:] for x in (own, values))
    signs[np.sum(mine * there, axis=1) < 0, _TURN:] = -1.0
    return signs.ravel()


def nearest_length(seconds: float) -> int:
    """Place of the nearest length in :data:`LENGTHS_S`."""
    return int(np.argmin(np.abs(np.log(np.array(LENGTHS_S) / max(seconds, 1e-6)))))


def deviations(values: NDArray[Any], length: int) -> NDArray[Any]:
    """How far features stray from the bridge over windows all along a recording.

    Parameters
    ----------
    values : (frames, channels) without NaN
    length : of the windows, in frames

    Returns
    -------
    (samples, channels); none where the recording is too short
    """
    inside = np.unique(np.linspace(0.15 * length, 0.85 * length, _INSIDE).astype(int))
    inside = inside[inside < length]
    step = max(length // _WINDOWS_A_LENGTH, 1)
    starts = np.arange(SIDE, len(values) - length - SIDE + 1, step)
    sides = np.r_[-SIDE:0, length : length + SIDE]
    weights = bridge(length)[inside].astype(values.dtype)
    if not len(starts):
        return np.empty((0, values.shape[1]), dtype=values.dtype)

    def at(offset: int) -> NDArray[Any]:
        return values[starts[0] + offset : starts[-1] + offset + 1 : step]

    beside = np.stack([at(side) for side in sides.tolist()])
    strays = (weights @ beside.reshape(len(sides), -1)).reshape(len(inside), *beside.shape[1:])
    for place, stray in zip(inside.tolist(), strays, strict=True):
        np.subtract(at(place), stray, out=stray)
    return np.asarray(strays.reshape(-1, values.shape[1]))


def learn(values: NDArray[Any], rate: float, lengths: Iterable[int] | None = None) -> Moments:
    """Learn moments from a recording.

    Parameters
    ----------
    values : (frames, channels) without NaN
    rate : frames per second
    lengths : of the gaps they are wanted for, in frames; for all of :data:`LENGTHS_S` when not
        given. The moments of other lengths are zero.
    """
    frames, channels = values.shape
    wanted = {nearest_length(n / rate) for n in lengths} if lengths is not None else None
    mean = values.mean(axis=0)
    centred = values - mean
    within = np.zeros((len(LENGTHS_S), channels, channels))
    counts = np.zeros(len(LENGTHS_S))
    for i, seconds in enumerate(LENGTHS_S):
        if wanted is not None and i not in wanted:
            continue
        strays = deviations(values, max(round(seconds * rate), 1))
        # Neighbouring windows repeat each other.
        counts[i] = min(frames, len(strays))
        within[i] = strays.T @ strays / max(len(strays), 1)
    return Moments(mean, centred.T @ centred / frames, within, float(frames), counts)


def pooled(own: Moments, prior: Moments | None) -> Moments:
    """Moments of a recording and of others before it, each by its weight.

    Channels that the others tell nothing of move with those that they tell of as they do in the
    recording itself.
    """
    if prior is None:
        return own
    if prior.told is not None:
        prior = replace(
            prior,
            whole=completed(prior.whole, own.whole, prior.told),
            within=np.stack(
                [
                    completed(*both, prior.told)
                    for both in zip(prior.within, own.within, strict=True)
                ]
            ),
        )
    total = own.weight + prior.weight
    whole = (own.weight * own.whole + prior.weight * prior.whole) / total
    counts = own.counts + prior.counts
    share = (own.counts / np.maximum(counts, 1e-9))[:, None, None]
    within = share * own.within + (1.0 - share) * prior.within
    return Moments(own.mean, whole, within, total, counts)


def completed(covariance: FloatArray, own: FloatArray, told: BoolArray) -> FloatArray:
    """A covariance whose untold channels are regressed on the told ones as another has it.

    Parameters
    ----------
    covariance : (channels, channels); what it has of untold channels does not matter
    own : (channels, channels) the other
    told : (channels,) bool
    """
    if told.all():
        return covariance
    here, there = np.ix_(told, told), np.ix_(told, ~told)
    ridge = _RIDGE * float(np.trace(own)) / len(own) + _TINY
    by = np.linalg.solve(own[here] + ridge * np.eye(int(told.sum())), own[there])
    left = own[np.ix_(~told, ~told)] - own[there].T @ by
    out = own.copy()
    out[here] = covariance[here]
    out[there] = covariance[here] @ by
    out[np.ix_(~told, told)] = out[there].T
    out[np.ix_(~told, ~told)] = by.T @ covariance[here] @ by + left
    return out


def averaged(parts: Sequence[Moments], weight: float) -> Moments:
    """One prior of many recordings, longer ones counting for more.

    Parameters
    ----------
    parts : of the same channels
    weight : poses that the result counts for
    """
    whole = sum(p.weight for p in parts)
    counts = np.maximum(sum(p.counts for p in parts), 1e-9)
    return Moments(
        np.asarray(sum(p.weight * p.mean for p in parts) / whole),
        np.asarray(sum(p.weight * p.whole for p in parts) / whole),
        np.asarray(sum(p.counts[:, None, None] * p.within for p in parts) / counts[:, None, None]),
        weight,
        np.full(len(LENGTHS_S), weight),
    )
