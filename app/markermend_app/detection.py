"""How the window detects: one dial, or a preset that was kept under a name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from markermend_app import settings
from markermend_app.background.garbage import keep_what_is_loaded

if TYPE_CHECKING:
    from markermend.artifact import Artifact
    from markermend.mesh import Mesh
    from markermend.progress import Progress
    from markermend.take import Take

PRESET, SENSITIVITY, PROCESSES = "detection_preset", "sensitivity", "processes"
BALANCED = 0.5
DIALS: Mapping[str, float] = MappingProxyType(
    {"Only what is nearly certain": 0.2, "Balanced": BALANCED, "All that looks odd": 0.8}
)


def chosen_params(slow: bool) -> Any:
    """Parameters of detection as the preferences have them.

    Parameters
    ----------
    slow : look for slow changes too, where the method knows how

    Raises
    ------
    MarkermendError
        when the preset is gone or cannot be read
    """
    from markermend.detectors import DEFAULT, find_detector
    from markermend.presets import load_preset

    name = settings.text(PRESET, "")
    if name:
        params = load_preset(name)[1]
    else:
        params = find_detector(DEFAULT).params(sensitivity=settings.number(SENSITIVITY, BALANCED))
    wanted = {"slow": slow, "jobs": round(settings.number(PROCESSES, -1)) or -1}
    known = {f.name for f in fields(params)}
    return replace(params, **{k: v for k, v in wanted.items() if k in known})


def search(take: Take, mesh: Mesh | None, progress: Progress, *, slow: bool) -> Sequence[Artifact]:
    """Artifacts of a take as the preferences have them found; on a worker, for it takes seconds.

    Raises
    ------
    MarkermendError
        when the preset is gone or cannot be read
    Cancelled
        when ``progress`` raises it
    """
    from markermend.detectors import detect

    params = chosen_params(slow)
    keep_what_is_loaded()
    return detect(take, params=params, mesh=mesh, progress=progress)
