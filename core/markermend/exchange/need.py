"""Libraries that only some users have."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from markermend.errors import MethodError


def need(library: str) -> Any:
    """Import a library of the extra ``tables``.

    Raises
    ------
    MethodError
        when it is not installed; the message says how to get it
    """
    try:
        return import_module(library)
    except ImportError as error:
        raise MethodError(
            f'This needs {library}; install it with: python -m pip install "markermend[tables]"'
        ) from error
