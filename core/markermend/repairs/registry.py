"""One list of repair methods, from which forms, command line and docs are generated.

A method is a frozen dataclass of parameters and a pure function. It sees the take through
:class:`Evidence`, which says which samples may be believed, and returns a :class:`Repair`:
patches for the artifact's interval and axes (and its counterpart's, for a swap), or none with
the reason. "Cannot repair" is a value, not an exception.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from types import MappingProxyType
from typing import Any

from markermend.arrays import BoolArray, FloatArray
from markermend.artifact import Artifact
from markermend.mesh import Mesh
from markermend.patch import Patch
from markermend.plugins.discover import REPAIRS as PLUGINS
from markermend.plugins.guards import guard_method
from markermend.progress import Progress, quiet
from markermend.registry import Registry
from markermend.take import Take


@dataclass(frozen=True, eq=False)
class Evidence:
    """What a repair may look at.

    Attributes
    ----------
    take : the recording as it stands
    trusted : (frames, markers, 3) bool; false where missing or flagged as damaged, the
        artifact under repair included
    mesh : the body's structure, or None when nobody has worked it out yet
    progress : told by methods that take seconds how far they are; may raise ``Cancelled``
    """

    take: Take
    trusted: BoolArray
    mesh: Mesh | None = None
    progress: Progress = quiet

    @cached_property
    def seen(self) -> BoolArray:
        """(frames, markers) bool, read-only: believed in all three coordinates."""
        # Axis by axis, since reducing over an axis of three is ten times slower.
        seen: BoolArray = self.trusted[:, :, 0] & self.trusted[:, :, 1]
        seen &= self.trusted[:, :, 2]
        seen.flags.writeable = False
        return seen

    def with_seen(self, seen: BoolArray) -> Evidence:
        """Itself, spared to work out :attr:`seen`, which takes a while in long takes.

        Parameters
        ----------
        seen : (frames, markers) bool, what ``trusted`` comes to; becomes read-only
        """
        seen.flags.writeable = False
        self.__dict__["seen"] = seen
        return self


@dataclass(frozen=True, eq=False)
class Repair:
    """What a method proposes for one artifact.

    Attributes
    ----------
    method : name in the registry
    patches : new values; empty when the method cannot repair here
    reason : why there are none, or why another method than the first choice was used
    error_mm : expected mean Euclidean error over the interval, or None when unknown
    band_mm : (stop - start,) expected deviation per frame (one standard deviation), or None
    params : parameters used
    leaves : sudden artifacts that the detector would find there once it is carried out; None
        when it did not look
    weights : how many numbers were learnt for it: weights, coefficients, components; of processes
        and kernels the effective number, the trace of the smoother; 0 for methods that learn none
    """

    method: str
    patches: tuple[Patch, ...] = ()
    reason: str = ""
    error_mm: float | None = None
    band_mm: FloatArray | None = None
    params: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    leaves: tuple[Artifact, ...] | None = None
    weights: int = 0

    def __reduce__(self) -> tuple[Any, ...]:
        # A read-only mapping cannot be pickled, and plugins repair in another process.
        values = (getattr(self, f.name) for f in fields(self))
        return Repair, tuple(dict(v) if isinstance(v, MappingProxyType) else v for v in values)

    def __repr__(self) -> str:
        if not self.patches:
            return f"<Repair by {self.method}: none, {self.reason}>"
        places = ", ".join(f"{p.marker} [{p.start}, {p.stop})" for p in self.patches)
        error = "" if self.error_mm is None else f", about {self.error_mm:.2g} mm off"
        return f"<Repair by {self.method}: {places}{error}>"


MethodFunction = Callable[[Evidence, Artifact, Any], Repair]


@dataclass(frozen=True)
class Method:
    """A registered repair method.

    Attributes
    ----------
    name : short name for command line and files
    label : name for people
    summary : one sentence on what it does and when it is right
    params : frozen dataclass; each field's metadata may give ``unit``, ``min``, ``max``, ``help``
    run : ``(evidence, artifact, params) -> Repair``
    source : paper and equation, or empty
    key : the number key that picks it in a review, or None
    plugin : the package that brings it, empty for ours
    crosses_blackout : whether it can repair where no other marker is seen, from the whole body's
        movement before and after
    """

    name: str
    label: str
    summary: str
    params: type
    run: MethodFunction
    source: str = ""
    key: int | None = None
    plugin: str = ""
    crosses_blackout: bool = False


REPAIRS = Registry(
    "repair method",
    Method,
    PLUGINS,
    guard_method,
    order=lambda m: (m.key is None, m.key or 0, m.name),
)
"""Every repair method by name, in the order operators see them (keys 1 to 9)."""


def register(
    name: str,
    *,
    label: str,
    summary: str,
    params: type,
    source: str = "",
    key: int | None = None,
    crosses_blackout: bool = False,
) -> Callable[[MethodFunction], MethodFunction]:
    """Add a method to :data:`REPAIRS`; used as a decorator.

    Methods with a number key come first, in that order, then the others by name.

    Parameters
    ----------
    name, label, summary, params, source, key, crosses_blackout : of the :class:`Method`, whose
        ``run`` is the function below the decorator
    """

    def add(run: MethodFunction) -> MethodFunction:
        made = Method(
            name, label, summary, params, run, source, key, crosses_blackout=crosses_blackout
        )
        REPAIRS.add(made)
        return run

    return add


def find_method(name: str) -> Method:
    """Look a method up.

    Raises
    ------
    MethodError
        when there is none of that name; the message lists those there are
    """
    return REPAIRS.find(name)
