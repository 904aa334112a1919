"""Parameters of methods: frozen dataclasses whose fields declare what they take."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, fields, replace
from numbers import Real
from typing import Any, Protocol

from markermend.errors import MethodError


class Parametrised(Protocol):
    """What every method of a registry has."""

    @property
    def name(self) -> str:
        """Short name for command line and files."""

    @property
    def params(self) -> type:
        """Dataclass of its parameters."""


def tunable(default: Any, help: str, unit: str = "", low: float = 0, high: float = 1e6) -> Any:
    """Make a field with the metadata that forms and the command line are made from.

    Parameters
    ----------
    default : value
    help : what it does, for people
    unit : of the value, empty for none
    low, high : range in which it makes sense
    """
    return field(default=default, metadata={"help": help, "unit": unit, "min": low, "max": high})


def read_params(
    method: Parametrised,
    params: Mapping[str, Any] | object | None,
    settings: Mapping[str, Any] | None = None,
) -> Any:
    """Turn what a caller gives into the method's own parameter dataclass.

    Parameters
    ----------
    method : whose parameters they are
    params : None for the defaults, a mapping of names to values, or the dataclass itself
    settings : single parameters by name; they win over `params`

    Raises
    ------
    MethodError
        when a name is unknown, or a value no number where one is wanted or outside the range that
        its field declares
    """
    own = isinstance(params, method.params)
    if not own and params is not None and not isinstance(params, Mapping):
        raise MethodError(
            f"The method “{method.name}” takes {method.params.__name__} or a mapping, not"
            f" {type(params).__name__}."
        )
    given = {**(params if isinstance(params, Mapping) else {}), **(settings or {})}
    known = [f.name for f in fields(method.params)]
    for name in given:
        if name not in known:
            raise MethodError(
                f"The method “{method.name}” has no parameter “{name}”; it has"
                f" {', '.join(known) or 'none'}."
            )
    made: Any = replace(params, **given) if own else method.params(**given)  # type: ignore[type-var]
    check_ranges(made, f" of the method “{method.name}”")
    return made


def check_ranges(params: Any, whose: str = "") -> None:
    """Refuse values outside the range that their field declares; nothing else has one.

    Parameters
    ----------
    params : a dataclass
    whose : parameters they are, for the message

    Raises
    ------
    MethodError
        naming the first of them
    """
    for f in fields(params):
        low, high, value = f.metadata.get("min"), f.metadata.get("max"), getattr(params, f.name)
        if (low, high) != (None, None) and not isinstance(value, Real):
            raise MethodError(f"“{f.name}”{whose} is a number, not {value!r}.")
        if (low is not None and not value >= low) or (high is not None and not value <= high):
            bounds = (
                f"must lie between {low:g} and {high:g}"
                if low is not None and high is not None
                else f"must be {low:g} at least"
                if low is not None
                else f"must be {high:g} at most"
            )
            raise MethodError(f"“{f.name}”{whose} {bounds}, not {value}.")
