"""Damage clean skeleton recordings, restore them by several means, compare with the truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.bench.parts import in_parts
from markermend.bench.poses_network import ALL, Tried, by_networks, error_of
from markermend.errors import DataError
from markermend.poses.faults.holding import held
from markermend.poses.live import Live
from markermend.poses.networks.learning_sets import never_saw, subject_of
from markermend.poses.networks.network import Network, smoothed
from markermend.poses.normal import Normal, denormalise, normalise
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior
from markermend.poses.prior_learning import learn_recording, together
from markermend.poses.quaternion import inverse, multiply, turn, unit, unrolled, upright
from markermend.poses.restore import restore
from markermend.poses.simulated.noise import NOISES, Noise, corrupt
from markermend.poses.simulated.sensor import RATE_HZ, as_depth_sensor
from markermend.progress import Progress, quiet

HIDDEN = (0, 1, 2, 3, 4)
"""Joints occluded in one pose; the last stands for more, too."""

_MOST_HIDDEN = HIDDEN[-1]

MOVEMENT_S = 5.0
"""Length of what counts as one movement."""

NEARER = ", nearer of q and -q"
"""What is added to the name of a method whose error does not depend on signs of rotations."""

KNOWN = ", who is shown known"
"""What is added where other recordings of the same person were learnt from, too."""


@dataclass(frozen=True)
class Case:
    """One kind of damage.

    Attributes
    ----------
    name : as the table has it
    kind : ``"both"``, ``"occlusions"`` or ``"displacements"``; ``"nothing"`` leaves it clean
    burst_s : seconds that an occlusion lasts; 0 for single frames
    limbs : whole arms and legs
    slow : at 30 Hz, every fourth pose of 120
    sensor : of a simulated depth sensor: 30 Hz, other proportions and axes
    """

    name: str
    kind: str
    burst_s: float = 0.0
    limbs: bool = False
    slow: bool = False
    sensor: bool = False

    def noise(self, rate: float) -> Noise:
        """The noise at a rate."""
        base = NOISES.get(self.kind, Noise(occlusion=0.0, displacement=0.0))
        burst = max(round(self.burst_s * rate), 1)
        return Noise(base.occlusion, base.displacement, burst, self.limbs)


CASES = (
    *(Case("frame by frame", kind) for kind in NOISES),
    *(Case("bursts of 0.25 s", kind, 0.25) for kind in ("both", "occlusions")),
    Case("whole limb, bursts of 1 s", "occlusions", 1.0, limbs=True),
    *(Case("bursts of 1 s, 30 Hz", kind, 1.0, slow=True) for kind in ("both", "occlusions")),
    *(Case("simulated sensor, bursts of 1 s", kind, 1.0, sensor=True) for kind in NOISES),
    Case("clean, 120 Hz", "nothing"),
    Case("clean, 30 Hz", "nothing", slow=True),
)
"""What is tried."""


@dataclass(frozen=True)
class Row:
    """One method on one recording.

    Attributes
    ----------
    clip, subject : the recording, and who was left out of what had been learnt
    case, kind, method : what was done
    error : mean absolute error over the features of all poses
    by_hidden : the same for poses with as many joints occluded as :data:`HIDDEN` says; NaN where
        there is none
    poses_hidden : number of those
    by_movement : joints occluded in a pose and error, means over each :data:`MOVEMENT_S`
    poses : number of all
    """

    clip: str
    subject: str
    case: str
    kind: str
    method: str
    error: float
    by_hidden: tuple[float, ...]
    poses_hidden: tuple[int, ...]
    by_movement: tuple[tuple[float, float], ...]
    poses: int


def compare(
    clips: Mapping[str, Pose],
    *,
    cases: Sequence[Case] = CASES,
    networks: Mapping[str, Network] | None = None,
    part_s: float | None = None,
    seed: int = 1,
    progress: Progress | None = None,
) -> list[Row]:
    """Restore people never seen: what is learnt leaves the subject out, but where :data:`KNOWN`.

    Parameters
    ----------
    clips : name to recording of the CMU skeleton or the 17 joints, clean; two subjects or more
    cases : what is done to them
    networks : ``without<subject>-…`` to network, trained on the others; ``fold<n>of10-…`` to
        one that was trained on nine tenths of all poses, tried on the tenth only (a random split)
    part_s : seconds; clips are cut into parts of about so long, each restored by itself, by what
        whole clips taught
    seed : of the damage; each clip, or part, has its own
    progress : told the share done; may raise to stop

    Raises
    ------
    DataError
        when all clips show one subject, or one is so short that it is occluded throughout
    """
    rows: list[Row] = []
    names = [part for name, clip in clips.items() for part in in_parts(name, clip, part_s)]
    seeds = {part: seed + n for n, part in enumerate(names)}
    steps, done = len(names) * len(cases), 0
    for name, pose, prior, knowing in left_out(clips):
        mine = {
            trained: network
            for trained, network in (networks or {}).items()
            if never_saw(trained, name)
        }
        for part, body in in_parts(name, pose, part_s).items():
            for case in cases:
                (progress or quiet)(done / steps, f"{part}: {case.name}")
                done += 1
                rows += _try(part, body, case, (prior, knowing), mine, seeds[part])
    return rows


def unseen(clips: Mapping[str, Pose]) -> Iterator[tuple[str, Pose, Prior]]:
    """Each recording's 17 joints, and what is learnt from everybody but whom it shows.

    Raises
    ------
    DataError
        when all clips show one subject
    """
    for name, pose, prior, _ in left_out(clips, known_too=False):
        yield name, pose, prior


def left_out(
    clips: Mapping[str, Pose], *, known_too: bool = True
) -> Iterator[tuple[str, Pose, Prior, Prior | None]]:
    """Each recording's 17 joints, what everybody else tells, and what all other recordings tell.

    The last is None where no other recording shows the same person, or nobody asks for it.

    Raises
    ------
    DataError
        when all clips show one subject
    """
    bodies = {name: to_nuitrack(pose) for name, pose in clips.items()}
    subjects = sorted({subject_of(name) for name in bodies})
    if len(subjects) < 2:
        raise DataError("To leave one subject out, recordings of two or more are needed.")
    parts = {name: learn_recording(pose, name) for name, pose in bodies.items()}
    for subject in subjects:
        own = [name for name in bodies if subject_of(name) == subject]
        prior = together([part for name, part in parts.items() if name not in own])
        for name in own:
            knowing = None
            if known_too and len(own) > 1:
                knowing = together([part for other, part in parts.items() if other != name])
            yield name, bodies[name], prior, knowing


@dataclass(frozen=True, eq=False)
class Damage:
    """What noise makes of a recording, in features.

    Attributes
    ----------
    right, features : (frames, joints, 7) before and after, w of rotations at least 0
    occluded : (frames, joints) bool
    normal : to go back
    """

    right: FloatArray
    features: FloatArray
    occluded: BoolArray
    normal: Normal

    def seen_in(self, pose: Pose) -> Pose:
        """The recording as a sensor gives it, with confidence 0 where joints are occluded."""
        samples = denormalise(self.features, self.normal)
        return pose.with_samples(*samples, np.where(self.occluded, 0.0, 1.0))


def damaged(pose: Pose, noise: Noise, seed: int) -> Damage:
    """Damage a clean recording; the same seed does the same to it."""
    right, normal = normalise(pose)
    right[..., 3:] = upright(right[..., 3:])
    features, occluded = corrupt(right, pose.parents, noise, seed=seed)
    features[..., 3:] = upright(unit(features[..., 3:]))
    return Damage(right, features, occluded, normal)


def _try(
    clip: str,
    pose: Pose,
    case: Case,
    priors: tuple[Prior, Prior | None],
    networks: Mapping[str, Network],
    seed: int,
) -> list[Row]:
    """All methods on one damaged recording."""
    prior, knowing = priors
    truth = recorded(pose, case)
    damage = damaged(truth, case.noise(truth.rate), seed)
    features, occluded, normal = damage.right, damage.occluded, damage.normal
    known = _known(occluded, truth.parents)
    if not known.any(axis=0).all():
        raise DataError(
            f"The recording {clip} is too short for “{case.name}”: a joint is never seen in it."
            " Leave it out, or choose other cases, or longer parts."
        )
    everywhere = np.ones(len(features), dtype=bool)
    results = {
        name: Tried(run(damage.features, known), everywhere, ALL) for name, run in SIMPLE.items()
    }
    results |= by_networks(networks, clip, damage.features, known, pose.frames)
    given = damage.seen_in(truth)
    learnt = {"restore, no prior": None, "restore": prior}
    if knowing is not None:
        learnt[f"restore{KNOWN}"] = knowing
    for name, known_before in learnt.items():
        done = restore(given, prior=known_before).pose
        results[name] = Tried(_relative(done, normal), everywhere, ALL)
    if given.seen.all(axis=1).any():
        came, after = as_they_come(given, prior)
        results["live"] = Tried(_relative(came, normal), after, ALL)
    count = np.count_nonzero(occluded, axis=1)
    hidden = np.minimum(count, _MOST_HIDDEN)
    length = round(MOVEMENT_S * truth.rate)
    movements = [slice(n, n + length) for n in range(0, len(count) - length + 1, length)]
    # What a recording itself repeats, as 03_02 of the CMU database does, is not how its body moved.
    sound = ~held(truth)[1]
    rows = []
    judged = [(name, tried, False) for name, tried in results.items()]
    judged.append((f"restore{NEARER}", results["restore"], True))
    for name, tried, nearer in judged:
        every = error_of(tried.features, features, tried.columns, nearer=nearer)
        at = tried.judged & sound
        off = every[at]
        groups = [off[hidden[at] == n] for n in HIDDEN]
        moved = [
            (float(count[m].mean()), float(every[m][at[m]].mean()))
            for m in movements
            if at[m].any()
        ]
        rows.append(
            Row(
                clip,
                subject_of(clip),
                case.name,
                case.kind,
                name,
                float(off.mean()) if len(off) else float("nan"),
                tuple(float(g.mean()) if len(g) else float("nan") for g in groups),
                tuple(len(g) for g in groups),
                tuple(moved),
                len(off),
            )
        )
    return rows


def as_they_come(pose: Pose, prior: Prior) -> tuple[Pose, BoolArray]:
    """Each pose by those before it alone, and which ones come after the first whole one."""
    first = int(pose.seen.all(axis=1).argmax())
    positions, rotations = pose.positions.copy(), pose.rotations.copy()
    live = Live(
        Pose(
            positions[first : first + 1],
            rotations[first : first + 1],
            pose.joints,
            pose.parents,
            pose.rate,
        ),
        prior,
    )
    for frame in range(first + 1, pose.frames):
        positions[frame], rotations[frame] = live(
            positions[frame], rotations[frame], pose.seen[frame]
        )
    whole = pose.with_samples(positions, rotations, np.ones(pose.seen.shape))
    return whole, np.arange(pose.frames) > first


def recorded(pose: Pose, case: Case) -> Pose:
    """Return a recording as a case has it before the damage."""
    if case.sensor:
        return as_depth_sensor(pose)
    if not case.slow:
        return pose
    step = max(round(pose.rate / RATE_HZ), 1)
    return Pose(
        pose.positions[::step],
        pose.rotations[::step],
        pose.joints,
        pose.parents,
        pose.rate / step,
        pose.confidence[::step],
    )


def _known(occluded: BoolArray, parents: tuple[int, ...]) -> BoolArray:
    """(frames, joints, 7) bool: features that the damage left."""
    turned = ~occluded
    for joint, parent in enumerate(parents):
        if parent > 0:
            turned[:, parent] &= ~occluded[:, joint]
    return np.concatenate(
        [np.repeat(~occluded[..., None], 3, axis=2), np.repeat(turned[..., None], 4, axis=2)],
        axis=2,
    )


def _relative(pose: Pose, normal: Normal) -> FloatArray:
    """(frames, joints, 7) of a recording by the normalisation of another."""
    back = inverse(normal.rotation)[:, None]
    places = turn(back, pose.positions - normal.position[:, None]) / normal.scale
    return np.concatenate([places, multiply(back, multiply(pose.rotations, normal.offset))], axis=2)


def _interpolated(
    cross: Callable[[IntArray, FloatArray, IntArray], FloatArray],
) -> Callable[[FloatArray, BoolArray], FloatArray]:
    """Each feature by itself, ends held."""

    def run(damaged: FloatArray, known: BoolArray) -> FloatArray:
        path = np.where(known, damaged, np.nan)
        path[..., 3:] = unrolled(path[..., 3:])
        flat = path.reshape(len(path), -1)
        time = np.arange(len(flat))
        for column in flat.T:
            there = np.flatnonzero(~np.isnan(column))
            if 1 < len(there) < len(column):
                column[:] = cross(there, column[there], np.clip(time, there[0], there[-1]))
        return flat.reshape(path.shape)

    return run


def _pchip(there: IntArray, values: FloatArray, time: IntArray) -> FloatArray:
    return np.asarray(PchipInterpolator(there, values)(time))


def _filtered(damaged: FloatArray, known: BoolArray) -> FloatArray:
    return smoothed(_interpolated(_pchip)(damaged, known))


SIMPLE: Mapping[str, Callable[[FloatArray, BoolArray], FloatArray]] = {
    "as it is": lambda damaged, known: damaged,
    "linear": _interpolated(lambda there, values, time: np.interp(time, there, values)),
    "pchip": _interpolated(_pchip),
    "pchip, filtered": _filtered,
}
"""What needs no knowledge of bodies."""
