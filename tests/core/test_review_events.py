"""Which artifacts of a skeleton recording tell of one event."""

from __future__ import annotations

from dataclasses import replace

from markermend.artifact import Artifact, Kind, Status
from markermend.review.events import events


def step(marker: str, start: int = 10, **more: object) -> Artifact:
    return replace(Artifact(marker, "xyz", start, start + 5, Kind.STEP), **more)


def test_joints_that_went_wrong_together_are_one_event() -> None:
    arm = [step("shoulder"), step("elbow"), step("wrist")]
    later = step("wrist", 40)
    assert events([arm[0], later, *arm[1:]]) == (tuple(arm), (later,))


def test_what_differs_in_class_frames_decision_or_kind_of_repair_is_not() -> None:
    apart = (
        step("hip"),
        step("knee", stop=14),
        step("ankle", kind=Kind.GAP),
        step("toes", status=Status.REJECTED),
        step("left_hand", counterpart="right_hand"),
        step("root", axes="x"),
    )
    assert events(apart) == tuple((a,) for a in apart)
    assert events([]) == ()
