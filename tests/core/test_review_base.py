"""What hand work wrote, put back piece by piece."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from markermend.patch import Patch
from markermend.review.base import Base, Held
from markermend.take import Take

FRAMES = 40
SPANS = st.lists(st.tuples(st.integers(0, 39), st.integers(1, 12)), min_size=1, max_size=12)


def base() -> Base:
    """What hand work has not touched yet: one marker, and some frames without it."""
    rng = np.random.default_rng(3)
    positions = rng.normal(0, 100, (FRAMES, 2, 3))
    positions[10:14, 1] = np.nan
    return Base(Take(positions, ("A", "B"), 100.0))


def patch(start: int, stop: int, value: float) -> Patch:
    """All axes of marker B moved to a place."""
    return Patch("B", "xyz", start, stop, np.full((stop - start, 3), value))


def bits(base: Base) -> bytes:
    """Everything that is read of marker B."""
    positions, origin = base.read(1, 0, FRAMES)
    return positions.tobytes() + origin.tobytes()


@given(SPANS)
def test_steps_taken_back_and_done_again_leave_every_bit_as_it_was(spans):
    state = base()
    seen, undo = [bits(state)], []
    for n, (start, length) in enumerate(spans):
        undo.append(state.write(1, patch(start, min(start + length, FRAMES), float(n))))
        seen.append(bits(state))
    redo = []
    for held, before in zip(undo[::-1], seen[-2::-1], strict=True):
        redo.append(state.put(1, held))
        assert bits(state) == before
    for held, after in zip(redo[::-1], seen[1:], strict=True):
        state.put(1, held)
        assert bits(state) == after


def kept_alive(held: Held) -> int:
    """Bytes of the arrays behind what a step holds."""
    arrays = (held.frames, held.values, held.origins)
    return sum((a if a.base is None else a.base).nbytes for a in arrays)


def test_a_step_holds_no_more_than_its_own_frames():
    state = base()
    first = state.write(1, patch(0, 30, 1.0))
    inside = state.write(1, patch(4, 6, 2.0))
    beside = state.write(1, patch(34, 36, 3.0))
    assert [len(h.frames) for h in (first, inside, beside)] == [0, 2, 0]
    assert kept_alive(inside) < 4 * 2 * 40
    assert kept_alive(beside) < 100
