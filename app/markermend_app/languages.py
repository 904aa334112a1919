"""The language of the window: that of the system, or the one chosen in the preferences."""

from __future__ import annotations

from importlib.resources import files

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from markermend_app import settings

SETTING = "language"
LANGUAGES = {"en": "English", "de": "Deutsch"}
"""Names of the languages there are, each in its own."""


def language() -> str:
    """Code of the language in use: the chosen one, else the system's where there is one."""
    chosen = settings.text(SETTING, "system")
    if chosen in LANGUAGES:
        return chosen
    system = QLocale.system().name().partition("_")[0]
    return system if system in LANGUAGES else "en"


def install(app: QCoreApplication) -> list[QTranslator]:
    """Let the app speak the language in use; holds for what is made afterwards."""
    code = language()
    if code == "en":
        return []
    # Qt's own words, such as those of its buttons, before ours.
    own, qts = QTranslator(app), QTranslator(app)
    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    ours = files("markermend_resources") / "translations" / f"{code}.qm"
    loaded = [qts] if qts.load(f"qtbase_{code}", folder) else []
    if own.load(str(ours)):
        loaded.append(own)
    for translator in loaded:
        app.installTranslator(translator)
    return loaded
