"""Artifacts counted as events: found or missed, false alarms, and how far confidence holds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, ByteArray, FloatArray, IntArray
from markermend.artifact import Artifact, Kind, axis_columns
from markermend.bench.confusion import CLASSES
from markermend.take import Take

HALF = 0.5
DECILES = 10


@dataclass(frozen=True, eq=False)
class Events:
    """Counts of artifacts over simulations.

    Attributes
    ----------
    drawn : (5,) int64 true artifacts by class, in the order of :data:`CLASSES`
    found : (5,) int64 of them, half covered by flags of their class
    flagged : (5,) int64 of them, half covered by flags of any class
    flags : (5,) int64 flags by class
    alarms : (5,) int64 of them, those that touch no damage at all
    minutes : of recording looked at
    confidence : (10,) sum of the confidence of flags by decile of confidence
    count, real : (10,) int64 flags by decile, and those of which half is damage
    """

    drawn: IntArray
    found: IntArray
    flagged: IntArray
    flags: IntArray
    alarms: IntArray
    minutes: float
    confidence: FloatArray
    count: IntArray
    real: IntArray

    def __add__(self, other: Events) -> Events:
        return Events(
            self.drawn + other.drawn,
            self.found + other.found,
            self.flagged + other.flagged,
            self.flags + other.flags,
            self.alarms + other.alarms,
            self.minutes + other.minutes,
            self.confidence + other.confidence,
            self.count + other.count,
            self.real + other.real,
        )

    def recall(self, kind: str) -> float:
        """Share of a class's artifacts found as that class; NaN without any."""
        k = CLASSES.index(kind)
        return float(self.found[k] / self.drawn[k]) if self.drawn[k] else math.nan

    @property
    def alarms_per_minute(self) -> float:
        """False alarms of all classes per minute of recording; NaN without a recording."""
        return float(self.alarms.sum() / self.minutes) if self.minutes else math.nan

    @property
    def calibration_error(self) -> float:
        """Mean distance of confidence from the share of real flags, over all flags."""
        total = self.count.sum()
        if not total:
            return math.nan
        return float(np.abs(self.confidence - self.real).sum() / total)


def count_events(
    take: Take,
    truth: Sequence[Artifact],
    found: Sequence[Artifact],
    found_map: ByteArray,
    damaged: BoolArray,
    ignored: BoolArray,
) -> Events:
    """Compare artifacts with the truth.

    Parameters
    ----------
    take : the recording
    truth : artifacts to be found; others that are damage but do not count are left out here
    found : flags; gaps are passed over
    found_map : (frames, markers, 3) uint8, the flags' class by sample
    damaged : (frames, markers, 3) bool, all samples known to be damaged, counted or not
    ignored : (frames, markers, 3) bool, samples left out of the measurement; a flag of which
        half lies there is neither right nor wrong
    """
    drawn, hit, flagged, flags, alarms = (np.zeros(len(CLASSES), dtype=np.int64) for _ in range(5))
    for a in truth:
        code = CLASSES.index(a.kind.value)
        codes = _samples(take, a, found_map)
        drawn[code] += 1
        hit[code] += (codes == code).mean() >= HALF
        flagged[code] += (codes > 0).mean() >= HALF
    confidence = np.zeros(DECILES)
    count, real = (np.zeros(DECILES, dtype=np.int64) for _ in range(2))
    for a in found:
        if a.kind is Kind.GAP or _samples(take, a, ignored).mean() >= HALF:
            continue
        code = CLASSES.index(a.kind.value)
        share = _samples(take, a, damaged).mean()
        flags[code] += 1
        alarms[code] += share == 0
        decile = min(int(a.confidence * DECILES), DECILES - 1)
        confidence[decile] += a.confidence
        count[decile] += 1
        real[decile] += share >= HALF
    minutes = take.duration_s / 60
    return Events(drawn, hit, flagged, flags, alarms, minutes, confidence, count, real)


def no_events() -> Events:
    """Return counts of nothing."""
    zero = np.zeros(len(CLASSES), dtype=np.int64)
    none = np.zeros(DECILES, dtype=np.int64)
    return Events(zero, zero, zero, zero, zero, 0.0, np.zeros(DECILES), none, none)


def _samples(take: Take, a: Artifact, values: BoolArray | ByteArray) -> BoolArray | ByteArray:
    """What an array holds on the samples of an artifact, (frames, axes)."""
    return values[a.start : a.stop, take.index(a.marker)][:, axis_columns(a.axes)]
