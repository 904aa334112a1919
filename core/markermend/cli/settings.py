"""Parameters of a method as ``--set NAME=VALUE`` gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from markermend.errors import MethodError


def settings_of(params: type, given: Sequence[str]) -> dict[str, Any]:
    """Read ``NAME=VALUE`` as the field of a parameter dataclass has it.

    Parameters
    ----------
    params : the dataclass
    given : texts; a name it does not know keeps its value as text

    Raises
    ------
    MethodError
        when a text is no setting
    """
    kinds: dict[str, Any] = {f.name: type(f.default) for f in fields(params)}
    settings: dict[str, Any] = {}
    for text in given:
        name, sign, value = text.partition("=")
        kind = kinds.get(name)
        try:
            if not sign:
                raise ValueError
            if kind is bool:
                settings[name] = {"true": True, "false": False}[value.lower()]
            else:
                settings[name] = value if kind is None else kind(value)
        except (ValueError, KeyError):
            raise MethodError(f"“{text}” is no setting; write NAME=VALUE.") from None
    return settings
