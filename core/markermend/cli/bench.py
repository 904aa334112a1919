"""``markermend bench NAME …``: rerun an experiment and print its table."""

from __future__ import annotations

import argparse
from pathlib import Path

from markermend.cli.bench_blind import run_blind
from markermend.cli.bench_centres import run_centres
from markermend.cli.bench_constraints import run_constraints
from markermend.cli.bench_e2 import run_e2
from markermend.cli.bench_e3 import run_e3
from markermend.cli.bench_faults import run_faults
from markermend.cli.bench_gaps import run_gaps
from markermend.cli.bench_pose import run_pose
from markermend.cli.bench_predictors import run_predictors
from markermend.cli.bench_slides import run_slides
from markermend.cli.bench_smooth import run_smooth
from markermend.cli.bench_takes import clean_takes
from markermend.cli.bench_training import run_training
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_figures,
    check_outputs,
    say,
    write_figures,
    write_text,
)


def run(options: argparse.Namespace) -> int:
    """Run the experiment that was named."""
    return RUN[str(options.experiment)](options)


def _run_e1(options: argparse.Namespace) -> int:
    """Contaminate takes, detect, and show the measures."""
    from markermend.bench.ceiling import ceiling_table, slow_ceiling
    from markermend.bench.e1 import COMPANIONS, e1
    from markermend.bench.e1_svg import e1_figures, figure_names
    from markermend.bench.e1_text import e1_csv, e1_table
    from markermend.bench.unrest import figure_name, unrest, unrest_figure, unrest_table
    from markermend.detectors import find_detector

    stems = [Path(t).stem for t in options.takes]
    names = figure_names(stems, options.share, options.amplitude)
    names += [figure_name(stem) for stem in stems]
    check_figures(options.figures, names, force=options.force)
    check_outputs([options.csv], source=options.takes, force=options.force)
    takes = clean_takes(options.takes, options.flaws)
    methods = list(dict.fromkeys(options.method))
    params = {
        name: find_detector(name).params(slow=False)
        for name in methods
        if options.no_slow and name not in COMPANIONS
    }
    with Bar() as bar:
        rows = e1(
            takes,
            methods=methods + list(COMPANIONS if options.companions else ()),
            params=params,
            shares=options.share,
            amplitudes_mm=options.amplitude,
            simulations=options.simulations,
            rounded=options.rounded,
            seed=options.seed,
            n_jobs=options.jobs,
            progress=bar,
        )
    left = [] if options.no_slow else [unrest(t, jobs=options.jobs) for t in takes]
    told = [u for u in left if u is not None]
    if options.figures is not None:
        drawn = {figure_name(u.take): unrest_figure(u) for u in told}
        write_figures(options.figures, e1_figures(rows) | drawn)
    if options.csv is not None:
        write_text(options.csv, e1_csv(rows))
    if options.csv != STDOUT:
        ceilings = (
            []
            if options.no_slow
            else [c for t in takes for c in slow_ceiling(t, seed=options.seed, jobs=options.jobs)]
        )
        for line in [*e1_table(rows), *ceiling_table(ceilings), *unrest_table(told)]:
            say(line)
    return 0


RUN = {
    "blind": run_blind,
    "centres": run_centres,
    "e1": _run_e1,
    "e2": run_e2,
    "e3": run_e3,
    "faults": run_faults,
    "gaps": run_gaps,
    "pose": run_pose,
    "predictors": run_predictors,
    "slides": run_slides,
    "smooth": run_smooth,
    "constraints": run_constraints,
    "training": run_training,
}
