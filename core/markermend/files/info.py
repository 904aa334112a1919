"""What a careful operator wants to know of a file beyond its markers."""

from __future__ import annotations

from typing import Any

from markermend.arrays import runs
from markermend.files.c3d_layout import C3dLayout
from markermend.take import Take

_PLATE_TYPES = {
    1: "forces and centre of pressure",
    2: "forces and moments",
    3: "eight force channels",
    4: "forces and moments with a calibration matrix",
    5: "eight channels with a calibration matrix",
    6: "twelve channels with a calibration matrix",
    7: "eight channels with a polynomial",
}


def describe_file(take: Take) -> dict[str, Any]:
    """Collect what a take's file tells, as plain values for JSON.

    Parameters
    ----------
    take : the recording

    Returns
    -------
    dict
        ``format``, ``units``, ``rate``, ``first_frame``, ``frames``, ``missing`` (samples, and how
        they are coded), ``gaps`` (per marker with any: number, frames, longest), ``points``
        (number of each kind), ``events``, ``analog`` (rate and channels with units),
        ``force_plates`` (type, corners in the file's units, analog channels), ``oddities``, and
        ``info`` with what else is there: manufacturer, processor, storage…
    """
    source = take.source
    layout = source.layout if source is not None else None
    kinds = take.points.kinds if take.points is not None else ()
    analog = take.analog
    return {
        "format": source.format if source is not None else None,
        "units": take.info.get("units", ""),
        "rate": float(take.rate),
        "first_frame": int(take.first_frame),
        "frames": take.frames,
        "missing": {
            "samples": int((~take.present).sum()),
            "coding": take.info.get("missing_samples", ""),
        },
        "gaps": _gaps(take),
        "points": {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)},
        "events": [
            {"label": e.label, "time_s": e.time_s, "context": e.context} for e in take.events
        ],
        "analog": None
        if analog is None
        else {
            "rate": float(analog.rate),
            "channels": [
                {"label": label, "unit": unit}
                for label, unit in zip(analog.labels, analog.units, strict=True)
            ],
        },
        "force_plates": _force_plates(layout) if isinstance(layout, C3dLayout) else [],
        "oddities": list(take.warnings),
        "read_only": take.read_only,
        "info": dict(take.info),
    }


def _gaps(take: Take) -> dict[str, dict[str, int]]:
    """Gaps of each marker that has any."""
    found = {}
    for column, label in enumerate(take.labels):
        gaps = runs(~take.present[:, column])
        if len(gaps):
            lengths = gaps[:, 1] - gaps[:, 0]
            found[label] = {
                "gaps": len(gaps),
                "frames": int(lengths.sum()),
                "longest": int(lengths.max()),
            }
    return found


def _force_plates(layout: C3dLayout) -> list[dict[str, Any]]:
    """Type, corners and analog channels of each force plate."""
    used = min(layout.count("FORCE_PLATFORM", "USED"), 255)
    types = layout.numbers("FORCE_PLATFORM", "TYPE")
    corners = layout.numbers("FORCE_PLATFORM", "CORNERS")
    channels = layout.find("FORCE_PLATFORM", "CHANNEL")
    numbers = layout.numbers("FORCE_PLATFORM", "CHANNEL", unsigned=True)
    each = channels.dims[0] if channels is not None and channels.dims else 0
    labels = layout.strings("ANALOG", "LABELS")
    plates = []
    for i in range(used):
        kind = int(types[i]) if i < len(types) else 0
        wired = [int(n) for n in numbers[i * each : (i + 1) * each]]
        place = corners[12 * i : 12 * i + 12]
        plates.append(
            {
                "type": kind,
                "means": _PLATE_TYPES.get(kind, "unknown"),
                "corners": place.reshape(-1, 3).tolist() if len(place) == 12 else [],
                "channels": [labels[n - 1] for n in wired if 0 < n <= len(labels)],
            }
        )
    return plates
