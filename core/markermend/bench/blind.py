"""Which version of a movement looks most natural: a page that asks people, and their votes.

Versions stand side by side under letters drawn anew for every movement; which letter hides which
version only the key tells. The questions are those of Goncalves and others (2024), section 4.3 and
Table 6: the most natural version, and the second most natural.
"""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import json
import string
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from scipy.ndimage import uniform_filter1d

from markermend.arrays import FloatArray
from markermend.bench.scales import SCALES, occlusion_scales
from markermend.errors import DataError
from markermend.poses.pose import Pose
from markermend.vertical import vertical_axis

QUESTIONS = ("most natural", "second most natural")
MOST_VERSIONS = 6
COLUMNS = ("study", "rater", "movement", "question", "answer")
_UNSEEN, _FARTHEST = -32768, 32767
_PLACE = "/*STUDY*/null"


@dataclass(frozen=True)
class Version:
    """One version of one movement.

    Attributes
    ----------
    name : what its votes are counted under, the same in every movement
    file : where it was read from
    pose : the recording
    """

    name: str
    file: str
    pose: Pose


@dataclass(frozen=True)
class Votes:
    """What people found.

    Attributes
    ----------
    people : number
    by_version : for every version its votes by question (:data:`QUESTIONS`), as Table 6 has them
    by_scale : for every version its votes for the most natural by scale of occlusion
        (:func:`occlusion_scales`), as Figure 22 has them; none where all movements are alike
    """

    people: int
    by_version: dict[str, list[int]]
    by_scale: dict[str, list[int]]


def blind_page(movements: Sequence[Sequence[Version]], *, seed: int) -> tuple[str, dict[str, Any]]:
    """Make the page that asks, and the key to it.

    Parameters
    ----------
    movements : the versions of each movement, with the same names in every one
    seed : same seed, same letters

    Returns
    -------
    HTML that needs no other file and names none, and the key: for every movement the version and
    the file behind each letter, and how many joints are not seen in a pose of the version that has
    most of these

    Raises
    ------
    DataError
        when versions of a movement differ in joints, frames or rate, or are too few or too many
    """
    random = np.random.default_rng(seed)
    shown, hidden, unseen = [], [], []
    for versions in movements:
        _check(versions)
        order = [versions[i] for i in random.permutation(len(versions))]
        shown.append(_movement([version.pose for version in order], versions[0].pose.parents))
        hidden.append(
            {
                letter: {"version": version.name, "file": version.file}
                for letter, version in zip(string.ascii_uppercase, order, strict=False)
            }
        )
        unseen.append(max(float((~v.pose.seen).sum(axis=1).mean()) for v in versions))
    names = [version.name for version in movements[0]]
    questions = QUESTIONS[: len(names) - 1]
    study = hashlib.sha256(json.dumps(shown).encode()).hexdigest()[:12]
    content = {"study": study, "columns": COLUMNS, "questions": questions, "movements": shown}
    template = files("markermend_resources").joinpath("blind.html").read_text("utf-8")
    key = {"study": study, "seed": seed, "versions": names, "movements": hidden, "unseen": unseen}
    return template.replace(_PLACE, json.dumps(content)), key


def is_key(key: dict[str, Any]) -> bool:
    """Whether a document is the key of :func:`blind_page`, whole."""
    study, names, movements = (key.get(part) for part in ("study", "versions", "movements"))
    unseen = key.get("unseen", [])
    if not (isinstance(study, str) and isinstance(names, list) and names):
        return False
    if not (isinstance(movements, list) and movements and isinstance(unseen, list)):
        return False
    return all(isinstance(count, int | float) for count in unseen) and all(
        isinstance(hidden, dict)
        and hidden
        and all(isinstance(v, dict) and v.get("version") in names for v in hidden.values())
        for hidden in movements
    )


def tally(key: dict[str, Any], answers: Sequence[str]) -> Votes:
    """Count the votes.

    Parameters
    ----------
    key : of :func:`blind_page`
    answers : text of the CSV files that the page saved

    Raises
    ------
    DataError
        when answers belong to another page, are no answers, or somebody answers twice or gives
        one version both places
    """
    votes: Counter[tuple[str, str]] = Counter()
    scaled: Counter[tuple[str, int]] = Counter()
    scale = _scales(key)
    given: dict[tuple[str, str], dict[str, str]] = {}
    for text in answers:
        rows = csv.DictReader(io.StringIO(text.removeprefix("\ufeff")))
        if tuple(rows.fieldnames or ()) != COLUMNS:
            raise DataError(f"Answers begin with the line {','.join(COLUMNS)}; these do not.")
        for row in rows:
            study, rater, movement, question, answer = (row[name] or "" for name in COLUMNS)
            if study != key["study"]:
                raise DataError("The answers belong to another page; use the key written with it.")
            if question not in QUESTIONS:
                raise DataError(f"The page does not ask “{question}”, which “{rater}” answers.")
            number = int(movement) - 1 if movement.isdecimal() else -1
            there = key["movements"][number] if 0 <= number < len(key["movements"]) else {}
            if answer not in there:
                raise DataError(f"The page has no version {answer} of movement {movement}.")
            before = given.setdefault((rater, str(number)), {})
            if question in before:
                raise DataError(f"“{rater}” answers twice; leave one of the files out.")
            if answer in before.values():
                raise DataError(
                    f"“{rater}” gives version {answer} of movement {movement} both places; the page"
                    " lets nobody do that, so leave this file out."
                )
            before[question] = answer
            version = there[answer]["version"]
            votes[version, question] += 1
            if scale and question == QUESTIONS[0]:
                scaled[version, scale[number]] += 1
    names = key["versions"]
    return Votes(
        len({rater for rater, _ in given}),
        {name: [votes[name, question] for question in QUESTIONS] for name in names},
        {name: [scaled[name, n] for n in range(SCALES)] for name in names} if scale else {},
    )


def _scales(key: dict[str, Any]) -> list[int]:
    """Scale of occlusion of each movement; none where they are alike or the key does not tell."""
    unseen = np.array(key.get("unseen", []), dtype=float)
    if len(set(unseen.tolist())) < 2 or len(unseen) != len(key["movements"]):
        return []
    return [int(n) for n in occlusion_scales(unseen)[0]]


def _check(versions: Sequence[Version]) -> None:
    """Refuse what cannot stand side by side."""
    if not 2 <= len(versions) <= MOST_VERSIONS:
        raise DataError(f"Give 2 to {MOST_VERSIONS} versions of a movement, not {len(versions)}.")
    first = versions[0]
    for other in versions[1:]:
        for what, ours, theirs in (
            ("joints", first.pose.joints, other.pose.joints),
            ("number of poses", first.pose.frames, other.pose.frames),
            ("rate", first.pose.rate, other.pose.rate),
        ):
            if ours != theirs:
                raise DataError(
                    f"“{first.file}” and “{other.file}” differ in their {what};"
                    " give versions of the same recording."
                )


def _movement(poses: Sequence[Pose], parents: Sequence[int]) -> dict[str, Any]:
    """What the page needs to draw versions side by side: mm, z up, 0 on the floor."""
    together = np.stack([pose.positions for pose in poses])
    if np.isnan(together).all():
        raise DataError("No version has a single joint that was seen.")
    up = vertical_axis(np.concatenate(list(together), axis=1))
    # Cyclic, so that left stays left.
    together = np.roll(together, 2 - up, axis=3)
    flat = together.reshape(-1, 3)
    middle = np.nanmedian(flat, axis=0)
    lowest = np.where(np.isnan(together), np.inf, together)[:, :, :, 2].min(axis=2)
    # What was thrown below the floor must not lower it.
    middle[2] = np.percentile(lowest[np.isfinite(lowest)], 10)
    together = together - middle
    centre = _centre(together, poses[0].rate)
    reach = np.nanpercentile(np.linalg.norm(together - centre[None, :, None], axis=3), 95)
    return {
        "rate": poses[0].rate,
        "parents": list(parents),
        "frames": poses[0].frames,
        "reach": round(float(reach)),
        "centre": _packed(centre),
        "versions": [_packed(version) for version in together],
    }


def _centre(together: FloatArray, rate: float) -> FloatArray:
    """(frames, 3) what every camera follows alike, slowly, so that no version's trembling hides."""
    versions, frames, joints, _ = together.shape
    points = together.transpose(1, 0, 2, 3).reshape(frames, versions * joints, 3)
    known = np.isfinite(points[:, :, 0]).any(axis=1)
    centre = np.empty((frames, 3))
    middles = np.nanmedian(points[known], axis=1)
    for axis in range(3):
        centre[:, axis] = np.interp(np.arange(frames), np.flatnonzero(known), middles[:, axis])
    centre[:, 2] = np.median(centre[:, 2])
    return np.asarray(uniform_filter1d(centre, max(1, round(rate)), axis=0, mode="nearest"))


def _packed(points: FloatArray) -> str:
    """Whole millimetres as little-endian 16-bit integers in base64."""
    near = np.clip(np.round(np.nan_to_num(points)), -_FARTHEST, _FARTHEST)
    whole = np.where(np.isnan(points), _UNSEEN, near).astype("<i2")
    return base64.b64encode(whole.tobytes()).decode("ascii")
