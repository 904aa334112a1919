"""The looks: every colour of the app, in light, dark and high contrast."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from PySide6.QtGui import QColor

from markermend.artifact import Kind
from markermend.class_colours import ON_DARK, ON_LIGHT


@dataclass(frozen=True)
class Theme:
    """The colours of one look.

    Attributes
    ----------
    name, dark : which look this is
    window, panel, plot : backgrounds of the window, of lists and fields, and of drawings
    raised : background of buttons, headers and dock titles
    border : lines between things
    text, muted : what is read, and what is read second
    grid : lines within drawings
    bones, points : segments and markers of the body that are not shown in the plots
    accent, on_accent : what is active or proposed, and text upon it
    selection : what the operator has swept over
    original : samples as they were opened
    warning : what needs attention
    flag : events of the file
    axes : by axis name, x red, y green, z blue
    kinds : by class of artifact, told apart by colour-blind people too (after Okabe and Ito)
    markers : curves of shown markers, in the order they are shown
    """

    name: str
    dark: bool
    window: QColor
    panel: QColor
    plot: QColor
    raised: QColor
    border: QColor
    text: QColor
    muted: QColor
    grid: QColor
    bones: QColor
    points: QColor
    accent: QColor
    on_accent: QColor
    selection: QColor
    original: QColor
    warning: QColor
    flag: QColor
    axes: Mapping[str, QColor]
    kinds: Mapping[Kind, QColor]
    markers: tuple[QColor, ...]


def _kinds(gap: str, peak: str, noise: str, step: str, slow: str) -> Mapping[Kind, QColor]:
    """Colours by class."""
    names = (gap, peak, noise, step, slow)
    return MappingProxyType({k: QColor(c) for k, c in zip(Kind, names, strict=True)})


def _axes(x: str, y: str, z: str) -> Mapping[str, QColor]:
    """Colours by axis."""
    return MappingProxyType({"x": QColor(x), "y": QColor(y), "z": QColor(z)})


LIGHT = Theme(
    name="light",
    dark=False,
    window=QColor("#eef0f3"),
    panel=QColor("#ffffff"),
    plot=QColor("#ffffff"),
    raised=QColor("#f7f8fa"),
    border=QColor("#d3d8df"),
    text=QColor("#1d2430"),
    muted=QColor("#5d6776"),
    grid=QColor("#dfe3e9"),
    bones=QColor("#9ea4ad"),
    points=QColor("#73777f"),
    accent=QColor("#4a55c9"),
    on_accent=QColor("#ffffff"),
    selection=QColor("#7a8299"),
    original=QColor("#a2a9b4"),
    warning=QColor("#a8570a"),
    flag=QColor("#6a4fb3"),
    axes=_axes("#c62f2f", "#22802f", "#2563c9"),
    kinds=_kinds(*ON_LIGHT.values()),
    markers=tuple(
        QColor(c)
        for c in ("#2b3a55", "#0f7c8a", "#8a5a14", "#7b3fa0", "#4d7a1e", "#a83256", "#5b6573")
    ),
)

DARK = Theme(
    name="dark",
    dark=True,
    window=QColor("#1c1f24"),
    panel=QColor("#22262c"),
    plot=QColor("#191c20"),
    raised=QColor("#2a2f36"),
    border=QColor("#3a404a"),
    text=QColor("#e4e7ec"),
    muted=QColor("#9aa3b0"),
    grid=QColor("#30363e"),
    bones=QColor("#666d76"),
    points=QColor("#979a9e"),
    accent=QColor("#8e98ff"),
    on_accent=QColor("#14171c"),
    selection=QColor("#98a2b8"),
    original=QColor("#6b7380"),
    warning=QColor("#f0b45a"),
    flag=QColor("#b9a5f5"),
    axes=_axes("#ff7070", "#62c972", "#6fa8ff"),
    kinds=_kinds(*ON_DARK.values()),
    markers=tuple(
        QColor(c)
        for c in ("#d7e0f0", "#5cd0dc", "#e0b070", "#c79bf0", "#a8d66a", "#f58ca8", "#a4afbf")
    ),
)

CONTRAST_LIGHT = replace(
    LIGHT,
    name="contrast-light",
    window=QColor("#ffffff"),
    raised=QColor("#ffffff"),
    border=QColor("#000000"),
    text=QColor("#000000"),
    muted=QColor("#262626"),
    grid=QColor("#b0b0b0"),
    bones=QColor("#404040"),
    points=QColor("#202020"),
    accent=QColor("#0000c8"),
    selection=QColor("#303030"),
    original=QColor("#6e6e6e"),
    warning=QColor("#8a3c00"),
    flag=QColor("#4b0082"),
    axes=_axes("#b00000", "#006400", "#0000b4"),
    kinds=_kinds("#0064a8", "#b03000", "#806000", "#006e4e", "#9c2c7c"),
    markers=tuple(
        QColor(c)
        for c in ("#000000", "#00606c", "#6c4000", "#5c1c86", "#345c00", "#8c1040", "#404040")
    ),
)

CONTRAST_DARK = replace(
    DARK,
    name="contrast-dark",
    window=QColor("#000000"),
    panel=QColor("#000000"),
    plot=QColor("#000000"),
    raised=QColor("#000000"),
    border=QColor("#ffffff"),
    text=QColor("#ffffff"),
    muted=QColor("#e0e0e0"),
    grid=QColor("#5a5a5a"),
    bones=QColor("#c0c0c0"),
    points=QColor("#e0e0e0"),
    accent=QColor("#ffe000"),
    on_accent=QColor("#000000"),
    selection=QColor("#d0d0d0"),
    original=QColor("#a0a0a0"),
    warning=QColor("#ffb030"),
    flag=QColor("#d8c8ff"),
    axes=_axes("#ff8080", "#70ff80", "#80b8ff"),
    kinds=_kinds("#60c8ff", "#ff8050", "#ffd840", "#40e8b0", "#ff9cdc"),
    markers=tuple(
        QColor(c)
        for c in ("#ffffff", "#60f0ff", "#ffc070", "#dcb0ff", "#b8ff70", "#ff90b8", "#d0d0d0")
    ),
)

LOOKS: Mapping[str, Theme] = MappingProxyType(
    {look.name: look for look in (LIGHT, DARK, CONTRAST_LIGHT, CONTRAST_DARK)}
)


def colour_blind(look: Theme) -> Theme:
    """A look whose axes and classes differ in brightness too, not by red and green alone."""
    if look.dark:
        axes, kinds = _axes(*_SAFE_AXES_DARK), _kinds(*_SAFE_DARK)
    else:
        axes, kinds = _axes(*_SAFE_AXES_LIGHT), _kinds(*_SAFE_LIGHT)
    return replace(look, axes=axes, kinds=kinds)


# After Okabe and Ito (2008), some darkened or lightened until any two can be told apart with every
# kind of colour blindness.
_SAFE_LIGHT = ("#4185d4", "#ff7607", "#6a4600", "#004337", "#c17fa4")
_SAFE_DARK = ("#1e73cb", "#be7c2d", "#ffef66", "#56fff0", "#7b6672")
_SAFE_AXES_LIGHT = ("#d55e00", "#1b1b1b", "#0072b2")
_SAFE_AXES_DARK = ("#ff9a3d", "#f2f2f2", "#4aa3ff")
