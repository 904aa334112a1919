"""Which points of a C3D file are markers, and which are angles, forces or a model's output."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence

# Lists of labels in the POINT group, as Vicon's type groups name them.
LISTS = {
    "ANGLES": "angle",
    "FORCES": "force",
    "MOMENTS": "moment",
    "POWERS": "power",
    "SCALARS": "scalar",
    "REACTIONS": "reaction",
    "MODELED_MARKERS": "modelled",
    "MODELLED_MARKERS": "modelled",
}
# Outputs that some versions of Plug-in Gait write without listing them.
_BY_NAME = (
    (re.compile(r"(Angles?|AnglesN)$"), "angle"),
    (re.compile(r"(GroundReactionForce|NormalisedGRF|Force)$"), "force"),
    (re.compile(r"(GroundReactionMoment|Moment)$"), "moment"),
    (re.compile(r"Power$"), "power"),
    (re.compile(r"^CentreOfMass(Floor)?$"), "modelled"),
)
# Each segment of Plug-in Gait is written as four points: origin and three axes.
_SEGMENT_POINTS = "OALP"


def kinds_of(point_texts: Callable[[str], Sequence[str]], labels: Sequence[str]) -> tuple[str, ...]:
    """Tell markers from other points.

    Parameters
    ----------
    point_texts : gives the texts of a parameter of the POINT group by its name, none where the
        file has no such parameter
    labels : one per point, in the file's order

    Returns
    -------
    one per point: empty for a marker, else ``"angle"``, ``"force"``, ``"moment"``, ``"power"``,
    ``"scalar"``, ``"reaction"`` or ``"modelled"``
    """
    lists = dict(LISTS)
    for name in point_texts("TYPE_GROUPS")[0::2]:
        lists.setdefault(name.upper(), name.lower().removesuffix("s") or "modelled")
    listed: dict[str, str] = {}
    for name, kind in lists.items():
        for label in point_texts(name):
            if label:
                listed.setdefault(label, kind)
    axes = _segment_axes(labels)
    return tuple(_kind(label, listed, axes) for label in labels)


def units_of(
    point_texts: Callable[[str], Sequence[str]], kinds: Iterable[str]
) -> Mapping[str, str]:
    """Unit of each kind of point that is no marker, as far as the file tells.

    Parameters
    ----------
    point_texts : as for :func:`kinds_of`
    kinds : of points, as :func:`kinds_of` returns them

    Returns
    -------
    mapping of kind to unit: of ``POINT:ANGLE_UNITS`` and the like; a model's points are lengths
    """
    told: dict[str, str] = {}
    for kind in dict.fromkeys(kinds):
        name = "UNITS" if kind == "modelled" else f"{kind.upper()}_UNITS"
        unit = next(iter(point_texts(name)), "").strip()
        if kind and unit:
            told[kind] = unit
    return told


def _kind(label: str, listed: dict[str, str], axes: set[str]) -> str:
    """Kind of one point by the file's lists, else by its name."""
    bare = label.rpartition(":")[2]
    for name in (label, bare):
        if name in listed:
            return listed[name]
    if label in axes:
        return "modelled"
    for pattern, kind in _BY_NAME:
        if pattern.search(bare):
            return kind
    return ""


def _segment_axes(labels: Iterable[str]) -> set[str]:
    """Points that stand for a segment's axes: three letters and each of O, A, L, P."""
    known = set(labels)
    stems = {s[:-1] for s in known if len(s.rpartition(":")[2]) == 4 and s.endswith("O")}
    whole = [s for s in stems if all(s + letter in known for letter in _SEGMENT_POINTS)]
    return {stem + letter for stem in whole for letter in _SEGMENT_POINTS}
