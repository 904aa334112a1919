"""``markermend train MODEL …``: learn a model that ships with Markermend anew."""

from __future__ import annotations

import argparse

from markermend.cli.bench_takes import clean_takes
from markermend.cli.console import Bar, check_outputs, say, table, write_json
from markermend.cli.train_pose import run_networks, run_prior, run_segments


def run(options: argparse.Namespace) -> int:
    """Train the model that was named."""
    return RUN[str(options.model)](options)


def _run_sudden(options: argparse.Namespace) -> int:
    """Learn the curves of the sudden classes, and show how they hold on takes left out."""
    from markermend.detectors.joint.left_out import leave_one_out
    from markermend.detectors.joint.training import as_json, collect, fit_curves, performers
    from markermend.errors import MethodError

    check_outputs([options.output], source=options.takes, force=options.force)
    if not options.takes and not options.performers:
        raise MethodError("Training needs a take, or a performer at least.")
    known = clean_takes(options.takes, options.flaws)
    simulated = performers(options.performers, options.seed)
    takes = [(c.take, c.flaws) for c in known] + [(take, ()) for take in simulated]
    names = [c.name for c in known] + [f"performer {i + 1}" for i in range(len(simulated))]
    with Bar() as bar:
        examples = collect(takes, rounds=options.rounds, seed=options.seed, progress=bar)
    write_json(options.output, as_json(fit_curves(examples)))
    if len(examples) > 1:
        say("Judged by curves fitted to all other takes:")
        head = ["Take", "Class", "Flags", "Real", "Calibration error", "Area under curve"]
        rows = [
            [
                names[r.take],
                r.kind.value,
                f"{r.flags}",
                f"{r.real}",
                *map(_figure, (r.error, r.area)),
            ]
            for r in leave_one_out(examples)
        ]
        for line in table(head, rows, "llrrrr"):
            say(line)
    say(f"Written: {options.output}.")
    return 0


def _run_slow(options: argparse.Namespace) -> int:
    """Learn the trees of slow changes."""
    from itertools import chain
    from pathlib import Path

    from markermend.detectors.joint.slow_training import collect_slow, dressed, fit_slow
    from markermend.detectors.joint.training import performers
    from markermend.errors import MethodError

    check_outputs([options.output], source=options.takes, force=options.force)
    known = [(c.take, c.flaws) for c in clean_takes(options.takes, options.flaws)]
    known += [(take, ()) for take in performers(options.performers, options.seed)]
    folder = Path(options.poses) if options.poses else None
    if folder and not any(folder.glob("*.amc")):
        raise MethodError(f"There are no skeleton recordings (.amc) in {folder}.")
    worn = dressed(folder, options.sets, options.seed) if folder else iter(())
    with Bar() as bar:
        examples = collect_slow(
            chain(known, ((take, ()) for take in worn)),
            rounds=options.rounds,
            seed=options.seed,
            jobs=options.jobs,
            count=len(known) + (options.sets * len(list(folder.glob("*.amc"))) if folder else 0),
            progress=bar,
        )
        if len(examples) < 2:
            raise MethodError("Training slow changes needs two takes at least.")
        fit_slow(examples, seed=options.seed).save(Path(options.output))
    drifts = sum(len(e.drawn) for e in examples)
    say(f"Learned from {drifts} drifts in {len(examples)} takes. Written: {options.output}.")
    return 0


def _figure(value: float) -> str:
    """Three digits, or a dash where there is nothing to measure."""
    return "–" if value != value else f"{value:.3f}"


RUN = {
    "sudden": _run_sudden,
    "slow": _run_slow,
    "prior": run_prior,
    "segments": run_segments,
    "pose": run_networks,
}
