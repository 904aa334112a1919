"""Where the gaps of the published experiments lie, and of three of our own."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from markermend.bench.gaps import GapCase
from markermend.errors import DataError
from markermend.take import Take

# As published: gaps at a time, lengths in frames at 100 Hz or in seconds.
POISSON_FRAMES = (10, 20, 50, 100, 200)
CONCOMITANT_S = (0.5, 1.0, 2.0, 5.0)
CONCOMITANT_COUNTS = (1, 3, 6, 10, 20)
DURATIONS_S = (5.0, 10.0, 20.0, 40.0)
PROTOCOLS = (
    "skurowski2021",
    "tits2018",
    "tits2018-duration",
    "tits2018-count",
    "single",
    "blackout",
    "ends",
)
# Of our own, from short to long: one marker alone, also up to where the take begins or ends, and no
# marker at all.
ALONE_S = (0.1, 0.2, 0.5, 1.0, 2.0, 4.0)
BLACKOUT_S = (0.1, 0.2, 0.5, 1.0, 2.0)
METHODS_OF = {
    "skurowski2021": (
        "ffnn_lin", "ffnn_tanh", "lstm", "gru", "bilstm",
        "linear", "spline", "makima", "pchip", "msvd",
    ),
    "tits2018": ("glr", "li", "lpr", "lgrnn", "pca", "bolero", "pma", "pma_all", "pma_no_pca"),
}  # fmt: skip
"""All methods a paper compares, by its name."""


def named_methods(names: Iterable[str]) -> tuple[str, ...]:
    """Names with those of a paper replaced by all the methods it compares, each once."""
    return tuple(dict.fromkeys(m for name in names for m in METHODS_OF.get(name, (name,))))


@dataclass(frozen=True)
class _Setting:
    """How gaps are drawn.

    Attributes
    ----------
    label : for the table
    length : of the gaps, frames; their mean where it is not fixed
    intervals : how many
    together : markers that are missing in each
    fixed : whether all have the same length
    duration : frames of the take that are used, None for all
    at_end : whether it lies where the take begins or ends, with one side only
    """

    label: str
    length: float
    intervals: int
    together: int
    fixed: bool = True
    duration: int | None = None
    at_end: bool = False


def draw_cases(
    takes: Mapping[str, Take], protocol: str, *, simulations: int, seed: int
) -> tuple[GapCase, ...]:
    """Place gaps at random as a paper does.

    ``skurowski2021``: two gaps of Poisson length with means 10 to 200 frames; ``tits2018``: three
    markers at once for 0.5 to 5 s; ``tits2018-duration``: three at once for 1 s in fragments of 5
    to 40 s; ``tits2018-count``: 1 to 20 markers at once for 1 s. Of our own are ``single``, one
    marker for 0.1 to 4 s, ``blackout``, all markers for 0.1 to 2 s, and ``ends``, one marker or
    three from the first frame on or up to the last, for 0.1 to 4 s.

    Parameters
    ----------
    takes : by name; what a take has no room for is left out
    protocol : of :data:`PROTOCOLS`
    simulations : for each take and setting
    seed : same seed, same gaps

    Raises
    ------
    DataError
        when there is no such protocol
    """
    cases = []
    for name, take in takes.items():
        for number, setting in enumerate(_settings(protocol, take)):
            for i in range(simulations):
                try:
                    case = _draw(name, take, setting, seed + 1000 * number + i)
                except DataError:
                    break
                cases.append(case)
    return tuple(cases)


def concomitant_cases(
    takes: Mapping[str, Take], together: int, seconds: float, *, simulations: int, seed: int
) -> tuple[GapCase, ...]:
    """Several markers missing at once for a while, as often as asked for in every take."""
    return tuple(
        _draw(name, take, setting, seed + i)
        for name, take in takes.items()
        for setting in [_Setting(f"{together} at once", seconds * take.rate, 1, together)]
        for i in range(simulations)
    )


def _draw(name: str, take: Take, setting: _Setting, seed: int) -> GapCase:
    """One simulation; DataError where there is no room for it."""
    from markermend.simulation.gap_placement import place_gaps

    if setting.at_end:
        return _draw_at_end(name, take, setting, seed)
    within = None
    if setting.duration is not None:
        spare = take.frames - setting.duration
        if spare < 0:
            raise DataError(f"{name} is shorter than {setting.duration} frames.")
        first = int(np.random.default_rng(seed).integers(spare + 1))
        within = first, first + setting.duration
        take = Take(take.positions[slice(*within)], take.labels, take.rate)
    first = 0 if within is None else within[0]
    _, gaps = place_gaps(
        take,
        count=setting.intervals,
        mean_length=setting.length,
        concomitant=setting.together,
        fixed_length=setting.fixed,
        seed=seed,
    )
    hidden = tuple((g.marker, first + g.start, first + g.stop) for g in gaps)
    return GapCase(name, setting.label, round(setting.length), hidden, {}, within)


def _draw_at_end(name: str, take: Take, setting: _Setting, seed: int) -> GapCase:
    """Markers that are not seen before some frame, or not from some frame on."""
    length = round(setting.length)
    rng = np.random.default_rng(seed)
    first = int(rng.integers(2)) * (take.frames - length)
    # One frame more on either side, so that something is known where the gap borders on the take.
    around = take.present[max(0, first - 1) : first + length + 1]
    whole = np.flatnonzero(around.all(axis=0))
    if length >= take.frames or len(whole) < setting.together:
        raise DataError(f"{name} has no room for {setting.together} gaps of {length} frames.")
    picked = sorted(rng.choice(whole, size=setting.together, replace=False))
    hidden = tuple((take.labels[c], first, first + length) for c in picked)
    return GapCase(name, setting.label, length, hidden, {})


def _settings(protocol: str, take: Take) -> list[_Setting]:
    """Every setting of a protocol."""
    rate = take.rate
    if protocol == "skurowski2021":
        return [_Setting(protocol, float(n), 2, 1, fixed=False) for n in POISSON_FRAMES]
    if protocol == "tits2018":
        return [_Setting("3 at once", s * rate, 1, 3) for s in CONCOMITANT_S]
    if protocol == "tits2018-duration":
        return [
            _Setting(f"3 in {s:g} s", rate, 1, 3, duration=round(s * rate)) for s in DURATIONS_S
        ]
    if protocol == "tits2018-count":
        return [_Setting(f"{n} at once", rate, 1, n) for n in CONCOMITANT_COUNTS]
    if protocol == "single":
        return [_Setting("1 at once", s * rate, 1, 1) for s in ALONE_S]
    if protocol == "blackout":
        return [_Setting("all at once", s * rate, 1, take.markers) for s in BLACKOUT_S]
    if protocol == "ends":
        return [
            _Setting(f"{n} at an end", s * rate, 1, n, at_end=True) for n in (1, 3) for s in ALONE_S
        ]
    known = ", ".join(PROTOCOLS)
    raise DataError(f"There is no protocol “{protocol}”; choose one of {known}.")
