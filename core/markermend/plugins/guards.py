"""What runs instead of a plugin's own function: its work elsewhere, its result looked at."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from markermend.arrays import FloatArray
from markermend.artifact import Artifact
from markermend.errors import MethodError
from markermend.plugins.discover import DETECTORS, REPAIRS, SMOOTHERS
from markermend.plugins.worker import Worker
from markermend.progress import Progress, quiet
from markermend.take import Take

if TYPE_CHECKING:
    # The registries call this module while they are imported.
    from markermend.detectors.registry import Detector, DetectorFunction
    from markermend.mesh import Mesh
    from markermend.repairs.registry import Evidence, Method, MethodFunction, Repair
    from markermend.smoothers.registry import Signals, Smoother, SmootherFunction


def guard_detector(detector: Detector) -> DetectorFunction:
    """Detect in another process; artifacts must lie within the take.

    What is returned raises MethodError where they do not, and where the plugin fails.
    """
    worker = Worker(DETECTORS, detector.name)

    def run(take: Take, params: Any, mesh: Mesh | None, progress: Progress) -> list[Artifact]:
        found = worker.call(take, params, mesh, progress=progress)
        if not all(isinstance(a, Artifact) for a in found):
            raise MethodError(f"The plugin “{detector.name}” found something that is no artifact.")
        for a in found:
            if a.marker not in take or a.stop > take.frames:
                raise MethodError(
                    f"The plugin “{detector.name}” found damage outside the take, on {a.marker}."
                )
        return list(found)

    return run


def guard_method(method: Method) -> MethodFunction:
    """Repair in another process; only the interval and its axes may be replaced.

    Where more is, or the plugin fails, what is returned gives a repair without patches, and why.
    """
    from markermend.repairs.registry import Repair

    worker = Worker(REPAIRS, method.name)

    def run(evidence: Evidence, artifact: Artifact, params: Any) -> Repair:
        try:
            # A progress function cannot go to another process.
            done = worker.call(replace(evidence, progress=quiet), artifact, params)
        except MethodError as error:
            # One artifact that a plugin cannot repair shall not end the work on the others.
            return Repair(method.name, reason=str(error))
        fault = _fault_of(done, artifact)
        return Repair(method.name, reason=fault) if fault else done

    return run


def _fault_of(done: Any, artifact: Artifact) -> str:
    """Say what is wrong with a plugin's repair, or nothing."""
    from markermend.repairs.registry import Repair

    if not isinstance(done, Repair):
        return "the plugin did not return a repair"
    for p in done.patches:
        mine = p.marker in artifact.markers
        inside = artifact.start <= p.start < p.stop <= artifact.stop
        if not (mine and inside and set(p.axes) <= set(artifact.axes)):
            return "the plugin wanted to change samples that are not the artifact's"
    return ""


def guard_smoother(smoother: Smoother) -> SmootherFunction:
    """Smooth in another process; no sample may be invented or lost.

    What is returned raises MethodError where one is, and where the plugin fails.
    """
    worker = Worker(SMOOTHERS, smoother.name)

    def run(signals: Signals, params: Any) -> FloatArray:
        after = np.asarray(worker.call(signals, params))
        before = signals.values
        if after.shape != before.shape or not np.array_equal(np.isnan(after), np.isnan(before)):
            raise MethodError(
                f"The plugin “{smoother.name}” invented or lost samples; nothing was smoothed."
            )
        return after

    return run
