"""Every gap of a take: where it is, and filled."""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Real
from typing import Any

from markermend.arrays import runs
from markermend.artifact import Artifact, Kind, in_order
from markermend.errors import MethodError
from markermend.mesh import Mesh
from markermend.progress import Progress
from markermend.repairs.proposing import AUTO
from markermend.repairs.run import repair
from markermend.take import AXES, Take, is_unlabelled


def find_gaps(take: Take, *, max_gap: int | None = None) -> tuple[Artifact, ...]:
    """Every interval in which a named marker is missing, also where detection names no gap.

    Parameters
    ----------
    take : the recording
    max_gap : longest gap to name, in frames; None for all

    Returns
    -------
    Artifacts of kind gap, in order. Unlabelled trajectories and markers that are never seen
    have none.

    Raises
    ------
    MethodError
        when ``max_gap`` is no whole number, or negative
    """
    whole = max_gap is None or (isinstance(max_gap, Real) and max_gap % 1 == 0 and max_gap >= 0)
    if not whole:
        raise MethodError(f"max_gap is a whole number of frames, 0 or more, not {max_gap!r}.")
    found = []
    for column, label in enumerate(take.labels):
        if is_unlabelled(label) or not take.present[:, column].any():
            continue
        for start, stop in runs(~take.present[:, column]):
            if max_gap is None or stop - start <= max_gap:
                why = f"Not seen for {stop - start} frames."
                found.append(Artifact(label, AXES, int(start), int(stop), Kind.GAP, why=why))
    return in_order(found)


def fill(
    take: Take,
    *,
    method: str = AUTO,
    max_gap: int | None = None,
    mesh: Mesh | None = None,
    params: Mapping[str, Any] | object | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> Take:
    """Fill the gaps of a take and change nothing else.

    Parameters
    ----------
    take : the recording
    method : name in the registry, or ``"auto"``
    max_gap : longest gap to fill, in frames; None for all
    mesh : the body's structure, if it was worked out before
    params : of a named method, as a mapping or its dataclass; None for the defaults
    progress : told the share of gaps done; may raise ``Cancelled``
    settings : single parameters by name, ``context=50``

    Returns
    -------
    Take
        a new one; what cannot be filled stays missing

    Raises
    ------
    MethodError
        when there is no such method, a parameter is unknown or out of range, or ``max_gap`` is no
        whole number
    """
    gaps = find_gaps(take, max_gap=max_gap)
    return repair(
        take, gaps, method=method, mesh=mesh, params=params, progress=progress, **settings
    )
