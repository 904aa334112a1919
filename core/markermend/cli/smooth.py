"""``markermend smooth``: take noise out of trajectories and fill nothing."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import numpy as np

import markermend as mm
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_outputs,
    check_take_output,
    chosen_frames,
    count,
    read_take,
    say,
    table,
    warn,
    write_text,
    written,
)
from markermend.cli.settings import settings_of
from markermend.errors import MethodError
from markermend.parameters import read_params
from markermend.smoothers import TOO_MUCH, derivatives, find_smoother, percent_sm1
from markermend.smoothers.run import AUTO
from markermend.smoothers.table import derivatives_csv
from markermend.take import AXES, Take


def run(options: argparse.Namespace) -> int:
    """Smooth one take."""
    check_outputs([options.output, options.derivatives], source=options.take, force=options.force)
    check_take_output(options.output, source=options.take)
    smoother = find_smoother(options.method)
    if options.derivatives is not None and smoother.name != AUTO:
        raise MethodError(
            f"Error bands are known for the method “{AUTO}” only; leave out "
            f"--method {smoother.name} or --derivatives."
        )
    params = read_params(smoother, None, settings_of(smoother.params, options.set))
    take = read_take(options.take)
    start, stop = chosen_frames(take, options) or (0, None)
    with Bar() as bar:
        smoothed = mm.smooth(
            take,
            options.method,
            markers=options.marker,
            start=start,
            stop=stop,
            params=params,
            progress=bar,
        )
    export = mm.write(smoothed, options.output, as_float=options.float)
    names = take.labels if options.marker is None else options.marker
    if options.derivatives is not None:
        with Bar() as bar:
            found = derivatives(take, markers=names, progress=bar)
        write_text(options.derivatives, derivatives_csv(found, take))
    if options.derivatives == STDOUT:
        return 0
    less = _less(take, smoothed, names)
    for line in _listing(take, smoothed, names, less) if options.list else ():
        say(line)
    _judge(names, less)
    for line in written(export):
        say(line)
    return 0


def _less(take: Take, smoothed: Take, names: Sequence[str]) -> dict[str, float]:
    """%SM1 of each marker's coordinate that lost most."""
    columns = [take.index(name) for name in names]
    less = percent_sm1(take.positions[:, columns], smoothed.positions[:, columns])
    return dict(zip(names, less.max(axis=1).tolist(), strict=True))


def _judge(names: Sequence[str], less: dict[str, float]) -> None:
    """Say how much smoother it became, and warn of too much."""
    if not names:
        return
    middle = float(np.median(list(less.values())))
    say(f"Smoothed: {count(len(names), 'marker')}, SM1 less by {middle:.1f} % (median).")
    much = [name for name in names if less[name] > TOO_MUCH]
    if much:
        shown = ", ".join(much[:5]) + ("…" if len(much) > 5 else "")
        warn(
            f"{count(len(much), 'marker')} lost more than {TOO_MUCH:g} % of SM1 in a coordinate "
            f"({shown}); look whether they still follow the movement."
        )


def _listing(take: Take, smoothed: Take, names: Sequence[str], less: dict[str, float]) -> list[str]:
    """What changed for every marker."""
    rows = []
    for name in names:
        column = take.index(name)
        change = smoothed.positions[:, column] - take.positions[:, column]
        seen = take.present[:, column]
        cells = ["–", "–"]
        if seen.any():
            far = np.sqrt(np.sum(change[seen] ** 2, axis=1))
            cells = [f"{np.sqrt(np.mean(far**2)):.3f}", f"{far.max():.2f}"]
        rows.append([name, *cells, f"{less[name]:.1f}"])
    head = ["Marker", "Change, mm", "Largest", f"%SM1 of {'/'.join(AXES)}, most"]
    return [*table(head, rows, "lrrr"), ""]
