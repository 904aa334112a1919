"""The history of a review: every step that was made, each undoable.

What steps do to the review's state is told by their edits; which steps there are is told by the
session, whose verbs make them.
"""

from __future__ import annotations

from collections.abc import Callable

from markermend.review.edits import (
    Change,
    Edit,
    SetBase,
    SetNames,
    SetRegion,
    State,
    extent,
    merged,
)
from markermend.review.pace import Stopwatch
from markermend.review.step import Step, decides, parts


class History:
    """Steps done and undone, and the state they led to.

    Parameters
    ----------
    state : what the first step is made on; edits change it

    Attributes
    ----------
    stopwatch : measures the operator's time; told by whoever sees what the operator does
    revision : grows with every change, also by undo and redo; what was computed at one revision
        may be applied only while it is unchanged
    on_step : called after each change with ``("do", step)``, ``("undo", step)`` or
        ``("redo", step)``; the journal hangs here
    """

    def __init__(self, state: State) -> None:
        self.revision = 0
        self.stopwatch = Stopwatch()
        self.on_step: Callable[[str, Step], None] | None = None
        self._state = state
        self._done: list[Step] = []
        self._undone: list[Step] = []
        self._clean_at: Step | None = None

    @property
    def state(self) -> State:
        """What edits apply to; to be read, not written."""
        return self._state

    @property
    def history(self) -> tuple[str, ...]:
        """Labels of the steps done, oldest first."""
        return tuple(s.label for s in self._done)

    @property
    def undone(self) -> tuple[str, ...]:
        """Labels of the steps that redo would bring back, next first."""
        return tuple(s.label for s in reversed(self._undone))

    @property
    def undoable(self) -> bool:
        """Whether the last step is one that the operator would take back, who did it."""
        return bool(self._done) and not self._done[-1].by_itself

    @property
    def begun(self) -> bool:
        """Whether anything was done but to choose the frames that matter."""
        return any(not isinstance(s.edit, SetRegion) for s in self._done)

    @property
    def by_hand(self) -> tuple[str, ...]:
        """Work by hand on samples and names, in the words of the history."""
        return tuple(s.label for s in self._done if parts(s.edit, SetBase, SetNames))

    @property
    def renamed(self) -> bool:
        """Whether markers were given other names."""
        return any(parts(s.edit, SetNames) for s in self._done)

    def perform(
        self, label: str, edit: Edit, spent_s: float | None = None, by_itself: bool = False
    ) -> Change:
        """Apply an edit as one undoable step; one that was stored knows the time of its making."""
        inverse = edit.apply(self._state)
        if spent_s is None:
            spent_s = self.stopwatch.touch()
        else:
            self.stopwatch.spent_s = max(self.stopwatch.spent_s, spent_s)
        step = Step(label, edit, inverse, spent_s, by_itself)
        self._done.append(step)
        self._undone.clear()
        return self._after("do", step)

    def undo(self) -> Change:
        """Take the last step back; does nothing when there is none."""
        if not self._done:
            return Change()
        step = self._done.pop()
        step.inverse.apply(self._state)
        self._undone.append(step)
        return self._after("undo", step)

    def redo(self) -> Change:
        """Bring the last undone step back; does nothing when there is none."""
        if not self._undone:
            return Change()
        step = self._undone.pop()
        step.edit.apply(self._state)
        self._done.append(step)
        return self._after("redo", step)

    def travel(self, steps_done: int) -> Change:
        """Undo or redo until so many steps are done; the changes are told as one."""
        changes = []
        while len(self._done) > max(0, steps_done):
            changes.append(self.undo())
        while len(self._done) < steps_done and self._undone:
            changes.append(self.redo())
        return merged(changes)

    @property
    def exported(self) -> bool:
        """Whether the samples and decisions as they stand have been exported (or are untouched)."""
        last = self._done[-1] if self._done else None
        return last is self._clean_at or not any(decides(s) for s in self._done)

    @property
    def exported_at(self) -> int | None:
        """How many steps were done when it was exported last; None if that state is gone."""
        return next((i + 1 for i, s in enumerate(self._done) if s is self._clean_at), None)

    def mark_exported(self, steps_done: int | None = None) -> None:
        """Remember that what stands now is in a file, or what stood after so many steps."""
        done = self._done if steps_done is None else self._done[:steps_done]
        self._clean_at = done[-1] if done else None

    @property
    def steps(self) -> tuple[tuple[Step, ...], tuple[Step, ...]]:
        """Steps done (oldest first) and undone (as a stack), for saving."""
        return tuple(self._done), tuple(self._undone)

    def _after(self, what: str, step: Step) -> Change:
        """Count the change and tell the journal."""
        self.revision += 1
        if self.on_step is not None:
            self.on_step(what, step)
        return extent(step.edit)
