"""Where joints were not seen: channels that are unknown over the same frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import BoolArray, IntArray, runs
from markermend.poses.filling.bridging import known_alike


@dataclass(frozen=True, eq=False)
class Gap:
    """Channels that are unknown over the same frames."""

    start: int
    stop: int
    channels: IntArray

    @property
    def length(self) -> int:
        """Frames."""
        return self.stop - self.start

    @property
    def part(self) -> tuple[slice, IntArray]:
        """Where it is in (frames, channels)."""
        return slice(self.start, self.stop), self.channels


def gaps_of(known: BoolArray) -> list[Gap]:
    """All gaps, channels with the same frames together.

    Parameters
    ----------
    known : (frames, channels) bool
    """
    together: dict[tuple[int, int], list[int]] = {}
    for channels in known_alike(known):
        for start, stop in runs(~known[:, channels[0]]).tolist():
            together.setdefault((start, stop), []).extend(channels)
    return [Gap(*frames, np.sort(columns)) for frames, columns in together.items()]


def by_lasting(gaps: Sequence[Gap], frames: int, at_least: float) -> tuple[list[Gap], list[Gap]]:
    """Tell brief gaps from those that last, and from those beside these.

    Parameters
    ----------
    gaps : in any order
    frames : of the recording
    at_least : frames that a gap has which lasts
    """
    during = np.zeros(frames, dtype=bool)
    for gap in gaps:
        if gap.length >= at_least:
            during[gap.start : gap.stop] = True
    lasts = [bool(during[gap.start : gap.stop].any()) for gap in gaps]
    brief, lasting = (
        [gap for gap, own in zip(gaps, lasts, strict=True) if own == asked]
        for asked in (False, True)
    )
    return brief, lasting
