"""Takes as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from markermend.errors import MethodError
from markermend.exchange.need import need
from markermend.take import AXES, Origin, Take

if TYPE_CHECKING:
    import pandas

Layout = Literal["wide", "long", "kineticstoolkit"]


def to_dataframe(take: Take, layout: Layout = "wide") -> pandas.DataFrame:
    """Lay a take out as a table.

    Parameters
    ----------
    take : the recording
    layout : ``"wide"``: a row a frame, columns (marker, axis), indexed by seconds.
        ``"long"``: a row a frame and marker with ``frame`` (the file's number), ``time``,
        ``marker``, ``x``, ``y``, ``z`` and ``origin`` (missing, measured, filled, edited).
        ``"kineticstoolkit"``: a row a frame, columns ``LFHD[0]`` to ``LFHD[3]``, the last one 1,
        in metres, as ``kineticstoolkit.TimeSeries.from_dataframe`` takes them

    Returns
    -------
    table in mm (but for Kinetics Toolkit), NaN where the marker was not seen; time in seconds from
    the first frame

    Raises
    ------
    MethodError
        when pandas is not installed, or there is no such layout
    """
    pd = need("pandas")
    time = pd.Index(np.arange(take.frames) / take.rate, name="time")
    if layout == "wide":
        columns = pd.MultiIndex.from_product([take.labels, list(AXES)], names=["marker", "axis"])
        return pd.DataFrame(take.positions.reshape(take.frames, -1), time, columns)
    if layout == "kineticstoolkit":
        series = np.ones((take.frames, take.markers, 4))
        series[:, :, :3] = take.positions / 1000.0
        # Of a missing point the 1 is missing too, as its own reader has it.
        series[~take.present] = np.nan
        names = [f"{label}[{i}]" for label in take.labels for i in range(4)]
        return pd.DataFrame(series.reshape(take.frames, -1), time, names)
    if layout == "long":
        origins = np.array([o.name.lower() for o in Origin])
        frames = take.first_frame + np.arange(take.frames)
        return pd.DataFrame(
            {
                "frame": np.repeat(frames, take.markers),
                "time": np.repeat(time, take.markers),
                "marker": np.tile(np.array(take.labels, dtype=object), take.frames),
                **{a: take.positions[:, :, i].ravel() for i, a in enumerate(AXES)},
                "origin": origins[take.origin.ravel()],
            }
        )
    raise MethodError(f"There is no layout “{layout}”; choose one of wide, long, kineticstoolkit.")
