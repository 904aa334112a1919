"""Confusion matrices by sample, and the measures skurowski2022 reads from them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, ByteArray, IntArray
from markermend.artifact import Artifact, Kind, Status, axis_columns
from markermend.take import Take

CLASSES = ("clear", Kind.PEAK.value, Kind.NOISE.value, Kind.STEP.value, Kind.SLOW.value)
OUTLIER = len(CLASSES)
"""Code of a sample flagged by a detector that names no class."""
FOUND = (*CLASSES, "outlier")


@dataclass(frozen=True, eq=False)
class Confusion:
    """How many samples of each true class were found to be of which class.

    Attributes
    ----------
    counts : (5, 6) int64; rows are the true classes in the order of :data:`CLASSES`, columns
        the found ones with “outlier” last, for detectors that name no class
    """

    counts: IntArray

    def __add__(self, other: Confusion) -> Confusion:
        return Confusion(self.counts + other.counts)

    def _cells(self, kind: str) -> tuple[int, int, int, int]:
        """True positives, false positives, false negatives and true negatives of one class."""
        k = CLASSES.index(kind)
        tp = int(self.counts[k, k])
        fp, fn = int(self.counts[:, k].sum()) - tp, int(self.counts[k].sum()) - tp
        return tp, fp, fn, int(self.counts.sum()) - tp - fp - fn

    def tpr(self, kind: str) -> float:
        """Sensitivity (skurowski2022, eq. 32); NaN without samples of the class."""
        tp, _, fn, _ = self._cells(kind)
        return _share(tp, tp + fn)

    def fnr(self, kind: str) -> float:
        """Miss rate (eq. 33); NaN without samples of the class."""
        tp, _, fn, _ = self._cells(kind)
        return _share(fn, tp + fn)

    def fdr(self, kind: str) -> float:
        """False discovery rate, 1 − PPV: what eq. 34 defines and calls fall-out."""
        tp, fp, _, _ = self._cells(kind)
        return _share(fp, tp + fp)

    def ppv(self, kind: str) -> float:
        """Precision (eq. 35); NaN when the class was never found."""
        tp, fp, _, _ = self._cells(kind)
        return _share(tp, tp + fp)

    def f(self, kind: str | None = None) -> float:
        """F-score (eq. 36) of one class, or of all together, the clear signal included."""
        if kind is None:
            total = int(self.counts.sum())
            tp = int(np.trace(self.counts))
            return _share(tp, total)
        tp, fp, fn, _ = self._cells(kind)
        return _share(tp, tp + 0.5 * (fp + fn))

    def mcc(self, kind: str | None = None) -> float:
        """Matthews correlation (eq. 37) of one class, or of all (its multiclass form, R_K)."""
        if kind is not None:
            tp, fp, fn, tn = self._cells(kind)
            spread = math.sqrt((tp + fp) * (tp + fn) * (tn + fp) * (tn + fn))
            return _share(tp * tn - fp * fn, spread)
        c = self.counts.astype(np.float64)
        total, right = c.sum(), float(np.trace(c))
        true, found = c.sum(axis=1), c.sum(axis=0)
        spread = math.sqrt((total**2 - (found**2).sum()) * (total**2 - (true**2).sum()))
        shared = float((true * found[: len(true)]).sum())
        return _share(right * total - shared, spread)

    def flagged(self, kind: str) -> float:
        """Share of a class's samples found to be damaged in any way; NaN without samples."""
        row = self.counts[CLASSES.index(kind)]
        return _share(int(row[1:].sum()), int(row.sum()))


def class_map(take: Take, artifacts: Iterable[Artifact]) -> ByteArray:
    """Paint artifacts onto the samples they cover.

    Parameters
    ----------
    take : the recording the artifacts belong to
    artifacts : gaps and rejected ones are passed over; a swap covers its counterparts too; where
        two overlap, the more confident one counts

    Returns
    -------
    (frames, markers, 3) uint8, index into :data:`CLASSES`
    """
    codes = np.zeros(take.positions.shape, dtype=np.uint8)
    for a in sorted(artifacts, key=lambda a: a.confidence):
        if a.kind is Kind.GAP or a.status is Status.REJECTED:
            continue
        for label in a.markers:
            marker = take.index(label)
            for axis in axis_columns(a.axes):
                codes[a.start : a.stop, marker, axis] = CLASSES.index(a.kind.value)
    return codes


def confuse(true: ByteArray, found: ByteArray, counted: BoolArray) -> Confusion:
    """Count samples.

    Parameters
    ----------
    true, found : (...) uint8 class codes, see :func:`class_map`
    counted : (...) bool; the other samples are left out
    """
    width = len(FOUND)
    codes = true[counted].astype(np.int64) * width + found[counted]
    counts = np.bincount(codes, minlength=len(CLASSES) * width)
    return Confusion(counts.reshape(len(CLASSES), width).astype(np.int64))


def nothing() -> Confusion:
    """Return a matrix without samples."""
    return Confusion(np.zeros((len(CLASSES), len(FOUND)), dtype=np.int64))


def _share(part: float, whole: float) -> float:
    """Quotient; NaN where there is nothing to divide by."""
    return part / whole if whole else math.nan
