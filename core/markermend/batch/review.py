"""What a batch left for an operator, taken into a review of the source.

The review begins where the batch ended: what it repaired is repaired, and can be undone like
anything else; what it left is open.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from markermend.artifact import Artifact, Status, axis_columns, changed_markers
from markermend.artifact_json import artifacts_of, from_dict
from markermend.batch.run import REVIEW
from markermend.batch.sources import find_takes
from markermend.errors import DataError, FileFormatError
from markermend.files import read
from markermend.patch import Patch
from markermend.review.place import source_hash
from markermend.review.session import Session
from markermend.take import Take

if TYPE_CHECKING:
    from markermend.repairs import Repair


@dataclass(frozen=True)
class ToReview:
    """A take that waits for an operator.

    Attributes
    ----------
    path : the recording
    name : as lists show it
    found : JSON of what a batch found and did, or None where none was run
    cleaned : the take as the batch repaired it, or None
    sha256 : of the recording that was cleaned, or None
    prior : by which a batch restored a skeleton, or None for Markermend's own
    """

    path: Path
    name: str
    found: Path | None = None
    cleaned: Path | None = None
    sha256: str | None = None
    prior: Path | None = None


def takes_to_review(given: Iterable[str | Path]) -> tuple[ToReview, ...]:
    """List takes to be reviewed: files as they are named, then those of folders by their names.

    Parameters
    ----------
    given : takes, folders and patterns as for :func:`markermend.batch.find_takes`; or one
        ``review.json`` of a batch, or the folder it was written to

    Raises
    ------
    MarkermendError
        when something given is not there
    FileFormatError
        when the JSON is not the list of a batch
    """
    items = [Path(item) for item in given]
    if len(items) == 1:
        whole = items[0] / REVIEW if items[0].is_dir() else items[0]
        if whole.suffix.lower() == ".json" and whole.is_file():
            return _listed(whole)
    place = {item.resolve(): i for i, item in reversed(list(enumerate(items))) if item.is_file()}
    found = sorted(find_takes(items), key=lambda source: place.get(source.path, len(items)))
    return tuple(ToReview(source.path, source.name) for source in found)


def take_over(session: Session, item: ToReview) -> bool:
    """Begin a review with what a batch found and did.

    Parameters
    ----------
    session : a review of the source in which nothing was done
    item : the take

    Returns
    -------
    Whether there was anything; not where no batch was run

    Raises
    ------
    FileFormatError
        when what the batch wrote cannot be read
    DataError
        when the source is no longer the take that was cleaned
    """
    if item.found is None or item.cleaned is None:
        return False
    values = _json(item.found)
    take, clean = session.original, read(item.cleaned)
    same = item.sha256 is None or source_hash(take) == item.sha256
    if not same or (take.labels, take.frames) != (clean.labels, clean.frames):
        raise DataError(
            f"“{item.path.name}” is no longer the take that was cleaned; run the batch again."
        )
    found = artifacts_of(values)
    how = [listed.get("repair") or {} for listed in values["artifacts"]]
    pending = (a.with_status(Status.PENDING) for a in found)
    session.add_detected(pending, str(values["method"]), by_itself=True)
    repairs = [
        (a.id, _repair(a, h, clean)) for a, h in zip(found, how, strict=True) if h.get("method")
    ]
    if repairs:
        session.repair(repairs, f"Repair {len(repairs)} artifacts (batch)", by_itself=True)
    return True


def _repair(artifact: Artifact, told: Mapping[str, Any], clean: Take) -> Repair:
    """The repair of an artifact as the batch told it."""
    from markermend.repairs import Repair

    band, method = told.get("band_mm"), str(told["method"])
    return Repair(
        method,
        _patches(artifact, method, clean),
        error_mm=told["error_mm"],
        band_mm=None if band is None else np.array(band),
        leaves=tuple(from_dict(left) for left in told.get("leaves", ())),
    )


def _listed(path: Path) -> tuple[ToReview, ...]:
    """Takes of a batch's list."""
    try:
        return tuple(
            ToReview(
                Path(entry["source"]),
                str(entry["name"]),
                path.parent / entry["json"],
                path.parent / entry["cleaned"],
                entry.get("source_sha256"),
                Path(entry["prior"]) if entry.get("prior") else None,
            )
            for entry in _json(path)["takes"]
        )
    except (KeyError, TypeError) as error:
        raise FileFormatError(
            f"“{path}” is not the list of a batch; open the “{REVIEW}” that it wrote."
        ) from error


def _json(path: Path) -> Any:
    """Read a JSON file that a batch wrote."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FileFormatError(f"“{path}” cannot be read; run the batch again.") from error


def _patches(artifact: Artifact, method: str, clean: Take) -> tuple[Patch, ...]:
    """What the repair of an artifact wrote, as it stands in the cleaned take."""
    names = changed_markers(artifact, method)
    rows, axes = slice(artifact.start, artifact.stop), axis_columns(artifact.axes)
    return tuple(
        Patch(
            name,
            artifact.axes,
            artifact.start,
            artifact.stop,
            clean.positions[rows, clean.index(name)][:, axes],
        )
        for name in names
    )
