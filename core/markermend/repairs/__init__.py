"""Repairs: putting back what a marker did over a damaged interval.

Importing this package registers every method in :data:`REPAIRS`.
"""

from markermend.repairs import (  # noqa: F401, importing a module registers its methods
    cyclic,
    dynamics,
    empty,
    ffnn_loose,
    interpolation,
    kalman,
    local_regression,
    pattern,
    rigid,
    savgol,
    skeleton,
    skurowski2021,
    swap,
    tits2018,
)
from markermend.repairs.advice import COMPARED, Advice, advise, compared
from markermend.repairs.choice import choose
from markermend.repairs.gaps import fill, find_gaps
from markermend.repairs.proposing import propose, propose_from
from markermend.repairs.registry import REPAIRS, Evidence, Method, Repair, find_method
from markermend.repairs.run import repair, repair_all
from markermend.repairs.trust import evidence_for

__all__ = [
    "COMPARED",
    "REPAIRS",
    "Advice",
    "Evidence",
    "Method",
    "Repair",
    "advise",
    "choose",
    "compared",
    "evidence_for",
    "fill",
    "find_gaps",
    "find_method",
    "propose",
    "propose_from",
    "repair",
    "repair_all",
]
