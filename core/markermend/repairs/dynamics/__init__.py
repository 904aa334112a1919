"""Linear dynamical systems of the whole body, which can cross a blackout of all markers."""

from markermend.repairs.dynamics import methods  # noqa: F401, importing registers the methods
