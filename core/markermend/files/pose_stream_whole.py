"""Tell when a pose of a stream is whole: at its last row, wherever that can be known."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from markermend.errors import FileFormatError
from markermend.files.pose_rows import Header

STREAM = "The stream"
"""What a stream is called where something is wrong with it."""

LATELY_S = 1.0
"""Of a joint whose rows stay away for so long, none is waited for; so long rows are to come in the
order of the first pose until that is relied on."""

Row = tuple[int, list[str]]
"""Number and cells of a line."""


class WholePoses:
    """Gathers rows until no joint that was seen lately is missing.

    A pose whose unseen joints have rows is whole with the last of its joints. Where these are left
    out, only the first row of the next pose would tell, a pose late. But rows come in one order
    mostly, so none is waited for behind the last joint that came within :data:`LATELY_S`. Whoever
    comes back after longer may come too late for one pose, and counts from the next.

    Parameters
    ----------
    header : of the stream
    rate : poses per second
    warn : told, in a sentence, of rows that are left out
    """

    def __init__(self, header: Header, rate: float, warn: Callable[[str], None]) -> None:
        self._header, self._warn = header, warn
        self.come_at(rate)
        # Of each joint its place in the first pose, and the last pose that it came with.
        self._place, self._came = dict[str, int](), dict[str, int]()
        self._count, self._in_order = 0, 0
        self._waiting: dict[str, Row] = {}
        self._expected, self._last = frozenset[str](), -1
        self._strangers, self._late = set[str](), False

    def come_at(self, rate: float) -> None:
        """So many poses a second come from now on."""
        self._lately = max(round(LATELY_S * rate), 1)

    def of(self, lines: Iterator[tuple[int, str]]) -> Iterator[list[Row]]:
        """Rows of one pose after the other.

        Parameters
        ----------
        lines : number and text of each; which joints there are, the first frame tells

        Raises
        ------
        FileFormatError
            when a row is damaged, or contradicts another
        """
        given: int | None = None
        now: int | None = None
        for number, line in lines:
            text = line.rstrip("\r\n")
            row = self._header.cells(text, number)
            if len(row) < self._header.width:
                if not line.endswith("\n") and next(lines, None) is None:
                    # Whoever wrote it was stopped.
                    self._warn("The stream is cut short; its last row was left out.")
                    break
                raise FileFormatError(
                    f"{STREAM} is damaged: line {number}, “{text[:40]}”, lacks cells."
                )
            frame, joint = self._header.frame(row, number), self._header.joint(row, number)
            if self._waiting and frame != now:
                yield self._whole()
            if self._place and joint not in self._place:
                self._leave_out(joint)
            elif frame == given:
                self._come_late(joint)
            else:
                now = frame
                self._gather(joint, (number, row))
                if self._is_whole(joint):
                    given = frame
                    yield self._whole()
        if self._waiting:
            yield self._whole()

    def _gather(self, joint: str, row: Row) -> None:
        """Add a row to the pose that is waited for."""
        there = self._waiting.setdefault(joint, row)
        if there[1] != row[1]:
            raise FileFormatError(
                f"{STREAM} is damaged: lines {there[0]} and {row[0]} both tell of “{joint}” in one"
                " frame, and differ."
            )

    def _is_whole(self, joint: str) -> bool:
        """Whether none is to come after a joint's row."""
        if not self._place:
            return False
        missing = self._expected - self._waiting.keys()
        return not missing or (self._in_order >= self._lately and self._place[joint] >= self._last)

    def _whole(self) -> list[Row]:
        """Rows of the pose that was waited for; the next one is, from now on."""
        rows = list(self._waiting.values())
        names = list(self._waiting)
        self._place = self._place or {joint: n for n, joint in enumerate(names)}
        places = [self._place[joint] for joint in names]
        self._in_order = self._in_order + 1 if places == sorted(places) else 0
        self._came |= dict.fromkeys(names, self._count)
        self._waiting, self._count = {}, self._count + 1
        self._expect()
        return rows

    def _expect(self) -> None:
        """Wait for joints that came lately."""
        since = self._count - self._lately
        self._expected = frozenset(joint for joint, n in self._came.items() if n >= since)
        self._last = max(self._place[joint] for joint in self._expected)

    def _come_late(self, joint: str) -> None:
        """A row of a pose that has gone out: the same once more, or one that was not expected."""
        if self._came[joint] == self._count - 1:
            return
        self._came[joint] = self._count - 1
        self._expect()
        if not self._late:
            self._warn(
                f"A row of “{joint}” came after its pose had gone out, and was left out; write rows"
                " of unseen joints too, with confidence 0, and none will."
            )
        self._late = True

    def _leave_out(self, joint: str) -> None:
        """Rows of a joint that the first pose does not have."""
        if joint not in self._strangers:
            self._warn(f"The stream's first pose has no joint “{joint}”; its rows are left out.")
        self._strangers.add(joint)
