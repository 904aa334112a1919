"""What a stage finds on one coordinate, and how such findings become artifacts.

Confidence here grows with the ratio r of a stage's statistic to its threshold as r² / (1 + r²):
one half at the threshold, 0.8 at twice, 0.9 at three times. It orders findings of one kind
truly, but it is not calibrated: how many of those at 0.8 are real depends on the take. Slow
changes are believed three tenths of that, never up to one half, because one or two in ten of
those published were real: repairs that ask for a confidence of one half leave them alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from markermend.arrays import BoolArray
from markermend.artifact import Artifact, Kind
from markermend.take import AXES, Take

# Findings on two axes are one artifact when they share this much of their union.
SAME_OVERLAP = 0.3
SLOW_BELIEF = 0.3


@dataclass(frozen=True)
class Finding:
    """A damaged interval of one coordinate.

    Attributes
    ----------
    channel : 3 × marker + axis
    start, stop : half-open interval of frames
    kind : class of the artifact
    ratio : the stage's statistic over its threshold, at least 1
    amplitude_mm : size of the deviation on this axis
    """

    channel: int
    start: int
    stop: int
    kind: Kind
    ratio: float
    amplitude_mm: float


def mask_of(findings: Iterable[Finding], shape: tuple[int, int]) -> BoolArray:
    """(frames, channels) bool: samples that findings cover."""
    mask = np.zeros(shape, dtype=bool)
    for f in findings:
        mask[f.start : f.stop, f.channel] = True
    return mask


def confidence(ratio: float, kind: Kind) -> float:
    """Share of belief for a statistic ``ratio`` times its threshold.

    One half at the threshold; less for slow changes, 0.15 there and never above 0.3.
    """
    belief = ratio**2 / (1 + ratio**2)
    return SLOW_BELIEF * belief if kind is Kind.SLOW else belief


def overlap(a: tuple[int, int], b: tuple[int, int]) -> float:
    """Intersection over union of two half-open intervals."""
    shared = min(a[1], b[1]) - max(a[0], b[0])
    return max(shared, 0) / (max(a[1], b[1]) - min(a[0], b[0]))


def to_artifacts(take: Take, findings: Iterable[Finding]) -> list[Artifact]:
    """Join findings of one kind on the axes of one marker, and put each into words.

    Parameters
    ----------
    take : the recording, for labels and rate
    findings : in any order

    Returns
    -------
    One artifact for each group of overlapping findings (three tenths of their union): it
    spans them all, names their axes, has the confidence of the strongest and the amplitude
    of all axes together (root of summed squares).
    """

    def marker_and_kind(f: Finding) -> tuple[int, str]:
        return f.channel // 3, f.kind

    ordered = sorted(findings, key=lambda f: (*marker_and_kind(f), f.start, f.stop, f.channel))
    artifacts = []
    for (marker, _), same in groupby(ordered, key=marker_and_kind):
        for group in _join(list(same)):
            artifacts.append(_artifact(take, marker, group))
    return artifacts


def _join(findings: list[Finding]) -> list[list[Finding]]:
    """Group findings of one marker and kind across axes; sorted by start."""
    groups: list[list[Finding]] = []
    for f in findings:
        for group in groups:
            axis_free = all(f.channel != g.channel for g in group)
            if axis_free and overlap(_span(group), (f.start, f.stop)) >= SAME_OVERLAP:
                group.append(f)
                break
        else:
            groups.append([f])
    return groups


def _span(group: Sequence[Finding]) -> tuple[int, int]:
    """Smallest interval that holds all findings."""
    return min(f.start for f in group), max(f.stop for f in group)


def _artifact(take: Take, marker: int, group: list[Finding]) -> Artifact:
    """One artifact for findings on different axes of one marker."""
    start, stop = _span(group)
    kind = group[0].kind
    amplitude = float(np.sqrt(sum(f.amplitude_mm**2 for f in group)))
    return Artifact(
        marker=take.labels[marker],
        axes="".join(AXES[axis] for axis in sorted(f.channel % 3 for f in group)),
        start=start,
        stop=stop,
        kind=kind,
        confidence=confidence(max(f.ratio for f in group), kind),
        amplitude_mm=amplitude,
        why=_explain(kind, amplitude, stop - start, take.rate),
    )


def _explain(kind: Kind, amplitude: float, length: int, rate: float) -> str:
    """Put the evidence into one sentence."""
    size, lasting = f"{in_mm(amplitude)} mm", how_long(length, rate)
    if kind is Kind.PEAK:
        return f"sticks out by {size} for {lasting}"
    if kind is Kind.NOISE:
        return f"jitters by up to {size} for {lasting}"
    if kind is Kind.STEP:
        return f"jumps {size} in one frame and comes back {lasting} later"
    return f"deviates up to {size} from where its body says it should be, for {lasting}"


def in_mm(amplitude: float) -> str:
    """Write millimetres with no more digits than they are worth."""
    return f"{amplitude:.1f}" if amplitude < 10 else f"{amplitude:.0f}"


def how_long(length: int, rate: float) -> str:
    """Write a length as frames and time."""
    seconds = length / rate
    time = f"{1000 * seconds:.0f} ms" if seconds < 1 else f"{seconds:.1f} s"
    return f"{length} {'frame' if length == 1 else 'frames'} ({time})"
