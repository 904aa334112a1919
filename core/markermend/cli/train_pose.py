"""``markermend train prior`` and ``train pose``: what is learnt from clean skeleton recordings."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.cli.console import Bar, check_outputs, count, say
from markermend.poses import Pose


def run_prior(options: argparse.Namespace) -> int:
    """Learn how bodies move."""
    from markermend.poses.prior import learn_prior, save_prior

    poses = _read(options)
    with Bar() as bar:
        prior = learn_prior(list(poses.values()), progress=bar)
    save_prior(prior, Path(options.output))
    frames = sum(pose.frames for pose in poses.values())
    say(f"Learnt from {count(frames, 'pose')} in {count(len(poses), 'recording')}.")
    say(f"Written: {options.output}, {count(len(prior.joints), 'joint')}.")
    return 0


def run_networks(options: argparse.Namespace) -> int:
    """Train the paper's network in its three trainings."""
    from markermend.bench.poses import subject_of
    from markermend.poses.network import save_networks
    from markermend.poses.normal import normalise
    from markermend.poses.nuitrack import to_nuitrack
    from markermend.poses.quaternion import upright
    from markermend.poses.training import NOISES, Training, train_network

    features = {}
    for name, pose in _read(options).items():
        features[name], _ = normalise(to_nuitrack(pose))
        features[name][..., 3:] = upright(features[name][..., 3:])
    training = Training(epochs=options.epochs, seed=options.seed)
    left_out = sorted({subject_of(name) for name in features}) if options.leave_out else [None]
    networks, target = {}, Path(options.output)
    for subject in left_out:
        kept = [f for name, f in features.items() if subject_of(name) != subject]
        for kind, noise in NOISES.items():
            name = f"{'all' if subject is None else f'without{subject}'}-{kind}"
            state = target.with_name(f"{target.stem}-{name}.keras") if options.resume else None
            with Bar() as bar:
                networks[name] = train_network(
                    np.concatenate(kept), noise, training=training, resume=state, progress=bar
                )
            say(f"Trained: {name}.")
            save_networks(networks, target)
    say(f"Written: {target}, {count(len(networks), 'network')}.")
    return 0


def _read(options: argparse.Namespace) -> dict[str, Pose]:
    """Name to recording."""
    check_outputs([options.output], source=None, force=options.force)
    return {Path(path).stem: mm.read_pose(path) for path in options.poses}
