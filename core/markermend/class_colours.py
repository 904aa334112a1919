"""The colours of the classes of artifacts, for everything that draws them.

After Okabe and Ito (2008), darkened or lightened so that people with any colour vision tell them
apart on a light and on a dark ground.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from markermend.artifact import Kind

ON_LIGHT: Mapping[Kind, str] = MappingProxyType(
    {
        Kind.GAP: "#2f8fd0",
        Kind.PEAK: "#cb4512",
        Kind.NOISE: "#c79200",
        Kind.STEP: "#009e73",
        Kind.SLOW: "#b8569a",
    }
)
ON_DARK: Mapping[Kind, str] = MappingProxyType(
    {
        Kind.GAP: "#56b4e9",
        Kind.PEAK: "#f2683a",
        Kind.NOISE: "#f5c542",
        Kind.STEP: "#2cc295",
        Kind.SLOW: "#dd8fc0",
    }
)
