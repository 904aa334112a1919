"""The body mesh on real people: groups as a person would draw them, on any marker set."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from markermend.files import read
from markermend.mesh import Mesh, infer_mesh
from markermend.mesh.names import body_part
from markermend.take import Take

CMU = ("85_02", "85_12", "HDM_mm_01-02_03_120")
MOVING = (*(f"bodies/{name}" for name in (*CMU, "03_rolling", "AlbertoINT")),
          "gait/PiG_Motion-FlatFoot-Full", "gait/PiG_Motion-FlatFoot-Hole", "gait/test_walking",
          "gait/Qualisys", "gait/Walking_Hybrid_1_1")  # fmt: skip


@cache
def inferred(folder: Path, name: str) -> tuple[Take, Mesh]:
    take = read(folder / f"{name}.c3d")
    return take, infer_mesh(take)


def plain(take: Take, marker: int) -> str:
    """Name without the subject; the rolling take puts one L more before every label."""
    name = take.labels[marker].rpartition(":")[2]
    return name[1:] if "LRFHD" in take.labels else name


def places(take: Take, mesh: Mesh) -> list[set[str]]:
    """Body parts met in each group, with sides."""
    told = []
    for group in mesh.groups:
        parts = [body_part(plain(take, m).removeprefix("p")) for m in group.markers]
        told.append({" ".join(p).strip() for p in parts if p is not None})
    return told


def of(take: Take, mesh: Mesh, *names: str) -> set[int | None]:
    return {
        mesh.group_of(next(i for i in range(take.markers) if plain(take, i) == n)) for n in names
    }


@pytest.mark.parametrize("name", MOVING)
def test_no_group_mixes_what_no_person_would(shared_data: Path, name: str) -> None:
    take, mesh = inferred(shared_data, name)
    for parts in places(take, mesh):
        sides = {p.split()[0] for p in parts} & {"Left", "Right"}
        limbs = {p for p in parts if p.endswith(("foot", "shank", "thigh", "hand", "forearm"))}
        # The greater trochanters, left and right, ride on the pelvis.
        assert len(sides) < 2 or not limbs or "pelvis" in parts, parts
        if "head" in parts:
            assert parts == {"head"}
        if "pelvis" in parts:
            assert not any(p.endswith(("hand", "forearm", "foot", "shank")) for p in parts), parts
        if any(p.endswith("foot") for p in parts):
            assert not any(p.endswith(("thigh", "arm", "hand")) for p in parts), parts


@pytest.mark.parametrize("name", CMU)
def test_head_trunk_pelvis_and_limbs(shared_data: Path, name: str) -> None:
    take, mesh = inferred(shared_data, f"bodies/{name}")
    together = asker(take, mesh)
    assert together("LFHD", "RFHD", "LBHD", "RBHD")
    assert together("C7", "T10", "CLAV", "STRN")
    assert together("LFWT", "RFWT", "LBWT", "RBWT")
    for side in "LR":
        assert together(side + "FRM", side + "WRA", side + "WRB", side + "FIN")
        assert together(side + "TOE", side + "MT5")
        assert not together(side + "UPA", side + "FIN")
        assert not together(side + "THI", side + "ANK")


@pytest.mark.parametrize("name", ["85_02", "85_12"])
@pytest.mark.parametrize("side", ["L", "R"])
def test_feet_are_whole(shared_data: Path, name: str, side: str) -> None:
    take, mesh = inferred(shared_data, f"bodies/{name}")
    assert asker(take, mesh)(side + "HEE", side + "TOE", side + "MT5", side + "ANK")


@pytest.mark.parametrize("name", CMU)
@pytest.mark.parametrize("side", ["L", "R"])
def test_limbs_hang_in_order(shared_data: Path, name: str, side: str) -> None:
    take, mesh = inferred(shared_data, f"bodies/{name}")

    def road(*names: str) -> None:
        """Each group, from the trunk outwards, lies on the way of the last to the root."""
        stops = [next(iter(of(take, mesh, side + n if n[0] != "=" else n[1:]))) for n in names]
        way, group = [], stops[-1]
        while group is not None:
            way.append(group)
            group = mesh.groups[group].parent
        at = [way.index(s) for s in stops]
        assert at == sorted(at, reverse=True)

    road("=T10", "=LFWT", "KNE", "ANK", "TOE")
    road("=C7", "UPA", "FIN")
    road("=C7", "=LFHD")


def test_gait_with_joint_centres(shared_data: Path) -> None:
    take, mesh = inferred(shared_data, "gait/test_walking")
    together = asker(take, mesh)
    assert together("LASI", "RASI", "LPSI", "RPSI")
    assert together("C7", "T10", "CLAV", "STRN")
    for side in "LR":
        assert together(side + "CAL", side + "MT1", side + "MT2")
        assert together(side + "TB1", side + "TB2", side + "TB3", side + "LMAL", side + "MMAL")
        assert together(side + "TH1", side + "TH2", side + "TH3")
        foot, shank = (mesh.groups[next(iter(of(take, mesh, side + n)))] for n in ("CAL", "TB1"))
        assert mesh.groups[foot.parent] == shank


def test_two_subjects_are_two_trees(shared_data: Path) -> None:
    take, mesh = inferred(shared_data, "gait/Vicon")
    assert sum(g.parent is None for g in mesh.groups) == len(take.subjects) == 2
    assert [len(g.markers) for g in mesh.groups if g.subject == "boite"] == [8]


@pytest.mark.parametrize("name", [f"bodies/{n}" for n in CMU])
def test_names_are_body_parts(shared_data: Path, name: str) -> None:
    _, mesh = inferred(shared_data, name)
    names = [g.name for g in mesh.groups]
    assert {"Head", "Trunk", "Pelvis"} <= set(names)
    assert len(set(names)) == len(names)
    for side in ("Left", "Right"):
        assert any(n.startswith(side) and "foot" in n for n in names)
        assert any(n.startswith(f"{side} forearm") for n in names)


@pytest.mark.parametrize("name", MOVING)
def test_lines_make_a_figure_not_a_hairball(shared_data: Path, name: str) -> None:
    take, mesh = inferred(shared_data, name)
    grouped = sum(len(g.markers) for g in mesh.groups)
    assert grouped - 1 <= len(mesh.links) <= 2.2 * grouped
    size = np.nanmedian(
        np.nanmax(take.positions, axis=(0, 1)) - np.nanmin(take.positions, axis=(0, 1))
    )
    for a, b in mesh.links:
        apart = np.linalg.norm(take.positions[:, a] - take.positions[:, b], axis=1)
        assert np.nanmedian(apart) < min(600.0, size)


@pytest.mark.parametrize("name", ["bodies/85_02", "bodies/85_12", "bodies/HDM_mm_01-02_03_120",
                                  "bodies/03_rolling", "gait/Qualisys"])  # fmt: skip
def test_small_changes_leave_the_groups(shared_data: Path, name: str) -> None:
    take, mesh = inferred(shared_data, name)
    p, rng, frames = take.positions, np.random.default_rng(0), take.frames
    gaps, damaged = p.copy(), p.copy()
    for marker in range(take.markers):
        at = rng.integers(0, frames)
        gaps[at : at + frames // 10, marker] = np.nan
    for marker in rng.permutation(take.markers)[:8]:
        damaged[rng.integers(0, frames, frames // 100), marker] += 200.0
        at = rng.integers(0, frames)
        damaged[at : at + frames // 20, marker] += rng.normal(0, 80, 3)
    for what, other in {
        "noise": p + rng.normal(0, 1.0, p.shape),
        "end cropped": p[: frames * 9 // 10],
        "start cropped": p[frames // 10 :],
        "gaps": gaps,
        "damage": damaged,
        "larger": 1.3 * p,
    }.items():
        assert agreement(mesh, infer_mesh(Take(other, take.labels, take.rate))) >= 0.8, what


def agreement(a: Mesh, b: Mesh) -> float:
    """Marker pairs in one group in both, twice, over those in one group in each (Dice)."""

    def pairs(mesh: Mesh, of: Mesh) -> set[tuple[int, int]]:
        return {(i, j) for g in mesh.groups for i in g.markers for j in g.markers
                if i < j and of.group_of(i) is not None and of.group_of(j) is not None}  # fmt: skip

    first, second = pairs(a, b), pairs(b, a)
    return 2 * len(first & second) / (len(first) + len(second))


def asker(take: Take, mesh: Mesh) -> Callable[..., bool]:
    """A question: are these markers in one group?"""
    return lambda *names: len(of(take, mesh, *names)) == 1
