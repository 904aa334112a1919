"""Artifacts as JSON: what ``detect`` and ``clean`` write, truth files, saved sessions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from markermend.arrays import FloatArray
from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.take import Take

# Of a millimetre: no camera sees more.
_DIGITS = 3
_REQUIRED = ("marker", "axes", "start", "stop", "kind")


def to_dict(artifact: Artifact) -> dict[str, Any]:
    """Turn an artifact into plain values for ``json.dumps``.

    Parameters
    ----------
    artifact : frames 0-based, half-open; an amplitude of NaN becomes ``None``

    Returns
    -------
    dict with the keys ``marker, axes, start, stop, kind, confidence, amplitude_mm, why,
    counterpart, status, id``, ``note`` where the operator wrote one, and
    ``further_counterparts`` for a swap of three or more
    """
    size = artifact.amplitude_mm
    written: dict[str, Any] = {"note": artifact.note} if artifact.note else {}
    if artifact.further_counterparts:
        written["further_counterparts"] = list(artifact.further_counterparts)
    return {
        "marker": artifact.marker,
        "axes": artifact.axes,
        "start": int(artifact.start),
        "stop": int(artifact.stop),
        "kind": artifact.kind.value,
        "confidence": float(artifact.confidence),
        "amplitude_mm": float(size) if math.isfinite(size) else None,
        "why": artifact.why,
        "counterpart": artifact.counterpart,
        "status": artifact.status.value,
        "id": artifact.id,
        **written,
    }


def from_dict(values: Mapping[str, Any]) -> Artifact:
    """Make the artifact that :func:`to_dict` described.

    Parameters
    ----------
    values : at least ``marker, axes, start, stop, kind``; the other keys fall back to the
        defaults of :class:`markermend.artifact.Artifact`, unknown keys are ignored

    Raises
    ------
    DataError
        when a key is missing or a value does not make an artifact
    """
    missing = [key for key in _REQUIRED if key not in values]
    if missing:
        raise DataError(f"An artifact in the JSON lacks “{missing[0]}”.")
    size = values.get("amplitude_mm")
    counterpart = values.get("counterpart")
    try:
        return Artifact(
            marker=str(values["marker"]),
            axes=str(values["axes"]),
            start=int(values["start"]),
            stop=int(values["stop"]),
            kind=Kind(values["kind"]),
            confidence=float(values.get("confidence", 1.0)),
            amplitude_mm=math.nan if size is None else float(size),
            why=str(values.get("why", "")),
            counterpart=None if counterpart is None else str(counterpart),
            status=Status(values.get("status", Status.PENDING)),
            id=str(values.get("id", "")),
            note=str(values.get("note", "")),
            further_counterparts=tuple(str(m) for m in values.get("further_counterparts") or ()),
        )
    except (TypeError, ValueError) as error:
        raise DataError(
            f"An artifact of {values['marker']} in the JSON cannot be read: {error}."
        ) from error


def rounded(values_mm: FloatArray) -> list[float]:
    """Lengths as plain numbers, to the micrometre.

    Parameters
    ----------
    values_mm : (n,) mm, without NaN
    """
    return [round(float(v), _DIGITS) for v in values_mm]


def document(
    take: Take,
    artifacts: Iterable[Artifact],
    method: str,
    version: str,
    *,
    name: str | None = None,
    region: tuple[int, int] | None = None,
) -> dict[str, Any]:
    """Describe a take and its artifacts as one JSON document.

    Parameters
    ----------
    take : the recording the artifacts belong to
    artifacts : written in the order given
    method : what found them (``"joint"``, ``"paper"``, ``"truth"``…)
    version : Markermend's version
    name : the take's name; that of its source file when not given, else empty
    region : the frames that were asked about, a half-open interval; None for all

    Returns
    -------
    dict with the keys ``take, rate, first_frame, frames, method, version, artifacts``, and
    ``region`` where there is one
    """
    if name is None:
        name = take.source.path.name if take.source else ""
    return {
        "take": name,
        "rate": float(take.rate),
        "first_frame": int(take.first_frame),
        "frames": take.frames,
        "method": method,
        "version": version,
        **({} if region is None else {"region": list(region)}),
        "artifacts": [to_dict(artifact) for artifact in artifacts],
    }


def artifacts_of(values: Mapping[str, Any]) -> tuple[Artifact, ...]:
    """Read back the artifacts of a :func:`document`.

    Raises
    ------
    DataError
        when there is no list of artifacts, or one of them cannot be read
    """
    listed = values.get("artifacts")
    if not isinstance(listed, list):
        raise DataError("The JSON has no list of artifacts.")
    return tuple(from_dict(item) for item in listed)
