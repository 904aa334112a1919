"""Who a network may learn from, so that it is tried on what it never saw."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.errors import DataError
from markermend.poses.normal import normalise
from markermend.poses.nuitrack import to_nuitrack
from markermend.poses.pose import Pose
from markermend.poses.quaternion import upright

FOLDS = 10
"""Parts that the poses are divided into for cross-validation (goncalves2024, 3.3)."""

_FOLD = re.compile(rf"fold(\d+)of{FOLDS}$")


@dataclass(frozen=True, eq=False)
class LearningSet:
    """What one network learns from, and what it does not see.

    Attributes
    ----------
    name : ``all``, ``without<subject>`` or ``fold<n>of10``
    seen : (poses, joints, 7) to learn from
    unseen : (poses, joints, 7) held out; none for ``all``
    """

    name: str
    seen: FloatArray
    unseen: FloatArray


def features_of(pose: Pose) -> FloatArray:
    """(frames, joints, 7) as networks learn them: 17 joints, normalised, w at least 0."""
    features, _ = normalise(to_nuitrack(pose))
    features[..., 3:] = upright(features[..., 3:])
    return features


def subject_of(clip: str) -> str:
    """Who a recording shows: what stands before the underscore of its name."""
    return clip.partition("_")[0]


def folds_of(clip: str, frames: int) -> IntArray:
    """(frames,) which fold each pose is in, 1 to 10: at random, the same for the same name."""
    order = np.random.default_rng(zlib.crc32(clip.encode())).permutation(frames)
    return np.asarray(order % FOLDS + 1)


def fold_in(name: str) -> int | None:
    """Which fold a network of this name, up to its ``-``, did not see; None for others."""
    found = _FOLD.match(name)
    return int(found[1]) if found else None


def never_saw(network: str, clip: str) -> bool:
    """Whether a network of this name never saw who a recording shows, or a tenth of its poses."""
    group = network.partition("-")[0]
    return group == f"without{subject_of(clip)}" or fold_in(group) is not None


def learning_sets(
    clips: Mapping[str, FloatArray],
    *,
    leave_out: bool = False,
    folds: tuple[int, ...] = (),
    added: Mapping[str, FloatArray] | None = None,
) -> Iterator[LearningSet]:
    """Divide recordings into what is learnt from and what is held out.

    Parameters
    ----------
    clips : name to (frames, joints, 7) of :func:`features_of`
    leave_out : each subject in turn is held out
    folds : these tenths of the poses, drawn at random over all recordings, are held out in turn,
        as goncalves2024 does: poses next to a held-out one in time are learnt from
    added : of the same names, learnt from besides, where their recording is: of every frame, or of
        every so many

    Raises
    ------
    DataError
        when leaving a subject out leaves nobody
    """
    more = dict(added or {})
    nothing = next(iter(clips.values()))[:0]
    if folds:
        fold_at = {name: folds_of(name, len(clip)) for name, clip in clips.items()}
        for fold in folds:
            held = {name: fold_at[name] == fold for name in clips}
            seen = [clip[~held[name]] for name, clip in clips.items()]
            # What is held out is so in whatever it was made into.
            seen += [
                part[~held[name][:: -(-len(held[name]) // len(part))]]
                for name, part in more.items()
            ]
            yield LearningSet(
                f"fold{fold}of{FOLDS}",
                np.concatenate(seen),
                np.concatenate([clip[held[name]] for name, clip in clips.items()]),
            )
        return
    if not leave_out:
        yield LearningSet("all", np.concatenate([*clips.values(), *more.values()]), nothing)
        return
    subjects = sorted({subject_of(name) for name in clips})
    if len(subjects) < 2:
        raise DataError("To leave one subject out, recordings of two or more are needed.")
    for subject in subjects:
        kept = [
            clip
            for part in (clips, more)
            for name, clip in part.items()
            if subject_of(name) != subject
        ]
        yield LearningSet(
            f"without{subject}",
            np.concatenate(kept),
            np.concatenate([c for name, c in clips.items() if subject_of(name) == subject]),
        )
