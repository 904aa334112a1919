"""A recipe: every choice of a batch, as TOML, so that a run can be repeated to the byte."""

from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.detectors import DEFAULT, find_detector
from markermend.encoding import printable, utf8
from markermend.errors import FileFormatError, MethodError
from markermend.files.opening import not_opened
from markermend.parameters import read_params
from markermend.plugins.formats import writable
from markermend.repairs import find_method

NAME = "{name}"
_SAME = "same"
# How many processes a detector uses changes no result; in a batch each take has one.
_NO_CHOICE = "jobs"
_TABLES: dict[str, tuple[str, ...]] = {
    "detect": ("method", "params"),
    "repair": ("method", "min_confidence"),
    "skeletons": ("prior",),
    "output": ("format", "name", "float", "record", "mark_outputs"),
}


@dataclass(frozen=True)
class Recipe:
    """What is done to each take.

    Attributes
    ----------
    detector : name of the detection method
    detector_params : its parameters as a mapping or their dataclass, which they become; None for
        the defaults
    method : name of the repair method for everything, or ``"auto"``
    min_confidence : in [0, 1]; below it nothing is repaired but listed for review
    format : of the repaired take: ``"c3d"``, ``"trc"``, ``"csv"``, one that a plugin
        writes, or ``"same"`` as it was read
    name : the repaired take's file name without ending; ``{name}`` stands for the take's
    as_float, record, mark_outputs : as for :func:`markermend.write`; ``record`` writes what was
        repaired and how
    prior : file that says how bodies of skeletons move, of ``markermend train prior``; nothing for
        Markermend's own alone
    version : Markermend's, of the recipe's writer

    Raises
    ------
    MethodError
        when a method is unknown or a value makes no sense
    """

    detector: str = DEFAULT
    detector_params: Any = None
    method: str = "auto"
    min_confidence: float = 0.5
    format: str = _SAME
    name: str = f"{NAME}_clean"
    as_float: bool = False
    record: bool = False
    mark_outputs: bool = False
    prior: str = ""
    version: str = mm.__version__

    def __post_init__(self) -> None:
        detector = find_detector(self.detector)
        one = any(f.name == _NO_CHOICE for f in fields(detector.params))
        params = read_params(detector, self.detector_params, {_NO_CHOICE: 1} if one else None)
        object.__setattr__(self, "detector_params", params)
        if self.method != "auto":
            find_method(self.method)
        if not 0.0 <= self.min_confidence <= 1.0:
            raise MethodError(
                f"A recipe's min_confidence must lie between 0 and 1, not at {self.min_confidence}."
            )
        formats = (_SAME, *(ending[1:] for ending in writable()))
        if self.format not in formats:
            raise MethodError(
                f"A recipe's format must be one of {', '.join(formats)}, not “{self.format}”."
            )
        if "\0" in self.prior or printable(self.prior) != self.prior:
            raise MethodError(
                f"A recipe cannot hold the name of the prior “{printable(self.prior)}”; rename it."
            )
        if NAME not in self.name or "/" in self.name or "\\" in self.name:
            raise MethodError(
                f"A recipe's output name must hold {NAME} and no folder, unlike “{self.name}”."
            )

    def to_toml(self) -> str:
        """Return the recipe as text, every choice spelled out, for this version of Markermend."""
        lines = [f"version = {_value(mm.__version__)}", "", "[detect]"]
        lines += [f"method = {_value(self.detector)}", "", "[detect.params]"]
        lines += [
            f"{f.name} = {_value(getattr(self.detector_params, f.name))}"
            for f in fields(self.detector_params)
            if f.name != _NO_CHOICE
        ]
        lines += ["", "[repair]", f"method = {_value(self.method)}"]
        lines += [f"min_confidence = {_value(float(self.min_confidence))}", "", "[skeletons]"]
        lines += [f"prior = {_value(self.prior)}", "", "[output]"]
        lines += [f"format = {_value(self.format)}", f"name = {_value(self.name)}"]
        lines += [f"float = {_value(self.as_float)}", f"record = {_value(self.record)}"]
        lines += [f"mark_outputs = {_value(self.mark_outputs)}", ""]
        return "\n".join(lines)

    def beside(self, folder: Path) -> Recipe:
        """The same with the whole path of a prior, which was named from a folder on."""
        return replace(self, prior=str((folder / self.prior).resolve())) if self.prior else self

    @property
    def hash(self) -> str:
        """SHA-256 of the text, the version included: what was done by another is done again."""
        return hashlib.sha256(utf8(self.to_toml())).hexdigest()


def read_recipe(path: str | Path) -> Recipe:
    """Read a recipe; what it does not say keeps its default.

    A prior's path is taken from the recipe's folder on.

    Raises
    ------
    FileFormatError
        when the file cannot be read, is no TOML, or names something that recipes do not have
    MethodError
        when a method is unknown or a value makes no sense
    """
    where = Path(path)
    try:
        given = tomllib.loads(where.read_text(encoding="utf-8"))
    except OSError as error:
        raise not_opened(where, error) from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"The recipe “{where}” is not TOML; name another file.") from error
    except ValueError as error:
        raise FileFormatError(f"The recipe “{where}” is not TOML: {error}.") from error
    for table, keys in _TABLES.items():
        if not isinstance(given.get(table, {}), dict):
            raise FileFormatError(f"In the recipe “{where}” {table} should be a table.")
        _refuse_unknown(where, f"{table}.", given.get(table, {}), keys)
    _refuse_unknown(where, "", given, ("version", *_TABLES))
    plain = Recipe()
    found, mended, skeletons, output = (given.get(table, {}) for table in _TABLES)

    def take(values: Mapping[str, Any], key: str, default: Any) -> Any:
        return _typed(where, key, values.get(key, default), default)

    detector = take(found, "method", plain.detector)
    return Recipe(
        detector=detector,
        detector_params=_params(where, detector, found.get("params", {})),
        method=take(mended, "method", plain.method),
        min_confidence=take(mended, "min_confidence", plain.min_confidence),
        format=take(output, "format", plain.format),
        name=take(output, "name", plain.name),
        as_float=take(output, "float", plain.as_float),
        record=take(output, "record", plain.record),
        mark_outputs=take(output, "mark_outputs", plain.mark_outputs),
        prior=take(skeletons, "prior", plain.prior),
        version=take(given, "version", plain.version),
    ).beside(where.parent)


def _params(where: Path, detector: str, given: Mapping[str, Any]) -> Any:
    """The detector's parameter dataclass with the values given."""
    made = find_detector(detector).params
    if not isinstance(given, dict):
        raise FileFormatError(f"In the recipe “{where}” detect.params should be a table.")
    known = {f.name: f.default for f in fields(made) if f.name != _NO_CHOICE}
    _refuse_unknown(where, "detect.params.", given, tuple(known))
    return made(**{key: _typed(where, key, value, known[key]) for key, value in given.items()})


def _refuse_unknown(
    where: Path, table: str, given: Mapping[str, Any], known: tuple[str, ...]
) -> None:
    """Refuse a name that would otherwise be passed over in silence, such as a misspelled one."""
    for key in given:
        if key not in known:
            raise FileFormatError(
                f"The recipe “{where}” has “{table}{key}”; known there are {', '.join(known)}."
            )


def _typed(where: Path, key: str, value: Any, default: Any) -> Any:
    """A value of its default's type; whole numbers do for others too."""
    if isinstance(default, float) and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if type(value) is not type(default):
        raise FileFormatError(
            f"In the recipe “{where}” {key} should be like {_value(default)}, not {value!r}."
        )
    return value


def _value(value: Any) -> str:
    """A text, number or truth value as TOML, which writes these as JSON does."""
    return json.dumps(value, ensure_ascii=False)
