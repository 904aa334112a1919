"""Which prior skeleton recordings under review are restored with: the user's own where it fits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from markermend.errors import FileFormatError
from markermend.files.opening import not_opened
from markermend.progress import Progress, part, quiet

if TYPE_CHECKING:
    from markermend.poses.pose import Pose
    from markermend.poses.prior import Prior
    from markermend.take import Take

_chosen: Path | None = None


def choose_prior(path: Path | None) -> None:
    """Let recordings that are restored from now on be so with a prior of the user's own.

    Parameters
    ----------
    path : what ``markermend train prior`` or :func:`learn_files` wrote; None for Markermend's own.
        It is read when it is needed.
    """
    global _chosen
    _chosen = path


def prior_for(pose: Pose) -> Prior:
    """The prior that was chosen, where it can be read and fits a recording, or Markermend's."""
    from markermend.poses.prior import shipped_prior

    own = _readable()
    return own if own is not None and fits(pose, own) else shipped_prior()


def fits(pose: Pose, prior: Prior) -> bool:
    """Whether a prior serves a recording."""
    from markermend.poses.loose_root import body_of
    from markermend.poses.prior import fitting

    return fitting(body_of(pose), prior) is not None


def why_not_used(pose: Pose) -> str:
    """Why a recording is restored by Markermend's own prior though another was chosen, or nothing.

    Parameters
    ----------
    pose : the recording
    """
    if _chosen is None:
        return ""
    own = _readable()
    if own is None:
        return f"{_chosen.name} is gone or holds no prior, so that Markermend's own is used."
    if fits(pose, own):
        return ""
    return (
        f"{_chosen.name} does not fit this recording, whose joints are others or stand elsewhere,"
        " and is not used."
    )


def heeded(take: Take, path: Path | None) -> Take:
    """Return a skeleton recording that is restored by a prior, or that warns why it is not.

    Parameters
    ----------
    take : of joints
    path : what :func:`choose_prior` takes
    """
    from markermend.poses.take import pose_of

    choose_prior(path)
    why = why_not_used(pose_of(take))
    return replace(take, warnings=(why, *take.warnings)) if why else take


def learn_files(paths: Sequence[Path], target: Path, *, progress: Progress | None = None) -> Prior:
    """Learn a prior from the clean recordings in files, and write it.

    Parameters
    ----------
    paths : skeleton recordings of the same joints
    target : file to write, whole or not at all
    progress : told the share done; may raise to stop

    Raises
    ------
    MarkermendError
        when a file cannot be read or written, or nothing can be learnt from the recordings
    """
    from markermend.files.pose import read_pose
    from markermend.poses.prior import learn_prior, save_prior

    tell, poses = progress or quiet, []
    for n, path in enumerate(paths):
        one = part(tell, 0.4 * n / len(paths), 0.4 * (n + 1) / len(paths))
        poses.append(read_pose(path, progress=one))
    names = [path.name for path in paths]
    prior = learn_prior(poses, names=names, progress=part(tell, 0.4, 0.9))
    tell(0.9, "Writing")
    save_prior(prior, target)
    return prior


def own_prior(path: Path) -> Prior:
    """A prior of the user's own, together with Markermend's where both know the 17 joints.

    It is read once, and anew where the file has changed.

    Raises
    ------
    FileFormatError
        when the file is not there or holds no prior
    """
    try:
        changed = path.stat().st_mtime_ns
    except OSError as error:
        raise not_opened(path, error) from error
    return _read(path, changed)


def _readable() -> Prior | None:
    """The prior that was chosen, if there is one that can be read."""
    try:
        return None if _chosen is None else own_prior(_chosen)
    except FileFormatError:
        return None


@lru_cache(maxsize=1)
def _read(path: Path, _changed: int) -> Prior:
    from markermend.poses.prior import beside_ours, load_prior

    return beside_ours(load_prior(path))
