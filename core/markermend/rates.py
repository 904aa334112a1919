"""How many frames or poses a second a recording can have."""

from __future__ import annotations

from markermend.errors import FileFormatError

LEAST_HZ, MOST_HZ = 0.1, 10_000.0


def rate_of(hertz: float, name: str) -> float:
    """A rate, as it is.

    Parameters
    ----------
    hertz : frames or poses per second
    name : of the file, for what is wrong with it

    Raises
    ------
    FileFormatError
        when nothing records so slowly or so fast
    """
    if not LEAST_HZ <= hertz <= MOST_HZ:
        raise FileFormatError(
            f"{name} would have {hertz:g} poses a second, which is no rate of a recording;"
            f" {LEAST_HZ:g} to {MOST_HZ:,.0f} Hz can be read."
        )
    return hertz
