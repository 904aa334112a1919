"""What the engine wrote in English, steps of the history and reasons, in the language of the app.

The engine's sentences are made of few forms, so that a list of forms translates them. What has
none stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache, lru_cache

from markermend.artifact import Kind
from markermend_app import file_words, units
from markermend_app.method_words import label_of
from markermend_app.style import theme
from markermend_app.words import tr
from markermend_app.work_words import DOING

_SAME = (
    # Steps of the history.
    "Accept {0}",
    "Reject {0}",
    "Reopen {0}",
    "Mark {0}",
    "Remove {0}",
    "Adjust {0}",
    "Nudge the beginning of {0}",
    "Nudge the end of {0}",
    "Split {0}",
    "Note on {0}",
    "Repair all accepted",
    "Repair {0} artifacts alike ({1})",
    "Repair {0} by hand",
    "Repair {0}",
    "Swap {0} and {1} by hand",
    "Call {0} on {1} {2}",
    "Cut {0} in {1}",
    "Move {0} to {1} in {2}",
    "Merge {0} into {1}",
    "Smooth {0} in {1}",
    "Rename {0} to {1}",
    "Join {0} on {1}",
    "Lower {0} ({1} on {2})",
    "Leave {0} ({1} on {2})",
    "Detect ({0})",
    "Review frames {0}–{1} only",
    "Review the whole take",
    "Found before the export",
    "Decided before the export",
    "Review the same frames",
    "{0} artifacts",
    "{0} artifact",
    "{0} markers",
    "{0} joints",
    "frames {0}–{1}",
    "all frames",
    # Reasons; what follows a semicolon first, since it stands behind any of them.
    "marked by hand",
    "called {0} by hand",
    "its frames were set by hand",
    "was taken for a mix-up with {0}, which was repaired by itself",
    "{0}; {1} times its usual scatter",
    "{0}; its residual changes there from {1} to {2}",
    "{0}; {1} cameras see it instead of {2}",
    "not seen for 1 frame, since samples were cut or moved by hand",
    "not seen for {0} frames, since samples were cut or moved by hand",
    "not seen for {0} of the {1} frames that were chosen by hand",
    "not seen for {0}",
    "sticks out by {0} for {1}, its neighbours do not",
    "sticks out by {0} for {1}, its neighbours by {2}",
    "jitters by about {0} for {1}, {2} times its usual; its neighbours are calm",
    "jitters by about {0} for {1}, {2} times its usual",
    "jumps {0} in one frame and slides back within {1}",
    "jumps {0} in one frame, its neighbours do not, and comes back {1} later",
    "jumps {0} in one frame, its neighbours by {1}, and comes back {2} later",
    "jumps {0} in one frame, its neighbours do not, and slides back within {1}",
    "jumps {0} in one frame, its neighbours by {1}, and slides back within {2}",
    "slides {0} off within {1} and jumps back, its neighbours do not",
    "slides {0} off within {1} and jumps back, its neighbours by {2}",
    "slides {0} off within {1} and jumps back",
    "slides {0} off, jumps past its course and slides back, {1} in all",
    "lies {0} off for {1} beside a gap or an end, one jump away",
    "drifts {0} off the place its neighbours give it and returns, within {1}",
    "changes places with {0} for {1}: once exchanged, {2} of the {3} jump are left",
    "jumps {0} in one frame, its neighbours do not, and stays off for {1}, up to an end of the "
    "take, at another distance from them: it moved on the body or fell off",
    "jumps {0} in one frame, its neighbours by {1}, and stays off for {2}, up to an end of the "
    "take, at another distance from them: it moved on the body or fell off",
    "seen for {0} inside a gap, {1} from where its neighbours put it; around the gap that is {2}",
    "strays {0} from where its neighbours put it in the {1} before it is lost",
    "strays {0} from where its neighbours put it in the {1} after it is found again",
    "repeats one position for {0} while its neighbours move {1}; in the end it is {2} off",
    "repeats one position for {0}, as every marker does: the recording stands still",
    "sticks out by {0} for {1}",
    "jitters by up to {0} for {1}",
    "jumps {0} in one frame and comes back {1} later",
    "deviates up to {0} from where its body says it should be, for {1}",
    "stands on the other side, and {0} here, for {1}",
    "stands still while the body moves, for {0}",
    "was guessed by the sensor, up to {0} from where the body has it, for {1}",
    "stands still with the whole body, though that was moving, for {0}",
    "is said to stand at 0, 0, 0 for {0}",
    "stands up to {0} from where the rest of the body has it, for {1}",
    "has its angles exchanged with those of {0}, for {1}",
    "is carried off with the whole body, by up to {0}, for {1}",
    "is thrown off by a wrong angle, by up to {0}, for {1}",
    # Why there is no repair, or this one.
    "With only {0} to follow: {1}",
    "Worked out from other repairs; look at it closely. Without them: {0}",
    "No other marker of the body is seen all through the interval of {0}; three are needed.",
    "Only one other marker of the body is seen all through the interval of {0}; three are needed.",
    "Only two others of the body are seen all through the interval of {0}; three are needed.",
    "{0} is seen together with its references in only {1} frames; {2} are needed.",
    "{0} has no trusted samples near the interval's beginning; needed: {1}.",
    "{0} has no trusted samples near the interval's end; needed: {1}.",
    "{0} has only one trusted sample near the interval's beginning; needed: {1}.",
    "{0} has only one trusted sample near the interval's end; needed: {1}.",
    "{0} has only {1} trusted samples near the interval's beginning; needed: {2}.",
    "{0} has only {1} trusted samples near the interval's end; needed: {2}.",
    "The result would be about {0} mm off; too far to be used.",
    "The result may be {0} mm off, more than the {1} mm that it would mend.",
    "It would leave more damage than it mends: a {0} of {1} mm.",
    "Already exchanged together with {0}.",
    "No counterpart is known that carries the opposite step.",
    "Angles were exchanged here, not places; restoring the skeleton gives them back.",
    "Only skeleton recordings have joints and bones.",
    "No bone of this recording was ever seen whole; a joint and the one that it hangs on must be "
    "seen in one pose.",
    "The joint is never seen elsewhere, so that nothing tells.",
    "The recording is too short: it takes {0} poses, and has {1}; take a longer one.",
    "There is no signal to smooth inside a gap.",
    "The interval is empty already.",
    "Edited by hand since; how far off it may be is not known any more.",
    "Smoothed since; the expected error is that of the repair.",
    "{0} Smoothed since; the expected error is that of the repair.",
    "The detector still finds damage there: a {0} of {1} mm.",
    "The detector still finds damage there: a {0} of {1} mm and {2} more.",
    # Why something cannot be done by hand, or at all.
    "{0} is not seen in these frames; there is nothing to cut.",
    "{0} is not seen in these frames; there is nothing to take over.",
    "{0} has samples of its own in {1} of these frames; cut them first, or swap the two from here "
    "to there.",
    "Choose another name; these samples have this one already.",
    "Choose two or more artifacts of one name, to join them.",
    "Put the cursor inside the artifact, to split it there.",
    "That is repaired already; reopen it to undo the repair.",
    "This take is open in another window; close it there to edit here.",
    # Why a name is refused.
    "A name cannot be empty.",
    "There is a “{0}” already; choose another name.",
    "{0} frames ({1})",
    "{0} frame ({1})",
)
# Before what is said of markers in general, since some of it ends alike.
_JOINTS = (
    "No joint centre can be told from this take; that needs two neighbouring rigid groups of {0} "
    "markers or more that turn against each other. {1}: {2}.",
    "No joint centre can be told from this take; that needs two neighbouring rigid groups of {0} "
    "markers or more that turn against each other.",
    "{0} has fewer than {1} markers",
    "the markers of {0} are hardly ever seen together",
    "the markers of {0} lie along one line",
    "its groups are hardly ever seen together",
    "its groups turn against each other about some axis by {0}° only",
    "its groups turn against each other about a second axis by {0}° only",
    "it turns least about the limb's own length, where no joint beside it tells of it",
    "it could lie {0} mm off: {1}° is too little turning for an error of {2} mm",
    "This is a skeleton recording: its joints are in it already.",
    *("movement", "the joints beside it", "the markers' middle"),
)
# Whose first part is a repair method's label.
_OF_METHODS = (
    "{0} is not used: {1}",
    "{0} may be about {1} mm off.",
    "{0} would leave damage.",
)
_FILES = (
    *(*file_words.ODDITIES, *file_words.VALUES),
    *(*file_words.PROBLEMS, *file_words.REVIEWS),
)
_FORMS: Mapping[str, str] = {
    "Detect (sudden)": "Find gaps, peaks, noise and steps",
    "Detect (all kinds)": "Find artifacts of all classes",
    **file_words.HERE,
    **DOING,
    **{form: form for form in (*_JOINTS, *_FILES, *_OF_METHODS, *_SAME)},
}
"""Forms as the engine writes them, and as they are told."""
# Whose keys some forms name.
_ACTIONS = ("repair", "repair_accepted")
_PARTS = (
    *("head", "trunk", "shoulder", "pelvis", "upper arm"),
    *("forearm", "hand", "thigh", "shank", "foot"),
)
_SIDES = {"Left": "Left {0}", "Right": "Right {0}"}
FORMS = (*_FORMS.values(), *file_words.NAMES, *_PARTS, *_SIDES.values(), "{0} and {1}")
"""Everything that is translated here."""


@cache
def compiled(form: str) -> re.Pattern[str]:
    """What is written in a form, as an expression with a group for each of its parts."""
    return re.compile(re.sub(r"\\\{\d\\\}", "(.+?)", re.escape(form)))


@cache
def _words_of(form: str) -> tuple[str, ...]:
    """What a form says between the places of its parts."""
    return tuple(re.split(r"\{\d\}", form))


@lru_cache(maxsize=4096)
def _read(text: str) -> tuple[str, tuple[str, ...]] | None:
    """The form of a sentence and what stands in its places, or None for one that is not known.

    Lists ask for the same few hundred sentences with each picture of theirs.
    """
    for form, told_form in _FORMS.items():
        # Expressions take long to make, and nearly all forms have a word that is not there.
        found = all(w in text for w in _words_of(form)) and compiled(form).fullmatch(text)
        if found:
            return told_form, found.groups()
    return None


def told(text: str) -> str:
    """A sentence of the engine in the language and the unit of the app, if its form is known."""
    sentence, known = told_in_mm(text), _read(text)
    # What is said of files has their names in it.
    return sentence if known is None or known[0] in _FILES else units.in_words(sentence)


def told_in_mm(text: str) -> str:
    """A sentence of the engine in the language of the app, for what is in millimetres itself."""
    kinds = {kind.value: kind for kind in Kind}
    if text in kinds:
        return theme.kind_name(kinds[text], within=True)
    kind, _, marker = text.partition(" on ")
    if kind in kinds and marker:
        return tr("{0} on {1}").format(told_in_mm(kind), marker)
    known = _read(text)
    if known is None:
        return text
    form, parts = known
    first, *rest = parts or ("",)
    said = tr(first) if form in _OF_METHODS else told_in_mm(first)
    return tr(form).format(said, *map(told_in_mm, rest), **_ways(form))


def _ways(form: str) -> dict[str, str]:
    """How actions are done whose keys a form names."""
    # Actions know the document, which tells sentences.
    from markermend_app.actions import shortcuts

    return {name: shortcuts.way_to(name) for name in _ACTIONS if f"{{{name}}}" in form}


def told_repair(method: str, error_mm: float | None, *, joints: bool) -> str:
    """A repair's method and how far off it is expected to be; a swap cannot be off."""
    label = label_of(method, joints=joints)
    return f"{label}, {units.give_or_take(error_mm)}" if error_mm else label


def told_group(name: str) -> str:
    """The name of a group of markers in the language of the app, as far as it names parts."""
    subject, colon, rest = name.rpartition(": ")
    found = re.fullmatch(r"(?:(Left|Right) )?(.+?)( \d+)?", rest)
    parts = [] if found is None else found[2].lower().split(" and ")
    # Joints of a skeleton recording keep the names that their file gives them.
    if found is None or rest[:1].islower() or not set(parts) <= set(_PARTS):
        return name
    text = tr(parts[0])
    for part in parts[1:]:
        text = tr("{0} and {1}").format(text, tr(part))
    if found[1]:
        text = tr(_SIDES[found[1]]).format(text)
    return f"{subject}{colon}{text[0].upper()}{text[1:]}{found[3] or ''}"
