"""Recovery of missing markers by probabilistic model averaging (tits2018), and its models.

Importing this package registers the models and their averages in the registry.
"""

from markermend.repairs.tits2018 import methods

__all__ = ["methods"]
