"""The window in other languages: everything can be translated, and the German is whole."""

from __future__ import annotations

import ast
import importlib
import re
import subprocess
import xml.etree.ElementTree as ET
from importlib.resources import files
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, Qt, QTranslator
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QComboBox, QLineEdit, QWidget

from markermend.mesh import infer_mesh
from markermend.review.file import open_session
from markermend_app import languages, settings
from markermend_app.actions import shortcuts
from markermend_app.actions.shortcut_sheet import ShortcutSheet
from markermend_app.dialogs.preferences import Preferences
from markermend_app.panels.quality_model import MARKER
from markermend_app.style import theme
from markermend_app.window import MainWindow

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(str(files("markermend_resources"))) / "translations"
LEAST_DONE = 0.9


def messages(ts):
    """Context, source and translation of each message."""
    root = ET.parse(ts).getroot()
    return [
        (context.findtext("name"), m.findtext("source"), m.find("translation"))
        for context in root.findall("context")
        for m in context.findall("message")
    ]


@pytest.fixture
def german(qapp):
    """The app in German for one test."""
    settings.remember(languages.SETTING, "de")
    loaded = languages.install(qapp)
    yield
    for translator in loaded:
        qapp.removeTranslator(translator)


@pytest.fixture
def open_window(qtbot, damaged, tmp_path):
    """Make a window with a take under review."""

    def make():
        take, truth = damaged
        window = MainWindow()

        def quiet(window):
            window.document.session.mark_exported()

        qtbot.addWidget(window, before_close_func=quiet)
        window.document.open(open_session(take, folder=tmp_path), infer_mesh(take))
        window.document.decisions.add_detected(truth, "truth")
        window.document.step(1)
        return window

    return make


@pytest.mark.parametrize("ts", sorted(FOLDER.glob("*.ts")), ids=lambda p: p.stem)
def test_placeholders_survive_translation(ts):
    for _context, source, translation in messages(ts):
        if translation.get("type") != "unfinished":
            wanted, had = (re.findall(r"\{[^}]*\}", t) for t in (source, translation.text))
            assert sorted(wanted) == sorted(had), source


@pytest.mark.parametrize("ts", sorted(FOLDER.glob("*.ts")), ids=lambda p: p.stem)
def test_what_is_loaded_is_what_was_translated(ts):
    translator = QTranslator()
    assert translator.load(str(ts.with_suffix(".qm")))
    for context, source, translation in messages(ts):
        if translation.get("type") != "unfinished":
            assert translator.translate(context or "", source) == translation.text


def spoken(node, inside=""):
    """Context and text of every string that code asks a translation of."""
    if isinstance(node, ast.ClassDef):
        inside = node.name
    if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
        if isinstance(node.func, ast.Name) and node.func.id in ("tr", "_tr"):
            yield "", node.args[0].value
        elif isinstance(node.func, ast.Attribute) and node.func.attr == "tr":
            yield inside, node.args[0].value
    for part in ast.iter_child_nodes(node):
        yield from spoken(part, inside)


@pytest.mark.parametrize("ts", sorted(FOLDER.glob("*.ts")), ids=lambda p: p.stem)
def test_no_string_is_overlooked(ts):
    """Those inside of f-strings are: Qt's lupdate does not read them."""
    known = {(context or "", source) for context, source, _ in messages(ts)}
    for path in sorted((ROOT / "app").rglob("*.py")):
        asked = set(spoken(ast.parse(path.read_text(encoding="utf-8"))))
        assert not asked - known, path.name


@pytest.fixture
def translate(monkeypatch):
    """The script that brings the translations up to date."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    return importlib.import_module("translate")


def test_nearly_all_strings_of_the_app_are_translated(translate, tmp_path):
    ts = tmp_path / "de.ts"
    ts.write_bytes((FOLDER / "de.ts").read_bytes())
    try:
        translate.update(ts)
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"Qt's lupdate does not run here ({error})")
    done = [m[2].get("type") != "unfinished" for m in messages(ts)]
    assert sum(done) / len(done) > LEAST_DONE


def test_what_moves_to_another_class_stays_translated(translate):
    def ts(*entries):
        contexts = "".join(
            f"<context><name>{name}</name><message><source>{source}</source>"
            f"<translation{state}>{text}</translation></message></context>"
            for name, source, state, text in entries
        )
        return f"<TS>{contexts}</TS>"

    doubted = ' type="unfinished"'
    before = ts(("A", "Cut &amp; go", "", "Weg &amp; los"), ("A", "Open", "", "Offen"))
    moved = ("B", "Cut &amp; go", doubted, "Weg &amp; los")
    # What only says the same as another class may mean something else.
    alike = ("A", "Open", "", "Offen"), ("B", "Open", doubted, "Offen")
    now = translate.keep_moved(before, ts(moved, *alike))
    assert now == ts(("B", "Cut &amp; go", "", "Weg &amp; los"), *alike)


def test_the_window_speaks_german(german, open_window):
    window = open_window()
    assert window.menus["File"].title() == "&Datei"
    assert window.actions_by_name["repair"].text() == "Reparieren"
    assert window.docks["queue"].windowTitle() == "Prüfliste"
    texts = {a.text() for a in window.menuBar().actions()}
    assert "&Hilfe" in texts
    # Open is a verb in the toolbar, and what is not decided in the queue.
    assert window.queue.filters.status.currentText() == "Offen"


def test_alt_opens_each_menu_by_a_letter_of_its_own(german, open_window):
    titles = [action.text() for action in open_window().menuBar().actions()]
    letters = [title[title.index("&") + 1].lower() for title in titles]
    assert len(letters) == len(set(letters))


def test_german_has_room_in_the_quality_panel_and_the_sheet_of_keys(german, open_window, qtbot):
    window = open_window()
    theme.apply(QApplication.instance(), "light")
    window.show()
    window.dock_layout.show("quality")
    head = window.quality.head
    qtbot.waitUntil(lambda: head.model().rowCount() > 0)
    assert head.model().index(0, MARKER).data() == "Ganze Aufnahme"
    assert head.columnWidth(MARKER) >= head.sizeHintForColumn(MARKER)
    sheet = ShortcutSheet(window)
    qtbot.addWidget(sheet)
    sheet.show()
    prompt = sheet.keys.findChild(QLineEdit)
    words = prompt.fontMetrics().horizontalAdvance(prompt.placeholderText())
    # The prompt is Qt's own and long; most of it is seen.
    assert prompt.width() > 0.6 * words
    tree, column = sheet.tree, 1
    assert tree.viewport().width() - tree.columnWidth(0) >= tree.sizeHintForColumn(column)


def test_german_keeps_the_words_of_what_is_used_most_in_the_toolbar(german, open_window, qtbot):
    window = open_window()
    theme.apply(QApplication.instance(), "light")
    window.resize(1500, 900)
    window.show()
    style = Qt.ToolButtonStyle

    def of(name):
        return window.toolbar.widgetForAction(window.actions_by_name[name]).toolButtonStyle()

    assert of("repair") == of("accept") == of("open") == style.ToolButtonTextBesideIcon
    assert window.toolbar.sizeHint().width() <= window.toolbar.width()
    window.resize(960, 900)
    qtbot.waitUntil(lambda: of("repair") == style.ToolButtonIconOnly)


class Brackets(QTranslator):
    """Puts every string it is asked for into brackets."""

    def translate(self, context, source, disambiguation=None, n=-1):
        """The string in brackets."""
        return f"⟦{source}⟧" if source else ""

    def isEmpty(self):
        """It has something for everything."""
        return False


def words_of(widget):
    """Texts that a widget shows or tells."""
    for name in ("text", "title", "toolTip", "accessibleName", "placeholderText", "windowTitle"):
        get = getattr(widget, name, None)
        value = get() if callable(get) else None
        if isinstance(value, str):
            yield value
    if isinstance(widget, QComboBox):
        yield from (widget.itemText(i) for i in range(widget.count()))


def test_everything_in_the_window_can_be_translated(qapp, open_window, qtbot, damaged):
    brackets = Brackets()
    QCoreApplication.installTranslator(brackets)
    try:
        window = open_window()
        sheet, page = ShortcutSheet(window), Preferences(window)
        for dialog in (sheet, page):
            qtbot.addWidget(dialog)
        take, truth = damaged
        names = {*take.labels, *(a.why for a in truth), *shortcuts.PRESET_LABEL.values()}
        names |= {*languages.LANGUAGES.values(), "Markermend", "Markermend…", "100 Hz"}
        plain = set()
        for top in (window, sheet, page):
            for widget in (top, *top.findChildren(QWidget), *top.findChildren(QAction)):
                for text in words_of(widget):
                    known = text in names or "⟦" in text or text.startswith(("qt_", "box"))
                    if not known and re.search(r"[A-Za-z]{2}", text):
                        plain.add((type(widget).__name__, text))
        assert plain == set()
    finally:
        QCoreApplication.removeTranslator(brackets)
    assert theme.kind_name(next(iter(theme.KIND_NAME))) == "Gap"
