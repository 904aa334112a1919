"""How to detect, as the options of ``detect`` and ``clean`` say it."""

from __future__ import annotations

import argparse
from dataclasses import fields
from typing import Any

from markermend.cli.numbers import share
from markermend.errors import ExportError


def add_detection(p: argparse.ArgumentParser, option: str) -> None:
    """Add the options.

    Parameters
    ----------
    p : of the command
    option : what names the detection method there
    """
    p.add_argument(
        option,
        dest="detector",
        metavar="NAME",
        help="how to detect (default: joint, our own; paper: the four stages as published)",
    )
    p.add_argument(
        "--no-slow",
        action="store_true",
        help="skip slow changes, which take longer to look for than all the others",
    )
    p.add_argument(
        "--sensitivity",
        metavar="S",
        type=share,
        help="from 0 to 1 (default: 0.5): flag what is at least 1 − S sure; more is found, and "
        "more of it wrongly, the higher it is",
    )
    p.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="any other parameter of the method; “markermend methods NAME” lists them",
    )
    p.add_argument("--preset", metavar="NAME", help="detect as was saved under this name")
    p.add_argument(
        "--save-preset", metavar="NAME", help="save how to detect, as chosen here, under a name"
    )


def refuse_choice(options: argparse.Namespace, why: str) -> None:
    """Refuse options that choose how to detect where that has no effect.

    Parameters
    ----------
    options : of the command
    why : nothing is chosen there, as the beginning of a sentence

    Raises
    ------
    MethodError
        when one of them was given, but for ``--no-slow``, which asks for nothing
    """
    from markermend.errors import MethodError

    names = {"sensitivity": "--sensitivity", "set": "--set", "preset": "--preset"}
    given = [shown for name, shown in names.items() if getattr(options, name) not in (None, [])]
    if options.detector is not None:
        given.insert(0, f"“{options.detector}”")
    if given:
        raise MethodError(f"{why}, so that {' and '.join(given)} can change nothing; leave it out.")


def choose(options: argparse.Namespace) -> tuple[str, Any]:
    """Name of the detection method and its parameters: the preset, then what is said beside it.

    Raises
    ------
    MethodError
        for an unknown preset, method or parameter, or a value that makes no sense
    """
    from markermend.cli.settings import settings_of
    from markermend.detectors import DEFAULT, find_detector
    from markermend.parameters import read_params

    name, params = DEFAULT, None
    # Presets are recipes, and with them comes all that a batch may need.
    if options.preset is not None:
        from markermend.presets import load_preset

        name, params = load_preset(options.preset)
    if options.detector is not None and options.detector != name:
        name, params = options.detector, None
    method = find_detector(name)
    given = settings_of(method.params, options.set)
    if options.sensitivity is not None:
        given["sensitivity"] = options.sensitivity
    if options.no_slow and "slow" in {f.name for f in fields(method.params)}:
        given["slow"] = False
    params = read_params(method, params, given)
    if options.save_preset is not None:
        from markermend.presets import has_preset, save_preset

        if has_preset(options.save_preset) and not options.force:
            raise ExportError(
                f"There is a preset “{options.save_preset}” already; add --force to replace it."
            )
        save_preset(options.save_preset, name, params)
    return name, params
