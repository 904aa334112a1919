"""Reports: what was damaged, repaired and left, as one HTML file that needs nothing else.

The file opens from a mail attachment, prints, follows the reader's light or dark setting, and
holds the same facts as JSON in ``<script type="application/json">`` elements: class ``take`` for
each take (as ``clean --json`` writes it, with ``quality``), class ``index`` for a batch.
"""

from __future__ import annotations

from markermend.report.index import index_section
from markermend.report.quality import Quality, quality
from markermend.report.review import Reviewed, review_report, reviewed
from markermend.report.sections import batch_parts, take_report

__all__ = [
    "Quality",
    "Reviewed",
    "batch_parts",
    "index_section",
    "quality",
    "review_report",
    "reviewed",
    "take_report",
]
