"""Markers read one by one look like those of the take, whatever is done to them."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.review import hand
from markermend.review.session import Session
from markermend.take import Take
from markermend_app.columns import _laid, column_of, lay_out
from markermend_app.panels.plots.drawn import Drawn


@pytest.mark.parametrize("laid", [True, False])
def test_a_column_is_the_markers_samples(damaged, laid):
    take = damaged[0]
    if laid:
        lay_out(take)
    for i in range(take.markers):
        positions, origin = column_of(take, i)
        np.testing.assert_array_equal(positions, take.positions[:, i])
        np.testing.assert_array_equal(origin, take.origin[:, i])
        assert positions.flags.f_contiguous


def test_what_was_laid_out_serves_under_other_names_and_goes_with_the_samples(damaged):
    take = Take(damaged[0].positions.copy(), damaged[0].labels, damaged[0].rate)
    before = len(_laid)
    lay_out(take)
    held = column_of(take, 1)[0]
    renamed = take.renamed({"CLAV": "CHEST"})
    del take
    assert np.shares_memory(column_of(renamed, 1)[0], held)
    assert len(_laid) == before + 1
    del renamed
    assert len(_laid) == before


@pytest.mark.parametrize("laid", [True, False])
def test_a_marker_is_drawn_as_it_stands_after_every_step_and_back(damaged, laid):
    take = damaged[0]
    if laid:
        lay_out(take)
    session, drawn, rng = Session(take), Drawn(), np.random.default_rng(2)
    hand.cut(session, "LWRB", 1, 9)

    def check():
        for i, name in enumerate(take.labels):
            shown = drawn.of(session, name, None, None)
            np.testing.assert_array_equal(shown.now.positions, session.positions[:, i])
            np.testing.assert_array_equal(shown.origin, session.take.origin[:, i])
            np.testing.assert_array_equal(shown.before.positions, take.positions[:, i])

    check()
    for start in range(10, 370, 30):
        name = str(rng.choice(take.labels[1:]))
        drawn.note(hand.cut(session, name, start, start + int(rng.integers(5, 25))).markers)
        check()
    for _ in range(12):
        drawn.note(session.undo().markers)
        check()
    for _ in range(12):
        drawn.note(session.redo().markers)
        check()
