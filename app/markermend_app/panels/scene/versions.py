"""What a take was, or is to be, drawn beside what it is: before and after, and as proposed."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from PySide6.QtCore import Qt

from markermend.arrays import FloatArray
from markermend.measures import differing
from markermend_app.document import Document
from markermend_app.panels.scene import paint
from markermend_app.panels.scene.proposed import proposed_body
from markermend_app.panels.scene.seen import Seen
from markermend_app.style import theme


def paint_other_version(
    sight: paint.Sight,
    document: Document,
    seen: Seen,
    versions: tuple[FloatArray, FloatArray],
    shown: Collection[int],
) -> None:
    """Paint the other version, before or after the repairs, where it differs.

    Bones say what became of a body, and ties only of the joints that are shown: those of a whole
    body hide it. Segments between markers are no bones, so that each marker is tied.

    Parameters
    ----------
    sight : where to
    document : with the frame that is looked at
    seen : what is known of the take
    versions : (frames, markers, 3) mm each, the one that is looked at and the other
    shown : columns of the markers that are shown in the plots
    """
    near = seen.near()
    color = theme.blend(theme.current().original, theme.current().text, 0.2)
    for column in shown:
        mine, other = (version[near, column] for version in versions)
        way = np.where(differing(mine, other)[:, None], other, np.nan)
        paint.paint_trails(sight, way[None], color, 1.2, Qt.PenStyle.DotLine)
    now, other = (version[document.frame] for version in versions)
    apart = differing(now, other)
    if document.joints:
        links = seen.links[apart[seen.links].any(axis=1)]
        paint.paint_links(sight, other, links, theme.current().original, 1.0)
        apart &= np.isin(np.arange(len(now)), list(shown))
    paint.paint_other(sight, now[apart], other[apart], color)


def paint_proposal(
    sight: paint.Sight, document: Document, seen: Seen, now: FloatArray, spots: FloatArray
) -> FloatArray:
    """Paint the previewed repair: the body as it would stand, the way of markers, and their places.

    Parameters
    ----------
    sight : where to
    document : with the frame that is looked at
    seen : what is known of the take
    now : (markers, 3) mm in this frame
    spots : (markers, 2) pixels where they are drawn

    Returns
    -------
    (markers, 2) pixels where names stand: a missing marker's at its proposed place
    """
    placed, proposed = proposed_body(document, now)
    paint.paint_proposed(sight, placed, seen.links[proposed[seen.links].any(axis=1)])
    spots = spots.copy()
    near = seen.near()
    for column, way, start in seen.ghosts():
        if start >= near.stop or start + len(way) <= near.start:
            # Long before or after, it would hang in the air.
            continue
        paint.paint_trails(sight, way[None], theme.current().accent, 1.6, Qt.PenStyle.DashLine)
        at = document.frame - start
        if 0 <= at < len(way):
            spot = paint.paint_ghost(sight, way[at], now[column])
            if np.isnan(spots[column, 0]):
                spots[column] = spot
    return spots
