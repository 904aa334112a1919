"""A small Acclaim skeleton and a movement of it."""

from __future__ import annotations

from pathlib import Path

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
