"""Events of a C3D file, in its EVENT group and in its header."""

from __future__ import annotations

import math
import struct

import numpy as np

from markermend.files.c3d_layout import C3dLayout
from markermend.files.c3d_numbers import decode_floats
from markermend.files.c3d_records import text_of
from markermend.take import Event

# Places in the header (C3D user guide, "Header events").
KEY_AT, COUNT_AT, TIMES_AT, LABELS_AT = 298, 300, 304, 396
KEY = 12345
MOST = 18


def read_events(layout: C3dLayout) -> tuple[Event, ...]:
    """Return events in order of time; those of the header only where the group lacks them.

    Parameters
    ----------
    layout : the file

    Returns
    -------
    events, with times in seconds on the file's own clock
    """
    events = _group_events(layout)
    half = 0.5 / layout.rate
    times = np.array([e.time_s for e in events])
    for event in _header_events(layout):
        if not (np.abs(times - event.time_s) <= half).any():
            events.append(event)
    return tuple(sorted(events, key=lambda e: (e.time_s, e.label, e.context)))


def _group_events(layout: C3dLayout) -> list[Event]:
    """Events of the EVENT group: label, context, and minutes and seconds."""
    times = layout.numbers("EVENT", "TIMES")
    labels = layout.strings("EVENT", "LABELS")
    contexts = layout.strings("EVENT", "CONTEXTS")
    used = layout.count("EVENT", "USED", len(times) // 2)
    events = []
    for i in range(min(used, len(times) // 2)):
        time_s = 60.0 * times[2 * i] + times[2 * i + 1]
        if math.isfinite(time_s):
            label = labels[i] if i < len(labels) else ""
            events.append(Event(label, float(time_s), contexts[i] if i < len(contexts) else ""))
    return events


def _header_events(layout: C3dLayout) -> list[Event]:
    """Up to 18 events with labels of four letters."""
    order, header = layout.processor.order, layout.header
    key, count = struct.unpack_from(f"{order}HH", header, KEY_AT)
    if key != KEY:
        return []
    count = min(count, MOST)
    times = decode_floats(np.frombuffer(header, np.uint8, 4 * MOST, TIMES_AT), layout.processor)
    events = []
    for i in range(count):
        label = text_of(header[LABELS_AT + 4 * i : LABELS_AT + 4 * i + 4])
        if np.isfinite(times[i]):
            events.append(Event(label, float(times[i])))
    return events
