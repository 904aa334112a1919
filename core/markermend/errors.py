"""Everything Markermend raises on purpose.

::

    MarkermendError
    ├── FileFormatError   the file is damaged, or of a kind that cannot be read
    │   └── NoSkeletonError   an AMC has no ASF beside it that is surely its own
    ├── ExportError       the result could not be written; nothing was changed
    │   └── RangeError    a value does not fit the file's 16-bit integers; floats would hold it
    ├── DataError         the take does not allow what was asked (no such marker, too few frames)
    └── MethodError       unknown method, or parameters outside their range
    Cancelled             the caller's progress function asked to stop; not an error

Each message is one sentence for an operator: which file or marker, what is wrong, what to do.
"""

from __future__ import annotations


class MarkermendError(Exception):
    """Base of every error a user may see; ``str`` of it is one plain sentence."""


class FileFormatError(MarkermendError):
    """A file is damaged or of a kind that cannot be read."""


class NoSkeletonError(FileFormatError):
    """A movement (AMC) has no skeleton (ASF) beside it that is surely its own."""


class ExportError(MarkermendError):
    """A result could not be written; what was there before is unchanged."""


class RangeError(ExportError):
    """A value does not fit the 16-bit integers of the source; a file of floats would hold it."""


class DataError(MarkermendError):
    """The take does not allow what was asked."""


class MethodError(MarkermendError):
    """A method is unknown or a parameter is outside its range."""


class Cancelled(Exception):
    """Raised by a progress function to stop the work it reports on."""
