"""Takes with a known truth: a simulated performer, contamination, damage and gaps, all seeded."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np
from threadpoolctl import threadpool_limits

from markermend.artifact import Artifact
from markermend.errors import MethodError
from markermend.progress import Progress, part
from markermend.simulation.contamination import contaminate
from markermend.simulation.damage import Amounts, damage
from markermend.simulation.gap_placement import place_gaps
from markermend.simulation.script import DEFAULT_SCRIPT, Activity
from markermend.simulation.skeleton import Motion
from markermend.take import Take

__all__ = [
    "DEFAULT_SCRIPT",
    "Activity",
    "Amounts",
    "contaminate",
    "damage",
    "place_gaps",
    "simulate",
    "simulate_clean",
    "simulate_motion",
]


def simulate_clean(
    *,
    duration_s: float = 40.0,
    rate: float = 100.0,
    seed: int = 0,
    height_m: float = 1.75,
    activities: Sequence[Activity] = DEFAULT_SCRIPT,
    labels: Sequence[str] | None = None,
    soft_tissue: bool = True,
    noise: bool = True,
    progress: Progress | None = None,
) -> Take:
    """Record a simulated person, undamaged.

    Parameters
    ----------
    duration_s, rate : length in seconds, frames per second
    seed : same seed, same performance
    height_m : body height
    activities : what the person does, over again until the take is full
    labels : part of the 53 markers; all when not given
    soft_tissue : let skin move the markers over the bones
    noise : add the cameras' noise
    progress : told what is being done; may raise ``Cancelled``

    Returns
    -------
    Take with every sample measured, z up, floor at 0, mm

    Raises
    ------
    MethodError
        when duration, rate or height make no sense, or for an unknown activity or marker
    """
    from markermend.simulation.markers import camera_noise, place_markers

    report = part(progress, 0.0, 1.0)
    _, skin, cameras = _draws(seed)
    with threadpool_limits(1):
        report(0.0, "Performing")
        motion = simulate_motion(
            duration_s=duration_s, rate=rate, seed=seed, height_m=height_m, activities=activities
        )
        report(0.3, "Placing markers")
        names, positions = place_markers(
            motion, rate, labels=labels, soft_tissue=soft_tissue, rng=skin
        )
        report(0.8, "Recording")
        noisy, residuals = camera_noise(positions, rate, cameras)
    report(1.0, "Recorded")
    info = MappingProxyType({"system": "Markermend simulation", "seed": str(seed)})
    return Take(noisy if noise else positions, names, rate, residuals=residuals, info=info)


def simulate_motion(
    *,
    duration_s: float = 40.0,
    rate: float = 100.0,
    seed: int = 0,
    height_m: float = 1.75,
    activities: Sequence[Activity] = DEFAULT_SCRIPT,
) -> Motion:
    """Return the bones under the markers of :func:`simulate_clean` with the same arguments.

    Raises
    ------
    MethodError
        when duration, rate or height make no sense, or for an unknown activity
    """
    from markermend.simulation.performer import perform

    if not (1.0 <= duration_s <= 3600.0 and 20.0 <= rate <= 2000.0 and 0.5 <= height_m <= 2.5):
        raise MethodError(
            "A simulation lasts 1 s to an hour, at 20 to 2000 Hz, of a person of 0.5 to 2.5 m."
        )
    return perform(
        duration_s=duration_s,
        rate=rate,
        height_mm=1000.0 * height_m,
        activities=activities,
        rng=_draws(seed)[0],
    )


def _draws(seed: int) -> list[np.random.Generator]:
    """For the movement, the skin and the cameras."""
    try:
        return np.random.default_rng(seed).spawn(3)
    except (TypeError, ValueError):
        raise MethodError(f"A seed is a whole number, 0 or more, not {seed!r}.") from None


def simulate(
    *,
    duration_s: float = 40.0,
    rate: float = 100.0,
    seed: int = 0,
    height_m: float = 1.75,
    damaged: bool = True,
    progress: Progress | None = None,
) -> tuple[Take, tuple[Artifact, ...]]:
    """Record a simulated person with damage of every class, and know the truth.

    Parameters
    ----------
    duration_s, rate : length in seconds, frames per second
    seed : same seed, same take
    height_m : body height
    damaged : put damage in; without it the take is clean and the truth empty
    progress : told what is being done; may raise ``Cancelled``

    Returns
    -------
    the take and the truth in order of start; :func:`simulate_clean` with the same arguments
    gives the same performance undamaged

    Raises
    ------
    MethodError
        when duration, rate or height make no sense
    DataError
        when the take is too short for the damage
    """
    clean = simulate_clean(
        duration_s=duration_s,
        rate=rate,
        seed=seed,
        height_m=height_m,
        progress=part(progress, 0.0, 0.9),
    )
    if not damaged:
        return clean, ()
    result = damage(clean, seed=seed)
    part(progress, 0.9, 1.0)(1.0, "Damaged")
    return result
