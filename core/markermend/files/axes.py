"""Turn a take so that another axis points up, as programs that disagree about it need."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

import numpy as np

from markermend.errors import DataError
from markermend.take import Take


def vertical_of(take: Take) -> str:
    """Name the axis that points up as the file tells it (``POINT:Y_SCREEN``), or nothing."""
    told = take.info.get("y_screen", "").strip().lower()
    return told[-1:] if told[-1:] in ("x", "y", "z") else ""


def with_vertical(take: Take, wanted: str, *, current: str = "") -> Take:
    """Turn a take about its x axis so that y or z points up.

    Parameters
    ----------
    take : the recording
    wanted : ``"y"`` or ``"z"``
    current : the axis that points up now, where the file does not tell

    Returns
    -------
    Take
        with the markers turned; z up becomes y up by (x, y, z) → (x, z, -y). A take that has to
        be turned comes back without its source, analog channels and other points, since these
        would stay as they were. One that stands right already comes back as it is.

    Raises
    ------
    DataError
        when the axis is neither y nor z, or nothing tells which one points up now
    """
    now = current or vertical_of(take)
    if wanted not in ("y", "z") or now not in ("y", "z"):
        raise DataError(
            f"The take can be turned between y and z up, not from “{now or 'unknown'}” to"
            f" “{wanted}”; say which axis points up now."
        )
    if now == wanted:
        return take
    x, y, z = (take.positions[..., axis] for axis in range(3))
    turned = np.stack((x, z, -y) if wanted == "y" else (x, -z, y), axis=2)
    return replace(
        take,
        positions=turned,
        points=None,
        analog=None,
        source=None,
        info=MappingProxyType({**take.info, "y_screen": f"+{wanted.upper()}"}),
    )
