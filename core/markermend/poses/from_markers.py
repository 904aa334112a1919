"""Joint centres from markers: the point that is fixed in both of two neighbouring rigid groups."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.arrays import BoolArray, FloatArray
from markermend.errors import DataError
from markermend.mesh import Mesh, infer_mesh
from markermend.poses.pose import Pose
from markermend.progress import Progress, part
from markermend.repairs.body_frame import align, to_lab
from markermend.take import Take

LEAST_MARKERS = 3
LEAST_FRAMES = 20
# Markers less wide than this across their longest line do not tell how a group turns about it.
LEAST_WIDTH_MM = 10.0
# Groups that turn less than this against each other about some axis, root mean square, are a hinge.
LEAST_TURNING_DEG = 2.0
# A joint that turns this many times less about one axis than about any other may be a hinge.
HINGE = 2.0
# A centre that the take leaves more open than this is of no use.
MOST_DOUBT_MM = 150.0


@dataclass(frozen=True)
class Joint:
    """What is known of the joint between a group and its parent.

    Attributes
    ----------
    name : of both groups, the parent's first, after the subject where there is one
    groups : indices of parent and child in the mesh's groups
    error_mm : root mean square distance of the centre as one group carries it to the centre as
        the other does; NaN where the joint was left out. It tells how well two rigid bodies and
        one point describe the markers. A fault that skin makes alike in every frame is not in it.
    doubt_mm : how far the centre could be moved, in the direction that the movement tells least
        about, until the squared error has doubled; of a hinge, how far off the markers are along
        its axis, root mean square; NaN where it was not worked out. A bound rather than an
        expectation.
    turning_deg : root mean square angle by which the groups turn against each other, in the
        direction in which it is least; NaN where it was not worked out
    left_out : why there is no centre, one clause; empty where there is one
    along : what tells where along its axis the centre of a hinge is; empty where movement does
    """

    name: str
    groups: tuple[int, int]
    error_mm: float = np.nan
    doubt_mm: float = np.nan
    turning_deg: float = np.nan
    left_out: str = ""
    along: str = ""


@dataclass(frozen=True, eq=False)
class JointCentres:
    """Joint centres of a take.

    Attributes
    ----------
    pose : one joint for each that was not left out, at the mean of where both groups carry it, or
        where the one that is wholly seen does; unseen where neither is. A joint is turned as its
        child group is, against how that stood about the middle of the take.
    joints : every pair of neighbouring groups, parents first, those left out too
    """

    pose: Pose
    joints: tuple[Joint, ...]


@dataclass(frozen=True, eq=False)
class _Body:
    """A group's movement: ``turn @ local + place`` is in the lab, where ``posed``; its markers."""

    turn: FloatArray
    place: FloatArray
    posed: BoolArray
    shape: FloatArray


_Found = dict[tuple[int, int], tuple[Joint, FloatArray | None]]


def joint_centres(
    take: Take, mesh: Mesh | None = None, *, progress: Progress | None = None
) -> JointCentres:
    """Find the centres of the joints of a body under markers.

    Nothing but movement is used: no marker names, no measures of the person. What is damaged in
    the take pulls the centres with it, so clean first.

    Parameters
    ----------
    take : the recording, in mm; a group is used in the frames in which all its markers are seen
    mesh : its rigid groups and their tree; inferred when not given
    progress : told the share done; may raise ``Cancelled``

    Returns
    -------
    JointCentres

    Raises
    ------
    DataError
        when the take is a skeleton recording, or no joint is left; it says why

    Notes
    -----
    Symmetrical centre of rotation estimation, Ehrig, Taylor, Duda and Heller 2006, J. Biomech.
    39, 2798-2809, equation 5: the least squares solution of R_i c_i + t_i = R_j c_j + t_j over all
    frames, by singular values. Of a joint that turns about one axis this leaves a line (Ehrig,
    Taylor, Duda and Heller 2007, J. Biomech. 40, 2150-2157). Knees and elbows bend in a plane, so
    the centre is put where the joints beside it lie along the axis; where none is known, midway
    between the outermost markers of both groups.
    """
    if take.skeleton:
        raise DataError("This is a skeleton recording: its joints are in it already.")
    if mesh is None:
        mesh = infer_mesh(take, progress=part(progress, 0.0, 0.8))
    report = part(progress, 0.8, 1.0)
    bodies: list[_Body | str] = []
    for done, group in enumerate(mesh.groups):
        report(done / len(mesh.groups), "joint centres")
        bodies.append(_body(take, group.markers, group.name))
    pairs = [(g.parent, child) for child, g in enumerate(mesh.groups) if g.parent is not None]
    found: dict[tuple[int, int], tuple[Joint, FloatArray | None]] = {}
    # Hinges come after the joints that tell where along their axis they are.
    for hinges in (False, True):
        for pair in pairs:
            tried = _joint(_name(mesh, pair), pair, bodies, found if hinges else None)
            if not hinges or found[pair][1] is None or tried[0].doubt_mm < found[pair][0].doubt_mm:
                found[pair] = tried
    joints = [found[pair][0] for pair in pairs]
    places = [place for pair in pairs if (place := found[pair][1]) is not None]
    report(1.0, "joint centres")
    if not places:
        why = f" {joints[0].name}: {joints[0].left_out}." if joints else ""
        raise DataError(
            "No joint centre can be told from this take; that needs two neighbouring rigid groups"
            f" of {LEAST_MARKERS} markers or more that turn against each other.{why}"
        )
    return JointCentres(_pose(take, mesh, bodies, joints, places), tuple(joints))


def _body(take: Take, markers: tuple[int, ...], name: str) -> _Body | str:
    """A group's movement, or why it is not known."""
    if len(markers) < LEAST_MARKERS:
        return f"{name} has fewer than {LEAST_MARKERS} markers"
    columns = list(markers)
    posed = np.asarray(take.present[:, columns].all(axis=1))
    if posed.sum() < LEAST_FRAMES:
        return f"the markers of {name} are hardly ever seen together"
    turn, place = np.zeros((take.frames, 3, 3)), np.zeros((take.frames, 3))
    cloud = take.positions[posed][:, columns]
    turn[posed], place[posed] = align(cloud, np.ones(len(columns)))
    shape = np.mean((cloud - place[posed][:, None]) @ turn[posed], axis=0)
    width = np.linalg.svd(shape, compute_uv=False)[1] / np.sqrt(len(columns))
    if width < LEAST_WIDTH_MM:
        return f"the markers of {name} lie along one line"
    return _Body(turn, place, posed, shape)


def _name(mesh: Mesh, pair: tuple[int, int]) -> str:
    """Both groups, the parent's first."""
    above, below = (mesh.groups[g] for g in pair)
    return f"{below.subject}:" * bool(below.subject) + f"{above.name}/{below.name}"


def _joint(
    name: str,
    groups: tuple[int, int],
    bodies: list[_Body | str],
    known: _Found | None,
) -> tuple[Joint, FloatArray | None]:
    """One joint, and where it is, (frames, 3) with NaN where neither group is posed.

    With ``known`` joints beside it, a hinge is found too.
    """
    above, below = (bodies[g] for g in groups)
    if isinstance(above, str):
        return Joint(name, groups, left_out=above), None
    if isinstance(below, str):
        return Joint(name, groups, left_out=below), None
    both = above.posed & below.posed
    if both.sum() < LEAST_FRAMES:
        return Joint(name, groups, left_out="its groups are hardly ever seen together"), None
    centres, axes, turning = centre_of_rotation(
        above.turn[both], above.place[both], below.turn[both], below.place[both]
    )
    span, along, least, about = 0.0, "", float(turning[0]), "some"
    if known is not None and turning[1] > HINGE * turning[0]:
        centres, span, along = _along_axis(centres, axes, groups, (above, below), known)
        least, about = float(turning[1]), "a second"
        if not along:
            why = "it turns least about the limb's own length, where no joint beside it tells of it"
            return Joint(name, groups, turning_deg=turning[0], left_out=why), None
    if least < LEAST_TURNING_DEG:
        why = f"its groups turn against each other about {about} axis by {least:.1f}° only"
        return Joint(name, groups, turning_deg=turning[0], left_out=why), None
    place, error = _carried(centres, above, below)
    # Moving the centre by a distance moves the two apart by that times the angle.
    doubt = max(span, error / float(np.radians(least)))
    if doubt > MOST_DOUBT_MM:
        why = (
            f"it could lie {doubt:.0f} mm off: {least:.1f}° is too little turning for an error"
            f" of {error:.1f} mm"
        )
        return Joint(name, groups, doubt_mm=doubt, turning_deg=turning[0], left_out=why), None
    return Joint(name, groups, error, doubt, turning[0], along=along), place


def _carried(centres: FloatArray, above: _Body, below: _Body) -> tuple[FloatArray, float]:
    """(frames, 3) midway between where both bodies carry a point, and how far apart that is."""
    carried = [
        to_lab(np.broadcast_to(centre, body.place.shape), body.turn, body.place)
        for centre, body in zip(centres, (above, below), strict=True)
    ]
    both = above.posed & below.posed
    apart = carried[0][both] - carried[1][both]
    place = np.full(above.place.shape, np.nan)
    place[above.posed] = carried[0][above.posed]
    place[below.posed] = carried[1][below.posed]
    place[both] = (carried[0][both] + carried[1][both]) / 2
    return place, float(np.sqrt(np.mean((apart**2).sum(axis=1))))


def _along_axis(
    centres: FloatArray,
    axes: FloatArray,
    groups: tuple[int, int],
    bodies: tuple[_Body, _Body],
    known: _Found,
) -> tuple[FloatArray, float, str]:
    """Centres moved along a hinge's axis, how far from there the markers are, and what told.

    Nothing tells where the joints beside it lie beyond the markers: the axis is not across the
    limb.
    """
    reach = [
        (body.shape - centre) @ axis
        for body, centre, axis in zip(bodies, centres, axes, strict=True)
    ]
    markers = np.concatenate(reach)
    told = []
    for group, body, centre, axis in zip(groups, bodies, centres, axes, strict=True):
        beside = [
            float(np.nanmedian(np.einsum("fi,fij,j->f", place - body.place, body.turn, axis)[seen]))
            - float(centre @ axis)
            for pair, (_, place) in known.items()
            if place is not None and group in pair and pair != groups
            if (seen := body.posed & ~np.isnan(place[:, 0])).any()
        ]
        if beside:
            told.append(np.mean(beside))
    shift = float(np.mean(told)) if told else float(markers.min() + markers.max()) / 2
    if not markers.min() <= shift <= markers.max():
        return centres, np.nan, ""
    span = float(np.sqrt(np.mean((markers - shift) ** 2)))
    return centres + shift * axes, span, "the joints beside it" if told else "the markers' middle"


def centre_of_rotation(
    turn: FloatArray, place: FloatArray, other_turn: FloatArray, other_place: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The point that is fixed in two moving rigid bodies, by least squares.

    Parameters
    ----------
    turn, other_turn : (frames, 3, 3) rotations from each body's axes to the lab
    place, other_place : (frames, 3) their origins in the lab, mm

    Returns
    -------
    centres : (2, 3) the point in the axes of the one body and of the other, mm
    axes : (2, 3) the direction in each that the movement tells least about, of length 1
    turning : (3,) root mean square angles in degrees by which the bodies turn against each other
        in the directions in which it is least, second and third; the first is 0 where they turn
        about one axis only, and the centre is then anywhere on it
    """
    stacked = np.concatenate([turn, -other_turn], axis=2).reshape(-1, 6)
    _, singular, directions = np.linalg.svd(stacked, full_matrices=False)
    # A direction that turns by a root mean square angle a has 1 - a²/2 as its mean cosine, and the
    # smallest squared singular value is the number of frames times one minus that.
    turning = np.degrees(np.sqrt(2.0 / len(turn)) * singular[:2:-1])
    solved = np.linalg.lstsq(stacked, (other_place - place).reshape(-1), rcond=None)[0]
    axes = directions[-1].reshape(2, 3)
    return solved.reshape(2, 3), axes / np.linalg.norm(axes, axis=1, keepdims=True), turning


def _pose(
    take: Take,
    mesh: Mesh,
    bodies: list[_Body | str],
    joints: list[Joint],
    places: list[FloatArray],
) -> Pose:
    """The joints that were found as a recording; each hangs on the next one up the tree."""
    kept = [joint for joint in joints if not joint.left_out]
    at = {joint.groups[1]: i for i, joint in enumerate(kept)}
    rotations = np.full((take.frames, len(kept), 4), np.nan)
    parents = []
    for i, joint in enumerate(kept):
        body = bodies[joint.groups[1]]
        assert isinstance(body, _Body)
        rotations[body.posed, i] = Rotation.from_matrix(body.turn[body.posed]).as_quat()
        above: int | None = joint.groups[0]
        while above is not None and above not in at:
            above = mesh.groups[above].parent
        parents.append(-1 if above is None else at[above])
    names = tuple(joint.name for joint in kept)
    return Pose(
        np.stack(places, axis=1),
        rotations,
        names,
        tuple(parents),
        take.rate,
        first_frame=take.first_frame,
    )
