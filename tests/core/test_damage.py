"""Which samples artifacts name: a mix-up those of all its markers."""

from __future__ import annotations

import numpy as np

from markermend.artifact import (
    Artifact,
    Kind,
    Status,
    damage_mask,
    distrusted,
    trusted_samples,
)
from markermend.repairs.trust import evidence_for
from markermend.take import Take

SWAP = Artifact("A", "xyz", 3, 6, Kind.STEP, counterpart="B", further_counterparts=("C",))
TAKE = Take(np.random.default_rng(1).normal(0, 100, (10, 4, 3)), tuple("ABCD"), 100.0)


def test_a_mix_up_is_damage_of_all_its_markers() -> None:
    expected = np.zeros((10, 4), dtype=bool)
    expected[3:6, :3] = True
    np.testing.assert_array_equal(damage_mask(TAKE, [SWAP]).all(axis=2), expected)
    np.testing.assert_array_equal(trusted_samples(TAKE, [SWAP]), ~expected)
    assert distrusted([SWAP]) == dict.fromkeys("ABC", frozenset({(3, 6)}))


def test_nothing_is_learnt_from_any_marker_of_a_mix_up_until_it_is_exchanged() -> None:
    evidence = evidence_for(TAKE, [SWAP])
    assert not evidence.trusted[3:6, :3].any()
    assert not evidence.seen[3:6, :3].any()
    assert evidence.trusted[3:6, 3].all()
    for status in (Status.REPAIRED, Status.REJECTED):
        assert evidence_for(TAKE, [SWAP.with_status(status)]).trusted.all()


def test_a_counterpart_that_the_take_lacks_is_passed_over() -> None:
    lost = Artifact("A", "xyz", 3, 6, Kind.STEP, counterpart="E")
    assert damage_mask(TAKE, [lost]).any(axis=(0, 2)).tolist() == [True, False, False, False]
