"""A take is searched as the preferences have it."""

from __future__ import annotations

from markermend.progress import quiet
from markermend_app import detection, settings


def test_the_dial_decides_what_is_found(damaged):
    found = {}
    for sensitivity in (0.0, 1.0):
        settings.remember(detection.SENSITIVITY, sensitivity)
        found[sensitivity] = detection.search(damaged[0], None, quiet, slow=False)
    assert len(found[0.0]) < len(found[1.0])
