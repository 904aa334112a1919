"""What is wrong in a skeleton recording: joints that vanish, freeze, jump, or change sides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from markermend.arrays import FloatArray, runs
from markermend.artifact import Artifact, Kind
from markermend.detectors.finding import how_long, in_mm
from markermend.errors import DataError
from markermend.poses.faults.finding import (
    CARRIED,
    CROSSED,
    FROZEN,
    GUESSED,
    MISPLACED,
    REPEATED,
    SWAPPED,
    THROWN,
    VANISHED,
    Fault,
)
from markermend.poses.nuitrack import twins
from markermend.poses.pose import Pose
from markermend.poses.restore import Restored
from markermend.poses.take import pose_of, restored
from markermend.progress import Progress
from markermend.take import AXES, Take

# Share of such flags that are real, (right + 1) / (all + 2): of 40, 36, 228 and 365 flags on five
# recordings with simulated faults, 40, 36, 228 and 305 were. Bodies that are carried off count as
# joints that are, angles of both sides as limbs, repeated poses as frozen joints, wrong guesses as
# joints that are elsewhere. Of 185 angles that threw a limb off 166 were simulated; the others,
# hands and thumbs that turn over from one frame to the next in the files as they are, count half.
_CONFIDENCE = {
    VANISHED: 0.98,
    FROZEN: 0.97,
    REPEATED: 0.97,
    SWAPPED: 0.99,
    CROSSED: 0.99,
    MISPLACED: 0.84,
    CARRIED: 0.84,
    THROWN: 0.94,
    GUESSED: 0.84,
}
# A joint that is away for longer than this has gone somewhere, rather than jumped and come back.
_PEAK_FRAMES = 2
# Of how far a joint is off, it moves this share from frame to frame where it jumps about.
_RESTLESS = 0.5


def detect_joints(take: Take, progress: Progress | None = None) -> list[Artifact]:
    """Find joints that were not seen, and those that are wrong without the recording saying so.

    Parameters
    ----------
    take : one made of a skeleton recording
    progress : told the share done; may raise to stop

    Returns
    -------
    Gaps where a joint was not seen; peaks, noise and steps where it stands where its bones cannot
    reach, freezes while the body moves or with all of it, is carried off with it, or is swapped
    with that of the other side (said once, of the left one). A recording of which nothing can be
    made, such as a single pose, has none but gaps.
    """
    pose = pose_of(take)
    found = list(_unseen(take, pose))
    try:
        told = restored(pose, progress)
    except DataError:
        return found
    return found + [a for fault in told.faults for a in _artifact(take, told, fault)]


def _unseen(take: Take, pose: Pose) -> Iterator[Artifact]:
    """A gap for every time a joint goes; one that was never seen has none."""
    for joint, label in enumerate(take.labels):
        seen = pose.seen[:, joint]
        for start, stop in runs(~seen).tolist() if seen.any() else ():
            lasting = how_long(stop - start, pose.rate)
            yield Artifact(label, AXES, start, stop, Kind.GAP, why=f"not seen for {lasting}")


def _artifact(take: Take, told: Restored, fault: Fault) -> Iterator[Artifact]:
    """A fault as an artifact; none for the right half of a swap, which the left one tells."""
    pose, label, rows = pose_of(take), take.labels[fault.joint], slice(fault.start, fault.stop)
    off = pose.positions[rows, fault.joint] - told.pose.positions[rows, fault.joint]
    sizes = np.sqrt(np.sum(off**2, axis=1))
    if np.isnan(sizes).all():
        return
    amplitude, lasting = float(np.nanmax(sizes)), how_long(len(off), pose.rate)
    kind, counterpart = Kind.STEP, None
    if fault.kind in (SWAPPED, CROSSED):
        counterpart = _other_side(take, fault.joint)
        if counterpart is None:
            return
        why = f"stands on the other side, and {counterpart} here, for {lasting}"
        if fault.kind == CROSSED:
            why = f"has its angles exchanged with those of {counterpart}, for {lasting}"
    elif fault.kind == FROZEN:
        why = f"stands still while the body moves, for {lasting}"
    elif fault.kind == REPEATED:
        why = f"stands still with the whole body, though that was moving, for {lasting}"
    elif fault.kind == VANISHED:
        why = f"is said to stand at 0, 0, 0 for {lasting}"
    elif fault.kind == CARRIED:
        kind = _kind(off, sizes)
        why = f"is carried off with the whole body, by up to {in_mm(amplitude)} mm, for {lasting}"
    elif fault.kind == THROWN:
        kind = _kind(off, sizes)
        why = f"is thrown off by a wrong angle, by up to {in_mm(amplitude)} mm, for {lasting}"
    elif fault.kind == GUESSED:
        kind = _kind(off, sizes)
        far = in_mm(amplitude)
        why = f"was guessed by the sensor, up to {far} mm from where the body has it, for {lasting}"
    else:
        assert fault.kind == MISPLACED
        kind = _kind(off, sizes)
        far = in_mm(amplitude)
        why = f"stands up to {far} mm from where the rest of the body has it, for {lasting}"
    yield Artifact(
        label,
        AXES,
        fault.start,
        fault.stop,
        kind,
        _CONFIDENCE[fault.kind],
        amplitude,
        why,
        counterpart,
    )


def _kind(off: FloatArray, sizes: FloatArray) -> Kind:
    """Class of a joint's being elsewhere: for a frame or two, jumping about, or staying there."""
    if len(off) <= _PEAK_FRAMES:
        return Kind.PEAK
    moves = np.sqrt(np.sum(np.diff(off, axis=0) ** 2, axis=1))
    restless = np.nanmedian(moves) > _RESTLESS * np.nanmedian(sizes)
    return Kind.NOISE if restless else Kind.STEP


def _other_side(take: Take, joint: int) -> str | None:
    """The right joint to a left one; None where it is no left one, or has none."""
    label, other = take.labels[joint], take.labels[twins(take.labels)[joint]]
    # Their names differ in the side alone, and left comes first in the alphabet, as l does.
    return other if label < other else None
