"""Work that is told to stop stops between its steps, also those that report nothing."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.artifact import Artifact, Kind
from markermend.errors import Cancelled
from markermend.predictors.local import predict_local
from markermend.progress import heed, heeded
from markermend.repairs import propose
from markermend.simulation import simulate_clean
from markermend.take import Take


@pytest.fixture(scope="module")
def gap():
    """A take with a gap, and the gap."""
    take = simulate_clean(duration_s=6.0, seed=3)
    positions = take.positions.copy()
    positions[200:230, take.index("LELB")] = np.nan
    return Take(positions, take.labels, take.rate), Artifact("LELB", "xyz", 200, 230, Kind.GAP, 1.0)


def looks(work) -> int:
    """How often some work heeds who waits for it; a work that is stopped comes to no end."""
    seen = []

    with heeded(lambda *_: seen.append(1)):
        work()
    for stop in (1, len(seen) // 2, len(seen)):
        left = iter(range(stop))

        def report(*_, left=left):
            if next(left, None) is None:
                raise Cancelled

        ended = stop == len(seen)
        with heeded(report):
            if ended:
                work()
            else:
                with pytest.raises(Cancelled):
                    work()
    return len(seen)


def test_nobody_needs_to_be_heeded():
    heed()


def test_a_proposal_stops_between_its_steps(gap):
    take, artifact = gap
    assert looks(lambda: propose(take, artifact, (artifact,))) >= 10


def test_a_prediction_stops_between_its_steps(gap):
    take, _ = gap
    assert looks(lambda: predict_local(take.positions, take.index("LELB"))) >= 4
