"""What a row of controls can do without where room is scarce."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget


def spare(widget: QWidget) -> None:
    """Let a widget, while it is seen, not keep its panel from being made narrow."""
    policy = widget.sizePolicy()
    policy.setHorizontalPolicy(QSizePolicy.Policy.Ignored)
    widget.setSizePolicy(policy)


def show_if_it_fits(widget: QWidget, row: QHBoxLayout, width: int) -> None:
    """Show a spared widget only where the others of its row leave it all the room it wants."""
    row.invalidate()
    widget.setVisible(row.sizeHint().width() + widget.sizeHint().width() <= width)
