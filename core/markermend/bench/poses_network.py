"""Trained networks on a damaged recording, each judged only where it never saw the poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.poses.networks.learning_sets import fold_in, folds_of
from markermend.poses.networks.network import PARTS, Network, smoothed
from markermend.poses.normal import FEATURES
from markermend.poses.quaternion import signed_like, unit, upright

RANDOM, FILTERED, WHERE_HIDDEN = ", random split", ", filtered", ", where occluded"
"""What is added to the name of a network that was tried in another way."""

ALL = slice(0, FEATURES)


@dataclass(frozen=True, eq=False)
class Tried:
    """What a method made of a damaged recording.

    Attributes
    ----------
    features : (frames, joints, 7)
    judged : (frames,) bool, those that count
    columns : of a joint's seven features, those that count
    """

    features: FloatArray
    judged: BoolArray
    columns: slice


def by_networks(
    networks: Mapping[str, Network], clip: str, damaged: FloatArray, known: BoolArray, frames: int
) -> dict[str, Tried]:
    """Let networks undo the damage, without and with the paper's filter.

    Parameters
    ----------
    networks : by the names that ``train pose`` gives them
    clip : name of the recording
    damaged : (poses, joints, 7), of every frame or every n-th
    known : (poses, joints, 7) bool, what the damage left
    frames : of the recording

    Returns
    -------
    dict
        ``network <kind>`` for those that never saw the subject; with :data:`RANDOM` for those that
        learnt from other poses of the same recordings, and are judged by those they did not learn
        from; with :data:`WHERE_HIDDEN` what the network knows put only where a joint is occluded
    """
    tried: dict[str, Tried] = {}
    step = -(-frames // len(damaged))
    for name, network in networks.items():
        group, _, kind = name.partition("-")
        fold = fold_in(group)
        judged = np.ones(len(damaged), dtype=bool)
        label = f"network {kind}"
        if fold is not None:
            judged, label = folds_of(clip, frames)[::step] == fold, label + RANDOM
        made = network(damaged)
        for way, features in (
            ("", made),
            (FILTERED, smoothed(made)),
            (WHERE_HIDDEN, np.where(known, damaged, made)),
        ):
            before = tried.get(label + way)
            if before is not None:
                features = np.where(judged[:, None, None], features, before.features)
            tried[label + way] = Tried(
                features,
                judged if before is None else judged | before.judged,
                PARTS[network.parts],
            )
    return tried


def error_of(
    result: FloatArray, truth: FloatArray, columns: slice = ALL, *, nearer: bool = False
) -> FloatArray:
    """(frames,) mean absolute error over features of all joints but the first.

    Parameters
    ----------
    result, truth : (frames, joints, 7)
    columns : which of a joint's seven features
    nearer : of q and -q, which are one rotation, take the one nearer to the truth instead of the
        one with w at least 0
    """
    own, right = result[:, 1:].copy(), truth[:, 1:]
    own[..., 3:] = upright(unit(own[..., 3:]))
    if nearer:
        known = np.ones(own.shape[:2], dtype=bool)
        own[..., 3:] = signed_like(own[..., 3:], right[..., 3:], known)
    return np.asarray(np.abs(own - right)[..., columns].mean(axis=(1, 2)))
