"""Learn the confidence of sudden artifacts from contaminated takes, seeded."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact, Kind, damage_mask
from markermend.detectors.channels import channels
from markermend.detectors.joint.confidence import FEATURES, Curve, features
from markermend.detectors.joint.neighbours import nearest_markers
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.sudden import Sudden, find_sudden
from markermend.errors import DataError
from markermend.progress import Progress, quiet
from markermend.simulation import contaminate, simulate_clean
from markermend.take import Take, is_unlabelled

AMPLITUDES_MM = (2.0, 5.0, 10.0, 30.0)
SHARE = 0.03
RARER = 10.0
"""Training has several artifacts a second, so that all sorts are seen; takes as they come have
far fewer. Odds are divided by this."""
LEAST_MM = JointParams().least_mm
"""Smaller ones are left out, as they are when takes are looked at."""
PENALTY = 1 / 3
"""Half the squared weights count as this much loss (the inverse of scikit-learn's C). With a third
of it a step was flagged that was none in a take that was left out."""
LONGEST_PEAK_S = 0.05
KINDS = (Kind.PEAK, Kind.NOISE, Kind.STEP)
RATES_HZ = (60.0, 100.0, 120.0, 200.0, 240.0)


@dataclass(frozen=True, eq=False)
class Examples:
    """Flags of one class on contaminated copies of one take.

    Attributes
    ----------
    measured : (n, features) see :func:`markermend.detectors.joint.confidence.features`
    real : (n,) bool, at least half of the flag is damage
    """

    measured: FloatArray
    real: BoolArray


def performers(count: int, seed: int) -> list[Take]:
    """Simulate undamaged performers of all sizes, recorded at 60 to 240 Hz for 20 s each.

    Parameters
    ----------
    count : how many
    seed : same seed, same performers
    """
    return [
        simulate_clean(
            duration_s=20.0,
            rate=RATES_HZ[i % len(RATES_HZ)],
            height_m=1.1 + 0.17 * (i % 6),
            seed=seed + i,
        )
        for i in range(count)
    ]


def collect(
    takes: Sequence[tuple[Take, Sequence[Artifact]]],
    *,
    rounds: int = 10,
    seed: int = 0,
    progress: Progress | None = None,
) -> list[dict[Kind, Examples]]:
    """Contaminate takes and find out which flags are real.

    Parameters
    ----------
    takes : clean recordings, each with what is damaged in it already; that is left out
    rounds : contaminations of each take and amplitude (2 to 30 mm)
    seed : same takes and seed, same examples
    progress : told the share done; may raise ``Cancelled``

    Returns
    -------
    Examples by class, for each take
    """
    report = progress or quiet
    collected = []
    with threadpool_limits(1):
        for i, (take, flaws) in enumerate(takes):
            report(i / len(takes), "contaminating")
            parts = _examples(take, flaws, rounds, seed + 1000 * i)
            found = [s for some, _ in parts for s in some]
            measured, real = features(found), np.concatenate([hit for _, hit in parts])
            kinds = np.array([s.kind.value for s in found])
            collected.append(
                {k: Examples(measured[kinds == k.value], real[kinds == k.value]) for k in KINDS}
            )
    return collected


def fit_curves(takes: Sequence[Mapping[Kind, Examples]]) -> dict[Kind, Curve]:
    """Fit one curve a class to the examples of several takes.

    Raises
    ------
    DataError
        when no false flag, or no real one, of a class turned up to learn from
    """
    return {
        kind: fit_curve(
            np.concatenate([take[kind].measured for take in takes]),
            np.concatenate([take[kind].real for take in takes]),
        )
        for kind in KINDS
    }


def fit_curve(measured: FloatArray, real: BoolArray) -> Curve:
    """Fit a logistic curve.

    Parameters
    ----------
    measured : (n, features)
    real : (n,) bool

    Raises
    ------
    DataError
        when all flags are real or none is
    """
    from sklearn.linear_model import LogisticRegression

    if real.all() or not real.any():
        raise DataError("Real and false flags are both needed to learn confidence from.")
    model: Any = LogisticRegression(C=1 / PENALTY, max_iter=1000).fit(measured, real)
    bias = float(model.intercept_[0]) - math.log(RARER)
    return Curve(bias, tuple(float(w) for w in model.coef_[0]))


def as_json(curves: dict[Kind, Curve]) -> dict[str, Any]:
    """Turn curves into what ``models/sudden.json`` holds."""
    return {
        "features": list(FEATURES),
        "curves": {
            kind.value: {
                "bias": round(curve.bias, 4),
                "weights": [round(w, 4) for w in curve.weights],
            }
            for kind, curve in curves.items()
        },
    }


def _examples(
    take: Take, flaws: Sequence[Artifact], rounds: int, seed: int
) -> list[tuple[list[Sudden], BoolArray]]:
    """Flags on contaminated copies of a take, and which of them are real."""
    labels = [label for label in take.labels if not is_unlabelled(label)]
    markers = [take.index(label) for label in labels]
    known = damage_mask(take, flaws)[:, markers].reshape(take.frames, -1)
    neighbours = nearest_markers(take, markers)
    examples = []
    for number in range(rounds):
        for k, amplitude in enumerate(AMPLITUDES_MM):
            damaged, truth = contaminate(
                take,
                share=SHARE,
                amplitude_mm=amplitude,
                markers=labels,
                seed=seed + number * len(AMPLITUDES_MM) + k,
            )
            signal, seen = channels(damaged, markers)
            peak = max(1, round(LONGEST_PEAK_S * take.rate))
            found = [
                s
                for s in find_sudden(signal, seen, neighbours, take.rate, peak)
                if s.size_mm >= LEAST_MM
            ]
            hurt = damage_mask(damaged, truth)[:, markers].reshape(take.frames, -1)
            ours = [s for s in found if not known[s.start : s.stop, s.channel].any()]
            hit = [hurt[s.start : s.stop, s.channel].mean() >= 0.5 for s in ours]
            examples.append((ours, np.array(hit, dtype=bool)))
    return examples
