"""Write a hierarchy's movement over the file it came from: what it does not change stays there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import FileFormatError
from markermend.files.bvh_hierarchy import (
    MOVES,
    TURNS,
    Joint,
    hierarchy_of,
    offsets_by,
    own_turn,
    turned_by,
    unit_by_size,
)
from markermend.files.bvh_read import HEAD, Channels, content_of
from markermend.poses.angles import angles_of, going_on
from markermend.poses.pose import Pose
from markermend.poses.quaternion import lengths_of
from markermend.progress import Progress

RIGID_MM = 1.0
"""What a joint may come off its place in its parent's axes and still be written as fixed there."""
DIGITS = 6
"""Digits behind the point of what is written."""
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
# What turning a rotation back and forth, or a place in the file's unit, may change.
_SAME = 1e-9
# What is left of an angle that is not written, in degrees.
_NO_ANGLE = 1e-4
_MOTION = re.compile(r"(?:^|[\r\n])[^\S\r\n]*(?=MOTION(?!\S))")
_LINE = re.compile(r"[^\n]*\n|[^\n]+")
_LINES_A_REPORT = 1024


@dataclass(frozen=True)
class _Own:
    """Channels of one joint: those that it has, then ``front`` and ``more`` that it needs besides.

    The first stand before those that it has, the others behind.

    ``values`` are (frames, channels) numbers, of those ``changed`` new ones.
    """

    front: tuple[str, ...]
    more: tuple[str, ...]
    values: FloatArray
    changed: BoolArray


def rounded(values: FloatArray) -> FloatArray:
    """Numbers as they are written, none of them -0."""
    return np.asarray(np.round(values, DIGITS) + 0.0)


def patched(pose: Pose, progress: Progress) -> bytes | None:
    """A recording's file with other numbers where the recording is another.

    The text of the hierarchy, the order of channels, endings of lines and every number that is not
    changed stay the same bytes. A joint's channels are changed in frames in which it is turned
    otherwise, or stands elsewhere, in its parent's axes. Channels that it lacks for that are added
    beside its own, and an end that needs some becomes a joint.

    Parameters
    ----------
    pose : every joint seen and turned in every frame
    progress : told the share of poses written; may raise to stop

    Returns
    -------
    The file's content; None where the recording comes from none, it is not there any more or says
    something else now, or cannot say what is changed, as a body of another size
    """
    source = pose.source
    if not isinstance(source, Channels) or not _fits(pose, source):
        return None
    try:
        raw = source.file.read_bytes()
        there = content_of(raw, source.file.name)
    except (OSError, FileFormatError):
        return None
    rows = slice(source.first, source.first + pose.frames)
    same = _alike(there.joints, source.joints)
    if not same or not np.array_equal(there.values[rows], source.values):
        return None
    places = offsets_by(pose, pose.parents) / source.scale_mm
    if not _same_body(places, source):
        return None
    own = _channels(pose, places, source)
    mark = _BYTE_ORDER_MARK if raw.startswith(_BYTE_ORDER_MARK) else b""
    text, code = _decoded(raw.removeprefix(mark))
    start = _MOTION.search(text)
    head = None if start is None else HEAD.match(text, start.end())
    if start is None or head is None:
        return None
    before = _hierarchy_with(text[: start.end()], pose, source, own)
    try:
        if unit_by_size(hierarchy_of(before.split()))[0] != source.scale_mm:
            # A body of such a size, or of such joints, would be taken to be in another unit.
            return None
    except (ValueError, IndexError):
        return None
    # What follows on the same line as the head begins behind a blank.
    blanks = text[head.end() : len(text) - len(text[head.end() :].lstrip())]
    told = _head_with(text, head, pose, source) + blanks
    movement = "".join(_movement_with(text[head.end() + len(blanks) :], source, own, progress))
    try:
        return mark + (before + told + movement).encode(code)
    except UnicodeEncodeError:
        return None


def _fits(pose: Pose, source: Channels) -> bool:
    """Whether a recording has the joints and frames of a file; ends have no name of their own."""
    joints = source.joints
    return (
        tuple(joint.parent for joint in joints) == pose.parents
        and len(source.values) == pose.frames
        and all(
            name == joint.name or not joint.is_end
            for name, joint in zip(pose.joints, joints, strict=True)
        )
    )


def _alike(some: list[Joint], others: tuple[Joint, ...]) -> bool:
    """Whether two hierarchies are one."""
    return len(some) == len(others) and all(
        (a.name, a.parent, a.channels, a.offset.tolist())
        == (b.name, b.parent, b.channels, b.offset.tolist())
        for a, b in zip(some, others, strict=True)
    )


def _decoded(raw: bytes) -> tuple[str, str]:
    """A text, and how its letters are written, as its reader takes them."""
    try:
        return raw.decode("utf-8"), "utf-8"
    except UnicodeDecodeError:
        return raw.decode("latin-1"), "latin-1"


def _same_body(places: FloatArray, source: Channels) -> bool:
    """Whether half of the bones that cannot change are as in the file, and not of another size."""
    rigid = [
        i
        for i, joint in enumerate(source.joints)
        if joint.parent >= 0 and not any(name in MOVES for name in joint.channels)
    ]
    usual = np.median(places[:, rigid], axis=0)
    away = lengths_of(usual - np.array([joint.offset for joint in source.joints])[rigid])
    return bool(np.count_nonzero(away * source.scale_mm < RIGID_MM) >= len(rigid) / 2)


def _channels(pose: Pose, places: FloatArray, source: Channels) -> list[_Own]:
    """Channels of each joint that have it where and as the recording has it."""
    found, column = list[_Own](), 0
    for i, joint in enumerate(source.joints):
        values = source.values[:, column : column + len(joint.channels)]
        column += len(joint.channels)
        new = _moves(joint, values, places[:, i], source.scale_mm)
        if not joint.is_end:
            new |= _turns(joint, values, own_turn(pose, i))
        front, more = _lacking(joint, new)
        # Of what a joint lacks it is at rest elsewhere.
        rest = [*(joint.offset[MOVES[name]] for name in front), *(0.0 for _ in more)]
        told = np.hstack([values, np.tile(rounded(np.array(rest)), (len(values), 1))])
        changed = np.zeros(told.shape, dtype=bool)
        for k, name in enumerate((*joint.channels, *front, *more)):
            if name in new:
                changed[:, k] = np.abs(new[name] - told[:, k]) > 0.5 * 10.0**-DIGITS
                told[:, k] = np.where(changed[:, k], rounded(new[name]), told[:, k])
        found.append(_Own(front, more, told, changed))
    return found


def _lacking(joint: Joint, new: Iterable[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Channels of position, and of rotation, to be added to a joint so that it has new ones.

    All three of a kind, and none of position by themselves: programs expect it so.
    """
    lacks = [name for name in new if name not in joint.channels]
    front = tuple(name for name in MOVES if name not in joint.channels)
    more = tuple(name for name in TURNS if name not in joint.channels)
    if not any(name in MOVES for name in lacks):
        front = ()
    if not any(name in TURNS for name in lacks) and not (front and len(more) == len(TURNS)):
        more = ()
    return front, more


def _moves(
    joint: Joint, values: FloatArray, place: FloatArray, scale: float
) -> dict[str, FloatArray]:
    """Channels of position that are changed, by their names, where a joint's place is another."""
    was = np.tile(joint.offset, (len(values), 1))
    for k, name in enumerate(joint.channels):
        if name in MOVES:
            was[:, MOVES[name]] = values[:, k]
    away = np.abs(place - was)
    fixed = joint.parent >= 0 and bool((np.ptp(was, axis=0) * scale < RIGID_MM).all())
    if fixed and (lengths_of(away) * scale < RIGID_MM).all():
        return {}
    there = (away > _SAME).any(axis=1)
    return {
        name: np.where(there, place[:, axis], was[:, axis])
        for name, axis in MOVES.items()
        if (away[:, axis] > _SAME).any()
    }


def _turns(joint: Joint, values: FloatArray, turn: FloatArray) -> dict[str, FloatArray]:
    """Channels of rotation that are changed, by their names, where a joint's turn is another."""
    own = [name for name in joint.channels if name in TURNS]
    was = values[:, [joint.channels.index(name) for name in own]]
    before = turned_by("".join(TURNS[name] for name in own), was)
    sign = np.where(np.sum(before * turn, axis=1) < 0, -1.0, 1.0)[:, None]
    anew: BoolArray = np.asarray((np.abs(before - sign * turn) > _SAME).any(axis=1))
    if not anew.any():
        return {}
    names = [*own, *(name for name in TURNS if name not in own)]
    path = np.hstack([was, np.zeros((len(was), len(names) - len(own)))])
    angles = angles_of(Rotation.from_quat(turn), "".join(TURNS[name] for name in names))
    path = going_on(np.where(anew[:, None], angles, path), anew)
    return {
        name: path[:, k]
        for k, name in enumerate(names)
        if name in own or (np.abs(path[:, k]) > _NO_ANGLE).any()
    }


def _hierarchy_with(text: str, pose: Pose, source: Channels, own: list[_Own]) -> str:
    """The text of a hierarchy with the names of a recording's joints, and channels they need."""
    words, edits = list(re.finditer(r"\S+", text)), list[tuple[int, int, str]]()
    for name, joint, one in zip(pose.joints, source.joints, own, strict=True):
        if name != joint.name:
            length = len(joint.name.split())
            first, last = (words[joint.begins_at + n] for n in (1, length))
            edits.append((first.start(), last.end(), name.replace(" ", "_")))
        if not one.front and not one.more:
            continue
        names = [*one.front, *joint.channels, *one.more]
        channels = f"{len(names)} {' '.join(names)}"
        if joint.channels_at:
            number, last = (words[joint.channels_at + 1 + n] for n in (0, len(joint.channels)))
            edits.append((number.start(), last.end(), channels))
            continue
        offset, end = words[joint.offset_at].start(), words[joint.offset_at + 3].end()
        line = _break_before(text, offset)
        channels = f"{line}CHANNELS {channels}"
        if joint.is_end:
            site, tip = (words[joint.begins_at + n] for n in (0, 1))
            edits.append((site.start(), tip.end(), f"JOINT {name.replace(' ', '_')}"))
            channels += f"{line}End Site{line}{{{line}  OFFSET 0 0 0{line}}}"
        edits.append((end, end, channels))
    for start, stop, put in sorted(edits, reverse=True):
        text = text[:start] + put + text[stop:]
    return text


def _break_before(text: str, place: int) -> str:
    """What a line ends and the next begins with, as before a place in a text."""
    blanks = text[len(text[:place].rstrip()) : place]
    found = re.search(r"(\r\n|\n|\r)[^\r\n]*$", blanks)
    return " " if found is None else found[0]


def _head_with(text: str, head: re.Match[str], pose: Pose, source: Channels) -> str:
    """The head of a movement, telling how many poses there are and how fast they follow."""
    frames, time = head.groups()
    if pose.rate != source.rate:
        time = f"{1.0 / pose.rate:.9g}"
    if int(frames) != pose.frames:
        frames = str(pose.frames)
    return text[head.start() : head.start(1)] + frames + text[head.end(1) : head.start(2)] + time


def _movement_with(
    text: str, source: Channels, own: list[_Own], progress: Progress
) -> Iterator[str]:
    """Lines of these poses, with other numbers where they are changed."""
    cells = _Cells(source, own)
    at, last = -source.first * cells.width, cells.anew.size
    for n, line in enumerate(_LINE.findall(text)):
        if n % _LINES_A_REPORT == 0:
            progress(min(max(at / last, 0.0), 1.0), "Writing poses")
        stop = at + len(line.split())
        if stop == at or (at >= 0 and stop <= last and cells.stay(at, stop)):
            yield line
        elif stop > 0 and at < last:
            yield cells.said(line, at)
        at = stop


class _Cells:
    """Numbers of a movement, counted one after the other, and what stands there instead."""

    def __init__(self, source: Channels, own: list[_Own]) -> None:
        self.width = source.values.shape[1]
        has = [one.values.shape[1] - len(one.front) - len(one.more) for one in own]
        pairs = list(zip(own, has, strict=True))
        self.anew = np.hstack([one.changed[:, :n] for one, n in pairs]).ravel()
        self.values = np.hstack([one.values[:, :n] for one, n in pairs]).ravel()
        # Numbers that are more, by the column that they stand behind.
        self.more: dict[int, list[FloatArray]] = {}
        for (one, n), end in zip(pairs, np.cumsum(has).tolist(), strict=True):
            cut = n + len(one.front)
            if one.front:
                self.more.setdefault(end - n - 1, []).append(one.values[:, n:cut])
            if one.more:
                self.more.setdefault(end - 1, []).append(one.values[:, cut:])

    def stay(self, start: int, stop: int) -> bool:
        """Whether numbers stand as they are."""
        return not self.more and not self.anew[start:stop].any()

    def said(self, line: str, at: int) -> str:
        """A line, whose first number is the one ``at``, with what shall stand there."""
        pieces = re.split(r"(\s+)", line)
        ending = pieces[-2] if pieces[-1] == "" and len(pieces) > 1 else ""
        for k in range(0, len(pieces), 2):
            if not pieces[k]:
                continue
            if 0 <= at < self.anew.size:
                pieces[k] = self._cell(pieces[k], at)
            else:
                pieces[k : k + 2] = ["", ""][: len(pieces) - k]
            at += 1
        told = "".join(pieces)
        return told if told.endswith(ending) else told.rstrip() + ending

    def _cell(self, word: str, at: int) -> str:
        """What stands for a number, and behind it."""
        frame, column = divmod(at, self.width)
        if self.anew[at]:
            word = _number(float(self.values[at]))
        if not self.more:
            return word
        before = self._behind(frame, -1) if column == 0 else []
        return " ".join([*before, word, *self._behind(frame, column)])

    def _behind(self, frame: int, column: int) -> list[str]:
        """Numbers of channels that are added behind a column of a pose."""
        return [_number(v) for block in self.more.get(column, ()) for v in block[frame].tolist()]


def _number(value: float) -> str:
    """A number as it is written."""
    return f"{value:.{DIGITS}f}"
