"""``markermend bench blind``: ask people which version of a movement looks most natural."""

from __future__ import annotations

import argparse
import secrets
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.cli.console import (
    check_outputs,
    count,
    read_json,
    say,
    table,
    write_json,
    write_text,
)
from markermend.cli.numbers import add_seed
from markermend.errors import DataError, ExportError

SUMMARY = "ask people which version of a movement looks most natural, not knowing which is which"


def add_blind(p: argparse.ArgumentParser) -> None:
    """Give the experiment its options."""
    p.add_argument(
        "versions",
        metavar="VERSION",
        nargs="+",
        help="skeleton recordings, versions of one movement; or folders, one a version, with "
        "recordings of the same names; with --tally, the answers that the page saved (CSV)",
    )
    p.add_argument("-o", "--output", metavar="FILE.html", help="page that asks, to be passed on")
    p.add_argument(
        "--key",
        metavar="KEY.json",
        help="which letter hides which version, to be kept back (default: FILE_key.json)",
    )
    add_seed(p, "letters", None)
    p.add_argument("--tally", metavar="KEY.json", help="count the votes by this key")
    p.add_argument("--force", action="store_true", help="overwrite what is there already")


def run_blind(options: argparse.Namespace) -> int:
    """Write the page and its key, or count what was answered."""
    if options.tally is not None:
        return _tally(options)
    from markermend.bench.blind import Version, blind_page

    if options.output is None:
        raise ExportError("Name the page to write with -o FILE.html, or count votes with --tally.")
    page = Path(options.output)
    key_path = options.key or str(page.with_name(f"{page.stem}_key.json"))
    check_outputs([options.output, key_path], source=options.versions, force=options.force)
    movements = [
        [
            Version(name, str(path), mm.read_pose(path))
            for name, path in zip(options.versions, paths, strict=True)
        ]
        for paths in _movements(options.versions)
    ]
    seed = secrets.randbelow(2**31) if options.seed is None else options.seed
    text, key = blind_page(movements, seed=seed)
    write_json(key_path, key)
    write_text(options.output, text)
    say(
        f"Written: {page}, {count(len(movements), 'movement')} in"
        f" {len(options.versions)} versions. Keep {key_path} back: it tells which is which."
    )
    return 0


def _movements(given: list[str]) -> list[list[Path]]:
    """The files of each movement, one a version."""
    from markermend.files.pose import WRITABLE

    paths = [Path(path) for path in given]
    if len(set(given)) < len(given):
        raise DataError("A version is given twice; give each once.")
    if not any(path.is_dir() for path in paths):
        return [paths]
    folders = []
    for path in paths:
        if not path.is_dir():
            raise DataError(f"“{path}” is no folder; give only folders, or only recordings.")
        held = sorted(file for file in path.iterdir() if file.suffix.lower() in WRITABLE)
        folders.append({file.stem: file for file in held})
    names = sorted(set().union(*folders))
    if not names:
        raise DataError(f"“{given[0]}” holds no skeleton recording ({', '.join(WRITABLE)}).")
    for path, folder in zip(paths, folders, strict=True):
        for name in names:
            if name not in folder:
                raise DataError(
                    f"“{path}” has no recording called {name}, but another folder has;"
                    " every version needs every movement."
                )
    return [[folder[name] for folder in folders] for name in names]


def _tally(options: argparse.Namespace) -> int:
    """Show the votes."""
    from markermend.bench.blind import QUESTIONS, is_key, tally
    from markermend.bench.scales import SCALES

    key: dict[str, Any] = read_json(options.tally)
    if not is_key(key):
        raise DataError(f"“{options.tally}” is no key that “bench blind” wrote.")
    try:
        texts = [Path(path).read_text(encoding="utf-8") for path in options.versions]
    except UnicodeDecodeError as error:
        raise DataError(
            "Answers are CSV in UTF-8, as the page saved them; these are not."
        ) from error
    votes = tally(key, texts)
    head = ["Version", *(cell for q in QUESTIONS for cell in (q.capitalize(), "%"))]
    for line in table(head, _shares(votes.by_version), "lrrrr"):
        say(line)
    if votes.by_scale:
        say("\nMost natural, by scale of occlusion: votes and % of those in the scale")
        head = ["Version", *(cell for n in range(SCALES) for cell in (str(n + 1), "%"))]
        for line in table(head, _shares(votes.by_scale), "l" + "rr" * SCALES):
            say(line)
    who = "1 person" if votes.people == 1 else f"{votes.people} people"
    say(f"\n{who}, {count(len(key['movements']), 'movement')}.")
    return 0


def _shares(votes: dict[str, list[int]]) -> list[list[str]]:
    """A row for each version: in each column votes, and how many of all of that column."""
    sums = [sum(column) for column in zip(*votes.values(), strict=True)]
    return [
        [name, *(cell for n, of in zip(row, sums, strict=True) for cell in _share(n, of))]
        for name, row in votes.items()
    ]


def _share(votes: int, of: int) -> tuple[str, str]:
    """Votes, and how many of all in per cent."""
    return str(votes), f"{100 * votes / of:.0f}" if of else "–"
