"""What marker names tell, over the conventions in use."""

from __future__ import annotations

import numpy as np
import pytest

from markermend.mesh.model import Group
from markermend.mesh.names import body_part, body_parts, name_groups
from markermend.take import Take


@pytest.mark.parametrize(
    ("part", "names"),
    [
        (("", "head"), "LFHD RBHD Head1 L_HDF pTopOfHead LEAR"),
        (("", "trunk"), "C7 T10 CLAV STRN RBAK RBAC CV7 TV10 SXS T12SpinalProcess Sternum th12"),
        (("", "pelvis"), "LASI RPSI SACR LFWT L_IAS R_IPS RASIS r_asis PelvisTop"),
        (("Left", "shoulder"), "LSHO L_SAJ LeftAcromion l_shoulder AcromionL"),
        (("Left", "upper arm"), "LUPA LELB L_HLE LUA1 LeftArmLatEpicondyle ArmL2"),
        (("Right", "forearm"), "RFRM RWRA RWRB R_RSP R_USP RightUlnarStyloid ForearmR3"),
        (("Right", "hand"), "RFIN R_HM2 RightTopOfHand GloveR1 HandR"),
        (("Left", "thigh"), "LTHI LKNE LTH3 L_FLE L_THIGH_1 LeftGreaterTrochanter l_suppat"),
        (("Left", "shank"), "LTIB LANK LSHN L_SK2 LTB1 L_TAM LLMAL LeftLatMalleolus"),
        (("Right", "foot"), "RHEE RTOE RMT5 R_FCC RCAL R_MT_1 RightHeelFoot r_toe"),
        (None, "Probe1 *12 m3 Sync WheelchairFront LHJC 7"),
    ],
)
def test_conventions(part: tuple[str, str] | None, names: str) -> None:
    for name in names.split():
        assert (body_part(name.removeprefix("p")) if part else body_part(name)) == part, name


def test_a_prefix_of_all_is_ignored_only_where_it_hides() -> None:
    assert body_parts(["LRFHD", "LLFHD", "LL_TH1", "LR_SK1", "LCV7"]) == [
        ("", "head"),
        ("", "head"),
        ("Left", "thigh"),
        ("Right", "shank"),
        ("", "trunk"),
    ]
    assert body_parts(["LTHI", "LKNE", "LANK"])[0] == ("Left", "thigh")


def test_sides_need_a_majority() -> None:
    names = ["STYLr", "WRIST", "INDEX", "EPICm", "LARMm"]
    assert {p[0] for p in body_parts(names) if p} == {""}


def named(groups: list[list[str]], subject: str = "") -> list[str]:
    labels = [name for group in groups for name in group]
    places = np.random.default_rng(0).normal(0, 100, (5, len(labels), 3))
    prefix = f"{subject}:" if subject else ""
    take = Take(places, tuple(prefix + name for name in labels), 100.0)
    built, at = [], 0
    for group in groups:
        built.append(Group("", subject, tuple(range(at, at + len(group)))))
        at += len(group)
    return [g.name for g in name_groups(take, built)]


def test_groups_are_named_for_people() -> None:
    assert named(
        [
            ["LFHD", "RFHD", "LBHD"],
            ["C7", "STRN", "LSHO"],
            ["LFRM", "LWRA", "LFIN", "LHM2"],
            ["RTHI", "RKNE"],
            ["RANK", "RHEE", "RTOE", "RMT5"],
        ]
    ) == ["Head", "Trunk", "Left forearm and hand", "Right thigh", "Right foot"]


def test_names_that_tell_nothing_are_shared_or_counted() -> None:
    first, second, third = named([["Probe1", "Probe2"], ["ab", "xy", "kq"], ["zz"]])
    assert first == "Probe"
    assert second.endswith("+2")
    assert second.split()[0] in {"ab", "xy", "kq"}
    assert third == "zz"
    assert named([["m1", "m2"]], subject="Box") == ["Box"]
    assert set(named([["Point1", "Point2"], ["Point3", "Point4"]])) <= {
        f"Point{a} +1" for a in range(1, 5)
    }
    assert named([["RBAC", "RSHO", "RUPA"]]) == ["Right shoulder and upper arm"]
    assert named([["LELB", "LUPA", "LWRA", "LWRB"]]) == ["Left upper arm and forearm"]


def test_names_are_unique() -> None:
    assert named([["LTHI", "LTH1"], ["LKNE", "LTH2"], ["LTH3"]]) == [
        "Left thigh",
        "Left thigh 2",
        "Left thigh 3",
    ]
