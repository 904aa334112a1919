"""Small Acclaim skeletons and movements of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from markermend.poses.skeleton import Movement, Segment, Skeleton

ASF = """\
# a comment
:version 1.10
:units
  mass 1.0
  length 0.45   // inches
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 1 0 0
   orientation 0 0 30
:bonedata
  begin
     id 1
     name upper
     direction 0 -2 0
     length 4
     axis 10 20 30 XYZ
     dof rx ry rz
  end
  begin
     id 2
     name lower   ; the other one
     direction 1 0 0
     length 3
     axis 0 -40 15 ZYX
     dof rz rx
  end
  begin
     id 3
     name stump
     direction 0 0 1
     length 1
     axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root upper stump
    upper lower
  end
"""
AMC = """\
#!OML
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 10 20 30
upper 40 50 60
lower -20 35
2
root 4 5 6 -10 5 90
upper 1 2 3
lower 10 20
"""


def write_small(folder: Path) -> Path:
    """Write both into a folder."""
    (folder / "a.asf").write_text(ASF)
    (folder / "a_1.amc").write_text(AMC)
    return folder


def arm_and_leg(frames: int, swings: int = 1) -> Movement:
    """A trunk with an arm whose elbow bends one way, and a leg, which swing so many times."""
    segments = (
        Segment("root", -1, (0.0, 0.0, 1.0), 0.0, dofs=("tx", "ty", "tz", "rx", "ry", "rz")),
        Segment("back", 0, (0.0, 0.0, 1.0), 5.0, (10.0, 20.0, 0.0), "xyz", ("rx", "ry", "rz")),
        Segment("arm", 1, (1.0, 0.0, 0.0), 3.0, (0.0, 0.0, 30.0), "xyz", ("rx", "ry", "rz")),
        Segment("fore", 2, (1.0, 0.0, 0.0), 2.5, (0.0, 0.0, 0.0), "xyz", ("ry",)),
        Segment("hand", 3, (1.0, 0.0, 0.0), 1.0, (0.0, 0.0, 0.0), "xyz", ("ry", "rz")),
        Segment("leg", 0, (0.0, 0.0, -1.0), 6.0, (0.0, 0.0, 0.0), "xyz", ("rx", "ry", "rz", "l")),
    )
    rng = np.random.default_rng(0)
    time = np.linspace(0, 2 * np.pi * swings, frames)[:, None]
    channels = {
        s.name: rng.uniform(-30, 30, len(s.dofs))
        + 20 * np.sin(time + rng.uniform(0, 6, len(s.dofs)))
        for s in segments
    }
    channels["root"][:, :3] /= 10.0
    channels["fore"] -= 60.0
    channels["leg"][:, 3] = 0.1
    return Movement(Skeleton(segments, 50.0), channels, frames)
