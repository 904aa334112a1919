"""What the engine says that it is doing, by the forms that :mod:`markermend_app.telling` reads."""

from __future__ import annotations

from collections.abc import Mapping

_SAME = (
    *("Reading frames", "Reading poses", "Reading rows"),
    *("Writing frames", "Writing poses", "Writing rows", "Comparing bytes"),
    *("Opening the review", "Proposing repairs", "Predicting {0}"),
    *("gaps", "jumps, peaks and heavy noise", "what is wrong, and how sure that is"),
    *("slow changes", "slow changes of {0}", "slow changes, filled"),
    *("the body's structure", "body mesh", "body mesh of {0}"),
    *("residuals", "residual of {0}"),
    *("Looking for noise", "Smoothing", "Smoothing again"),
    *("Filling", "Filling again", "Keeping bones"),
    "joint centres",
    *("Compiling the network", "Learning how the body moves, round {0} of {1}"),
    "Repaired",
)
# The work itself is called so.
DOING: Mapping[str, str] = {"Repairing {0}": "{0}", **{form: form for form in _SAME}}
"""Forms as the engine writes them, and as they are told."""
