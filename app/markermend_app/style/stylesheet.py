"""The style sheet of the app: spacing in steps of 4 px, one type scale, calm borders.

A label with the property ``role`` set to ``"heading"``, ``"small"``, ``"muted"`` or ``"warning"``
is styled accordingly, and a button with ``role`` set to ``"primary"`` stands out.
"""

from __future__ import annotations

from string import Template

from markermend_app.style.theme import BASE_PT, HEADING_PT, SMALL_PT, Theme, blend, svg_file


def stylesheet(theme: Theme) -> str:
    """The whole sheet for a theme."""
    colors = {
        name: getattr(theme, name).name()
        for name in (
            "window",
            "panel",
            "plot",
            "raised",
            "border",
            "text",
            "muted",
            "accent",
            "on_accent",
            "warning",
        )
    }
    arrow = theme.muted
    return _SHEET.substitute(
        colors,
        hover=blend(theme.raised, theme.text, 0.07).name(),
        pressed=blend(theme.raised, theme.text, 0.14).name(),
        checked=blend(theme.raised, theme.accent, 0.28).name(),
        row=blend(theme.panel, theme.text, 0.05).name(),
        chosen=blend(theme.panel, theme.accent, 0.24).name(),
        track=blend(theme.window, theme.text, 0.13).name(),
        dimmed=blend(theme.muted, theme.window, 0.4).name(),
        accent_hover=blend(theme.accent, theme.text, 0.15).name(),
        handle=blend(theme.border, theme.text, 0.12).name(),
        base=BASE_PT,
        small=SMALL_PT,
        heading=HEADING_PT,
        down=svg_file("chevron-down", arrow),
        up=svg_file("chevron-up", arrow),
        right=svg_file("chevron-right", arrow),
        close=svg_file("reject", arrow, tight=True),
        float=svg_file("frame", arrow, tight=True),
        check=svg_file("accept", theme.on_accent),
    )


_SHEET = Template("""
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QMainWindow, QDialog { background: $window; }
#palette { background: $panel; border: 1px solid $handle; }
QMainWindow::separator { background: $window; width: 4px; height: 4px; }
QMainWindow::separator:hover { background: $accent; }
QSplitter::handle { background: $window; }
QSplitter::handle:hover { background: $accent; }

QLabel[role="heading"] { font-size: ${heading}pt; font-weight: 600; }
QLabel[role="small"] { font-size: ${small}pt; color: $muted; }
QLabel[role="muted"] { color: $muted; }
QLabel[role="warning"] { color: $warning; }

QToolTip { background: $raised; color: $text; border: 1px solid $border; padding: 4px; }

QMenuBar { background: $window; padding: 0 4px; border-bottom: 1px solid $border; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: $hover; }
QMenu { background: $panel; border: 1px solid $border; padding: 4px; }
QMenu::item { padding: 4px 24px 4px 8px; border-radius: 4px; }
QMenu::icon { padding-left: 4px; }
QMenu::item:selected { background: $chosen; color: $text; }
QMenu::item:disabled { color: $dimmed; }
QMenu::separator { height: 1px; background: $border; margin: 4px 8px; }

QToolBar { background: $window; border: none; border-bottom: 1px solid $border;
    padding: 4px; spacing: 4px; }
QToolBar::separator { background: $border; width: 1px; margin: 4px; }
QToolButton { background: transparent; border: 1px solid transparent; border-radius: 4px;
    padding: 4px; color: $text; }
QToolButton:hover { background: $hover; }
QToolButton:pressed { background: $pressed; }
QToolButton:checked { background: $checked; border-color: $accent; }
QToolButton:focus { border: 2px solid $accent; padding: 3px; }
QToolButton:checked:focus { border-color: $text; }
QToolButton:disabled { color: $dimmed; }
QToolButton:checked:disabled { border-color: $border; }
QToolButton::menu-indicator { image: none; }

QPushButton { background: $raised; border: 1px solid $border; border-radius: 4px;
    padding: 4px 12px; min-height: 16px; color: $text; }
QPushButton:hover { background: $hover; }
QPushButton:pressed { background: $pressed; }
QPushButton:checked { background: $checked; border-color: $accent; }
QPushButton:focus { border: 2px solid $accent; padding: 3px 11px; }
QPushButton:checked:focus { border-color: $text; }
QPushButton:disabled { color: $dimmed; }
QPushButton:default, QPushButton[role="primary"] { background: $accent; color: $on_accent;
    border-color: $accent; }
QPushButton:default:focus, QPushButton[role="primary"]:focus { border-color: $text; }
QPushButton:default:hover, QPushButton[role="primary"]:hover { background: $accent_hover; }
QPushButton:default:disabled, QPushButton[role="primary"]:disabled { background: $raised;
    color: $dimmed; border-color: $border; }

QLineEdit, QPlainTextEdit, QTextEdit, QSpinBox, QDoubleSpinBox, QComboBox {
    background: $panel; border: 1px solid $border; border-radius: 4px; padding: 3px 8px;
    min-height: 16px; selection-background-color: $accent; selection-color: $on_accent; }
QLineEdit:focus, QPlainTextEdit:focus, QTextEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus,
QComboBox:focus { border: 2px solid $accent; padding: 2px 7px; }
QLineEdit:disabled, QSpinBox:disabled, QDoubleSpinBox:disabled, QComboBox:disabled {
    color: $dimmed; background: $window; }
QComboBox { combobox-popup: 0; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url("$down"); width: 12px; height: 12px; }
QComboBox QAbstractItemView, QComboBox QAbstractItemView:focus { background: $panel;
    border: 1px solid $border; padding: 0; outline: 0;
    selection-background-color: $chosen; selection-color: $text; }
QSpinBox::up-button, QDoubleSpinBox::up-button, QSpinBox::down-button,
QDoubleSpinBox::down-button { border: none; background: transparent; width: 16px; }
QSpinBox::up-arrow, QDoubleSpinBox::up-arrow { image: url("$up"); width: 10px; height: 10px; }
QSpinBox::down-arrow, QDoubleSpinBox::down-arrow { image: url("$down"); width: 10px;
    height: 10px; }

QCheckBox, QRadioButton { spacing: 8px; }
QCheckBox::indicator, QTreeView::indicator, QTableView::indicator, QListView::indicator {
    width: 13px; height: 13px; border: 1px solid $handle; border-radius: 3px; background: $panel; }
QCheckBox::indicator:hover, QTreeView::indicator:hover { border-color: $accent; }
QCheckBox::indicator:checked, QTreeView::indicator:checked, QTableView::indicator:checked,
QListView::indicator:checked { background: $accent; border-color: $accent;
    image: url("$check"); }
QCheckBox::indicator:indeterminate, QTreeView::indicator:indeterminate {
    background: $checked; border-color: $accent; }
QRadioButton::indicator { width: 11px; height: 11px; border: 1px solid $handle;
    border-radius: 6px; background: $panel; }
QRadioButton::indicator:hover { border-color: $accent; }
QRadioButton::indicator:checked { width: 5px; height: 5px; border: 4px solid $accent;
    border-radius: 6px; background: $on_accent; }
QRadioButton::indicator:disabled { border-color: $dimmed; }
QCheckBox:focus, QRadioButton:focus { color: $accent; }
QCheckBox::indicator:focus, QRadioButton::indicator:focus { border-color: $accent; }

QGroupBox { border: 1px solid $border; border-radius: 4px; margin-top: 16px; padding: 8px; }
QGroupBox::title { subcontrol-origin: margin; left: 8px; padding: 0 4px; font-weight: 600; }

QDockWidget { font-weight: 600; titlebar-close-icon: url("$close");
    titlebar-normal-icon: url("$float"); }
QDockWidget::title { background: $raised; border: 1px solid $border; padding: 4px 8px;
    text-align: left; }
QDockWidget::close-button, QDockWidget::float-button { border: none; border-radius: 4px;
    padding: 0; icon-size: 12px; }
QDockWidget::close-button:hover, QDockWidget::float-button:hover { background: $pressed; }

QTreeView, QTableView, QListView { background: $panel; border: 1px solid $border; outline: 0;
    gridline-color: $border; alternate-background-color: $row;
    selection-background-color: $chosen; selection-color: $text; padding: 1px; }
QTreeView:focus, QTableView:focus, QListView:focus { border: 2px solid $accent; padding: 0; }
QTreeView::item, QTableView::item, QListView::item { padding: 2px 4px; min-height: 20px; }
QTreeView::item:hover, QTableView::item:hover, QListView::item:hover { background: $row; }
QTreeView::item:selected, QTableView::item:selected, QListView::item:selected {
    background: $chosen; color: $text; }
QTreeView::branch { background: transparent; }
QTreeView::branch:has-children:closed { image: url("$right"); }
QTreeView::branch:has-children:open { image: url("$down"); }
QHeaderView { background: $raised; border: none; }
QHeaderView::section { background: $raised; color: $muted; border: none;
    border-right: 1px solid $border; border-bottom: 1px solid $border; padding: 4px 8px;
    font-size: ${small}pt; font-weight: 600; }
QHeaderView::section:hover { color: $text; }
QHeaderView::down-arrow { image: url("$down"); width: 10px; height: 10px; }
QHeaderView::up-arrow { image: url("$up"); width: 10px; height: 10px; }
QTableCornerButton::section { background: $raised; border: none; }

QTabWidget::pane { border: 1px solid $border; }
QTabBar::tab { background: transparent; color: $muted; padding: 4px 12px;
    border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: $text; }
QTabBar::tab:selected { color: $text; border-bottom-color: $accent; }

PlotStack, Inspector QScrollArea { border: 1px solid transparent; padding: 1px; }
Inspector Promise { border: none; padding: 0; }
PlotStack:focus, Inspector QScrollArea:focus { border: 2px solid $accent; padding: 0; }
QScrollBar { background: transparent; border: none; }
QScrollBar:vertical { width: 12px; }
QScrollBar:horizontal { height: 12px; }
QScrollBar::handle { background: $handle; border-radius: 4px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 24px; }
QScrollBar::handle:horizontal { min-width: 24px; }
QScrollBar::handle:hover { background: $muted; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }

QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: $track; }
QSlider::sub-page:horizontal { height: 4px; border-radius: 2px; background: $accent; }
QSlider::handle:horizontal { width: 12px; height: 12px; margin: -4px 0; border-radius: 6px;
    background: $accent; }
QSlider::sub-page:horizontal:disabled, QSlider::handle:horizontal:disabled {
    background: $dimmed; }
QSlider:focus { border: 1px solid $accent; border-radius: 4px; }

QProgressBar { background: $track; border: none; border-radius: 4px; min-height: 8px;
    max-height: 16px; text-align: center; font-size: ${small}pt; color: $text; }
QProgressBar::chunk { background: $accent; border-radius: 4px; }
QStatusBar { background: $window; border-top: 1px solid $border; color: $muted;
    font-size: ${small}pt; }
QStatusBar::item { border: none; }

QFrame#floatingButtons { background: $raised; border: 1px solid $border; border-radius: 4px; }
QFrame#notice { background: $raised; border-bottom: 1px solid $border; }
QToolButton#overviewMode { font-size: ${small}pt; padding: 0 2px; color: $muted; }
QPushButton#decision { padding: 4px; }
QToolButton#back { border-color: $accent; background: $checked; padding: 1px 6px; }
QLabel#readout { background: $raised; border: 1px solid $border; border-radius: 4px;
    padding: 2px 8px; font-size: ${small}pt; }
""")
