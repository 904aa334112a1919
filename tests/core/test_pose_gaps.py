"""Gaps of a skeleton's channels."""

from __future__ import annotations

import numpy as np

from markermend.poses.filling.gaps import Gap, by_lasting, gaps_of


def test_channels_that_are_unknown_together_are_one_gap():
    known = np.ones((20, 4), dtype=bool)
    known[3:6, [0, 2]] = False
    known[3:6, 3] = known[10:12, 3] = False
    found = {(gap.start, gap.stop): gap.channels.tolist() for gap in gaps_of(known)}
    assert found == {(3, 6): [0, 2, 3], (10, 12): [3]}
    for gap in gaps_of(known):
        assert not known[gap.part].any()
        assert gap.length == gap.stop - gap.start


def test_what_stands_beside_a_gap_that_lasts_is_looked_at_with_it():
    gaps = [Gap(n, stop, np.array([n])) for n, stop in ((0, 3), (5, 20), (18, 22), (30, 32))]
    brief, lasting = by_lasting(gaps, 40, 10)
    assert [gap.start for gap in brief] == [0, 30]
    assert [gap.start for gap in lasting] == [5, 18]
    assert by_lasting(gaps, 40, 16) == (gaps, [])
