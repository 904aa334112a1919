"""The repair previewed for the artifact under review, and those made ahead for the next ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QObject, Signal

from markermend.artifact import Artifact, Status
from markermend.mesh import Mesh
from markermend.review.session import Session
from markermend_app.background.proposals import Key, Proposals

AUTO = "auto"


class Preview(QObject):
    """Which repair is looked at: by which method, and from which other markers.

    Signals
    -------
    ready(str) : the proposal for an artifact (its id) has come

    Attributes
    ----------
    method : name in the registry, or ``"auto"``
    references : markers the repair is to follow, chosen by hand; empty leaves it to the method
    """

    ready = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.method = AUTO
        self.references: tuple[str, ...] = ()
        self.proposals = Proposals(self)
        self.proposals.ready.connect(self.ready)

    @property
    def best(self) -> bool:
        """Whether the methods are left to compete, rather than one of them looked at."""
        return self.method == AUTO and not self.references

    def reset(self) -> None:
        """Go back to the best method and the references it takes by itself."""
        self.method, self.references = AUTO, ()

    def get(self, artifact: Artifact) -> Any:
        """The proposed :class:`markermend.repairs.registry.Repair`, or None while it is made."""
        return self.proposals.get(artifact, self.method, self.references)

    def want(
        self,
        session: Session,
        mesh: Mesh,
        artifacts: Sequence[Artifact],
        following: Sequence[Artifact],
    ) -> None:
        """Have proposals made for what is under review, and ahead of time for the next ones.

        Of joints that are mixed up it is also asked whether they can be exchanged.
        """
        now: list[Key] = [
            (a, self.method, self.references) for a in artifacts if a.status is not Status.REPAIRED
        ]
        mixed_up = session.original.skeleton and any(a.counterpart for a, _, _ in now[:1])
        swap: list[Key] = [(now[0][0], "swap", ())] if mixed_up else []
        ahead: list[Key] = [(a, AUTO, ()) for a in following]
        self.proposals.want(session, mesh, list(dict.fromkeys([*now, *swap, *ahead])))
