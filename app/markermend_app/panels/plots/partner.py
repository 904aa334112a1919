"""Which marker a distance is best measured to."""

from __future__ import annotations

from markermend_app.document import Document


def partner_of(document: Document) -> str | None:
    """The second marker shown, else one on the same segment, else one joined to it, or None."""
    session, mesh, shown = document.session, document.mesh, document.shown
    if session is None or not shown:
        return None
    take = session.original
    if len(shown) > 1:
        return shown[1]
    if mesh is None or shown[0] not in take:
        return None
    column = take.index(shown[0])
    joined = [b if a == column else a for a, b in mesh.links if column in (a, b)]
    near = [m for m in joined if mesh.group_of(m) == mesh.group_of(column)]
    candidates = [*near, *mesh.siblings(column), *joined]
    return take.labels[candidates[0]] if candidates else None
