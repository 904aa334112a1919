"""What a take is like, and which of it goes with the errors of filling (skurowski2021, 3.3, 4.2).

The paper does not say what bins its entropy has. Bins of 20 mm for every coordinate give the sizes
that it prints, and let a marker that moves further have more.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, fields

import numpy as np
from scipy.stats import pearsonr, rankdata

from markermend.arrays import FloatArray
from markermend.bench.gap_measures import GapMeasures
from markermend.errors import DataError
from markermend.take import Take

BIN_MM = 20.0
EIGENPOSES = 5


@dataclass(frozen=True)
class Characteristics:
    """Characteristics of a take (Table 2).

    Attributes
    ----------
    entropy : bits a marker, the sum over its three coordinates
    stddev : mm a coordinate
    velocity, acceleration, jerk : mean length, m/s, m/s², m/s³ a marker
    monotonicity : mean |Spearman's correlation| of a coordinate with time (13)
    complexity : share of variance beyond the first five principal components (14)
    """

    entropy: float
    stddev: float
    velocity: float
    acceleration: float
    jerk: float
    monotonicity: float
    complexity: float


MEASURES = tuple(f.name for f in fields(Characteristics))


def describe(take: Take) -> Characteristics:
    """Measure a take.

    Parameters
    ----------
    take : the recording; each marker is measured where it is seen, the complexity in frames in
        which all are

    Raises
    ------
    DataError
        when no marker is seen in four frames running, or all are in fewer than two

    Notes
    -----
    skurowski2021, Table 2, eq. 13 and 14. Printed without its modulus, (13) would let rise and fall
    cancel each other, which the printed values do not.
    """
    whole = take.positions[take.present.all(axis=1)].reshape(-1, 3 * take.markers)
    if len(whole) < 2:
        raise DataError("Fewer than two frames show all markers, so that poses cannot be compared.")
    velocity, acceleration, jerk = (_mean_length(take, order) for order in (1, 2, 3))
    if not np.isfinite(jerk):
        raise DataError("No marker is seen long enough to tell how it moves.")
    seen = [take.positions[take.present[:, m], m] for m in range(take.markers)]
    tracks = [track for track in seen if len(track) > 1]
    columns = [column for track in tracks for column in track.T]
    variances = np.linalg.svd(whole - whole.mean(axis=0), compute_uv=False) ** 2
    total = float(variances.sum())
    return Characteristics(
        float(np.mean([sum(map(entropy, track.T)) for track in tracks])),
        float(np.mean([column.std(ddof=1) for column in columns])),
        velocity,
        acceleration,
        jerk,
        float(np.mean([_monotonicity(column) for column in columns])),
        1.0 - float(variances[:EIGENPOSES].sum()) / total if total > 0 else 0.0,
    )


def entropy(values: FloatArray, width: float = BIN_MM) -> float:
    """Shannon's entropy of a coordinate in bits, from a histogram.

    Parameters
    ----------
    values : (n,) mm, none missing
    width : of the bins, mm
    """
    _, counts = np.unique(np.floor(values / width), return_counts=True)
    shares = counts / len(values)
    return float(-(shares * np.log2(shares)).sum())


def _mean_length(take: Take, order: int) -> float:
    """Mean length of a derivative over all markers, m/sⁿ; NaN where none is seen long enough."""
    derived = np.diff(take.positions, n=order, axis=0) * take.rate**order / 1000.0
    lengths = np.linalg.norm(derived, axis=2)
    known = [column[~np.isnan(column)] for column in lengths.T]
    return float(np.mean([k.mean() for k in known if len(k)])) if any(map(len, known)) else np.nan


def _monotonicity(values: FloatArray) -> float:
    """|Spearman's correlation| with time; 0 for what does not move."""
    if np.ptp(values) == 0:
        return 0.0
    return abs(float(np.corrcoef(rankdata(values), np.arange(len(values)))[0, 1]))


@dataclass(frozen=True)
class Correlation:
    """How one thing goes with another over several takes.

    Attributes
    ----------
    first, second : names
    length : of the gaps in frames; 0 where it is no error
    r, p : Pearson's coefficient and its two-sided p-value; NaN where one of the two is constant
    """

    first: str
    second: str
    length: int
    r: float
    p: float


def correlate(
    measures: Sequence[GapMeasures], known: Mapping[str, Characteristics]
) -> tuple[Correlation, ...]:
    """Correlate errors with characteristics, take by take (Tables A6 to A12).

    Parameters
    ----------
    measures : of one protocol, each take for itself
    known : characteristics by name of the take

    Returns
    -------
    One for each method, characteristic and length

    Raises
    ------
    DataError
        when there are fewer than three takes, or no errors
    """
    _enough(known)
    if not measures:
        raise DataError("No gaps of the protocol skurowski2021 were filled, to correlate with.")
    made = []
    for method, length in sorted({(m.method, m.length) for m in measures}):
        some = [m for m in measures if (m.method, m.length) == (method, length)]
        errors = [m.rmse_mm for m in some]
        for name in MEASURES:
            values = [float(getattr(known[m.take], name)) for m in some]
            made.append(Correlation(method, name, length, *_pearson(errors, values)))
    return tuple(made)


def correlate_measures(known: Mapping[str, Characteristics]) -> tuple[Correlation, ...]:
    """Correlate characteristics with one another (Table 6), each pair once.

    Raises
    ------
    DataError
        when there are fewer than three takes
    """
    _enough(known)
    columns = dict(zip(MEASURES, np.array([astuple(k) for k in known.values()]).T, strict=True))
    return tuple(
        Correlation(a, b, 0, *_pearson(columns[a], columns[b]))
        for i, a in enumerate(MEASURES)
        for b in MEASURES[i + 1 :]
    )


def _enough(known: Mapping[str, Characteristics]) -> None:
    """Two points always lie on a line."""
    if len(known) < 3:
        raise DataError(f"Correlations need three takes or more, not {len(known)}.")


def _pearson(
    first: Sequence[float] | FloatArray, second: Sequence[float] | FloatArray
) -> tuple[float, float]:
    """Coefficient and p-value; NaN where there is too little or nothing varies."""
    if len(first) < 3 or np.ptp(first) == 0 or np.ptp(second) == 0:
        return float("nan"), float("nan")
    found = pearsonr(first, second)
    return float(found.statistic), float(found.pvalue)
