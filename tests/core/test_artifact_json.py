from __future__ import annotations

import json
import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.artifact import Artifact, Kind, Status
from markermend.artifact_json import artifacts_of, document, from_dict, to_dict
from markermend.errors import DataError
from markermend.take import Take

artifacts = st.builds(
    Artifact,
    marker=st.sampled_from(["LFHD", "Rory:RSHO", "*7"]),
    axes=st.sampled_from(["x", "y", "z", "xy", "xz", "yz", "xyz"]),
    start=st.integers(0, 500),
    stop=st.integers(501, 900),
    kind=st.sampled_from(Kind),
    confidence=st.floats(0, 1),
    amplitude_mm=st.floats(0, 500),
    why=st.text(max_size=30),
    counterpart=st.just("RFHD"),
    further_counterparts=st.sampled_from([(), ("LBHD",), ("LBHD", "C7")]),
    status=st.sampled_from(Status),
)


@given(artifacts)
def test_an_artifact_survives_json(artifact: Artifact) -> None:
    assert from_dict(json.loads(json.dumps(to_dict(artifact)))) == artifact


def test_further_counterparts_need_a_first() -> None:
    with pytest.raises(DataError, match="counterpart"):
        Artifact("C7", "xyz", 1, 2, Kind.STEP, further_counterparts=("LBHD",))


def test_an_artifact_takes_the_name_of_a_class() -> None:
    values: dict[str, Any] = {"kind": "step", "status": "accepted"}
    named = Artifact("C7", "xyz", 1, 2, **values)
    assert named.kind is Kind.STEP
    assert named.status is Status.ACCEPTED


@pytest.mark.parametrize(
    "wrong",
    [
        {"start": 0.5},
        {"stop": "2"},
        {"confidence": 1.5},
        {"confidence": math.nan},
        {"kind": "wobble"},
        {"status": "maybe"},
    ],
)
def test_an_artifact_of_nonsense_is_refused(wrong: dict[str, Any]) -> None:
    values: dict[str, Any] = {"start": 1, "stop": 2, "kind": Kind.GAP}
    with pytest.raises(DataError):
        Artifact("C7", "xyz", **(values | wrong))


def test_no_amplitude_is_null_and_comes_back_as_nan() -> None:
    values = to_dict(Artifact("C7", "xyz", 3, 9, Kind.GAP))
    assert values["amplitude_mm"] is None
    assert json.loads(json.dumps(values, allow_nan=False)) == values
    assert math.isnan(from_dict(values).amplitude_mm)


def test_an_artifact_without_a_size_equals_its_copy() -> None:
    gap = Artifact("C7", "xyz", 3, 9, Kind.GAP)
    assert pickle.loads(pickle.dumps(gap)) == gap
    assert from_dict(to_dict(gap)) == gap


def test_a_document_names_the_take_and_reads_back() -> None:
    take = Take(np.zeros((5, 1, 3)), ("C7",), 120.0, first_frame=11)
    found = (Artifact("C7", "z", 1, 2, Kind.PEAK, amplitude_mm=12.5),)
    values = json.loads(json.dumps(document(take, found, "paper", "1.2", name="a.c3d")))
    assert (values["take"], values["rate"], values["first_frame"]) == ("a.c3d", 120.0, 11)
    assert (values["frames"], values["method"], values["version"]) == (5, "paper", "1.2")
    assert artifacts_of(values) == found


@pytest.mark.parametrize(
    "wrong",
    [{"kind": "wobble"}, {"axes": "zx"}, {"start": 9}, {"stop": None}, {"status": "maybe"}],
)
def test_nonsense_is_refused_in_a_sentence(wrong: dict[str, object]) -> None:
    values = to_dict(Artifact("C7", "xyz", 3, 9, Kind.GAP)) | wrong
    with pytest.raises(DataError):
        from_dict(values)


def test_missing_keys_are_named() -> None:
    with pytest.raises(DataError, match="marker"):
        from_dict({"axes": "x"})
    with pytest.raises(DataError, match="list"):
        artifacts_of({"artifacts": None})
