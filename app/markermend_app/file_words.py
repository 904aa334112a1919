"""Forms in which the engine tells of files, translated where they are told."""

from __future__ import annotations

NAMES = (
    *("Processor", "Storage", "Units", "Missing samples", "Force plates", "Step mm"),
    *("Manufacturer", "Software", "Version"),
)
"""What a file's facts are called."""

VALUES = (
    *("none", "text", "16-bit integers", "32-bit floats"),
    "far-off coordinates or (0, 0, 0)",
    "residuals mean nothing",
    "negative residual ({0} samples)",
    "residual word 65535, read as -1 ({0} samples)",
    "(0, 0, 0) with a valid residual ({0} samples)",
)

ODDITIES = (
    "{0} samples have the residual word 65535, which is -1 without its sign; they were read as "
    "missing.",
    "{0} samples at exactly (0, 0, 0) with a valid residual were read as missing.",
    "{0} samples at exactly (0, 0, 0) were read as missing.",
    "{0} cells that are no numbers were read as missing.",
    "Labels that occur more than once were numbered: {0}.",
    "Of columns that stand more than once the first was read: {0}.",
    "Rows are missing (places: {0}); those that are there were read one after the other.",
    "The file marks every sample as invalid, yet has coordinates; they were read as valid.",
    "The file tells no unit of length; by the size of things metres were assumed.",
    "The file tells no unit of length; by the size of things millimetres were assumed.",
    "The file tells no unit of length; millimetres were assumed.",
    "The file tells no unit of length that is known; millimetres were assumed.",
    "The columns tell no unit of length that is known; millimetres were assumed.",
    "The table has no times; 100 Hz was assumed.",
    "The file does not tell its frame rate; its times were used.",
    "The file does not tell its frame rate; 100 Hz was assumed.",
    "The file tells no rate; 120 Hz was assumed.",
    "The file is cut short: it says that it has {0} frames, {1} are present.",
    "The file is cut short; the poses before its end were read.",
    "The file is cut short; its last pose was left out.",
    "The header counts {0} frames; {1} were read.",
)
"""What is odd about a file, as far as operators meet it often."""
