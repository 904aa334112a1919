"""What the plots draw of the current artifact's repair, whether proposed or carried out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.artifact import Status, axis_columns
from markermend.patch import Patch
from markermend_app.document import Document
from markermend_app.panels.plots.row import Banded


def shown_repair(document: Document) -> tuple[Sequence[Patch], Banded | None]:
    """The proposed patches, and the values that the error band goes around.

    Parameters
    ----------
    document : what is open

    Returns
    -------
    The patches of the preview, none where there is no preview; and the first of them with its
    band or, of a repair that was carried out, the samples as they stand with the band kept.
    None where the method gives no band.
    """
    a, session, proposal = document.current, document.session, document.proposal
    if proposal is not None:
        banded = bool(proposal.patches) and proposal.band_mm is not None
        return proposal.patches, (proposal.patches[0], proposal.band_mm) if banded else None
    if a is None or session is None or a.status is not Status.REPAIRED:
        return (), None
    note = session.notes.get(a.id)
    if note is None or note.band_mm is None:
        return (), None
    rows, column = slice(a.start, a.stop), session.original.index(a.marker)
    held = session.positions[rows, column][:, axis_columns(a.axes)]
    return (), (Patch(a.marker, a.axes, a.start, a.stop, held), np.array(note.band_mm))
