"""Errors on skeleton recordings as a table and as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence

import numpy as np

from markermend.bench.columns import aligned, number
from markermend.bench.poses import HIDDEN, KNOWN, MOVEMENT_S, Row
from markermend.bench.scales import SCALES, occlusion_scales


def poses_table(rows: Sequence[Row]) -> list[str]:
    """Mean absolute error of every method in every case, poses pooled.

    Subjects were never seen, but where a method's name says so.
    """
    known = KNOWN.removeprefix(", ")
    lines = [
        "Mean absolute error over all features; whoever is shown was left out of learning, except"
        f" where it says “{known}”: there only the recording itself was, of people whom others"
        " show, too."
    ]
    for case in dict.fromkeys(row.case for row in rows):
        here = [row for row in rows if row.case == case]
        kinds = list(dict.fromkeys(row.kind for row in here))
        body = [
            [
                method,
                *(pooled([r for r in here if (r.method, r.kind) == (method, k)]) for k in kinds),
            ]
            for method in dict.fromkeys(row.method for row in here)
        ]
        head = ["Method", *kinds]
        lines += ["", f"{case[0].upper()}{case[1:]}", *aligned([head, *body])]
    return lines


def hidden_table(rows: Sequence[Row]) -> list[str]:
    """The same by the number of joints occluded in a pose, both noises."""
    lines: list[str] = []
    for case in dict.fromkeys(row.case for row in rows if row.kind == "both"):
        here = [row for row in rows if row.case == case and row.kind == "both"]
        head = ["Joints occluded", *(f"{n}" for n in HIDDEN[:-1]), f"{HIDDEN[-1]} and more"]
        body = []
        for method in dict.fromkeys(row.method for row in here):
            groups = np.array([row.by_hidden for row in here if row.method == method])
            weight = np.array([row.poses_hidden for row in here if row.method == method])
            total = np.maximum(weight.sum(axis=0), 1)
            mean = np.sum(weight * np.nan_to_num(groups), axis=0) / total
            body.append([method, *(f"{value:.4f}" for value in mean.tolist())])
        lines += ["", f"{case[0].upper()}{case[1:]}, both", *aligned([head, *body])]
    return lines


def movements_table(rows: Sequence[Row]) -> list[str]:
    """The same by the scale of occlusion of a movement (:func:`occlusion_scales`)."""
    lines: list[str] = []
    for case in dict.fromkeys(row.case for row in rows if row.kind == "both"):
        here = [row for row in rows if row.case == case and row.kind == "both" and row.by_movement]
        moved = {
            method: np.array([m for row in here if row.method == method for m in row.by_movement])
            for method in dict.fromkeys(row.method for row in here)
        }
        if not moved:
            continue
        parts = np.cumsum([len(pairs) for pairs in moved.values()])[:-1]
        every = np.concatenate(list(moved.values()))
        together, edges = occlusion_scales(every[:, 0])
        scale = dict(zip(moved, np.split(together, parts), strict=True))
        most = max(moved, key=lambda method: len(moved[method]))
        head = ["Scale", *(f"{n + 1}" for n in range(SCALES))]
        body = [["joints occluded in a pose", *(f"to {edge:.1f}" for edge in edges)]]
        body.append(["movements", *(str((scale[most] == n).sum()) for n in range(SCALES))])
        for method, pairs in moved.items():
            groups = [pairs[scale[method] == n, 1] for n in range(SCALES)]
            body.append([method, *(number(g.mean() if len(g) else np.nan, 4) for g in groups)])
        title = f"{case[0].upper()}{case[1:]}, both, movements of {MOVEMENT_S:g} s"
        lines += ["", title, *aligned([head, *body])]
    return lines


def poses_csv(rows: Sequence[Row]) -> str:
    """Every method on every recording."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(
        [
            "clip",
            "subject",
            "case",
            "kind",
            "method",
            "error",
            *(f"hidden{n}" for n in HIDDEN),
            "poses",
        ]
    )
    for row in rows:
        writer.writerow(
            [row.clip, row.subject, row.case, row.kind, row.method, f"{row.error:.6f}"]
            + [f"{value:.6f}" for value in row.by_hidden]
            + [row.poses]
        )
    return file.getvalue()


def pooled(rows: Sequence[Row]) -> str:
    """Mean over poses."""
    poses = sum(row.poses for row in rows)
    return f"{sum(r.error * r.poses for r in rows if r.poses) / poses:.4f}" if poses else "–"
