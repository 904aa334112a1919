"""The command line in this process, and a recording to run it on."""

from __future__ import annotations

import json
from pathlib import Path

import ezc3d
import numpy as np

from markermend.cli import main

FRAMES, RATE, GAP = 400, 100.0, slice(150, 160)


def write_swing(path: Path) -> None:
    """Write a C3D of two rigid plates that swing, with one gap and one spike."""
    rng = np.random.default_rng(1)
    time = np.arange(FRAMES) / RATE
    corners = np.array([[0, 0, 0], [200, 0, 0], [0, 150, 0], [200, 150, 30.0]])
    points = []
    for plate, (height, speed) in enumerate(((1000.0, 0.4), (400.0, 0.7))):
        turn = 0.5 * np.sin(2 * np.pi * speed * time)
        sway = 80 * np.sin(2 * np.pi * 0.5 * speed * time + plate)
        for x, y, z in corners:
            points.append(
                [
                    np.cos(turn) * x - np.sin(turn) * y + sway,
                    np.sin(turn) * x + np.cos(turn) * y,
                    np.full(FRAMES, z + height),
                ]
            )
    positions = np.array(points).transpose(1, 0, 2) + rng.normal(0, 0.2, (3, 8, FRAMES))
    positions[2, 2, 300] += 40.0
    positions[:, 1, GAP] = np.nan
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [RATE]
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    names = [f"{plate}{i}" for plate in ("TOP", "LOW") for i in range(4)]
    file["parameters"]["POINT"]["LABELS"]["value"] = names
    file["data"]["points"] = np.concatenate([positions, np.ones((1, 8, FRAMES))])
    file.write(str(path))


def run(*words: object) -> int:
    """Run a command, and return its exit code."""
    return main([str(word) for word in words])


def strict(text: str) -> dict[str, object]:
    """Parse JSON, refusing NaN and Infinity, which are not JSON."""

    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)
