"""Recordings that tell no unit of length: the size of the body does, or whoever reads them."""

from __future__ import annotations

import numpy as np
import pytest

import markermend as mm
from markermend.cli import main
from markermend.errors import FileFormatError, MethodError

# Shares of a person's height, from the parent (Drillis and Contini), parents first.
LIMB = {
    "UpLeg": ("Hips", (0.06, 0, 0)),
    "Leg": ("UpLeg", (0, -0.245, 0)),
    "Foot": ("Leg", (0, -0.246, 0)),
    "Toe": ("Foot", (0, -0.04, 0.1)),
    "Shoulder": ("Chest", (0.03, 0.1, 0)),
    "Arm": ("Shoulder", (0.1, 0, 0)),
    "ForeArm": ("Arm", (0.186, 0, 0)),
    "Hand": ("ForeArm", (0.146, 0, 0)),
    "Index": ("Hand", (0.1, 0, 0)),
}
UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
CMU = 25.4 / 0.45
WORDS = {
    1.0: "millimetres",
    10.0: "centimetres",
    1000.0: "metres",
    25.4: "inches",
    CMU: "1/0.45 inches (as in files of the CMU database)",
}


def body(*, fingers=True, legs=True):
    """Joints with parent and place from it, of a body as tall as 1."""
    found = {"Hips": ("", (0, 0, 0)), "Spine": ("Hips", (0, 0.1, 0))}
    found |= {"Chest": ("Spine", (0, 0.1, 0)), "Neck": ("Chest", (0, 0.12, 0))}
    found["Head"] = ("Neck", (0, 0.1, 0))
    for side, sign in (("Left", 1), ("Right", -1)):
        for joint, (above, (x, y, z)) in LIMB.items():
            if (joint != "Index" or fingers) and (legs or joint not in ("UpLeg", *list(LIMB)[1:4])):
                trunk = above in found
                found[side + joint] = (above if trunk else side + above, (sign * x, y, z))
    return found


def bvh(path, height, each, **parts):
    """A body so tall, in units of so many mm."""
    joints, scale = body(**parts), height / each

    def lines(name):
        root = name == "Hips"
        place = " ".join(f"{scale * value:.6f}" for value in joints[name][1])
        below = [child for child, (above, _) in joints.items() if above == name]
        moves = "6 Xposition Yposition Zposition" if root else "3"
        yield f"{'ROOT' if root else 'JOINT'} {name}\n{{\nOFFSET {place}"
        yield f"CHANNELS {moves} Zrotation Xrotation Yrotation"
        for child in below:
            yield from lines(child)
        if not below:
            yield "End Site\n{\nOFFSET 0 0 0\n}"
        yield "}"

    poses = [f"0 {0.53 * scale} {n * scale / 100}" + " 0" * (3 * len(joints)) for n in range(3)]
    head = ["HIERARCHY", *lines("Hips"), "MOTION", "Frames: 3", "Frame Time: 0.033333"]
    path.write_text("\n".join([*head, *poses]) + "\n")
    return path


def csv(path, height, each, head="x,y,z"):
    joints, places = body(), dict[str, np.ndarray]()
    for name, (above, place) in joints.items():
        places[name] = height / each * np.array(place) + (places[above] if above else 0.0)
    rows = [f"frame,joint,parent,{head}"]
    for n in range(4):
        rows += [
            f"{n},{name},{joints[name][0]},{','.join(f'{v + n / each:.7g}' for v in place)}"
            for name, place in places.items()
        ]
    path.write_text("\n".join(rows) + "\n")
    return path


def tall(pose):
    """How far head and toes are apart over a body's height."""
    ends = pose.positions[:, [pose.index("Head"), pose.index("LeftFoot")]]
    return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean() / 0.9132)


@pytest.mark.parametrize("fingers", [True, False])
@pytest.mark.parametrize("each", [*UNITS.values(), CMU])
@pytest.mark.parametrize("height", [1100.0, 1400.0, 1750.0, 2000.0])
def test_the_size_of_a_body_tells_the_unit(tmp_path, height, each, fingers):
    if each == CMU and height < 1400:
        pytest.skip("its subjects are grown up")
    pose = mm.read_pose(bvh(tmp_path / "k.bvh", height, each, fingers=fingers))
    assert tall(pose) == pytest.approx(height, rel=1e-3)
    assert pose.positions[0, 0, 1] == pytest.approx(0.53 * height, rel=1e-3)
    assert pose.warnings == (f"The file tells no unit; {WORDS[each]} were assumed.",)
    if not fingers:
        return
    pose = mm.read_pose(csv(tmp_path / "k.csv", height, each))
    assert tall(pose) == pytest.approx(height, rel=1e-3)
    said = f"The file tells no unit of length; by the size of things {WORDS[each]} were assumed."
    assert (said in pose.warnings) == (each != 1.0)


@pytest.mark.parametrize("each", [1.0, 10.0, 1000.0])
def test_of_half_a_body_the_bones_tell_it_as_before(tmp_path, each):
    pose = mm.read_pose(bvh(tmp_path / "k.bvh", 1200.0, each, legs=False))
    assert pose.warnings == (f"The file tells no unit; {WORDS[each]} were assumed.",)


@pytest.mark.parametrize("unit", UNITS)
def test_who_reads_a_file_may_tell_its_unit(tmp_path, unit):
    small = bvh(tmp_path / "k.bvh", 300.0, UNITS[unit])
    pose = mm.read_pose(small, unit=unit)
    assert tall(pose) == pytest.approx(300.0, rel=1e-3)
    assert pose.warnings == ()
    pose = mm.read_pose(csv(tmp_path / "k.csv", 300.0, UNITS[unit]), unit=unit)
    assert tall(pose) == pytest.approx(300.0, rel=1e-3)
    # It is written so that it is read again without.
    for name in ("again.csv", "again.bvh"):
        if name == "again.bvh":
            pose = mm.read_pose(small, unit=unit)
        mm.write_pose(pose, tmp_path / name)
        assert tall(mm.read_pose(tmp_path / name)) == pytest.approx(300.0, rel=1e-3)


@pytest.mark.parametrize("each", [*UNITS.values(), CMU])
def test_a_table_in_another_unit_is_written_over_in_it(tmp_path, each):
    path = csv(tmp_path / "k.csv", 1700.0, each)
    pose = mm.read_pose(path)
    mm.write_pose(pose, tmp_path / "same.csv")
    assert (tmp_path / "same.csv").read_bytes() == path.read_bytes()
    places = pose.positions.copy()
    places[1, 3] += 5.0
    mm.write_pose(pose.with_samples(places, pose.rotations), tmp_path / "moved.csv")
    np.testing.assert_allclose(mm.read_pose(tmp_path / "moved.csv").positions, places, atol=1e-3)


@pytest.mark.parametrize("height", [20.0, 300.0, 500.0, 800.0, 1000.0, 2000.0, 2600.0, 30000.0])
def test_a_body_of_any_size_is_written_in_a_unit_that_it_is_read_in(tmp_path, height):
    pose = mm.read_pose(bvh(tmp_path / "k.bvh", height, 1.0), unit="mm")
    mm.write_pose(pose, tmp_path / "again.bvh")
    again = mm.read_pose(tmp_path / "again.bvh")
    assert tall(again) == pytest.approx(tall(pose), rel=1e-4)


def test_a_unit_that_a_file_tells_is_not_told_again(tmp_path):
    path = csv(tmp_path / "k.csv", 1700.0, 10.0, "x (cm),y (cm),z (cm)")
    assert tall(mm.read_pose(path, unit="cm")) == pytest.approx(1700.0, rel=1e-3)
    with pytest.raises(FileFormatError) as told:
        mm.read_pose(path, unit="m")
    said = "The columns of k.csv tell their unit of length; leave out the other."
    assert str(told.value) == said
    with pytest.raises(MethodError, match="“league” is no unit of length; name mm, cm, m, in, ft"):
        mm.read_pose(path, unit="league")


def test_the_command_line_takes_a_unit(tmp_path, capsys):
    path, out = csv(tmp_path / "k.csv", 300.0, 10.0), tmp_path / "out.csv"
    assert main(["denoise", str(path), "--unit", "cm", "-o", str(out)]) == 0
    assert tall(mm.read_pose(out)) == pytest.approx(300.0, rel=0.02)
    assert "assumed" not in capsys.readouterr().err.replace("30 Hz was assumed", "")
    for words in (["a.amc", "-o", str(tmp_path / "b.csv")], ["-", "-o", "-"]):
        assert main(["denoise", *words, "--unit", "m"]) == 1
        assert "--unit has no effect on" in capsys.readouterr().err
