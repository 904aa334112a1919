"""One take of a batch: read, detect, repair, write, and note that it is done."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import markermend as mm
from markermend.artifact import repair_in_words
from markermend.artifact_json import to_dict
from markermend.batch.recipe import NAME, Recipe
from markermend.batch.sources import Source
from markermend.encoding import json_kept
from markermend.errors import DataError, ExportError, MarkermendError
from markermend.files.atomic import write_text
from markermend.outcome import Outcome, cleaned_document, outcomes
from markermend.patch import patched
from markermend.plugins.formats import writable, writable_in_words
from markermend.progress import Progress, part
from markermend.repairs import repair_all
from markermend.report import quality, take_report
from markermend.report.quality import waits
from markermend.take import Take

TAKES, STATE = "takes", "state"


@dataclass(frozen=True)
class Job:
    """A take to be cleaned into a folder.

    Attributes
    ----------
    source : the take
    folder : of the batch
    recipe : what is done to it
    resume : leave it if it is done already, by this recipe from this very file
    """

    source: Source
    folder: Path
    recipe: Recipe
    resume: bool = False

    @property
    def state(self) -> Path:
        """Where it is noted what was done."""
        return self.folder / STATE / f"{self.source.name}.json"

    @property
    def output(self) -> Path:
        """The repaired take."""
        kind = self.recipe.format
        ending = self.source.path.suffix.lower() if kind == "same" else f".{kind}"
        place = self.folder / TAKES / self.source.name
        return place.with_name(self.recipe.name.replace(NAME, place.name) + ending)

    @property
    def json(self) -> Path:
        """What was found and done."""
        return self.folder / TAKES / f"{self.source.name}.json"

    @property
    def report(self) -> Path:
        """The same for people."""
        return self.folder / TAKES / f"{self.source.name}.html"


def clean_one(job: Job, progress: Progress) -> bool:
    """Clean one take and write all that comes of it; the note that it is done comes last.

    Parameters
    ----------
    job : what to do
    progress : told the share done; may raise to stop

    Returns
    -------
    whether there was anything to do

    Raises
    ------
    MarkermendError
        when the take cannot be read, cleaned or written
    """
    progress(0.0, "Reading")
    source = sha256(job.source.path)
    if job.resume and is_done(job, source):
        return False
    take = mm.read(job.source.path, progress=part(progress, 0.0, 0.05))
    if take.read_only:
        # Without an operator to look at it, half a take must not pass for a cleaned one.
        raise DataError(" ".join((f"{job.source.path.name} is damaged.", *take.warnings[:1])))
    _check_output(job, take)
    prior = None
    if take.skeleton:
        take, prior = _heeded(take, job.recipe)
    mesh = mm.infer_mesh(take)
    recipe = job.recipe
    found = mm.detect(
        take,
        method=recipe.detector,
        params=recipe.detector_params,
        mesh=mesh,
        progress=part(progress, 0.1, 0.8),
    )
    pairs = repair_all(
        take,
        found,
        method=recipe.method,
        min_confidence=recipe.min_confidence,
        mesh=mesh,
        progress=part(progress, 0.8, 0.95),
    )
    clean = patched(take, (patch for _, repair in pairs for patch in repair.patches))
    record = [repair_in_words(take, a, r.method) for a, r in pairs if r.patches]
    progress(0.95, "Writing")
    for folder in {job.output.parent, job.state.parent}:
        folder.mkdir(parents=True, exist_ok=True)
    mm.write(
        clean,
        job.output,
        as_float=recipe.as_float,
        record=record if recipe.record else (),
        mark_outputs=recipe.mark_outputs,
    )
    read = {"source_sha256": source, "prior_sha256": prior}
    _describe(job, read, take, clean, outcomes(found, pairs, recipe.min_confidence))
    progress(1.0, "Done")
    return True


def _heeded(take: Take, recipe: Recipe) -> tuple[Take, str | None]:
    """A skeleton recording that is restored by the recipe's prior, and the SHA-256 of that."""
    # Only a batch of skeletons has to wait until all about poses is loaded.
    from markermend.poses.own_prior import heeded

    # Before it is read: what changes in between is to be noticed.
    told = _prior_sha256(recipe)
    return heeded(take, Path(recipe.prior) if recipe.prior else None), told


def _check_output(job: Job, take: Take) -> None:
    """Refuse, before any work is done, a take that cannot be written as it is to be."""
    if job.output.suffix.lower() not in writable(skeleton=take.skeleton):
        endings = writable_in_words().replace(".", "")
        raise ExportError(
            f"{job.source.path.name} cannot be written in the format it came in; let the recipe's"
            f" output format be {endings}."
        )


def is_done(job: Job, source: str) -> bool:
    """Whether the note says so and everything it names is there, unchanged.

    Parameters
    ----------
    job : a take
    source : SHA-256 of its file
    """
    try:
        note = read_note(job)
        return (
            note["source_sha256"] == source
            and note["recipe_sha256"] == job.recipe.hash
            and note["prior_sha256"] in (None, _prior_sha256(job.recipe))
            and all(sha256(job.folder / p) == was for p, was in note["outputs"].items())
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        # A note that cannot be read is as good as none.
        return False


def read_note(job: Job) -> dict[str, Any]:
    """What was noted when a take was done: hashes, ``quality`` and ``review``."""
    note: dict[str, Any] = json.loads(job.state.read_text(encoding="utf-8"))
    return note


def sha256(path: Path) -> str:
    """SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _prior_sha256(recipe: Recipe) -> str | None:
    """SHA-256 of the recipe's prior, if it has one."""
    return sha256(Path(recipe.prior)) if recipe.prior else None


def json_text(values: Mapping[str, Any]) -> str:
    """Write values as JSON."""
    return json.dumps(values, ensure_ascii=False, indent=1, allow_nan=False) + "\n"


def json_with_paths(values: Mapping[str, Any]) -> str:
    """Write values as JSON that is read back to find the files it names, whatever their names."""
    return json_kept(json_text(values))


def why(error: Exception) -> str:
    """One sentence about what stopped a take."""
    if isinstance(error, MarkermendError):
        return str(error)
    if isinstance(error, MemoryError):
        return "There is not enough memory for this take."
    if isinstance(error, OSError):
        return f"{error.filename or 'A file'} cannot be used: {error.strerror or error}."
    return f"Markermend itself failed ({type(error).__name__}: {error}); please report it."


def _describe(
    job: Job, read: Mapping[str, str | None], take: Take, clean: Take, done: Sequence[Outcome]
) -> None:
    """Write JSON, report and, last, the note that the take is done, and from which files."""
    name, method = job.source.name, job.recipe.detector
    described = cleaned_document(take, done, method, mm.__version__, name=job.source.path.name)
    write_text(job.json, json_text(described))
    write_text(job.report, take_report(take, clean, done, method=method, name=name))
    outputs = (job.output, job.json, job.report)
    note = {
        **read,
        "recipe_sha256": job.recipe.hash,
        "outputs": {p.relative_to(job.folder).as_posix(): sha256(p) for p in outputs},
        "quality": quality(name, take, clean, done).to_dict(),
        "review": [{**to_dict(o.artifact), "reason": o.reason} for o in done if waits(o)],
    }
    write_text(job.state, json_with_paths(note))
