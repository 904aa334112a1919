"""Which artifact lies where in the overview."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QPointF

from markermend.artifact import Artifact
from markermend_app.panels.overview.places import Places

_REACH_PX = 4.0


class ArtifactRows:
    """Artifacts, each on the rows of all of its markers: a mix-up has several.

    Parameters
    ----------
    artifacts : of the review
    row_of : the row of a marker

    Attributes
    ----------
    intervals : (n, 3) int64: start, stop and row
    """

    def __init__(
        self, artifacts: Sequence[Artifact] = (), row_of: Callable[[str], int] = lambda _: 0
    ) -> None:
        self._lying = [a for a in artifacts for _ in a.markers]
        self.intervals = np.array(
            [(a.start, a.stop, row_of(marker)) for a in artifacts for marker in a.markers],
            dtype=np.int64,
        ).reshape(-1, 3)

    def at(self, point: QPointF, places: Places) -> Artifact | None:
        """The artifact under a point, or the nearest within a few pixels."""
        if not self._lying:
            return None
        away = places.away(point, self.intervals)
        nearest = int(np.argmin(away))
        return self._lying[nearest] if away[nearest] <= _REACH_PX else None
