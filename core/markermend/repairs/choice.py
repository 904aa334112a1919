"""Which method repairs an artifact when the operator names none."""

from __future__ import annotations

from markermend.artifact import Artifact, Kind
from markermend.take import Take

# Beyond a second no curve drawn through one trajectory is worth having.
LONGEST_CURVE_S = 1.0
# Up to here a spline follows the movement; beyond it overshoots.
LONGEST_SPLINE_S = 0.2


def choose(artifact: Artifact) -> str:
    """Name the method for an artifact by its kind.

    A peak gets the Kalman smoother, a step whose counterpart is known the swap, everything else the
    local regression on the rest of the body.

    Parameters
    ----------
    artifact : what is to be repaired

    Returns
    -------
    Name of a method in the registry.
    """
    if artifact.kind is Kind.PEAK:
        return "kalman"
    if artifact.kind is Kind.STEP and artifact.counterpart is not None:
        return "swap"
    return "local_regression"


def alternatives(take: Take, artifact: Artifact) -> tuple[str, ...]:
    """Methods to try in turn when the chosen one cannot repair, best first.

    Curves through the marker's own trajectory are offered up to a second only: an interval
    that cannot be repaired well is left as it is. Of them the Kalman smoother errs least up to
    three quarters of a second, and says how far off it may be; the others need less on the sides.
    """
    length_s = artifact.length / take.rate
    curves: tuple[str, ...] = ()
    if length_s <= LONGEST_SPLINE_S:
        curves = ("kalman", "spline", "pchip", "linear")
    elif length_s <= LONGEST_CURVE_S:
        curves = ("kalman",)
    first = choose(artifact)
    return tuple(m for m in ("local_regression", *curves) if m != first)
