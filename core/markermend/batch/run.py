"""A whole batch: plan it, do it, and sum it up."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import markermend as mm
from markermend.batch.cluster import connected, run_on_cluster
from markermend.batch.pool import Message, run_jobs
from markermend.batch.recipe import Recipe
from markermend.batch.sources import Source
from markermend.batch.work import (
    STATE,
    TAKES,
    Job,
    clean_one,
    json_text,
    json_with_paths,
    read_note,
    sha256,
)
from markermend.encoding import utf8
from markermend.errors import ExportError
from markermend.files.atomic import write_text, write_whole
from markermend.report import Quality, batch_parts

if TYPE_CHECKING:
    from distributed import Client

RECIPE, REPORT, REVIEW, INDEX = "recipe.toml", "report.html", "review.json", "index.json"
Listener = Callable[[Message, Source, float], None]


@dataclass(frozen=True)
class BatchResult:
    """What became of a batch.

    Attributes
    ----------
    takes : quality of each take that is cleaned, by name
    failures : sentence for each that could not be, by name
    skipped : takes that an earlier run had done already
    review : artifacts that wait for an operator
    """

    takes: Mapping[str, Quality]
    failures: Mapping[str, str]
    skipped: int
    review: int


def run_batch(
    takes: Sequence[Source],
    folder: str | Path,
    recipe: Recipe | None = None,
    *,
    jobs: int = -1,
    cluster: str | Client | None = None,
    resume: bool = False,
    force: bool = False,
    listener: Listener | None = None,
) -> BatchResult:
    """Clean takes into a folder.

    The folder receives ``recipe.toml``; under ``takes`` each repaired take with its JSON and
    report; ``report.html`` and ``index.json`` about all; and ``review.json``, which lists the
    takes with artifacts that wait for an operator. Same takes, recipe and version give the same
    bytes, on any number of processes, undisturbed or resumed.

    Parameters
    ----------
    takes : from :func:`find_takes`
    folder : made when it is not there
    recipe : what is done to each, the defaults when None
    jobs : processes; -1 as many as there are cores
    cluster : address of a Dask scheduler, or a client of it, to use instead of processes here;
        its workers must see takes, folder and the recipe's prior under the same paths
    resume : do only what an earlier run into this folder, by the same recipe, left
    force : do everything again, over what is there
    listener : told every message, its take, and the share done of the whole batch by file size;
        may raise to stop, after which ``resume`` goes on

    Raises
    ------
    ExportError
        when the folder is a file, or holds results already and neither ``resume`` nor ``force``
        is set, or a result would be written over one of the takes
    FileFormatError
        when the recipe's prior is not there or is none
    MarkermendError
        when the cluster does not answer
    """
    whole = Path(folder).resolve()
    chosen = (recipe or Recipe()).beside(Path())
    plan = [Job(source, whole, chosen, resume) for source in takes]
    _check(plan, whole, fresh=not (resume or force))
    if chosen.prior:
        # Before the first skeleton would fail for want of it.
        from markermend.poses.own_prior import own_prior

        own_prior(Path(chosen.prior))
    with nullcontext() if cluster is None else connected(cluster) as client:
        whole.mkdir(parents=True, exist_ok=True)
        write_text(whole / RECIPE, chosen.to_toml())
        failures, skipped = _work(plan, _processes(jobs) if client is None else client, listener)
    for part in (p for below in (TAKES, STATE) for p in (whole / below).rglob(".*.part")):
        # A killed worker leaves the file it was writing.
        part.unlink(missing_ok=True)
    return _sum_up(plan, whole, {name: failures[name] for name in sorted(failures)}, skipped)


def _work(
    plan: Sequence[Job], workers: int | Client, listener: Listener | None
) -> tuple[dict[str, str], int]:
    """Clean takes by processes or a cluster; why some failed, how many were done before."""
    # Largest first, so that no process is left with a long take at the end.
    size = {job.source.name: job.source.path.stat().st_size + 1 for job in plan}
    ordered = sorted(plan, key=lambda job: (-size[job.source.name], job.source.name))
    shares = dict.fromkeys(size, 0.0)
    failures: dict[str, str] = {}
    skipped = 0
    if isinstance(workers, int):
        running = run_jobs(ordered, clean_one, workers)
    else:
        running = run_on_cluster(ordered, clean_one, workers)
    with closing(running) as messages:
        for message in messages:
            source = ordered[message.job].source
            shares[source.name] = message.share
            if message.what == "failed":
                failures[source.name] = str(message.result)
            skipped += message.what == "done" and not message.result
            if listener is not None:
                done = sum(size[name] * share for name, share in shares.items())
                listener(message, source, done / sum(size.values()))
    return failures, skipped


def _check(plan: Sequence[Job], folder: Path, *, fresh: bool) -> None:
    """Refuse, before any work is done, to write over takes or over earlier results."""
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"“{folder}” is a file; name a folder for what is written.")
    if fresh and (folder / RECIPE).exists():
        raise ExportError(
            f"“{folder}” holds results already; add --resume to do what is left, or --force to do "
            "everything again."
        )
    sources = {job.source.path for job in plan}
    seen: dict[str, Path] = {}
    for job in plan:
        for path in (job.output, job.json, job.report):
            if path in sources:
                raise ExportError(f"“{path}” is one of the takes; name another folder to write.")
            other = seen.setdefault(str(path).casefold(), job.source.path)
            if other != job.source.path:
                raise ExportError(
                    f"“{other}” and “{job.source.path}” would both be written as “{path.name}”; "
                    "change the recipe's output name."
                )
            if fresh and path.exists():
                raise ExportError(f"“{path}” exists already; add --force to overwrite it.")


def _processes(jobs: int) -> int:
    """How many processes to use; -1 as many as this process may use cores."""
    if jobs > 0:
        return jobs
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _sum_up(
    plan: Sequence[Job], folder: Path, failures: Mapping[str, str], skipped: int
) -> BatchResult:
    """Write what is told about all takes, reading one take's notes at a time."""
    done = [job for job in plan if job.source.name not in failures]
    takes: dict[str, Quality] = {}
    review: list[dict[str, Any]] = []
    index: list[dict[str, Any]] = []
    for job in done:
        note = read_note(job)
        takes[job.source.name] = Quality(**note["quality"])
        place = {
            "source": str(job.source.path),
            "cleaned": job.output.relative_to(folder).as_posix(),
            "json": job.json.relative_to(folder).as_posix(),
            "report": job.report.relative_to(folder).as_posix(),
        }
        place["source_sha256"] = note["source_sha256"]
        index.append(place | note["quality"])
        if note["review"]:
            prior = {"prior": job.recipe.prior} if note["prior_sha256"] else {}
            review.append({"name": job.source.name, **place, **prior, "artifacts": note["review"]})
    failed = [{"name": name, "why": why} for name, why in failures.items()]
    about: dict[str, Any] = {"version": mm.__version__, "recipe_sha256": sha256(folder / RECIPE)}
    write_text(folder / INDEX, json_text(about | {"takes": index, "failed": failed}))
    least = plan[0].recipe.min_confidence
    waiting = about | {"min_confidence": least, "takes": review}
    write_text(folder / REVIEW, json_with_paths(waiting))
    pages = (job.report.read_text(encoding="utf-8") for job in done)
    _write_parts(folder / REPORT, batch_parts(list(takes.values()), failures, pages))
    return BatchResult(takes, failures, skipped, sum(q.review for q in takes.values()))


def _write_parts(path: Path, parts: Iterable[str] | Iterator[str]) -> None:
    """Write text part by part, whole or not at all."""
    write_whole(path, lambda file: file.writelines(utf8(p) for p in parts), backup=False)
