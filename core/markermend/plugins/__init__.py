"""Methods and file formats that other packages bring.

A package names them as entry points, one group for each sort::

    [project.entry-points."markermend.repairs"]
    hold = "my_package:hold"

where ``hold`` is a :class:`markermend.repairs.registry.Method`; likewise
:class:`markermend.detectors.registry.Detector` in ``markermend.detectors``,
:class:`markermend.smoothers.registry.Smoother` in ``markermend.smoothers`` and
:class:`markermend.plugins.formats.Format` in ``markermend.formats``. They stand beside ours in the
window, on the command line and in ``markermend methods``, with their parameters.

Nobody is harmed by a plugin that fails: one that cannot be loaded is left out, see :func:`faults`;
the work of the others runs in a process of its own, which ends when the work is cancelled or who
started it ends, and what comes back is checked. Scripts need no ``if __name__ == "__main__":``
for that.
"""

from markermend.plugins.discover import Fault, faults, loaded

__all__ = ["Fault", "faults", "loaded"]
