"""How bodies move as the user chose it in the preferences, for what is opened."""

from __future__ import annotations

from pathlib import Path

from markermend_app import settings

SETTING = "prior"
"""Name of the setting: path of a prior, or nothing for what comes with Markermend."""


def chosen() -> Path | None:
    """The prior that was chosen."""
    path = settings.text(SETTING, "")
    return Path(path) if path else None
