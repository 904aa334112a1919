"""``markermend denoise``: make a skeleton recording clean."""

from __future__ import annotations

import argparse
import io
import sys
from collections import Counter
from pathlib import Path

import numpy as np

import markermend as mm
from markermend.cli.console import (
    STDOUT,
    Bar,
    check_outputs,
    count,
    off_by_rigid_bones,
    output_is_closed,
    say,
    table,
    warn,
)
from markermend.cli.recordings import prior_asked_for
from markermend.errors import DataError, ExportError, MethodError
from markermend.poses import Pose
from markermend.poses.restore import Restored


def run(options: argparse.Namespace) -> int:
    """Restore one recording."""
    from markermend.files.pose import WRITABLE
    from markermend.poses.restore import restore

    if STDOUT in (options.pose, options.output):
        return _follow(options)
    check_outputs([options.output], source=options.pose, force=options.force)
    if Path(options.output).suffix.lower() not in WRITABLE:
        raise ExportError(
            f"“{options.output}” should end in {', '.join(WRITABLE)}, to tell what to write."
        )
    _check_amc(options)
    _check_used(options)
    pose = mm.read_pose(
        options.pose, skeleton=options.skeleton, rate=options.rate, unit=options.unit
    )
    for oddity in pose.warnings:
        warn(f"{Path(options.pose).name}: {oddity}")
    if options.network is not None:
        return _by_network(pose, options)
    prior = prior_asked_for(pose, options.prior)
    with Bar() as bar:
        try:
            restored = restore(pose, prior=prior, progress=bar)
        except DataError as error:
            # What poses refuse knows no file.
            raise DataError(f"{Path(options.pose).name}: {error}") from error
    off_mm = mm.write_pose(_as_asked(restored.pose, options), options.output)
    for line in _listing(restored) if options.list else ():
        say(line)
    kinds = Counter(fault.kind for fault in restored.faults)
    if kinds:
        found = ", ".join(f"{n} {kind}" for kind, n in sorted(kinds.items()))
        say(f"Found wrong: joints {found}.")
    say(
        f"Filled: {int(restored.filled.sum()):,} of"
        f" {count(restored.filled.size, 'position')}; noise taken out:"
        f" {float(np.median(restored.noise_mm)):.1f} mm (median of joints)."
    )
    never = [joint for i, joint in enumerate(pose.joints) if not pose.seen[:, i].any()]
    if never:
        warn(f"Never seen, and left so: {', '.join(never)}.")
    say(f"Written: {options.output}, {count(pose.frames, 'pose')}.")
    for line in off_by_rigid_bones(off_mm):
        say(line)
    return 0


def _as_asked(pose: Pose, options: argparse.Namespace) -> Pose:
    """The recording, with all segments of the CMU skeleton where these are wanted."""
    from markermend.poses.segments import to_cmu

    return to_cmu(pose) if options.cmu else pose


def _check_amc(options: argparse.Namespace) -> None:
    """Refuse, before any work is done, an AMC that there would be no skeleton for."""
    if Path(options.output).suffix.lower() != ".amc":
        return
    if Path(options.pose).suffix.lower() not in (".amc", ".asf"):
        raise ExportError(
            f"“{options.output}” needs a skeleton (ASF), which only a recording read from an AMC"
            " has; write a CSV or BVH."
        )
    for name, makes in (("cmu", "31 segments"), ("network", "17 joints")):
        if getattr(options, name):
            raise ExportError(
                f"--{name} makes {makes} that the skeleton (ASF) of the recording does not hold, so"
                f" “{options.output}” cannot be an AMC; write a CSV or BVH."
            )


def _check_used(options: argparse.Namespace) -> None:
    """Refuse options that would have no effect on this recording, or what is done to it."""
    ending = Path(options.pose).suffix.lower()
    if options.network is not None:
        _refuse(options, ("prior", "list"), "what a network does")
    if ending != ".amc":
        _refuse(options, ("skeleton",), "anything but an AMC")
    if ending in (".amc", ".asf"):
        _refuse(options, ("unit",), "lengths of an AMC, whose skeleton (ASF) tells their unit")


def _refuse(options: argparse.Namespace, names: tuple[str, ...], beside: str) -> None:
    """Refuse options that would have no effect beside what was asked for."""
    for name in names:
        if getattr(options, name):
            raise MethodError(f"--{name} has no effect on {beside}; leave it out.")


def _by_network(pose: Pose, options: argparse.Namespace) -> int:
    """Let a trained network do it."""
    from markermend.poses.networks.by_network import denoise_by_network
    from markermend.poses.networks.network import load_networks

    path, name = options.network
    networks = load_networks(Path(path))
    if name not in networks:
        raise MethodError(f"{path} has no network “{name}”; there are: {', '.join(networks)}.")
    with Bar() as bar:
        cleaned = denoise_by_network(pose, networks[name], progress=bar)
    mm.write_pose(_as_asked(cleaned, options), options.output)
    say(f"Written: {options.output}, {count(pose.frames, 'pose')}.")
    return 0


def _follow(options: argparse.Namespace) -> int:
    """Clean poses while they come."""
    from markermend.files.pose_stream import follow
    from markermend.poses.own_prior import own_prior
    from markermend.poses.prior import shipped_prior

    if options.pose != options.output:
        raise ExportError("A stream is “-” on both sides: markermend denoise - -o -")
    _refuse(options, ("network", "cmu", "list", "skeleton", "unit"), "a stream")
    prior = shipped_prior() if options.prior is None else own_prior(Path(options.prior))

    if sys.stdin is None or output_is_closed():
        raise ExportError(
            "A stream needs a standard input and output that are open; connect both, or name files."
        )
    for stream in (sys.stdin, sys.stdout):
        # What is no UTF-8 goes out as it came in.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding="utf-8", errors="surrogateescape")
    if isinstance(sys.stdin, io.TextIOWrapper):
        # Any ending of lines.
        sys.stdin.reconfigure(newline=None)

    def write(text: str) -> None:
        sys.stdout.write(text)
        sys.stdout.flush()

    # Line by line: iterating over the stream itself would wait for a full buffer.
    lines = iter(sys.stdin.readline, "")
    follow(lines, write, rate=options.rate, prior=prior, warn=warn)
    return 0


def _listing(restored: Restored) -> list[str]:
    """What was done to every joint."""
    rows = []
    for i, joint in enumerate(restored.pose.joints):
        filled = restored.filled[:, i]
        error = restored.error_mm[filled, i]
        rows.append(
            [
                joint,
                f"{100 * filled.mean():.1f}",
                f"{np.sqrt(np.mean(error**2)):.1f}" if len(error) else "–",
                f"{restored.noise_mm[i]:.2f}",
            ]
        )
    head = ["Joint", "Filled, %", "Expected error there, mm", "Noise, mm"]
    wrong = [
        [
            restored.pose.joints[fault.joint],
            fault.kind,
            f"{fault.start / restored.pose.rate:.2f}",
            f"{fault.stop / restored.pose.rate:.2f}",
        ]
        for fault in restored.faults
    ]
    lines = table(["Joint", "Wrong", "From, s", "To, s"], wrong, "llrr") if wrong else []
    return [*table(head, rows, "lrrr"), "", *lines, *([""] if wrong else [])]
