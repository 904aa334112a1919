"""Presets: how to detect, kept under a name in the user's own folder.

A preset is a recipe (:mod:`markermend.batch.recipe`) that is found by name, so that ``batch
--recipe`` takes its file as it is.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from markermend.batch.recipe import Recipe, read_recipe
from markermend.errors import MethodError
from markermend.files.atomic import write_text

_NAME = re.compile(r"[\w][\w .+-]{0,59}")


def list_presets() -> tuple[str, ...]:
    """Names of all presets, in alphabetical order."""
    return tuple(sorted(path.stem for path in _folder().glob("*.toml")))


def has_preset(name: str) -> bool:
    """Whether saving under a name would replace a preset; some systems take A and a for one."""
    return _path(name).exists()


def save_preset(name: str, method: str, params: Any) -> Path:
    """Keep how to detect under a name; a preset of that name is replaced.

    Parameters
    ----------
    name : letters, digits, spaces and ``. + - _``, at most 60
    method : name of a detection method
    params : its parameter dataclass

    Returns
    -------
    The file written

    Raises
    ------
    MethodError
        when the name will not do, or ``params`` belong to another method
    ExportError
        when the folder cannot be written to
    """
    text = Recipe(detector=method, detector_params=params).to_toml()
    path = _path(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, text)
    return path


def load_preset(name: str) -> tuple[str, Any]:
    """Read back a preset.

    Returns
    -------
    the detection method's name, and its parameters

    Raises
    ------
    MethodError
        when there is none of that name; the message lists those there are
    FileFormatError
        when its file was damaged
    """
    path = _path(name)
    if not path.exists():
        known = ", ".join(list_presets()) or "none is saved yet"
        raise MethodError(f"There is no preset “{name}” ({known}).")
    recipe = read_recipe(path)
    return recipe.detector, recipe.detector_params


def _path(name: str) -> Path:
    """Where a preset is kept."""
    if not _NAME.fullmatch(name) or name != name.strip():
        raise MethodError(
            f"“{name}” cannot name a preset; use up to 60 letters, digits, spaces and . + - _."
        )
    return _folder() / f"{name}.toml"


def _folder() -> Path:
    """The user's own folder of presets; it need not exist."""
    from platformdirs import user_config_path

    return user_config_path("markermend", appauthor=False) / "presets"
