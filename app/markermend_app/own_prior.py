"""How bodies move as the user chose it in the preferences, for what is opened."""

from __future__ import annotations

from pathlib import Path

from markermend_app import settings

SETTING = "prior"
"""Name of the setting: path of a prior, or nothing for what comes with Markermend."""


def heed() -> None:
    """Restore skeleton recordings that are read from now on by what was chosen."""
    # Only who opens a skeleton has to wait until all about poses is loaded.
    from markermend.poses.own_prior import choose_prior

    path = settings.text(SETTING, "")
    choose_prior(Path(path) if path else None)
