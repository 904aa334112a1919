"""``markermend bench pose``: damage skeleton recordings, restore them, compare with the truth."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from pathlib import Path

from markermend.cli.console import STDOUT, Bar, check_outputs, say, warn, write_text
from markermend.cli.numbers import add_seed, positive
from markermend.cli.recordings import read_by_name
from markermend.errors import MethodError

SUMMARY = "damage clean skeleton recordings, restore people never seen, compare with the truth"

# So much is needed to learn anything from.
_LEAST_PART_S = 0.5


def add_pose(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument(
        "poses",
        metavar="POSE",
        nargs="+",
        help="clean recordings of two people or more; names begin with the person (01_05.amc)",
    )
    p.add_argument(
        "--networks",
        metavar="FILE",
        nargs="+",
        default=[],
        help="what “train pose --leave-out” and “train pose --fold” wrote, to be tried as well and"
        " set beside the published tables",
    )
    p.add_argument("--case", metavar="TEXT", nargs="+", help="only cases whose name has this text")
    p.add_argument(
        "--hidden",
        action="store_true",
        help="show errors by number of occluded joints, of a pose and of a movement",
    )
    p.add_argument(
        "--parts",
        metavar="SECONDS",
        type=positive,
        help="cut recordings into parts of about so long, each restored by itself; what is learnt"
        " is learnt from whole ones",
    )
    add_seed(p, "damage", 1)
    p.add_argument(
        "--csv", metavar="FILE", help="write every error as CSV; “-” for standard output"
    )
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_pose(options: argparse.Namespace) -> int:
    """Restore, and show how far off the results are."""
    from markermend.bench.poses import CASES, compare
    from markermend.bench.poses_paper import paper_tables
    from markermend.bench.poses_text import (
        hidden_table,
        movements_table,
        poses_csv,
        poses_table,
    )
    from markermend.poses.networks.network import Network, load_networks

    check_outputs(
        [options.csv], source=[*options.poses, *(options.networks or ())], force=options.force
    )
    wanted = options.case
    cases = [c for c in CASES if wanted is None or any(text in c.name for text in wanted)]
    if not cases:
        names = ", ".join(dict.fromkeys(case.name for case in CASES))
        raise MethodError(f"No case has “{wanted[0]}” in its name; there are: {names}.")
    if options.parts is not None and options.networks:
        raise MethodError(
            "Networks are tried on the poses that they did not see of whole recordings; leave out"
            " “--parts” or “--networks”."
        )
    if options.parts is not None and options.parts < _LEAST_PART_S:
        raise MethodError(f"Parts must last {_LEAST_PART_S:g} s at least; choose longer ones.")
    networks: dict[str, Network] = {}
    for path in options.networks:
        networks |= load_networks(Path(path))
    _say_untried(networks, [Path(path).stem for path in options.poses])
    with Bar() as bar:
        rows = compare(
            read_by_name(options.poses),
            part_s=options.parts,
            cases=cases,
            networks=networks,
            seed=options.seed,
            progress=bar,
        )
    if options.csv is not None:
        write_text(options.csv, poses_csv(rows))
    if options.csv != STDOUT:
        hidden = [*hidden_table(rows), *movements_table(rows)] if options.hidden else []
        for line in [*poses_table(rows), *hidden, *(paper_tables(rows) if networks else [])]:
            say(line)
    return 0


def _say_untried(names: Iterable[str], clips: Sequence[str]) -> None:
    """Say which networks have seen whoever is shown, and are not tried."""
    from markermend.poses.networks.learning_sets import never_saw

    seen = [name for name in names if not any(never_saw(name, clip) for clip in clips)]
    if seen:
        warn(
            f"Not tried: {', '.join(seen)}; a network is tried only on people or poses that it"
            " never saw; train it with “--leave-out” or “--fold”."
        )
