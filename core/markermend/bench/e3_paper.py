"""What skurowski2022 prints for E3: Tables 3 to 5, RMSE in mm."""

from __future__ import annotations

import math

from markermend.artifact import Kind

CLASSES = (Kind.PEAK, Kind.NOISE, Kind.STEP, Kind.SLOW)
DISTORTED, PERFECT, CLASSIFIED = "distorted", "perfect", "classified"

_ROWS = (
    (DISTORTED, ""),
    *(
        (where, method)
        for method in ("linear", "savgol", "spline", "ffnn")
        for where in (PERFECT, CLASSIFIED)
    ),
)
_TABLES = {
    0.05: """
        0.19065 0.17717 0.18069 0.10129
        0.00136 0.18322 0.15939 0.18795
        0.03947 0.18514 0.15623 0.29339
        0.01900 0.04963 0.17440 0.10130
        0.08159 0.06855 0.17553 0.10173
        0.00025 0.11041 0.09780 0.10972
        0.03429 0.68692 0.10895 0.19935
        0.01841 0.01953 0.01933 0.01875
        0.03944 0.04547 0.04409 0.11000
    """,
    0.1: """
        0.26906 0.26340 0.26282 0.15037
        0.00186 0.25487 0.28409 0.27662
        0.05144 0.26360 0.27618 0.38908
        0.02678 0.07211 0.25361 0.15046
        0.08959 0.08895 0.25510 0.15083
        0.00039 0.14679 0.15207 0.15955
        0.04754 0.95512 0.16358 0.23918
        0.02785 0.02468 0.02581 0.02612
        0.05537 0.05201 0.06349 0.14717
    """,
    0.2: """
        0.38228 0.39623 0.39247 0.21676
        0.00273 0.44107 0.44015 0.39172
        0.07007 0.45679 0.45630 0.55692
        0.03880 0.11228 0.37892 0.21704
        0.10383 0.16007 0.38120 0.21748
        0.00058 0.24337 0.28188 0.25274
        0.06753 1.58979 0.37534 0.35679
        0.04169 0.03711 0.03972 0.03735
        0.07903 0.11433 0.10284 0.20549
    """,
}


def published(share: float, located: str, method: str, kind: str) -> float:
    """Look up a figure of Tables 3 to 5.

    Parameters
    ----------
    share : of the frames that are damaged
    located : ``"distorted"``, ``"perfect"`` or ``"classified"``
    method : ``"linear"``, ``"savgol"``, ``"spline"`` or ``"ffnn"``; empty for distorted
    kind : class of the damage

    Returns
    -------
    RMSE in mm, mean of 200 simulations; NaN where the tables have none
    """
    if share not in _TABLES or (located, method) not in _ROWS:
        return math.nan
    numbers = [float(word) for word in _TABLES[share].split()]
    row = _ROWS.index((located, method))
    return numbers[row * len(CLASSES) + CLASSES.index(Kind(kind))]
