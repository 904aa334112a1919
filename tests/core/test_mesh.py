"""The body mesh: bodies whose groups are known, and what must not upset it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.errors import Cancelled
from markermend.mesh import infer_mesh
from markermend.take import Take

SEGMENTS = ("hip", "thigh", "shank", "foot")


def leg(frames: int = 600, seed: int = 0, noise_mm: float = 0.5) -> Take:
    """A chain of four rigid segments swinging in a plane, four markers each."""
    rng = np.random.default_rng(seed)
    t = np.arange(frames) / 100
    joint = np.column_stack([1000 * t, np.zeros(frames), np.full(frames, 1200.0)])
    columns, labels = [], []
    for level, name in enumerate(SEGMENTS):
        angle = (0.05, 0.5, 0.7, 0.9)[level] * np.sin(2 * np.pi * (0.9 + 0.13 * level) * t)
        along = np.column_stack([np.sin(angle), np.zeros(frames), -np.cos(angle)])
        across = np.column_stack([np.cos(angle), np.zeros(frames), np.sin(angle)])
        side = np.tile([0.0, 1.0, 0.0], (frames, 1))
        for number, (a, b, c) in enumerate(
            [(30, 40, 30), (120, -40, 30), (200, 40, -30), (290, -40, -30)]
        ):
            columns.append(joint + a * along + b * across + c * side)
            labels.append(f"{name}_{number}")
        joint = joint + 400 * along
    positions = np.stack(columns, axis=1) + rng.normal(0, noise_mm, (frames, len(columns), 3))
    return Take(positions, tuple(labels), 100.0)


def still(markers: int, frames: int = 50) -> Take:
    places = np.random.default_rng(1).normal(0, 400, (markers, 3))
    return Take(np.tile(places, (frames, 1, 1)), tuple(f"m{i}" for i in range(markers)), 100.0)


def changed(take: Take, positions: np.ndarray) -> Take:
    return Take(positions, take.labels, take.rate)


def test_a_chain_of_segments_comes_out_in_order() -> None:
    take = leg()
    mesh = infer_mesh(take)
    assert sorted(g.markers for g in mesh.groups) == [
        tuple(range(4 * i, 4 * i + 4)) for i in range(4)
    ]
    joined = {frozenset({g.markers[0] // 4, mesh.groups[g.parent].markers[0] // 4})
              for g in mesh.groups if g.parent is not None}  # fmt: skip
    assert joined == {frozenset({0, 1}), frozenset({1, 2}), frozenset({2, 3})}
    assert mesh.siblings(5) == (4, 6, 7)
    assert all(p < i for i, g in enumerate(mesh.groups) if (p := g.parent) is not None)


def test_parent_marker_sits_at_the_joint() -> None:
    take = leg()
    mesh = infer_mesh(take)
    for group in mesh.groups:
        if group.parent is None:
            continue
        upper = mesh.groups[group.parent].markers
        assert group.parent_marker in upper
        level, below = upper[0] // 4, group.markers[0] // 4
        near = (2, 3) if below > level else (0, 1)
        assert group.parent_marker - 4 * level in near


def test_gaps_and_damage_do_not_change_the_groups() -> None:
    take = leg()
    clean, rng = infer_mesh(take), np.random.default_rng(3)
    p = take.positions.copy()
    p[200:290, 2] = np.nan
    p[50:80, 9] += 120.0  # step
    p[rng.integers(0, 600, 12), 13] += 400.0  # peaks
    p[300:350, 6] += np.linspace(0, 60, 50)[:, None]  # drift
    p[400:440, [0, 15]] = p[400:440, [15, 0]]  # swap
    assert {g.markers for g in infer_mesh(changed(take, p)).groups} == {
        g.markers for g in clean.groups
    }


def test_unlabelled_and_rarely_seen_markers_have_no_group() -> None:
    take = leg()
    p = take.positions.copy()
    p[60:, 5] = np.nan
    labels = ("*7", *take.labels[1:])
    mesh = infer_mesh(Take(p, labels, 100.0))
    assert mesh.group_of(0) is None
    assert mesh.group_of(5) is None
    assert mesh.siblings(5) == ()
    assert all(mesh.group_of(i) is not None for i in range(16) if i not in (0, 5))
    assert not any(0 in link or 5 in link for link in mesh.links)


def test_subjects_are_trees_of_their_own() -> None:
    a, b = leg(seed=1), leg(seed=2)
    p = np.concatenate([a.positions, b.positions + 30.0], axis=1)
    labels = tuple(f"{s}:{n}" for s in ("Ann", "Bo") for n in a.labels)
    mesh = infer_mesh(Take(p, labels, 100.0))
    assert [g.subject for g in mesh.groups if g.parent is None] == ["Ann", "Bo"]
    for i, group in enumerate(mesh.groups):
        assert {labels[m].split(":")[0] for m in group.markers} == {group.subject}
        assert group.parent is None or mesh.groups[group.parent].subject == group.subject
        assert mesh.children(i) == tuple(c for c, g in enumerate(mesh.groups) if g.parent == i)
    assert all((i < 16) == (j < 16) for i, j in mesh.links)
    assert len({g.name for g in mesh.groups}) == len(mesh.groups)


def test_a_turning_prop_is_one_group_whatever_its_size() -> None:
    corners = np.array([[x, y, z] for x in (0, 900) for y in (0, 500) for z in (0, 1100)], float)
    angle = np.linspace(0, 6, 400)
    turn = np.zeros((400, 3, 3))
    turn[:, 2, 2] = 1
    turn[:, 0, 0] = turn[:, 1, 1] = np.cos(angle)
    turn[:, 0, 1], turn[:, 1, 0] = np.sin(angle), -np.sin(angle)
    mesh = infer_mesh(Take(corners @ turn, tuple(f"Box:{i}" for i in range(8)), 100.0))
    assert [g.markers for g in mesh.groups] == [tuple(range(8))]
    assert mesh.groups[0].name == "Box"


def test_where_nothing_moves_nearness_decides() -> None:
    centres = np.array([[0, 0, 0], [0, 0, 900], [700, 0, 400]], float)
    spots = np.array([[0, 0, 0], [60, 0, 0], [0, 60, 0], [0, 0, 60]], float)
    places = (centres[:, None] + spots).reshape(-1, 3)
    labels = tuple(f"m{i}" for i in range(12))
    for frames in (1, 80):
        mesh = infer_mesh(Take(np.tile(places, (frames, 1, 1)), labels, 100.0))
        assert {g.markers for g in mesh.groups} == {(0, 1, 2, 3), (4, 5, 6, 7), (8, 9, 10, 11)}


@pytest.mark.parametrize("markers", [0, 1, 2, 3])
@pytest.mark.parametrize("frames", [0, 1, 50])
def test_few_markers_and_frames(markers: int, frames: int) -> None:
    mesh = infer_mesh(still(markers, frames))
    grouped = sorted(m for g in mesh.groups for m in g.markers)
    assert grouped == (list(range(markers)) if frames else [])


def test_nothing_seen_gives_an_empty_mesh() -> None:
    mesh = infer_mesh(Take(np.full((20, 3, 3), np.nan), ("a", "b", "c"), 100.0))
    assert mesh.groups == ()
    assert mesh.links == ()


def test_markers_never_seen_together() -> None:
    p = leg().positions.copy()
    p[:300, :8], p[300:, 8:] = np.nan, np.nan
    mesh = infer_mesh(Take(p, leg().labels, 100.0))
    assert sum(g.parent is None for g in mesh.groups) == 1
    assert all({m // 8 for m in g.markers} in ({0}, {1}) for g in mesh.groups)


def test_same_take_same_mesh() -> None:
    assert infer_mesh(leg()) == infer_mesh(leg())


def test_progress_reaches_one_and_may_cancel() -> None:
    told: list[float] = []
    infer_mesh(leg(60), progress=lambda share, doing: told.append(share))
    assert told[0] == 0.0
    assert told[-1] == 1.0

    def stop(share: float, doing: str) -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        infer_mesh(leg(60), progress=stop)


@settings(max_examples=25, deadline=None)
@given(
    markers=st.integers(1, 14),
    frames=st.integers(1, 40),
    missing=st.floats(0.0, 0.9),
    seed=st.integers(0, 10_000),
)
def test_any_take_gives_a_sound_forest(
    markers: int, frames: int, missing: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    p = rng.normal(0, 300, (frames, markers, 3))
    p[rng.random((frames, markers)) < missing] = np.nan
    labels = tuple(f"{'AB'[i % 2]}:{i}" for i in range(markers))
    mesh = infer_mesh(Take(p, labels, 100.0))
    grouped = [m for g in mesh.groups for m in g.markers]
    assert len(grouped) == len(set(grouped))
    assert len({g.name for g in mesh.groups}) == len(mesh.groups)
    for i, group in enumerate(mesh.groups):
        assert group.markers
        assert group.name
        assert (group.parent is None) == (group.parent_marker is None)
        if group.parent is not None:
            assert group.parent < i
            assert group.parent_marker in mesh.groups[group.parent].markers
    for subject in {g.subject for g in mesh.groups}:
        own = [g for g in mesh.groups if g.subject == subject]
        assert sum(g.parent is None for g in own) == 1
        # The lines of a body hold all of it together.
        reached, edges = {own[0].markers[0]}, mesh.links
        for _ in range(markers):
            reached |= {b for a, b in edges if a in reached} | {a for a, b in edges if b in reached}
        assert reached == {m for g in own for m in g.markers}
    assert len(mesh.links) == len(set(mesh.links))
    assert all(a < b for a, b in mesh.links)
