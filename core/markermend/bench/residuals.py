"""Residuals of predictors, and how markers move together: what skurowski2022 looks at first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray, IntArray
from markermend.mesh import Mesh
from markermend.take import AXES, Take

EDGES = np.linspace(-6.125, 6.125, 50)
"""Bins of the histogram, in standard deviations; what lies outside counts in the last ones."""
RELATIONS = ("same group", "parent and child", "other groups")
STRONG = 0.9


@dataclass(frozen=True, eq=False)
class Shape:
    """How the residuals of some coordinates are distributed; means over these coordinates.

    Attributes
    ----------
    coordinates : how many
    sigma_mm : standard deviation about zero
    b_mm : of the Laplace distribution, σ / √2 as in (5)
    b_likely_mm : of the Laplace distribution by maximum likelihood, the mean of the residual's
        absolute value
    normal, laplace, laplace_likely : logarithm of the likelihood of a sample, under the normal
        distribution and under the Laplace distribution with either b
    laplace_share : share of the coordinates that are likelier under Laplace with b of (5)
    counts : (bins,) samples by residual in standard deviations, see :data:`EDGES`
    """

    coordinates: int
    sigma_mm: float
    b_mm: float
    b_likely_mm: float
    normal: float
    laplace: float
    laplace_likely: float
    laplace_share: float
    counts: IntArray


def shape_of(residuals: FloatArray) -> Shape:
    """Fit normal and Laplace distribution to residuals, each coordinate by itself.

    Parameters
    ----------
    residuals : (frames, coordinates) float64, mm; NaN = not predicted

    Returns
    -------
    Shape; coordinates without any residual other than 0 are passed over, and without any left
    the figures are NaN

    Notes
    -----
    skurowski2022, equation 5, with μ = 0.
    """
    rows, counts = [], np.zeros(len(EDGES) - 1, dtype=np.int64)
    for column in residuals.T:
        r = column[~np.isnan(column)]
        sigma = float(np.sqrt(np.mean(r**2))) if len(r) else 0.0
        if sigma <= 0.0:
            continue
        size, b = float(np.abs(r).mean()), sigma / np.sqrt(2.0)
        normal = -0.5 * np.log(2.0 * np.pi * sigma**2) - 0.5
        laplace = -np.log(2.0 * b) - size / b
        likely = -np.log(2.0 * size) - 1.0
        rows.append((sigma, b, size, normal, laplace, likely, float(laplace > normal)))
        counts += np.histogram(np.clip(r / sigma, EDGES[0], EDGES[-1]), EDGES)[0]
    means = np.mean(rows, axis=0) if rows else np.full(7, np.nan)
    sigma, b, size, normal, laplace, likely, wins = (float(v) for v in means)
    return Shape(len(rows), sigma, b, size, normal, laplace, likely, wins, counts)


def densities() -> tuple[FloatArray, FloatArray]:
    """Share of samples in each bin under the normal and under the Laplace distribution.

    Returns
    -------
    two (bins,) float64, for standard deviation 1; the tails count in the last bins
    """
    from scipy.stats import laplace, norm

    shares = []
    for cumulative in (norm.cdf(EDGES), laplace.cdf(EDGES, scale=1.0 / np.sqrt(2.0))):
        cumulative[0], cumulative[-1] = 0.0, 1.0
        shares.append(np.diff(cumulative))
    return np.asarray(shares[0]), np.asarray(shares[1])


@dataclass(frozen=True)
class CorrelationRow:
    """How strongly coordinates of two markers are correlated.

    Attributes
    ----------
    take : name
    quantity : position or velocity along one axis
    relation : of the two markers' groups, one of :data:`RELATIONS`
    pairs : how many
    mean : of the absolute value of the correlation coefficient
    strong : share of the pairs with 0.9 or more
    """

    take: str
    quantity: str
    relation: str
    pairs: int
    mean: float
    strong: float


def correlations(name: str, take: Take, mesh: Mesh) -> tuple[CorrelationRow, ...]:
    """Summarise the correlation matrices by how the mesh relates the markers.

    Parameters
    ----------
    name : of the take
    take : the recording
    mesh : the body's structure; markers without a group are left out

    Returns
    -------
    A row for position and velocity along each axis and every relation that occurs

    Notes
    -----
    skurowski2022, section 3.1 and Figure 3, which shows the matrix of X positions.
    """
    columns = grouped(mesh)
    group = np.array([g for g, found in enumerate(mesh.groups) for _ in found.markers])
    parent = np.array([-1 if found.parent is None else found.parent for found in mesh.groups])
    first, second = np.triu_indices(len(columns), 1)
    a, b = group[first], group[second]
    relation = np.where(a == b, 0, np.where((parent[a] == b) | (parent[b] == a), 1, 2))
    rows = []
    for what, values in (
        ("position", take.positions),
        ("velocity", np.diff(take.positions, axis=0)),
    ):
        for axis, letter in enumerate(AXES):
            size = np.abs(correlation_matrix(values[:, columns, axis]))[first, second]
            for k, between in enumerate(RELATIONS):
                r = size[(relation == k) & ~np.isnan(size)]
                if len(r):
                    strong = float((r >= STRONG).mean())
                    row = (name, f"{what} {letter}", between, len(r), float(r.mean()), strong)
                    rows.append(CorrelationRow(*row))
    return tuple(rows)


def grouped(mesh: Mesh) -> IntArray:
    """Columns of the markers that belong to a group, group by group, (n,) int64."""
    return np.array([m for group in mesh.groups for m in group.markers], dtype=np.int64)


@dataclass(frozen=True, eq=False)
class CorrelationMatrix:
    """Correlation of the X positions of a take's markers, group by group (Figure 3a).

    Attributes
    ----------
    take : name
    labels : of the markers, n of them
    values : (n, n) float64 in [-1, 1]; NaN where there is none
    """

    take: str
    labels: tuple[str, ...]
    values: FloatArray


def matrix_of(name: str, take: Take, mesh: Mesh) -> CorrelationMatrix:
    """Correlate the X positions of all markers of a take that belong to a group."""
    columns = grouped(mesh)
    labels = tuple(take.labels[c] for c in columns)
    return CorrelationMatrix(name, labels, correlation_matrix(take.positions[:, columns, 0]))


def correlation_matrix(signals: FloatArray) -> FloatArray:
    """Correlation coefficients of signals with gaps, each pair over the frames both are seen.

    Parameters
    ----------
    signals : (frames, n) float64; NaN = missing

    Returns
    -------
    (n, n) float64 in [-1, 1]; NaN where two are never seen together or one does not move
    """
    seen = ~np.isnan(signals)
    count = seen.sum(axis=0)
    mean = np.where(seen, signals, 0.0).sum(axis=0) / np.maximum(count, 1)
    x, m = np.where(seen, signals - mean, 0.0), seen.astype(np.float64)
    n = np.maximum(m.T @ m, 1.0)
    centre = (x.T @ m) / n
    spread = (x**2).T @ m / n - centre**2
    shared = x.T @ x / n - centre * centre.T
    scale = np.sqrt(np.maximum(spread * spread.T, 0.0))
    moving = scale > 1e-12
    result = np.where(moving, shared / np.where(moving, scale, 1.0), np.nan)
    return np.asarray(np.clip(result, -1.0, 1.0))
