"""How bodies move as the user chose it in the preferences, for what is opened."""

from __future__ import annotations

from pathlib import Path

from markermend.take import Take
from markermend_app import settings

SETTING = "prior"
"""Name of the setting: path of a prior, or nothing for what comes with Markermend."""


def heeded(take: Take) -> Take:
    """A skeleton recording that is to be restored by what was chosen, or says why it is not."""
    # Only who opens a skeleton has to wait until all about poses is loaded.
    from markermend.poses import own_prior

    path = settings.text(SETTING, "")
    return own_prior.heeded(take, Path(path) if path else None)
