"""``markermend train prior``, ``segments`` and ``pose``: learnt from clean skeleton recordings."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from markermend.cli.console import Bar, check_outputs, count, say, table
from markermend.cli.recordings import read_by_name
from markermend.poses import Pose
from markermend.poses.nuitrack import to_nuitrack


def run_prior(options: argparse.Namespace) -> int:
    """Learn how bodies move."""
    from markermend.poses.prior import save_prior
    from markermend.poses.prior_learning import learn_prior

    poses = _read(options)
    with Bar() as bar:
        prior = learn_prior(list(poses.values()), names=list(poses), progress=bar)
    if options.no_recordings:
        prior = replace(prior, remembered=())
    save_prior(prior, Path(options.output))
    frames = sum(pose.frames for pose in poses.values())
    say(f"Learnt from {count(frames, 'pose')} in {count(len(poses), 'recording')}.")
    kept = f", {count(len(prior.remembered), 'recording')} among it" if prior.remembered else ""
    say(f"Written: {options.output}, {count(len(prior.joints), 'joint')}{kept}.")
    return 0


def run_segments(options: argparse.Namespace) -> int:
    """Learn the segments that 17 joints do not tell of, and say how far off they are on others."""
    from markermend.bench.segments import try_segments
    from markermend.poses.segments import CARRIERS, learn_segments, save_segments

    poses = _read(options)
    with Bar() as bar:
        learnt = learn_segments(list(poses.values()), names=list(poses), progress=bar)
        save_segments(learnt, Path(options.output))
    tried = [[a.name, f"{a.place_mm:.1f}", f"{a.turned_deg:.1f}"] for a in try_segments(poses)]
    for line in (
        table(["Of people left out", "End, mm", "Rotation, °"], tried, "lrr") if tried else ()
    ):
        say(line)
    say(f"Written: {options.output}, {count(len(CARRIERS), 'segment')}.")
    return 0


def run_networks(options: argparse.Namespace) -> int:
    """Train the paper's network in its three trainings."""
    from markermend.poses.networks.learning_sets import FOLDS, features_of, learning_sets
    from markermend.poses.networks.network import save_networks
    from markermend.poses.networks.training import Training, held_out_error, train_network
    from markermend.poses.simulated.noise import NOISES
    from markermend.poses.simulated.sensor import as_depth_sensor

    poses = _read(options)
    suffix = "" if options.parts == "both" else f"+{options.parts}"
    added = None
    if options.sensor:
        suffix += "+sensor"
        added = {name: features_of(as_depth_sensor(to_nuitrack(p))) for name, p in poses.items()}
    if options.fold == []:
        options.fold = range(1, FOLDS + 1)
    sets = learning_sets(
        {name: features_of(pose) for name, pose in poses.items()},
        leave_out=options.leave_out,
        folds=tuple(options.fold or ()),
        added=added,
    )
    training = Training(epochs=options.epochs, batch=options.batch, seed=options.seed)
    networks, target = {}, Path(options.output)
    errors: dict[str, list[float]] = {kind: [] for kind in options.noise}
    for learnt in sets:
        for kind in options.noise:
            name = f"{learnt.name}-{kind}{suffix}"
            state = target.with_name(f"{target.stem}-{name}.keras") if options.resume else None
            with Bar() as bar:
                networks[name] = train_network(
                    learnt.seen,
                    NOISES[kind],
                    parts=options.parts,
                    training=training,
                    resume=state,
                    progress=bar,
                )
            save_networks(networks, target)
            told = ""
            if len(learnt.unseen):
                error = held_out_error(
                    networks[name], learnt.unseen, NOISES[kind], seed=options.seed
                )
                errors[kind].append(error)
                told = f", mean absolute error {error:.4f} on {len(learnt.unseen)} poses held out"
            say(f"Trained: {name}{told}.")
    for kind, some in errors.items():
        if len(some) > 1:
            say(f"{kind}: {np.mean(some):.4f} ± {np.std(some, ddof=1):.4f} over {len(some)} parts.")
    say(f"Written: {target}, {count(len(networks), 'network')}.")
    return 0


def _read(options: argparse.Namespace) -> dict[str, Pose]:
    """Name to recording."""
    check_outputs([options.output], source=options.poses, force=options.force)
    return read_by_name(options.poses)
