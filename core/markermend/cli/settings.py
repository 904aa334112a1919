"""Parameters of a method as ``--set NAME=VALUE`` gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from markermend.errors import MethodError

_FLAGS = {"true": True, "false": False}
_IN_WORDS = {bool: "true or false", int: "a whole number", float: "a number"}


def settings_of(params: type, given: Sequence[str]) -> dict[str, Any]:
    """Read ``NAME=VALUE`` as the field of a parameter dataclass has it.

    Parameters
    ----------
    params : the dataclass
    given : texts; a name it does not know keeps its value as text

    Raises
    ------
    MethodError
        when a text is no setting, or its value not of the field's kind
    """
    kinds: dict[str, type] = {f.name: type(f.default) for f in fields(params)}
    settings: dict[str, Any] = {}
    for text in given:
        name, sign, value = text.partition("=")
        kind = kinds.get(name)
        if not sign or not name:
            raise MethodError(f"“{text}” is no setting; write NAME=VALUE.")
        if kind is None:
            settings[name] = value
            continue
        try:
            settings[name] = _FLAGS[value.lower()] if kind is bool else kind(value)
        except (ValueError, KeyError):
            wanted = _IN_WORDS.get(kind, f"a {kind.__name__}")
            raise MethodError(f"“{name}” cannot be “{value}”; it is {wanted}.") from None
    return settings
