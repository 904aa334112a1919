"""Damage put into a clean take on purpose, with the truth beside it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.artifact import Artifact, Kind, axis_columns, in_order
from markermend.patch import Patch, patched
from markermend.take import Origin, Take


@dataclass(frozen=True)
class Damage:
    """Patches that damage a clean take, and the artifacts that say where and how."""

    patches: tuple[Patch, ...]
    artifacts: tuple[Artifact, ...]


def added(
    take: Take,
    marker: str,
    axes: str,
    start: int,
    deviation: FloatArray,
    kind: Kind,
    amplitude_mm: float,
    why: str,
) -> Damage:
    """Plan to add a deviation to some axes of one marker.

    Parameters
    ----------
    take : the clean recording; the marker must be seen over the whole interval
    marker, axes, start : where; ``axes`` a part of ``"xyz"``
    deviation : (length,) or (length, len(axes)) float64, mm
    kind, amplitude_mm, why : for the truth

    Returns
    -------
    Damage of one patch and one artifact; the samples still count as measured
    """
    columns = axis_columns(axes)
    stop = start + len(deviation)
    clean = take.positions[start:stop, take.index(marker)][:, columns]
    values = clean + deviation.reshape(len(deviation), -1)
    measured = np.full(len(deviation), Origin.MEASURED, dtype=np.uint8)
    patch = Patch(marker, axes, start, stop, values, measured)
    artifact = Artifact(marker, axes, start, stop, kind, amplitude_mm=amplitude_mm, why=why)
    return Damage((patch,), (artifact,))


def hidden(marker: str, start: int, stop: int, why: str) -> Damage:
    """Plan to make one marker missing over ``[start, stop)``."""
    nothing = np.full((stop - start, 3), math.nan)
    missing = np.full(stop - start, Origin.MISSING, dtype=np.uint8)
    patch = Patch(marker, "xyz", start, stop, nothing, missing)
    return Damage((patch,), (Artifact(marker, "xyz", start, stop, Kind.GAP, why=why),))


def swapped(take: Take, markers: Sequence[str], start: int, stop: int, why: str) -> Damage:
    """Plan to put the samples of each marker under the next one's name over ``[start, stop)``.

    Parameters
    ----------
    take : the clean recording
    markers : two or more; the samples of the last go under the first one's name
    start, stop : half-open interval of frames
    why : what the artifacts say of it

    Returns
    -------
    Damage of a patch and a step for each, with the others as counterparts in that order; its
    amplitude is the median distance from its own samples to those under its name
    """
    rows = slice(start, stop)
    measured = np.full(stop - start, Origin.MEASURED, dtype=np.uint8)
    patches, artifacts = [], []
    for i, label in enumerate(markers):
        own = take.positions[rows, take.index(label)]
        values = take.positions[rows, take.index(markers[i - 1])]
        distance = float(np.median(np.linalg.norm(own - values, axis=1)))
        partner, *further = (*markers[i + 1 :], *markers[:i])
        patches.append(Patch(label, "xyz", start, stop, values.copy(), measured))
        artifacts.append(
            Artifact(
                label,
                "xyz",
                start,
                stop,
                Kind.STEP,
                amplitude_mm=distance,
                why=why,
                counterpart=partner,
                further_counterparts=tuple(further),
            )
        )
    return Damage(tuple(patches), tuple(artifacts))


def apply_damage(take: Take, damages: Iterable[Damage]) -> tuple[Take, tuple[Artifact, ...]]:
    """Damage a take.

    Parameters
    ----------
    take : the clean recording
    damages : planned on that very take; no two may name the same sample

    Returns
    -------
    the damaged take (residuals NaN and cameras 0 where samples went missing) and the truth in
    order of start
    """
    planned = list(damages)
    result = patched(take, (patch for damage in planned for patch in damage.patches))
    truth = in_order(artifact for damage in planned for artifact in damage.artifacts)
    lost = ~result.present
    if result.residuals is not None:
        residuals = np.where(lost, np.float32(math.nan), result.residuals)
        result = replace(result, residuals=residuals.astype(np.float32))
    if result.cameras is not None:
        result = replace(result, cameras=np.where(lost, 0, result.cameras).astype(np.uint8))
    return result, truth


def spread_out(lengths: IntArray, frames: int, rng: np.random.Generator) -> IntArray:
    """Lay intervals out at random over ``[0, frames)``, in the order given, never overlapping.

    The free frames between them are shared out as the gaps of a Poisson process are.

    Parameters
    ----------
    lengths : (k,) int64, their sum at most ``frames``
    frames : of the take
    rng : what is random about it

    Returns
    -------
    (k,) int64 first frame of each
    """
    slack = frames - int(lengths.sum())
    free = np.sort(rng.integers(0, slack + 1, size=len(lengths)))
    return np.asarray(free + np.concatenate([[0], np.cumsum(lengths)[:-1]]), dtype=np.int64)
