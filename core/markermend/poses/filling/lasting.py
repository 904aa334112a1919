"""Fill gaps that last by what was at other moments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from markermend.arrays import BoolArray, Float32Array, FloatArray, IntArray
from markermend.poses.filling.borders import Borders
from markermend.poses.filling.gaps import Gap
from markermend.poses.filling.likeness import (
    MOMENTS,
    Telling,
    by_likeness,
    moments_to_compare,
    some_of,
    weights_of,
)
from markermend.poses.filling.paces import Paces, Weights
from markermend.poses.filling.remembered import Performances
from markermend.poses.filling.sides import Mirror

# A short recording shows less than there is, which it cannot tell by itself: squared errors of what
# alike moments tell are larger by so many seconds over how long it is, which is taken to be so long
# at least.
_TOO_SURE_S, _LEAST_S = 10.0, 5.0


@dataclass(frozen=True, eq=False)
class Moves:
    """How a recording moves.

    Attributes
    ----------
    rows : of :func:`markermend.poses.filling.likeness.moving`
    paces : what moves faster than a moment
    """

    rows: Float32Array
    paces: Paces


@dataclass(frozen=True, eq=False)
class Look:
    """What gaps are filled from, so precise as it takes.

    Attributes
    ----------
    estimate : (frames, channels) what the pass before made
    moves : by which alike moments are found; None where none are asked
    base : (frames, channels) all gaps bridged
    known : (channels, frames) bool
    so_far : (channels, frames + 1) in how many of the frames before a channel is known
    covariances : length of a gap to those that levels and deviations are regressed with
    rate, cross, noise : as :func:`markermend.poses.filling.filling.fill` has them
    compared : moments that are asked besides those beside a gap, mirrored ones, others' ones
    joints : (channels,) number of the joint that each is of
    mirror : of all channels, where there is one
    performed : other recordings that are asked, where there are any
    firm : whether regressions tell of frames that they were not learnt from as they do of others
    """

    estimate: Float32Array
    moves: Moves | None
    base: FloatArray
    known: BoolArray
    so_far: Float32Array
    covariances: dict[int, tuple[Float32Array, Float32Array]]
    rate: float
    cross: Callable[[int], FloatArray]
    noise: float
    compared: tuple[int, int, int]
    joints: IntArray
    mirror: Mirror | None
    performed: Performances | None
    firm: bool
    _frames_of: dict[bytes, IntArray] = field(default_factory=dict)

    def frames_of(self, channels: IntArray) -> IntArray:
        """Frames in which channels are all known; many gaps ask of the same ones."""
        key = channels.tobytes()
        if key not in self._frames_of:
            self._frames_of[key] = np.flatnonzero(self.known[channels].all(axis=0))
        return self._frames_of[key]


def fill_lasting(
    gap: Gap,
    look: Look,
    weights: Float32Array,
    others: IntArray,
    hidden: Float32Array,
    doubt: Float32Array,
) -> tuple[Float32Array, Float32Array] | None:
    """Tell by alike moments what regressions leave; None where too few are known.

    Parameters
    ----------
    gap, look : what is filled, and from what
    weights : (others, channels of the gap) of a regression on all movement alike
    others : channels that are seen during the gap
    hidden : (channels,) for which share of the gap each is not
    doubt : (others,) share of their variance that is added where they are regressed on
    """
    start, during, rate, moves = gap.start, slice(gap.start, gap.stop), look.rate, look.moves
    if moves is None:
        return None
    there = look.frames_of(gap.channels)
    chosen = moments_to_compare(there, start, gap.stop, rate, look.compared[0])
    if not len(chosen):
        return None
    by = np.zeros((len(hidden), len(gap.channels)), dtype=np.float32)
    by[others] = weights
    told = moves.paces.regressed(by, others, gap.channels, doubt)
    trust = np.zeros(len(hidden), dtype=np.float32)
    trust[others] = (1 - hidden[others]) * weights_of(by, look.joints)[others]
    strays, variance = by_likeness(
        moves.rows[during],
        start,
        _telling(chosen, moves, gap, told),
        trust,
        by,
        rate,
        look.noise,
        [*_mirrored(moves, look, gap, told), *_performed(moves, look, gap, trust, by)],
        _borders(look, gap),
    )
    variance *= np.float32(1.0 + _TOO_SURE_S / max(len(look.estimate) / rate, _LEAST_S))
    return told.tell(look.estimate[during], moves.paces.moved[during]) + strays, variance


def _telling(
    frames: IntArray, moves: Moves, gap: Gap, told: Weights, mirror: Mirror | None = None
) -> Telling:
    """Moments, and what regressions leave of a gap's channels then."""
    rows, fast = moves.rows[frames], moves.paces.moved[frames]
    if mirror is not None:
        rows, fast = mirror.image(rows), mirror.image(fast)
    # How they change stands beside the poses.
    poses = rows[:, : len(told.by)]
    return Telling(rows, poses[:, gap.channels] - told.tell(poses, fast), frames)


def _mirrored(moves: Moves, look: Look, gap: Gap, told: Weights) -> list[Telling]:
    """Moments in which the other side of the body was seen, mirrored."""
    mirror = look.mirror
    if mirror is None:
        return []
    twins = mirror.twins[gap.channels]
    there = some_of(look.frames_of(twins), look.compared[1])
    path = look.estimate[:, twins] * mirror.signs[gap.channels] if _asks(look) else None
    return [replace(_telling(there, moves, gap, told, mirror), path=path)]


def _performed(
    moves: Moves, look: Look, gap: Gap, trust: Float32Array, by: Float32Array
) -> list[Telling]:
    """Moments of other recordings, recording by recording."""
    others, most = look.performed, look.compared[2]
    if others is None or not most:
        return []
    found = []
    for path, chosen in others.nearest(moves.rows[gap.start : gap.stop], trust, most):
        poses, frames = others.paths[path], others.frames[chosen]
        targets = poses[np.ix_(frames, gap.channels)] - poses[frames] @ by
        way = poses[:, gap.channels] if _asks(look) else None
        found.append(Telling(others.moved[chosen], targets, frames, way))
    return found


def _borders(look: Look, gap: Gap) -> Borders | None:
    """The borders of a gap, where they are asked of."""
    if not _asks(look):
        return None
    return Borders(look.estimate[:, gap.channels], gap.start, gap.stop, look.rate)


def _asks(look: Look) -> bool:
    """Whether borders are asked of: where most moments are compared; few are too few."""
    return look.compared == MOMENTS
