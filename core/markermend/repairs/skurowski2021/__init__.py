"""The reconstruction methods of skurowski2021 beyond interpolation: its networks, its low rank."""

from markermend.repairs.skurowski2021 import (  # noqa: F401, importing registers the methods
    ffnn,
    low_rank,
    recurrent,
)
