"""Fill joints that are not seen, pose by pose, once each of them was seen."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

import numpy as np
from threadpoolctl import ThreadpoolController

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.poses.body.bending import OthersBends
from markermend.poses.body.facing import facing, sides_of
from markermend.poses.body.jointed import above_seen, told_of
from markermend.poses.filling.covariance import Moments
from markermend.poses.filling.sides import both_sides, both_sides_moved, mirror_signs, twin_columns
from markermend.poses.normal import FEATURES, bone_lengths, normalise
from markermend.poses.pose import Pose
from markermend.poses.quaternion import (
    NO_TURN,
    by_left,
    by_right,
    inverse,
    matrices,
    multiply,
    unit,
)
from markermend.poses.solving import Regression, average_in
from markermend.poses.streaming.articulation import FAR, Articulation
from markermend.poses.streaming.hanging import bones_more, with_bones
from markermend.poses.streaming.joining import JOINING, Kept, widened
from markermend.poses.streaming.levels import Levels
from markermend.poses.turnless import given_turns, turned_as_parents

# How long a movement is taken from the prior, how long one's own are, and how many they count for.
_PRIOR_S, _LAGS_S, _MEMORY = 1.0, (0.008, 0.03, 0.125, 0.5, 2.0), 3000.0
# Movement grows with the root of time; that within this time counts as it is.
_USUAL_S = 0.125
# Added to variances, the second over the poses learnt from: of few, less is made.
_RIDGE, _FEW = 1e-4, 0.1
# The same for each bone more that hidden joints are from seen ones, where one's own poses are all
# there is: those that follow each other tell much the same, and neighbours tell more than others.
_FEW_A_BONE = 4.0
# A joint that goes keeps a speed of its own for about this long; speeds are averaged over this.
_COASTS_S, _AVERAGED_S = 0.042, 0.024
# In this time what was filled follows what it settles to.
_SETTLES_S = 0.08
# Axes turn after the root over this time, and over the second where no rotation tells of it.
_FOLLOWS_S, _FACES_S = 0.1, 0.3
# How often joints are asked for it, and how often poses are learnt from.
_ASKED_HZ, _LEARNT_HZ = 30.0, 60.0


class Following:
    """Fills joints that are not seen, from those that are and from how bodies move.

    A joint that goes follows what the visible ones do from then on, as they have moved together so
    far, in this body and in others; it settles where this body can have it, and bones keep their
    length. What is seen goes through as it is.

    Parameters
    ----------
    first : one pose that shows the root and a bone; joints that it does not show, and never those
        alone, go through as they come. A joint may have no rotation.
    moments : of how others' bodies move, all joints but the root, in axes like these
    before : with fewer joints, by such moments or none too; what it has learnt is gone on with
    bending : how others bend, all joints but the root, parents first

    Attributes
    ----------
    ever_turned : (joints,) bool, had a rotation so far
    """

    def __init__(
        self,
        first: Pose,
        moments: Moments | None = None,
        before: Following | None = None,
        bending: OthersBends | None = None,
    ) -> None:
        self._threads = ThreadpoolController()
        self._there: BoolArray = np.array(first.seen[0])
        # A joint that never had a rotation is given none.
        turnless = np.isnan(first.rotations[0, :, 3])
        self.ever_turned = ~turnless
        root, faced, self._sides = first.order[0], facing(first), None
        if turnless[root] and not np.isnan(faced).any():
            self._sides = sides_of(first.joints, first.parents)
            rotations = first.rotations.copy()
            rotations[:, root] = faced
            first = first.with_samples(first.positions, rotations, first.confidence)
        without = turnless.copy()
        without[root] &= self._sides is None
        first = turned_as_parents(first, without)
        features, normal = normalise(first)
        self._parents, self._root = first.parents, normal.root
        self._hanging = [(j, p) for j, p in enumerate(first.parents) if p >= 0]
        hung = [(j, first.parents[j]) for j in first.order if first.parents[j] >= 0]
        self._bones = [(j, p) for j, p in hung if self._there[j] and self._there[p]]
        # Without a child that was ever seen nobody knows how a joint is turned.
        self._untold = np.array([p for j, p in self._hanging if not self._there[j]], dtype=int)
        every = [j for j in range(len(first.joints)) if j != self._root]
        self._others = [j for j in every if self._there[j]]
        self._scale, self._offset = normal.scale, normal.offset
        others = None
        if moments is not None:
            others = moments.of(np.flatnonzero(np.repeat(self._there[every], FEATURES)))
        self._lengths = bone_lengths(first.positions, first.parents)
        self._own_alone = others is None
        self._values = features[0, self._others].ravel()
        self._root_pose = first.positions[0, root], first.rotations[0, root]
        self._axes_turn, self._unasked, self._unlearnt = self._root_pose[1], 0, 0
        kept = None if before is None else self._measure_as(before, first)
        self._aligning = by_right(self._offset[self._others])
        channels = len(self._values)
        self._twins: IntArray | None = None
        self._covariance, self._weight = np.zeros((channels, channels)), 0.0
        if others is not None:
            others = others.longer(normal.scale / self._scale).signed_like(self._values)
            if others.told is not None:
                others = self._carried_along(others, others.told)
            self._twins = twin_columns([first.joints[j] for j in self._others])
            self._signs = mirror_signs(self._values, self._twins)
            moved = others.within_s(_PRIOR_S)
            self._covariance = np.array(both_sides(moved, self._twins, self._signs), order="C")
            self._weight = others.weight
        at = {joint: n for n, joint in enumerate(self._others)} | {self._root: -1, -1: -1}
        above = [at[self._above(joint)] for joint in self._others]
        body = self._values, above, first.rate, self._twins
        self._articulation = Articulation(*body, self._bending(first, bending, normal.scale))
        self._levels = Levels(self._values, others, first.rate)
        self._speed, self._coasting = np.zeros(channels), np.zeros(channels)
        self._known = np.ones(channels, dtype=bool)
        self._others_tell: Regression | None = None
        self._past: deque[FloatArray | None] = deque([self._values])
        self.come_at(first.rate)
        if before is not None and kept is not None:
            self._go_on(before, kept)

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._rate = rate
        # Poses that come faster than that tell the same.
        self._learns_from = max(round(rate / _LEARNT_HZ), 1)
        self._lags = sorted({max(round(lag * rate), 1) for lag in _LAGS_S})
        self._past = deque(self._past, maxlen=self._lags[-1])
        self._levels.come_at(rate)
        self._articulation.come_at(rate)

    def _bending(self, first: Pose, others: OthersBends | None, scale: float) -> OthersBends | None:
        """How others bend, of the joints that take part; a recording's mean bone is ``scale``."""
        if others is None or not self.ever_turned[self._others].any():
            return None
        turned = self.ever_turned.copy()
        turned[self._root] |= self._sides is not None
        some = told_of(others, first, self._others, self._there, turned)
        return some.longer(scale / self._scale)

    def _carried_along(self, moments: Moments, told: BoolArray) -> Moments:
        """Let joints that others tell nothing of move along with what they hang on."""
        at = {joint: n for n, joint in enumerate(self._others)}
        carriers = []
        for joint in self._others:
            carrier = joint
            while carrier in at and not told[FEATURES * at[carrier]]:
                carrier = self._above(carrier)
            carriers.append(at.get(carrier, -1))
        carried = np.array(carriers)
        columns = (carried[:, None] * FEATURES + np.arange(FEATURES)).ravel()
        moves = np.repeat(carried >= 0, FEATURES)
        both = np.outer(moves, moves)
        copied = moments.of(columns)
        return replace(
            copied,
            mean=np.where(told, moments.mean, self._values),
            whole=both * copied.whole,
            within=both * copied.within,
            told=None,
        )

    def _measure_as(self, before: Following, first: Pose) -> Kept | None:
        """Have columns in the same units, axes and signs; None where the root's axes are others."""
        aligned = (before._offset != NO_TURN).any(axis=1)
        offset = np.where(aligned[:, None], before._offset, self._offset)
        same = (offset == before._offset).all(axis=1)
        if not same[self._root] or (before._sides is None) != (self._sides is None):
            return None
        self._scale, self._offset = before._scale, offset
        self._lengths = np.where(np.isnan(before._lengths), self._lengths, before._lengths)
        # How a joint is turned was guessed while what hangs on it was not known.
        same[before._untold] = False
        turned = np.arange(FEATURES) >= FEATURES - len(NO_TURN)
        columns = before._there[:, None] & (same[:, None] | ~turned)
        now, then = (np.flatnonzero(columns[joints]) for joints in (self._others, before._others))
        kept = Kept(now, then)
        self._aligning = by_right(self._offset[self._others])
        self._axes_turn = before._axes_turn
        self._look()
        self._values = np.zeros(len(self._others) * FEATURES)
        self._values[kept.now] = before._values[kept.before]
        every = np.ones(len(self._parents), dtype=bool)
        self._values, _ = self._relative(first.positions[0], first.rotations[0], every, every)
        return kept

    def _go_on(self, before: Following, kept: Kept) -> None:
        """Take over what was learnt, and how joints were moving."""
        self._covariance = widened(before._covariance, self._covariance, kept, _RIDGE)
        self._weight = min(before._weight, max(self._weight, JOINING))
        self._levels.go_on(before._levels, kept)
        self._speed[kept.now] = before._speed[kept.before]
        self._coasting[kept.now] = before._coasting[kept.before]
        self._known[kept.now] = before._known[kept.before]
        # What a joint hangs on is to be the same, and turned as it was.
        hold = {j: before._above(j) for j in before._others if before._above(j) == self._above(j)}
        whole = np.bincount(kept.now // FEATURES, minlength=len(self._others)) == FEATURES
        whole_at = {joint for n, joint in enumerate(self._others) if whole[n]} | {self._root, -1}
        own = [j for j, above in hold.items() if j in whole_at and above in whole_at]
        places = (
            np.flatnonzero(np.repeat(np.isin(f._others, own), FEATURES)) for f in (self, before)
        )
        self._articulation.go_on(before._articulation, Kept(*places))

    def _above(self, joint: int) -> int:
        """The nearest joint above that takes part, -1 where there is none."""
        return above_seen(self._parents, joint, self._there)

    def _look(self) -> None:
        """Have the axes at hand that poses are looked at in."""
        self._forth = multiply(self._axes_turn, self._offset[self._root])
        self._axes = matrices(self._forth[None])[0]

    def _follow_root(self, steps: float) -> None:
        """Turn axes after the root: how it shakes is no movement of what hangs on it."""
        own, turned = self._axes_turn, self._root_pose[1]
        follows_s = _FOLLOWS_S if self._sides is None else _FACES_S
        share = 1.0 - np.exp(-steps / (follows_s * self._rate))
        self._axes_turn = unit(own + share * (np.copysign(1.0, turned @ own) * turned - own))
        self._look()

    def _turned_root(self) -> FloatArray:
        """(4,) how the root is turned in the axes that poses are looked at in."""
        # How joints stand shakes more than a rotation that was measured.
        if self._sides is not None:
            return np.array(NO_TURN)
        turned = multiply(self._root_pose[1], self._offset[self._root])
        return multiply(inverse(self._forth), turned)

    def _root_turn(
        self, positions: FloatArray, turns: FloatArray, seen: BoolArray, told: BoolArray
    ) -> FloatArray:
        """(4,) how the root is turned in one pose, as it was where nothing tells."""
        if self._sides is None:
            return np.asarray(turns[self._root]) if told[self._root] else self._root_pose[1]
        self._unasked += 1
        own: FloatArray = self._root_pose[1]
        if self._unasked * _ASKED_HZ < self._rate:
            return own
        self._unasked = 0
        faced = self._sides.facing(np.where(seen[:, None], positions, np.nan)[None])[0]
        return own if np.isnan(faced).any() else faced

    def __call__(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, steps: float = 1.0
    ) -> tuple[FloatArray, FloatArray]:
        """Fill one pose.

        Parameters
        ----------
        positions : (joints, 3) mm; anything where not seen
        rotations : (joints, 4) unit quaternions x, y, z, w; 0 or NaN of a joint that has none
        seen : (joints,) bool
        steps : poses from the last to this one; those between did not come

        Returns
        -------
        positions and rotations, whole; as they came of joints that the first pose did not show, and
        rotations of joints that never had one, or on which one of those hangs
        """
        # Streams round them, and what is not of unit length would count as movement.
        told = given_turns(rotations, seen)
        self.ever_turned = self.ever_turned | told
        turns = unit(np.where(told[:, None], rotations, NO_TURN))
        place = self._root_pose[0]
        if seen[self._root] and np.isfinite(positions[self._root]).all():
            place = positions[self._root]
        self._root_pose = place, self._root_turn(positions, turns, seen, told)
        self._follow_root(steps)
        values, known = self._relative(positions, turns, seen, told)
        # Matrices as small as these take twice as long where two threads share one.
        with self._threads.limit(limits=1):
            filled = self._filled(values, known, steps)
            self._unlearnt += 1
            counts = self._unlearnt if self._unlearnt >= self._learns_from else 0
            values = self._articulation.follow(filled, known, self._turned_root(), counts, steps)
            # As whole steps each, they would draw a joint to its mean.
            share = 1.0 - np.exp(-steps / (_SETTLES_S * self._rate))
            self._values = filled + share * (values - filled)
            self._past.extend([None] * (min(round(steps), self._lags[-1]) - 1))
            self._learn(self._values, counts)
        where, turned = self._absolute(values)
        where = with_bones(where, self._bones, self._lengths.tolist(), seen.tolist())
        free = np.ones(len(seen), dtype=bool)
        free[self._others] = known[FEATURES - 1 :: FEATURES]
        free[self._root] = told[self._root]
        free |= ~self.ever_turned
        free[self._untold] = True
        came = seen | ~self._there
        return (
            np.where(came[:, None], positions, where),
            np.where((free | ~self._there)[:, None], rotations, turned),
        )

    def _relative(
        self, positions: FloatArray, rotations: FloatArray, seen: BoolArray, told: BoolArray
    ) -> tuple[FloatArray, BoolArray]:
        """Columns of one pose, signs of rotations as before, and which are known."""
        place, others = self._root_pose[0], self._others
        values = np.empty((len(others), FEATURES))
        values[:, :3] = (positions[others] - place) @ (self._axes / self._scale)
        aligned = (self._aligning @ rotations[others, :, None])[:, :, 0]
        # What matrices of quaternions turn, they turn back when they are transposed.
        values[:, 3:] = aligned @ by_left(self._forth)
        before = self._values.reshape(-1, FEATURES)[:, 3:]
        away = np.einsum("jq,jq->j", values[:, 3:], before) < 0
        values[away, 3:] *= -1.0
        turned = told.copy()
        turned[[parent for joint, parent in self._hanging if not seen[joint]]] = False
        known = np.empty(values.shape, dtype=bool)
        known[:, :3], known[:, 3:] = seen[others, None], turned[others, None]
        # So far out no joint is a body's; NaN is not known either.
        return values.ravel(), known.ravel() & (np.abs(values.ravel()) < FAR)

    def _filled(self, values: FloatArray, known: BoolArray, steps: float) -> FloatArray:
        """What is not known moves and is where what is known tells, and coasts a little."""
        now = np.where(known, values, self._values)
        hidden, visible = np.flatnonzero(~known), np.flatnonzero(known)
        if len(hidden):
            if self._others_tell is None or not np.array_equal(known, self._known):
                few = _FEW
                if self._own_alone:
                    lost = {self._others[n] for n in np.flatnonzero(~known[::FEATURES])}
                    few += _FEW_A_BONE * bones_more(self._bones, lost)
                more = _RIDGE + few / (1.0 + self._weight)
                self._others_tell = Regression(self._covariance, hidden, visible, more)
                left = self._speed[hidden] - self._others_tell.tell(self._speed[visible])
                self._levels.begin(hidden, visible, self._values)
                gone = self._known[hidden]
                self._coasting[hidden] = np.where(gone, left, self._coasting[hidden])
            told = self._others_tell.tell(now[visible] - self._values[visible])
            slower = np.exp(-1.0 / (_COASTS_S * self._rate))
            # All the way that is gone at a speed that fades.
            far = (1.0 - slower**steps) / (1.0 - slower)
            now[hidden] += told + far * self._coasting[hidden]
            self._levels.draw(now, steps)
            self._coasting *= slower**steps
        share = 1.0 - np.exp(-steps / (_AVERAGED_S * self._rate))
        self._speed += share * ((now - self._values) / steps - self._speed)
        now.reshape(-1, FEATURES)[:, 3:] = unit(now.reshape(-1, FEATURES)[:, 3:])
        self._known = known
        return now

    def _learn(self, values: FloatArray, counts: int) -> None:
        """Add how far the pose is from those of some moments ago to the covariance.

        Slow movement tells how far limbs go together, quick one how they set out; a left limb
        moves much like a right one that is mirrored.
        """
        past = self._past
        then = {n: past[-n] for n in self._lags if n <= len(past)} if counts else {}
        there = {n: one for n, one in then.items() if one is not None}
        if there:
            # Movement grows with the root of time.
            usual = np.sqrt(_USUAL_S * self._rate / np.array(list(there)))
            before = np.array(list(there.values())).reshape(len(there), len(values))
            moved = (values - before) * usual[:, None]
            if self._twins is not None:
                moved = both_sides_moved(moved, self._twins, self._signs)
            self._weight = min(self._weight + counts, _MEMORY)
            average_in(self._covariance, moved, counts / self._weight)
            self._unlearnt = 0
        self._levels.learn(values)
        past.append(values)

    def _absolute(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Positions (joints, 3) in mm and rotations (joints, 4), global."""
        positions = np.zeros((len(self._parents), 3))
        rotations = np.zeros((len(self._parents), 4))
        positions[self._root], rotations[self._root] = self._root_pose
        columns, others = values.reshape(-1, FEATURES), self._others
        positions[others] = columns[:, :3] @ (self._axes.T * self._scale) + self._root_pose[0]
        turned = (columns[:, 3:] @ by_left(self._forth).T)[:, :, None]
        rotations[others] = (self._aligning.swapaxes(1, 2) @ turned)[:, :, 0]
        return positions, rotations
