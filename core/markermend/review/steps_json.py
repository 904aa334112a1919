"""Steps of a review as JSON; samples as base64 of little-endian doubles, to keep every bit."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from markermend.artifact_json import from_dict, to_dict
from markermend.patch import Patch
from markermend.review.edits import (
    Edit,
    Group,
    PutBack,
    RepairNote,
    SetArtifacts,
    SetBase,
    SetNames,
    SetNotes,
    SetRegion,
    SetSamples,
)
from markermend.review.step import Step


def step_to_dict(step: Step) -> dict[str, Any]:
    """Write a step: its label, edit and time; the inverse is found again by replaying."""
    entry = {"label": step.label, "edit": _edit_to_dict(step.edit), "spent_s": step.spent_s}
    return {**entry, "by_itself": True} if step.by_itself else entry


def step_from_dict(entry: Mapping[str, Any]) -> tuple[str, Edit, float, bool]:
    """Read a step back: label, edit, seconds spent on the review so far, and if by itself."""
    spent_s, by_itself = float(entry.get("spent_s", 0.0)), bool(entry.get("by_itself", False))
    return entry["label"], _edit_from_dict(entry["edit"]), spent_s, by_itself


def _edit_to_dict(edit: Edit) -> dict[str, Any]:
    if isinstance(edit, Group):
        return {"group": [_edit_to_dict(e) for e in edit.edits]}
    if isinstance(edit, SetSamples):
        return {"samples": [_patch_to_dict(p) for p in edit.patches]}
    if isinstance(edit, PutBack):
        raise TypeError("What takes a step back is not stored.")
    if isinstance(edit, SetBase):
        return {"base": [_patch_to_dict(p) for p in edit.patches]}
    if isinstance(edit, SetNames):
        return {"names": dict(edit.names)}
    if isinstance(edit, SetArtifacts):
        return {
            "artifacts": {i: None if a is None else to_dict(a) for i, a in edit.changes.items()}
        }
    if isinstance(edit, SetRegion):
        return {"region": None if edit.region is None else list(edit.region)}
    return {"notes": {i: None if n is None else asdict(n) for i, n in edit.changes.items()}}


def _edit_from_dict(entry: Mapping[str, Any]) -> Edit:
    if "group" in entry:
        return Group(tuple(_edit_from_dict(e) for e in entry["group"]))
    if "samples" in entry:
        return SetSamples(tuple(_patch_from_dict(p) for p in entry["samples"]))
    if "base" in entry:
        return SetBase(tuple(_patch_from_dict(p) for p in entry["base"]))
    if "names" in entry:
        return SetNames(entry["names"])
    if "artifacts" in entry:
        return SetArtifacts(
            {i: None if a is None else from_dict(a) for i, a in entry["artifacts"].items()}
        )
    if "region" in entry:
        region = entry["region"]
        return SetRegion(None if region is None else (int(region[0]), int(region[1])))
    return SetNotes(
        {i: None if n is None else _note_from_dict(n) for i, n in entry["notes"].items()}
    )


def _note_from_dict(entry: Mapping[str, Any]) -> RepairNote:
    """Read a note; those of older reviews have no band and may not tell what is left."""
    band = entry.get("band_mm")
    return RepairNote(
        entry["method"],
        entry["error_mm"],
        entry.get("leaves", ""),
        None if band is None else tuple(band),
    )


def _patch_to_dict(patch: Patch) -> dict[str, Any]:
    return {
        "marker": patch.marker,
        "axes": patch.axes,
        "start": patch.start,
        "stop": patch.stop,
        "values": base64.b64encode(patch.values.astype("<f8").tobytes()).decode(),
        "origin": None
        if patch.origin is None
        else base64.b64encode(patch.origin.tobytes()).decode(),
    }


def _patch_from_dict(entry: Mapping[str, Any]) -> Patch:
    shape = (entry["stop"] - entry["start"], len(entry["axes"]))
    values = np.frombuffer(base64.b64decode(entry["values"]), dtype="<f8").reshape(shape)
    origin = entry["origin"]
    return Patch(
        marker=entry["marker"],
        axes=entry["axes"],
        start=entry["start"],
        stop=entry["stop"],
        values=values.astype(np.float64),
        origin=None if origin is None else np.frombuffer(base64.b64decode(origin), dtype=np.uint8),
    )
