"""A take as a tree of rows: bodies, groups, markers, and what else the file holds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from markermend.artifact import Kind
from markermend.mesh import Mesh
from markermend.take import Take, is_unlabelled
from markermend_app.panels.plots.beside import analog_key, kind_name, point_key
from markermend_app.telling import told_group
from markermend_app.words import tr


@dataclass(eq=False)
class Node:
    """A row: a marker when it has a label, a channel when it has a key, else it holds rows."""

    name: str
    icon: str = ""
    label: str = ""
    key: str = ""
    selects: bool = False
    note: str = ""
    parent: Node | None = None
    rows: list[Node] = field(default_factory=list)
    counts: Counter[Kind] = field(default_factory=Counter)
    own: Counter[Kind] = field(default_factory=Counter)
    missing: float | None = None

    def add(self, node: Node) -> Node:
        """Put a row under this one."""
        node.parent = self
        self.rows.append(node)
        return node

    def markers(self) -> list[Node]:
        """Markers directly under this row, or itself."""
        return [self] if self.label else [n for n in self.rows if n.label]

    def below(self) -> Iterable[Node]:
        """Every row under this one, however deep."""
        for node in self.rows:
            yield node
            yield from node.below()

    def all_markers(self) -> list[Node]:
        """Itself where it is a marker, and every marker under this row, however deep."""
        own = [self] if self.label else []
        return own + [m for n in self.rows for m in n.all_markers()]


def grow(take: Take, mesh: Mesh | None) -> Node:
    """Arrange a take's trajectories by body and group; the rest stands apart."""
    root = Node("")
    placed: set[int] = set()
    subjects = take.subjects
    bodies = {
        s: root.add(Node(s or tr("Without subject"), "body"))
        for s in subjects
        if len(subjects) > 1 or s
    }
    groups: list[Node] = []
    for group in mesh.groups if mesh is not None else ():
        if group.parent is not None:
            above = groups[group.parent]
        else:
            above = bodies.get(group.subject, root)
        if take.skeleton:
            # A joint holds those that hang on it.
            (joint,) = group.markers
            groups.append(above.add(_marker(take, joint)))
            placed.add(joint)
            continue
        node = above.add(Node(told_group(group.name), "group", selects=True))
        groups.append(node)
        for column in group.markers:
            node.add(_marker(take, column))
            placed.add(column)
    for node in groups if not take.skeleton else ():
        node.rows.sort(key=lambda n: not n.label)
    rest = [i for i in range(take.markers) if i not in placed]
    for i in (i for i in rest if not is_unlabelled(take.labels[i])):
        bodies.get(take.subject(take.labels[i]), root).add(_marker(take, i))
    unlabelled = [i for i in rest if is_unlabelled(take.labels[i])]
    if unlabelled:
        section = root.add(_section(tr("Unlabelled"), len(unlabelled), "unlabelled"))
        for i in unlabelled:
            section.add(_marker(take, i))
    _add_others(root, take)
    return root


def _section(title: str, count: int, icon: str) -> Node:
    """Row above what is no labelled marker, with how many there are."""
    return Node(f"{title} ({count})", icon)


def _marker(take: Take, column: int) -> Node:
    """Row of a marker; the body's name is not repeated."""
    label = take.labels[column]
    return Node(label.rpartition(":")[2] or label, label=label)


def _add_others(root: Node, take: Take) -> None:
    """Add points that are not markers and analog channels: to be seen, not to be reviewed."""
    if take.points is not None and take.points.labels:
        section = root.add(_section(tr("Other points"), len(take.points.labels), "point"))
        by_kind: dict[str, Node] = {}
        for i, (label, kind) in enumerate(zip(take.points.labels, take.points.kinds, strict=True)):
            if kind not in by_kind:
                unit = take.points.units.get(kind)
                by_kind[kind] = section.add(Node(_in_unit(kind_name(kind), unit)))
            note = tr("Kept as it is; not a marker")
            by_kind[kind].add(Node(label, key=point_key(i), note=note))
    if take.analog is not None and take.analog.labels:
        section = root.add(_section(tr("Analog channels"), len(take.analog.labels), "curves"))
        channels = zip(take.analog.labels, take.analog.units, strict=True)
        for i, (label, unit) in enumerate(channels):
            section.add(Node(_in_unit(label, unit), key=analog_key(i), note=tr("Kept as it is")))


def _in_unit(name: str, unit: str | None) -> str:
    """A name with the unit of its values, if there is one."""
    return f"{name} ({unit})" if unit else name


def flatten(root: Node) -> Node:
    """The same markers without their tree."""
    flat = Node("")
    for node in root.all_markers():
        flat.add(Node(node.label, label=node.label, counts=node.counts, missing=node.missing))
    return flat
