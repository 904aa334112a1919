"""Read and write skeleton recordings; the ending tells which format."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from markermend.errors import FileFormatError
from markermend.files.amc import find_skeleton, read_amc
from markermend.files.asf import read_asf
from markermend.poses.pose import Pose
from markermend.poses.skeleton import Movement, forward_kinematics
from markermend.progress import Progress

__all__ = ["read_pose"]

_USUAL_AMC_RATE = 120.0


def read_pose(
    path: str | PathLike[str],
    *,
    skeleton: str | PathLike[str] | None = None,
    rate: float | None = None,
    progress: Progress | None = None,
) -> Pose:
    """Read a skeleton recording.

    Parameters
    ----------
    path : Acclaim movement (AMC, whose ASF is looked for beside it) or skeleton (ASF: one pose,
        at rest)
    skeleton : the ASF of an AMC, where it is not beside it
    rate : poses per second, where the file does not tell (AMC: 120)
    progress : may raise to stop

    Returns
    -------
    Pose

    Raises
    ------
    FileFormatError
        when the file cannot be opened, is damaged, or of an unknown kind
    """
    where = Path(path)
    try:
        match where.suffix.lower():
            case ".amc":
                body = read_asf(Path(skeleton) if skeleton is not None else find_skeleton(where))
                movement, stated, warnings = read_amc(where, body)
                if stated is None and rate is None:
                    warnings.append("The file tells no rate; 120 Hz was assumed.")
                hertz = rate or stated or _USUAL_AMC_RATE
                return forward_kinematics(movement, hertz, warnings=tuple(warnings))
            case ".asf":
                rest = Movement(read_asf(where), {}, 1)
                return forward_kinematics(rest, rate or _USUAL_AMC_RATE)
    except OSError as error:
        reason = error.strerror or str(error)
        raise FileFormatError(f"{where.name} cannot be opened: {reason.lower()}.") from error
    raise FileFormatError(
        f"{where.name} is no skeleton recording; its name should end in .amc, .asf."
    )
