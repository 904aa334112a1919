"""What marker names tell about the body: the part a marker sits on, and a name for a group.

Known are the habits of Plug-in Gait, of the CMU and HDM05 collections, of Qualisys and C-Motion
(bone landmarks), and plain English. A name that tells nothing does no harm.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.mesh.model import Group
from markermend.take import Take

Part = tuple[str, str]  # side ("Left", "Right" or empty) and part ("thigh")

# The first row whose pattern fits the whole name, in capitals and without its side, wins.
_PARTS = tuple(
    (re.compile(pattern), part)
    for part, pattern in (
        ("head", r"[FBTS]?HD[FBT]?\d?|HEAD.*|HED|TOPHEAD|TOPOFHEAD|FOREHEAD|TEMPLE|EAR"
         r"|AURICULARIS|TRAGUS|NOSE|CHIN|VERTEX"),
        ("trunk", r"CV?\d+.*|T[VS]?1?\dL?|TH1\d|T\d+SPIN.*|CLAV.*|STRN|STER.*|BA[KC]|IJ|PX|XIPH.*"
         r"|SXS|S[JN]N|CHEST.*|SPINE.*|THORAX.*|NECK|TRUNK.*|[UM]?BACK|L[VS][1-5]|SCAP.*"),
        ("shoulder", r"SHO\d?|SHOULD.*|AC|ACR.*|SAJ|SHLD"),
        ("pelvis", r"[AP]?(ASI|PSI|IAS|IPS|SIS)S?|[AP]SIS[LR]|[FB]WT|SACR?.*|VSAC|WAIST.*|HIP.*"
         r"|PELV.*|ILC|ICT?"),
        ("upper arm", r"UPA\d?|UA\d|UAR[YZ]?|UPPERARM.*|ARM.*|DELT|ELB.*|H[LM]E|UHE"
         r"|(LAT.*|MED.*)?EPIC.*"),
        ("forearm", r"FRM|FORE?ARM.*|RAD|WR[ABI].*|[RU]SP|STYL.*|ULNAR?.*|RADI.*"),
        ("hand", r"FIN\d?|HM\d|HAND?.*|TOPOFHAND|INDEX|THU?MB?\d?|PINKY|GLOVE\d?"
         r"|LASTC|[ML][AE][TD]H"),
        ("thigh", r"TH\d|THI.*|KNE.*|FTC|F[LM]E|GREATERTROCHANTER|TROCH.*|[LM]FC|MKNE|K[LM]|FEM.*"
         r"|UPPERLEG|SUPPAT|KNJ.*"),
        ("shank", r"TIB.*|TUB.*|SK\d|SHN|SHIN.*|SHANK.*|TTC|FAX|TB\d|[AM]?ANK.*|MAK|FAL|TAM|CALF.*"
         r"|[LM]?MAL.*|(LAT|MED)MAL.*|LOWERLEG|FIB.*"),
        ("foot", r"HEE.*|TOE|MT_?[1-5]|MET|FCC|CAL|FM\d|FIRSTM.*|FIFTHM.*|FOO(T.*)?"
         r"|BIGTOE|SMALLTOE"),
    )
)  # fmt: skip
_FROM_THE_TOP = [part for _, part in _PARTS]
_CENTRAL = {"head", "trunk", "pelvis"}
_NUMBERING = " _.-0123456789"
_LEADING = re.compile(r"(?i)(left|right|l|r)[\s_.-]*(.+)")
_TRAILING = re.compile(r"(.*[a-z\s_.-])(Left|Right|[LR])\d*")


def _part(name: str) -> str | None:
    """Part a name without its side tells of."""
    bare = re.sub(r"[\s_.-]", "", name).upper()
    return next((part for pattern, part in _PARTS if pattern.fullmatch(bare)), None)


def _common_start(names: Sequence[str]) -> str:
    """Longest beginning that all names share."""
    low, high = min(names), max(names)
    same = [a == b for a, b in zip(low, high, strict=False)]
    return low[: same.index(False) if False in same else len(same)]


def body_part(name: str) -> Part | None:
    """Side and body part a marker's name (without subject) tells of, or None."""
    side, part = "", None
    if leading := _LEADING.fullmatch(name):
        side, part = leading[1], _part(leading[2])
    if part is None and (trailing := _TRAILING.fullmatch(name)):
        side, part = trailing[2], _part(trailing[1])
    if part is None:
        side, part = "", _part(name)
    if part is None:
        return None
    full = {"L": "Left", "R": "Right"}.get(side[:1].upper(), "")
    return ("" if part in _CENTRAL else full), part


def body_parts(names: Sequence[str]) -> list[Part | None]:
    """Side and body part of each marker of one subject, or None.

    A prefix that all names share is ignored where that tells more, and so are sides where most
    limb markers have none: the L is then no "left" (``LARM`` for the lower arm).
    """
    parts = [body_part(name) for name in names]
    if len(names) > 1 and (shared := len(_common_start(names))):
        short = [body_part(name[shared:]) for name in names]
        parts = max(parts, short, key=lambda told: sum(p is not None for p in told))
    limbs = [p for p in parts if p is not None and p[1] not in _CENTRAL]
    if 2 * sum(side != "" for side, _ in limbs) < len(limbs):
        parts = [p and ("", p[1]) for p in parts]
    return parts


def name_groups(take: Take, groups: Sequence[Group]) -> tuple[Group, ...]:
    """Give every group a short name of its own: the body part, else what its markers share.

    Parameters
    ----------
    take : for labels and positions
    groups : unnamed

    Returns
    -------
    The same groups with names unique in the take; where two would be alike, the subject, then
    a number, is added
    """
    bare = [label.rpartition(":")[2].strip() for label in take.labels]
    parts: dict[int, Part | None] = {}
    for subject in {g.subject for g in groups}:
        own = [m for g in groups if g.subject == subject for m in g.markers]
        parts.update(zip(own, body_parts([bare[m] for m in own]), strict=True))
    bodies = Counter(g.subject for g in groups)
    names = [
        _anatomical([parts[m] for m in g.markers])
        or (g.subject if bodies[g.subject] == 1 else "")
        or _shared(take, g, bare)
        for g in groups
    ]
    return tuple(
        replace(group, name=name)
        for group, name in zip(groups, _unique(names, [g.subject for g in groups]), strict=True)
    )


def _anatomical(parts: Sequence[Part | None]) -> str | None:
    """Name of the one or two body parts that at least half of the markers sit on."""
    known = Counter(p for p in parts if p is not None)
    if known.total() * 2 < len(parts) or not known:
        return None
    # Of equals the limb wins: a back marker beside shoulder and arm does not make a trunk.
    (first, _), *rest = sorted(known.items(), key=lambda told: (-told[1], told[0][1] in _CENTRAL))
    name = f"{first[0]} {first[1]}".strip()
    if rest and rest[0][0][0] == first[0] and rest[0][1] * 3 >= known.total():
        ordered = sorted((first[1], rest[0][0][1]), key=_FROM_THE_TOP.index)
        name = f"{first[0]} {' and '.join(ordered)}".strip()
    return name[0].upper() + name[1:]


def _shared(take: Take, group: Group, bare: Sequence[str]) -> str:
    """The beginning its markers share, else the marker nearest the middle and how many more."""
    own = [bare[m] for m in group.markers]
    if len(own) == 1:
        return own[0]
    start = _common_start(own).rstrip(_NUMBERING)
    body = [bare[m] for m, label in enumerate(take.labels) if take.subject(label) == group.subject]
    if len(start) >= 3 and start != _common_start(body).rstrip(_NUMBERING):
        return start
    middle = np.nanmedian(take.positions[:, list(group.markers)], axis=0)
    nearest = int(np.sqrt(((middle - middle.mean(axis=0)) ** 2).sum(axis=1)).argmin())
    return f"{own[nearest]} +{len(own) - 1}"


def _unique(names: Sequence[str], subjects: Sequence[str]) -> list[str]:
    """Tell apart what is named alike: first by subject, then by number."""
    shared = {
        n for n in names if len({s for m, s in zip(names, subjects, strict=True) if m == n}) > 1
    }
    told = [
        f"{s}: {n}" if n in shared and s not in ("", n) else n
        for n, s in zip(names, subjects, strict=True)
    ]
    result: list[str] = []
    for name in told:
        number, fresh = 1, name
        while fresh in result:
            number += 1
            fresh = f"{name} {number}"
        result.append(fresh)
    return result
