"""Functional body mesh: which markers move as one rigid body, and how the bodies hang together.

>>> mesh = infer_mesh(take)
>>> [group.name for group in mesh.groups]
['Trunk', 'Head', 'Left upper arm', ...]
"""

from markermend.mesh.infer import infer_mesh
from markermend.mesh.model import Group, Mesh

__all__ = ["Group", "Mesh", "infer_mesh"]
