"""What a loose predictor may look at: the rest of the body, never the marker's own present.

skurowski2022, section 3.3.2: a marker is predicted from its siblings and from one marker of the
parent group (eq. 9). Where the mesh offers fewer than three such markers, the ones that keep
the most constant distance to it complete them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.predictors.bridging import bridge
from markermend.take import Take, is_unlabelled

LEAST_NEIGHBOURS = 3
# A neighbour seen in fewer frames than this share would be mostly bridges.
LEAST_PRESENCE = 0.5


@dataclass(frozen=True, eq=False)
class Inputs:
    """One marker and the markers it is predicted from.

    Attributes
    ----------
    neighbours : (frames, k, 3) mm, bridged where untrusted
    own : (frames, 3) mm, bridged where untrusted
    fit : (frames,) bool; rows to learn from: the marker trusted, most neighbours too
    usable : (frames,) bool; rows with at least half of the neighbours trusted
    """

    neighbours: FloatArray
    own: FloatArray
    fit: BoolArray
    usable: BoolArray


def neighbours_of(take: Take, mesh: Mesh, marker: int) -> tuple[int, ...]:
    """Columns a marker is predicted from: its parent marker, its siblings, else the nearest.

    Parameters
    ----------
    take : the recording
    mesh : the body's structure
    marker : column of the marker to predict

    Raises
    ------
    DataError
        when no other marker is seen in half of the frames
    """
    presence = take.present.mean(axis=0)
    parent = mesh.parent_marker(marker)
    chosen = [parent] if parent is not None else []
    chosen += [m for m in mesh.siblings(marker) if m not in chosen]
    chosen = [m for m in chosen if presence[m] >= LEAST_PRESENCE]
    if len(chosen) < LEAST_NEIGHBOURS:
        subject = take.subject(take.labels[marker])
        others = [
            m
            for m, label in enumerate(take.labels)
            if m != marker
            and m not in chosen
            and presence[m] >= LEAST_PRESENCE
            and not is_unlabelled(label)
            and take.subject(label) == subject
        ]
        spread = distance_spread(take.positions, marker, others)
        nearest = np.argsort(spread, kind="stable")[: LEAST_NEIGHBOURS - len(chosen)]
        chosen += [others[i] for i in nearest]
    if not chosen:
        raise DataError(
            f"Marker “{take.labels[marker]}” cannot be predicted: no other marker of its body "
            "is seen in half of the frames."
        )
    return tuple(chosen)


def distance_spread(positions: FloatArray, marker: int, others: list[int]) -> FloatArray:
    """How much distances to other markers vary: median absolute deviation on every 4th frame.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN = missing
    marker, others : columns

    Returns
    -------
    (others,) mm; infinite where two are never seen together
    """
    every = positions[::4]
    distance = np.linalg.norm(every[:, others] - every[:, [marker]], axis=2)
    together = ~np.isnan(distance)
    spread = np.full(len(others), np.inf)
    for i in np.flatnonzero(together.any(axis=0)):
        d = distance[together[:, i], i]
        spread[i] = np.median(np.abs(d - np.median(d)))
    return spread


def gather(
    positions: FloatArray, trusted: BoolArray, marker: int, neighbours: tuple[int, ...]
) -> Inputs:
    """Collect a marker and its neighbours, untrusted samples bridged.

    Parameters
    ----------
    positions : (frames, markers, 3) mm; NaN where missing
    trusted : (frames, markers, 3) bool, false at least where missing
    marker : column of the marker to predict
    neighbours : columns it is predicted from
    """
    frames = len(positions)
    chosen = [marker, *neighbours]
    known = trusted[:, chosen].reshape(frames, -1)
    filled = bridge(positions[:, chosen].reshape(frames, -1), known).reshape(frames, -1, 3)
    share = trusted[:, list(neighbours)].all(axis=2).mean(axis=1)
    usable = share >= 0.5
    return Inputs(filled[:, 1:], filled[:, 0], trusted[:, marker].all(axis=1) & usable, usable)


def trusted_samples(take: Take, trusted: BoolArray | None) -> BoolArray:
    """Trust given by the caller, and never where a marker is missing."""
    present = np.repeat(take.present[:, :, None], 3, axis=2)
    return present if trusted is None else trusted & present


def lagged_powers(
    regressors: FloatArray, lags: int, powers: int, *, floor: float = 0.0
) -> FloatArray:
    """Rows of current and former values, each raised to powers (skurowski2022, eq. 9).

    Parameters
    ----------
    regressors : (frames, n) without NaN
    lags : number of former frames; before the first frame its value is held
    powers : highest power
    floor : see :func:`standardised`

    Returns
    -------
    (frames, n × (lags + 1) × powers), standardised, as is each regressor before it is raised
    """
    scaled = standardised(regressors, floor)
    frames = np.arange(len(scaled))
    former = np.concatenate([scaled[np.maximum(frames - k, 0)] for k in range(lags + 1)], axis=1)
    raised = np.concatenate([former**p for p in range(1, powers + 1)], axis=1)
    return standardised(raised, floor)


def standardised(columns: FloatArray, floor: float = 0.0) -> FloatArray:
    """Centre columns and scale them to standard deviation 1; constant ones become 0.

    With a ``floor``, no column is divided by less than that share of the largest standard
    deviation, so that one which hardly moves is not blown up to be noise of full size.
    """
    spread = columns.std(axis=0)
    spread = np.maximum(spread, floor * spread.max(initial=0.0))
    centred = columns - columns.mean(axis=0)
    return np.asarray(centred / np.where(spread > 1e-9, spread, np.inf))
