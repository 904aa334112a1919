"""Opening a take, on a worker: what holds its review, and what can be made before.

A take of a batch is prepared while the one before is under review: read, searched, and its first
repairs proposed. Nothing is locked or written meanwhile, so that anybody else can open it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markermend.artifact import Artifact, Status
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.progress import Progress, part
from markermend.review.file import SessionFile, open_session, read_review
from markermend.review.priority import badness
from markermend.review.session import Session
from markermend.review.standing import Standing, standings
from markermend.take import Take
from markermend_app import detection, own_prior, settings
from markermend_app.background.preview import AUTO
from markermend_app.background.proposals import Key
from markermend_app.columns import lay_out
from markermend_app.document import AHEAD

if TYPE_CHECKING:
    # Batches bring the repair methods along, which take longer to load than a take to show.
    from markermend.batch.review import ToReview

SEARCHED = "sudden"


@dataclass(frozen=True)
class Opened:
    """A review that is open, with what was made ahead.

    Attributes
    ----------
    file : the review, locked
    mesh : the body's structure, or None where it is still to be looked at
    proposals : repairs
    """

    file: SessionFile
    mesh: Mesh | None = None
    proposals: Mapping[Key, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Glance:
    """How the review of a take stands.

    Attributes
    ----------
    standing : of the whole take
    begun : it was searched, or something was done in it
    exported : what was decided is in a file
    """

    standing: Standing
    begun: bool
    exported: bool = False

    @property
    def left(self) -> int:
        """Artifacts that are open."""
        return sum(self.standing.open.values())

    @property
    def decided(self) -> int:
        """Artifacts that are decided."""
        return sum(self.standing.decided.values())

    @property
    def done(self) -> bool:
        """Nothing waits for the operator."""
        return self.begun and not self.left


@dataclass(frozen=True, eq=False)
class Prepared:
    """What was made ahead for a take that is not open.

    Attributes
    ----------
    item : the take
    stamp : size and time of its file when it was read, and how bodies move
    take : as read
    mesh : the body's structure
    found : artifacts, or None where it was not searched
    history : of the review that the proposals rest on
    proposals : repairs of the artifacts that come first
    glance : how it stands
    """

    item: ToReview
    stamp: tuple[int, int, str]
    take: Take
    mesh: Mesh
    found: tuple[Artifact, ...] | None
    history: tuple[str, ...]
    proposals: Mapping[Key, Any]
    glance: Glance


def load(path: Path, progress: Progress, item: ToReview | None = None) -> SessionFile:
    """Read a take, which may be one of a batch, and open its review."""
    take = _read(path, part(progress, 0.0, 0.9), item)
    progress(0.9, "Opening the review")
    lay_out(take)
    return open_session(take, folder=review_folder(path))


def load_item(item: ToReview, progress: Progress) -> Opened:
    """Read a take of a batch and open its review, with what the batch left."""
    file = load(item.path, progress, item)
    try:
        _begin(file, item, None)
    except BaseException:
        file.close()
        raise
    return Opened(file)


def glance_at(session: Session) -> Glance:
    """Sum a review up."""
    whole = standings(
        session.original, session.take, session.listed, session.notes, session.region
    )[0]
    exported = session.exported and session.exported_at is not None
    return Glance(whole, session.begun, exported)


def glance(item: ToReview, progress: Progress) -> Glance:
    """See how the review of a take stands, without opening it."""
    from markermend.batch.review import take_over

    session = read_review(_read(item.path, progress, item), folder=review_folder(item.path))
    if not session.begun:
        take_over(session, item)
    return glance_at(session)


def prepare(item: ToReview, progress: Progress) -> Prepared:
    """Make ahead what opening a take would wait for."""
    from markermend.batch.review import take_over
    from markermend.mesh import infer_mesh
    from markermend.repairs import propose

    stamp = _stamp(item.path)
    take = _read(item.path, part(progress, 0.0, 0.1), item)
    session = read_review(take, folder=review_folder(item.path))
    mesh = infer_mesh(session.original, progress=part(progress, 0.1, 0.2))
    found = None
    new = not session.begun and not take_over(session, item)
    if new and settings.flag("detect_on_open", True):
        within = part(progress, 0.2, 0.8)
        found = tuple(detection.search(take, mesh, within, slow=False))
        session.add_detected(found, SEARCHED, by_itself=True)
    first = sorted(
        session.listed_with(Status.PENDING), key=lambda a: -badness(a, take.rate, take.frames)
    )[: AHEAD + 1]
    proposals: dict[Key, Any] = {}
    for i, artifact in enumerate(first):
        progress(0.8 + 0.2 * i / len(first), "Proposing repairs")
        known, errors = session.artifacts, session.expected_errors
        repair = propose(session.take, artifact, known, mesh=mesh, errors=errors)
        proposals[artifact, AUTO, ()] = repair
    return Prepared(item, stamp, take, mesh, found, session.history, proposals, glance_at(session))


def open_prepared(ahead: Prepared, progress: Progress) -> Opened:
    """Open the review of a take that was prepared; what no longer holds is made anew."""
    if _stamp(ahead.item.path) != ahead.stamp:
        return load_item(ahead.item, progress)
    lay_out(ahead.take)
    file = open_session(ahead.take, folder=review_folder(ahead.item.path))
    try:
        _begin(file, ahead.item, ahead.found)
    except BaseException:
        file.close()
        raise
    if file.session.history != ahead.history:
        return Opened(file)
    return Opened(file, ahead.mesh, ahead.proposals)


def review_folder(path: Path) -> Path | None:
    """Where the review of a take is kept: beside it, but the demo's with the user's own files."""
    from markermend_resources import demo_take

    if path != demo_take():
        return None
    from platformdirs import user_data_path

    folder = user_data_path("markermend", appauthor=False) / "sessions"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _begin(file: SessionFile, item: ToReview, found: tuple[Artifact, ...] | None) -> None:
    """Take what a batch or the search left into a review in which nothing was done."""
    from markermend.batch.review import take_over

    if file.read_only or file.session.begun or take_over(file.session, item):
        return
    if found is not None:
        file.session.add_detected(found, SEARCHED, by_itself=True)


def _read(path: Path, progress: Progress, item: ToReview | None) -> Take:
    """Read a take that can be reviewed; skeletons are restored as by the batch that left them."""
    from markermend.files import read

    take: Take = read(path, progress=progress)
    if take.frames == 0:
        raise DataError(f"“{path.name}” has no frames, so that there is nothing to review in it.")
    if not take.skeleton:
        return take
    # Only who opens a skeleton has to wait until all about poses is loaded.
    from markermend.poses.own_prior import heeded_if_there

    left = item is not None and item.found is not None
    return heeded_if_there(take, item.prior if item and left else own_prior.chosen())


def _stamp(path: Path) -> tuple[int, int, str]:
    """What a take that is read depends on: its file's size and time, and how bodies move."""
    moving = settings.text(own_prior.SETTING, "")
    try:
        told = path.stat()
    except OSError:
        return 0, 0, moving
    return told.st_size, told.st_mtime_ns, moving


def takes_folder(open_take: Path | None) -> Path:
    """Where takes are looked for: beside the open one, else the last one opened; not the demo."""
    from markermend_resources import demo_take

    known = (p for p in (open_take, *settings.recent()) if p is not None and p != demo_take())
    return next((p.parent for p in known if p.parent.is_dir()), Path())


def is_there(path: Path) -> bool:
    """Whether something has this name; nothing has one that is too long."""
    try:
        return path.exists()
    except OSError:
        return False


def same_file(path: Path, other: Path) -> bool:
    """Whether two paths lead to the same file, by links too; either may be gone."""
    try:
        return path.samefile(other)
    except OSError:
        return path == other


def proposed_place(path: Path, ending: str) -> Path:
    """Where a file made from a take is proposed: beside it, but the demo's in the user's home."""
    from markermend_resources import demo_take

    folder = Path.home() if path == demo_take() else path.parent
    return folder / f"{path.stem}{ending}"
