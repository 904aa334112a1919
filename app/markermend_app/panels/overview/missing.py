"""What is missing behind each pixel of the overview, kept while nothing of it changes."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.arrays import FloatArray
from markermend.heat import missing_share
from markermend.take import Take


class Missing:
    """Shares of missing samples in a picture; of a long take they take a while to count."""

    def __init__(self) -> None:
        self._known: tuple[int, tuple[float, float], FloatArray] | None = None

    @property
    def known(self) -> bool:
        """Whether anything was counted of this take."""
        return self._known is not None

    def forget(self) -> None:
        """Start over with another take."""
        self._known = None

    def note(self, take: Take, columns: Sequence[int]) -> None:
        """Count markers anew whose samples changed."""
        if self._known is not None:
            width, span, share = self._known
            share[columns] = missing_share(take.origin[:, columns], width, *span)

    def share(self, take: Take, width: int, span: tuple[float, float]) -> FloatArray:
        """(markers, width) in [0, 1], see :func:`markermend.heat.missing_share`."""
        if self._known is None or self._known[:2] != (width, span):
            self._known = width, span, missing_share(take.origin, width, *span)
        return self._known[2]
