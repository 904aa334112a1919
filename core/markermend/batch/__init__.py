"""Many takes: the same choices for all, in several processes, to be continued after a crash.

A :class:`Recipe` fixes every choice. :func:`run_batch` cleans each take in a worker process that
writes the result itself; what it finished is noted beside the results, so that a run that was
killed goes on where it stopped.
"""

from __future__ import annotations

from markermend.batch.recipe import Recipe, read_recipe
from markermend.batch.review import ToReview, take_over, takes_to_review
from markermend.batch.run import BatchResult, run_batch
from markermend.batch.sources import Source, find_takes

__all__ = [
    "BatchResult",
    "Recipe",
    "Source",
    "ToReview",
    "find_takes",
    "read_recipe",
    "run_batch",
    "take_over",
    "takes_to_review",
]
