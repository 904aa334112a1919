"""How many slow changes could be found on a take at all: the ceiling of every detector."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from joblib import Parallel, delayed
from threadpoolctl import threadpool_limits

from markermend.arrays import FloatArray
from markermend.bench.columns import aligned
from markermend.bench.e1 import Clean
from markermend.detectors.joint.bank import KINDS, LONGEST, SHORTEST
from markermend.detectors.joint.measures import stack
from markermend.detectors.joint.slow import Ground, prepare
from markermend.detectors.joint.views import BODY, look, see
from markermend.predictors.cross_fit import distance_spreads
from markermend.take import is_unlabelled

CLEAR = 5.0
MEAN_LENGTH, PLACES = 50, 20
AMPLITUDES_MM = (5.0, 10.0, 20.0)


@dataclass(frozen=True)
class Ceiling:
    """Share of slow changes that stand out clearly, were place and length known.

    Attributes
    ----------
    take : name
    kind : of the slow change's shape
    shares : in [0, 1] for each of :data:`AMPLITUDES_MM`
    """

    take: str
    kind: str
    shares: tuple[float, ...]


def slow_ceiling(clean: Clean, *, seed: int = 0, jobs: int = 1) -> list[Ceiling]:
    """Work out the ceiling of one take.

    Parameters
    ----------
    clean : recording with what is damaged in it already
    seed : of places, lengths (Poisson, 50 frames) and amplitudes (|N(μ, 0.4 μ)|)
    jobs : processes

    Returns
    -------
    One for each shape: the share of drifts whose signal-to-noise ratio under the fitted noise is
    above 5; empty where the body says too little
    """
    take = clean.take
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    ground = prepare(take, markers, clean.flaws)
    with threadpool_limits(1):
        spreads = distance_spreads(ground.positions, ground.trusted)
        seeds = np.random.SeedSequence(seed).spawn(len(markers))
        parts = Parallel(n_jobs=jobs)(
            delayed(_clearness)(ground, m, spreads, s) for m, s in enumerate(seeds)
        )
    clear = np.concatenate([p for p in parts if p is not None] or [np.zeros((0, len(KINDS)))])
    if not len(clear):
        return []
    drawn = np.abs(np.random.default_rng(seed).normal(1.0, 0.4, len(clear)))[:, None]
    return [
        Ceiling(
            clean.name,
            kind,
            tuple(float((mm * drawn[:, 0] * clear[:, k] > CLEAR).mean()) for mm in AMPLITUDES_MM),
        )
        for k, kind in enumerate(KINDS)
    ]


def _clearness(
    ground: Ground, marker: int, spreads: FloatArray, seed: np.random.SeedSequence
) -> FloatArray | None:
    """Signal to noise of a drift of 1 mm at some places of a marker, (places, kinds)."""
    known = ground.known[:, marker]
    views = look(ground.positions, marker, known, ground.trusted, spreads)
    if views is None:
        return None
    rng = np.random.default_rng(seed)
    length = np.clip(rng.poisson(MEAN_LENGTH, 3 * PLACES), SHORTEST, LONGEST)
    start = rng.integers(0, len(known) - LONGEST, 3 * PLACES)
    axis = np.repeat(np.arange(3), PLACES)
    powers = [
        see(views, BODY, axis, start, stack(np.repeat(kind, len(length)), length)).power.sum(axis=1)
        for kind in KINDS
    ]
    return np.asarray(np.sqrt(np.stack(powers, axis=1)))


def ceiling_table(ceilings: Sequence[Ceiling]) -> list[str]:
    """Lines of text, in percent."""
    if not ceilings:
        return []
    head = ("ceiling of slow changes", "shape", *(f"{mm:g} mm" for mm in AMPLITUDES_MM))
    rows = [(c.take, c.kind, *(f"{100 * s:.0f}" for s in c.shares)) for c in ceilings]
    return aligned([head, *rows])
