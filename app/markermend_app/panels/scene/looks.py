"""How markers and segments of the 3D view are coloured, chosen from a menu and remembered."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QMenu

from markermend.arrays import FloatArray
from markermend.mesh import Mesh
from markermend_app import settings
from markermend_app.style import theme
from markermend_app.words import tr

COLOURS = ("plain", "group", "damage")
_HUES = 12


class Looks:
    """What the 3D view shows besides the markers.

    Attributes
    ----------
    colours : one of ``COLOURS``
    ghost : draw the other version, before or after the repairs
    lengths : draw segments red whose length is off
    """

    def __init__(self) -> None:
        colours = settings.text("scene_colours", COLOURS[0])
        self.colours = colours if colours in COLOURS else COLOURS[0]
        self.ghost = settings.flag("scene_ghost", True)
        self.lengths = settings.flag("scene_lengths", True)

    @property
    def least(self) -> float:
        """Least radius of a marker, pixels: colours need more to be told apart."""
        return 2.0 if self.colours == COLOURS[0] else 4.0

    def set_colours(self, colours: str) -> None:
        """Colour markers in another way."""
        self.colours = colours
        settings.remember("scene_colours", colours)

    def set_ghost(self, shown: bool) -> None:
        """Draw the other version, or not."""
        self.ghost = shown
        settings.remember("scene_ghost", shown)

    def set_lengths(self, shown: bool) -> None:
        """Draw segments that are off in red, or not."""
        self.lengths = shown
        settings.remember("scene_lengths", shown)

    def fill(
        self,
        menu: QMenu,
        vertical: int | None,
        set_vertical: Callable[[int | None], None],
        changed: Callable[[], None],
        view: Callable[[QMenu], None],
        *,
        joints: bool = False,
    ) -> None:
        """Offer everything in a menu.

        Parameters
        ----------
        menu : where to
        vertical, set_vertical : which axis points up, None for the take's own
        changed : called when something else is to be seen
        view : adds the views to look from
        joints : joints are shown, not markers
        """
        one = tr("Joints in one colour") if joints else tr("Markers in one colour")

        def add(text: str, checked: bool, do: Callable[[], object], to: QMenu = menu) -> None:
            action = to.addAction(text)
            action.setCheckable(True)
            action.setChecked(checked)
            action.triggered.connect(lambda _=False: do())
            action.triggered.connect(lambda _=False: changed())

        for colours, text in zip(
            COLOURS,
            (one, tr("Coloured by group"), tr("Coloured by damage")),
            strict=True,
        ):
            add(text, self.colours == colours, partial(self.set_colours, colours))
        menu.addSeparator()
        add(tr("Ghost of the other version"), self.ghost, lambda: self.set_ghost(not self.ghost))
        add(
            tr("Segments of wrong length in red"),
            self.lengths,
            lambda: self.set_lengths(not self.lengths),
        )
        menu.addSeparator()
        view(menu)
        up = menu.addMenu(tr("Axis that points up"))
        for text, axis in ((tr("As the take suggests"), None), ("X", 0), ("Y", 1), ("Z", 2)):
            add(text, vertical == axis, partial(set_vertical, axis), up)


def marker_colours(
    looks: Looks, markers: int, mesh: Mesh | None, damage: FloatArray
) -> list[QColor]:
    """Colour of each marker that is not shown in the plots.

    Parameters
    ----------
    looks : how they are to be coloured
    markers : how many there are
    mesh : groups, if they are known
    damage : (markers,) share of their frames that are damaged
    """
    plain = theme.current().points
    if looks.colours == "group" and mesh is not None:
        colours = [theme.current().bones] * markers
        for i, group in enumerate(mesh.groups):
            for column in group.markers:
                colours[column] = _hue(i)
        return colours
    if looks.colours == "damage":
        # Most takes hold little damage: the root gives the small shares most of the colours.
        level = np.sqrt(np.clip(damage, 0.0, 1.0))
        return [_ramp(share, plain) for share in level.tolist()]
    return [plain] * markers


def _hue(group: int) -> QColor:
    """A colour of its own for each of a dozen groups; neighbours in the list lie far apart."""
    dark = theme.current().dark
    hue = (group * 5 % _HUES) / _HUES
    return QColor.fromHslF(hue, 0.62, 0.66 if dark else 0.42)


def _ramp(share: float, plain: QColor) -> QColor:
    """From plain over yellow to red."""
    kinds = list(theme.current().kinds.values())
    yellow, red = kinds[2], kinds[1]
    if share < 0.5:
        return theme.blend(plain, yellow, 2 * share)
    return theme.blend(yellow, red, 2 * share - 1)
