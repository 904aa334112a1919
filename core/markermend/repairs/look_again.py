"""The detector looks again at what was repaired: is there damage still, or anew.

Only sudden artifacts are looked for (peaks, noise, steps); what a repair may be off smoothly is
what its expected error tells.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact
from markermend.detectors.finding import in_mm
from markermend.detectors.joint import JointParams, detect_joint
from markermend.patch import Patch, write_patches
from markermend.progress import heed, quiet
from markermend.repairs.registry import Repair
from markermend.take import Take

# How far around a repair the detector must see to know what is usual there.
AROUND_S = 2.0
# Markers whose movement tells a blow to the body from damage.
NEIGHBOURS = 6


def looked_at(take: Take, repair: Repair, besides: Sequence[Patch] = ()) -> Repair:
    """Return a proposal that says what the detector would find where it was carried out.

    Parameters
    ----------
    take : the recording as it stands, without the repair
    repair : the proposal; one without patches is returned as it is
    besides : what other repairs put there

    Returns
    -------
    Repair
        with :attr:`Repair.leaves` set
    """
    written = (*besides, *repair.patches)
    found = [a for patch in repair.patches for a in _seen_in(take, patch, written)]
    return replace(repair, leaves=tuple(found)) if repair.patches else repair


def in_words(leaves: Iterable[Artifact]) -> str:
    """Say in one sentence what the detector still finds; empty where it finds nothing."""
    found = [f"{a.kind} of {in_mm(a.amplitude_mm)} mm" for a in leaves]
    if not found:
        return ""
    more = f" and {len(found) - 1} more" if len(found) > 1 else ""
    return f"The detector still finds damage there: a {found[0]}{more}."


def _seen_in(take: Take, patch: Patch, patches: Sequence[Patch]) -> list[Artifact]:
    """Sudden artifacts that touch a patch, once all patches are written."""
    heed()
    margin = round(AROUND_S * take.rate)
    first, last = max(0, patch.start - margin), min(take.frames, patch.stop + margin)
    window = take.positions[first:last].copy()
    write_patches(window, first, {label: i for i, label in enumerate(take.labels)}, patches)
    own = take.index(patch.marker)
    # Alone first: with neighbours to excuse it less is found, never more, and most repairs leave
    # nothing.
    if not _sudden(window, [own], take, patch, first):
        return []
    distance = np.linalg.norm(window - window[:, own, None], axis=2)
    known = np.isfinite(distance).any(axis=0)
    apart = np.full(len(known), np.inf)
    apart[known] = np.nanmedian(distance[:, known], axis=0)
    near = [int(i) for i in np.argsort(apart, kind="stable") if known[i] and i != own]
    return _sudden(window, [own, *near[:NEIGHBOURS]], take, patch, first)


def _sudden(
    window: FloatArray, columns: list[int], take: Take, patch: Patch, first: int
) -> list[Artifact]:
    """What the detector finds on the patched marker, where it touches the patch."""
    some = Take(window[:, columns], tuple(take.labels[c] for c in columns), take.rate)
    return [
        replace(a, start=a.start + first, stop=a.stop + first, id="")
        for a in detect_joint(some, JointParams(slow=False), None, quiet)
        if a.marker == patch.marker
        and any(patch.start <= edge + first <= patch.stop for edge in (a.start, a.stop))
        and set(a.axes) & set(patch.axes)
    ]
