"""What stands in place of the plots while there is nothing in them."""

from __future__ import annotations

from markermend.take import Take
from markermend_app.words import tr


def why_empty(take: Take | None) -> tuple[str, str]:
    """What is the matter, and what to do about it."""
    if take is None:
        return tr("No take is open"), tr("Open a take, or drop one onto the window.")
    if not take.markers:
        text = tr("There is nothing in it to be shown or mended.")
        if take.analog is not None or take.points is not None:
            text = tr("Check the channels in the tree that are to be seen.")
        return tr("This file has no markers"), text
    if take.skeleton:
        text = tr("Check joints in the tree, or go to an artifact in the review queue.")
        return tr("No joint is shown"), text
    text = tr("Check markers in the tree, or go to an artifact in the review queue.")
    return tr("No marker is shown"), text
