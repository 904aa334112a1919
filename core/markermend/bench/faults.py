"""How many faults that a sensor does not tell of are found, and how far off joints are after it."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.bench.columns import aligned, csv_cell, number
from markermend.bench.poses import Case, as_they_come, recorded, unseen
from markermend.errors import DataError
from markermend.poses.faults.finding import Fault
from markermend.poses.pose import Pose
from markermend.poses.restore import restore
from markermend.poses.simulated.breaking import HOLDS, KINDS, Broken, break_pose
from markermend.poses.simulated.noise import corrupt_pose
from markermend.progress import Progress, quiet

EVERY_S = 2.0
"""One fault in so many seconds, and one of each kind at least."""
ENOUGH = 0.5
"""Share of what was broken that must be flagged for a fault to count as found."""
SOUND = "sound"
"""What is said of the joints and frames that were not broken."""
BESIDE = "sound beside held"
"""The same of the recordings in which joints were held in more ways."""
_SAME_MM = 1e-6
_STATES = "broken", "restored", "told", "live", "live_told"
_TRIED = ((KINDS, SOUND), (HOLDS, BESIDE))

CASES = (
    Case("120 Hz", "nothing"),
    Case("30 Hz", "nothing", slow=True),
    Case("simulated sensor, 30 Hz", "nothing", sensor=True),
    Case("simulated sensor, 30 Hz, noisy", "displacements", sensor=True),
)
"""Recordings that are broken."""


@dataclass(frozen=True)
class FaultRow:
    """Faults of one kind in one recording.

    Attributes
    ----------
    clip, case : the recording, and how it was recorded
    kind : of the faults; :data:`SOUND` or :data:`BESIDE` for everything that was not broken
    faults : how many there are; of sound joints, poses times joints
    found : how many are flagged for :data:`ENOUGH` of what was broken; of sound joints, flags that
        touch nothing broken
    named : how many are mostly flagged by their own name; of sound joints, poses times joints
        that are flagged
    off_mm : mean distance from the truth as broken, restored, restored where the recording says
        which joints are wrong, and cleaned pose by pose as it comes, unsaid and said
    samples : poses times joints that this is the mean of
    minutes : length of the recording
    """

    clip: str
    case: str
    kind: str
    faults: int
    found: int
    named: int
    off_mm: tuple[float, ...]
    samples: int
    minutes: float


def find_faults(
    clips: Mapping[str, Pose],
    *,
    cases: Sequence[Case] = CASES,
    seed: int = 1,
    progress: Progress | None = None,
) -> list[FaultRow]:
    """Break recordings of people never seen without saying so, and restore them.

    Parameters
    ----------
    clips : name to clean recording of the CMU skeleton or the 17 joints; two subjects or more
    cases : how they were recorded
    seed : of the faults; each clip has its own
    progress : told the share done; may raise to stop

    Raises
    ------
    DataError
        when all clips show one subject, or one is too short
    """
    rows: list[FaultRow] = []
    seeds = {name: seed + n for n, name in enumerate(clips)}
    for done, (name, pose, prior) in enumerate(unseen(clips)):
        for n, case in enumerate(cases):
            (progress or quiet)((done + n / len(cases)) / len(clips), f"{name}: {case.name}")
            truth = recorded(pose, case)
            noisy = corrupt_pose(truth, case.noise(truth.rate), seed=seeds[name])
            for kinds, sound in _TRIED:
                each = max(int(truth.frames / truth.rate / EVERY_S / len(kinds)), 1)
                try:
                    given, broken = break_pose(noisy, each=each, seed=seeds[name], what=kinds)
                except DataError as error:
                    raise DataError(f"{name}, {case.name}: {error}") from None
                wrong = _marked(broken, truth)
                told = given.with_samples(
                    given.positions, given.rotations, np.where(wrong, 0.0, 1.0)
                )
                restored = restore(given, prior=prior)
                results = [given, restored.pose, restore(told, prior=prior).pose]
                results += [as_they_come(pose, prior)[0] for pose in (given, told)]
                off = [
                    np.sqrt(np.sum((p.positions - truth.positions) ** 2, axis=2)) for p in results
                ]
                rows += _judged(name, case.name, kinds, sound, broken, restored.faults, off, truth)
    return rows


def _judged(
    clip: str,
    case: str,
    kinds: Mapping[str, str],
    sound: str,
    broken: Sequence[Broken],
    faults: Sequence[Fault],
    off: Sequence[FloatArray],
    truth: Pose,
) -> list[FaultRow]:
    """A row for each kind, and one for all that is sound."""
    minutes = truth.frames / truth.rate / 60.0
    flagged = _marked(faults, truth)
    by_name = {
        name: _marked([f for f in faults if f.kind == name], truth) for name in set(kinds.values())
    }
    rows = []
    for kind, name in kinds.items():
        mine = [b for b in broken if b.kind == kind]
        at = [_marked([b], truth) for b in mine]
        rows.append(
            FaultRow(
                clip,
                case,
                kind,
                len(mine),
                sum(bool(flagged[a].mean() >= ENOUGH) for a in at),
                sum(bool(by_name[name][a].mean() >= ENOUGH) for a in at),
                _means(off, _marked(mine, truth)),
                int(_marked(mine, truth).sum()),
                minutes,
            )
        )
    # What a recording repeats by itself is no fault of whoever finds it.
    own = _repeats(truth)
    wrong = _marked(broken, truth) | own[:, None]
    false = [f for f in faults if not wrong[f.start : f.stop, f.joint].any()]
    rows.append(
        FaultRow(
            clip,
            case,
            sound,
            int((~wrong).sum()),
            len(false),
            int((flagged & ~wrong).sum()),
            _means(off, ~wrong),
            int((~wrong).sum()),
            minutes,
        )
    )
    return rows


def _repeats(pose: Pose) -> BoolArray:
    """(frames,) bool: the pose is the one before it, to the last digits."""
    far = np.abs(np.diff(pose.positions, axis=0)).max(axis=(1, 2))
    return np.concatenate([[False], far < _SAME_MM])


def _marked(faults: Sequence[Broken | Fault], pose: Pose) -> BoolArray:
    """(frames, joints) bool: wrong."""
    mask = np.zeros((pose.frames, len(pose.joints)), dtype=bool)
    for fault in faults:
        joints = fault.joints if isinstance(fault, Broken) else (fault.joint,)
        mask[fault.start : fault.stop, list(joints)] = True
    return mask


def _means(off: Sequence[FloatArray], at: BoolArray) -> tuple[float, ...]:
    """Mean distances at some joints; NaN for none."""
    return tuple(float(o[at].mean()) if at.any() else np.nan for o in off)


def faults_table(rows: Sequence[FaultRow]) -> list[str]:
    """Every kind in every case, recordings pooled."""
    lines = ["Faults that the recording does not tell of; mean distance from the truth in mm."]
    for case in dict.fromkeys(row.case for row in rows):
        names = "broken", "restored", "if it told", "live", "if it told"
        cells = [["Kind", "faults", "found", "by name", *names]]
        for kind in (*KINDS, *HOLDS):
            here = [row for row in rows if (row.case, row.kind) == (case, kind)]
            count = sum(row.faults for row in here)
            shares = (
                number(100.0 * sum(n) / max(count, 1), 1) + " %"
                for n in ([r.found for r in here], [r.named for r in here])
            )
            cells.append([kind, str(count), *shares, *_pooled(here)])
        sound = []
        for kind in (SOUND, BESIDE):
            here = [row for row in rows if (row.case, row.kind) == (case, kind)]
            cells.append([kind, "", "", "", *_pooled(here)])
            sound += here
        false, flagged = (sum(getattr(r, n) for r in sound) for n in ("found", "named"))
        share = 100.0 * flagged / sum(r.faults for r in sound)
        minutes = sum(r.minutes for r in sound)
        lines += ["", f"{case[0].upper()}{case[1:]}", *aligned(cells)]
        lines += [
            f"  Flags where nothing is wrong: {false}, {false / minutes:.2f} a minute; sound joints"
            f" flagged: {share:.3f} %"
        ]
    return lines


def _pooled(rows: Sequence[FaultRow]) -> list[str]:
    """Mean distances, weighted by samples."""
    there = [row for row in rows if row.samples]
    weight = sum(row.samples for row in there)
    return [
        number(sum(row.off_mm[n] * row.samples for row in there) / weight if weight else np.nan, 1)
        for n in range(len(_STATES))
    ]


def faults_csv(rows: Sequence[FaultRow]) -> str:
    """Every kind in every recording."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    off = [f"{state}_mm" for state in _STATES]
    writer.writerow(["clip", "case", "kind", "faults", "found", "named", *off, "samples"])
    for row in rows:
        writer.writerow(
            [row.clip, row.case, row.kind, row.faults, row.found, row.named]
            + [csv_cell(value) for value in row.off_mm]
            + [row.samples]
        )
    return file.getvalue()
