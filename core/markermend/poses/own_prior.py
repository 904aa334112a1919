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


def prior_for(pose: Pose, path: Path | None) -> tuple[Prior, str]:
    """What restores a recording: the prior in a file where that fits it, or else Markermend's.

    Parameters
    ----------
    pose : the recording
    path : what ``markermend train prior`` or :func:`learn_files` wrote; None for Markermend's own

    Returns
    -------
    the prior, and why it is not the one in the file, or nothing

    Raises
    ------
    FileFormatError
        when the file is not there or holds no prior
    """
    from markermend.poses.prior import shipped_prior

    if path is None:
        return shipped_prior(), ""
    own = own_prior(path)
    if fits(pose, own):
        return own, ""
    return shipped_prior(), (
        f"{path.name} does not fit this recording, whose joints are others or stand elsewhere,"
        " and is not used."
    )


def heeded(take: Take, path: Path | None) -> Take:
    """Return a skeleton recording that is restored by a prior, or that warns why it is not.

    Parameters
    ----------
    take : of joints, as it was read
    path : as for :func:`prior_for`; what it holds now serves for as long as the take is open

    Raises
    ------
    FileFormatError
        when the file is not there or holds no prior
    """
    from markermend.poses.take import pose_of, restore_by

    pose = pose_of(take)
    prior, why = prior_for(pose, path)
    restore_by(pose, prior)
    return _warning(take, why) if why else take


def heeded_if_there(take: Take, path: Path | None) -> Take:
    """As :func:`heeded`, but where the file holds no prior the take warns of that, too.

    What an operator chose long ago is not to keep recordings from being opened.
    """
    try:
        return heeded(take, path)
    except FileFormatError:
        assert path is not None
        why = f"{path.name} is gone or holds no prior, so that Markermend's own is used."
        return _warning(take, why)


def _warning(take: Take, why: str) -> Take:
    return replace(take, warnings=(why, *take.warnings))


def fits(pose: Pose, prior: Prior) -> bool:
    """Whether a prior serves a recording."""
    from markermend.poses.loose_root import body_of
    from markermend.poses.prior import fitting

    return fitting(body_of(pose), prior) is not None


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
    from markermend.poses.prior import save_prior
    from markermend.poses.prior_learning import learn_prior

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
        told = path.stat()
    except OSError as error:
        raise not_opened(path, error) from error
    # A copy may keep the time that a file was changed at.
    return _read(path, told.st_mtime_ns, told.st_ctime_ns, told.st_size, told.st_ino)


@lru_cache(maxsize=1)
def _read(path: Path, *_told: int) -> Prior:
    from markermend.poses.prior import load_prior
    from markermend.poses.prior_learning import beside_ours

    return beside_ours(load_prior(path))
