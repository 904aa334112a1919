"""Small reviews for tests: a take, artifacts, proposals, and verbs to be driven at random."""

from __future__ import annotations

import contextlib

import numpy as np
from hypothesis import strategies as st

from markermend.artifact import Artifact, Kind, Status
from markermend.errors import DataError
from markermend.patch import Patch
from markermend.repairs.registry import Repair
from markermend.review import hand
from markermend.review.session import Session
from markermend.take import Origin, Take

FRAMES, LABELS = 60, ("A", "B", "C")


def make_take() -> Take:
    rng = np.random.default_rng(3)
    positions = rng.normal(0, 100, (FRAMES, 3, 3))
    positions[10:20, 1] = np.nan
    return Take(positions, LABELS, 100.0, first_frame=5)


def artifact(marker="A", axes="xyz", start=30, stop=40, kind=Kind.NOISE, **more) -> Artifact:
    return Artifact(marker, axes, start, stop, kind, 0.9, 5.0, "because", **more)


def proposal(a: Artifact, value: float = 1.0, method: str = "spline") -> Repair:
    values = np.full((a.length, len(a.axes)), value)
    return Repair(method, (Patch(a.marker, a.axes, a.start, a.stop, values),), error_mm=0.4)


def state_of(session: Session) -> tuple:
    return (
        session.positions.tobytes(),
        session.origin.tobytes(),
        *(
            a.tobytes()
            for i in range(session.original.markers)
            for a in session.state.base.read(i, 0, session.original.frames)
        ),
        session.original.labels,
        session.region,
        session.artifacts,
        tuple(sorted((i, n.method) for i, n in session.notes.items())),
    )


DECISIONS = ("accept", "reject", "reopen", "repair", "adjust", "kind", "mark", "remove", "note")
HAND_WORK = ("cut", "move", "rename", "smooth", "split", "join", "region")

verbs = st.lists(
    st.tuples(
        st.sampled_from([*DECISIONS, *HAND_WORK]),
        st.integers(0, 30),
        st.integers(1, 12),
        st.floats(-500, 500),
    ),
    min_size=1,
    max_size=25,
)


def drive(session: Session, verb: str, where: int, length: int, value: float) -> None:
    """Do one of the operator's verbs; nothing when the session refuses it."""
    labels = session.original.labels
    marker, other = labels[where % 3], labels[(where + length) % 3]
    with contextlib.suppress(DataError):
        if verb == "cut":
            hand.cut(session, marker, where, where + length)
        elif verb == "move":
            hand.move(session, marker, other, where, where + length)
        elif verb == "region":
            session.set_region((where, where + length) if where % 4 else None)
        elif verb == "rename":
            hand.rename(session, {marker: other, other: marker} if where % 2 else {marker: "D"})
        elif verb == "smooth":
            values = np.full((length, 1, 3), value)
            origin = np.full((length, 1), Origin.EDITED, dtype=np.uint8)
            hand.replace_samples(session, "Smooth", [marker], where, values, origin)
        elif verb == "mark" or not session.artifacts:
            kind = Kind.GAP if where % 2 else Kind.STEP
            session.mark(Artifact(marker, "xyz", where, where + length, kind))
        else:
            _decide(session, verb, where, length, value)


def _decide(session: Session, verb: str, where: int, length: int, value: float) -> None:
    """Do something to one of the artifacts."""
    a = session.artifacts[where % len(session.artifacts)]
    if verb == "repair":
        session.repair([(a.id, proposal(a, value))])
    elif verb == "note":
        session.annotate(a.id, f"note {length}")
    elif verb == "split":
        hand.split(session, a.id, a.start + length)
    elif verb == "join":
        hand.join(session, [b.id for b in session.artifacts if b.marker == a.marker])
    elif verb == "adjust":
        session.change(a.id, start=where, stop=where + length)
    elif verb == "kind":
        session.change(a.id, kind=Kind.PEAK)
    elif verb == "remove":
        session.remove([a.id])
    else:
        status = {
            "accept": Status.ACCEPTED,
            "reject": Status.REJECTED,
            "reopen": Status.PENDING,
        }[verb]
        session.set_status([a.id], status)


def die(kept):
    """Let go of a review as a process does that is killed; its files are closed by the system."""
    kept._on_disk.wait()
    kept._journal.close()
