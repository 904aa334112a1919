"""What actions are called where a take has joints instead of markers."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from markermend_app.actions.action import Action
from markermend_app.words import tr

TEXTS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "palette": (
            "Find a command, joint or artifact…",
            "Type a few letters to do anything or go anywhere",
        ),
        "filter": (
            "Filter the list",
            "Narrow down the joints, or the review queue while the keyboard is there",
        ),
        "detect": (
            "Detect artifacts",
            "Look for joints that are missing, frozen, away or on the other side",
        ),
        "detect_slow": (
            "Detect slow drifts too",
            "Only for takes of markers: “Detect artifacts” looks for all that is known of joints",
        ),
        "joint_centres": (
            "Joint centres…",
            "Only for takes of markers: a skeleton recording has its joints in it already",
        ),
        "prediction": (
            "Show the body's prediction",
            "Where the rest of the body says the joint should be",
        ),
        "repair_selection": (
            "Repair selection",
            "Replace the swept range of the joint by the best repair",
        ),
        "smooth": (
            "Smooth…",
            "Take the noise out of the swept range, a joint, its group or the take, seen before",
        ),
        "swap_selection": (
            "Swap selection with another joint…",
            "Exchange the swept range with that of another joint, from here to there",
        ),
        "move_selection": (
            "Give selection to another joint…",
            "The swept range has the wrong name: it becomes part of another joint",
        ),
        "rename_marker": (
            "Rename joint…",
            "Give the foremost joint another name in the whole take",
        ),
        "merge_marker": (
            "Merge joint…",
            "Give all of the foremost joint to another one that is missing there",
        ),
        "choose_references": (
            "Choose the joints to follow",
            "Click joints in the 3D view, or press Return on them in the tree; the repair follows "
            "these only",
        ),
        "join_artifacts": (
            "Join artifacts",
            "Make one of those selected in the queue, else of this one and the next on its joint",
        ),
    }
)
"""Text and tip by the name of an action, where these speak of markers otherwise."""


def text_of(spec: Action, *, joints: bool) -> str:
    """What an action is called."""
    return tr(TEXTS[spec.name][0] if joints and spec.name in TEXTS else spec.text)


def tip_of(spec: Action, *, joints: bool) -> str:
    """What it does, in one sentence."""
    if joints and spec.name in TEXTS:
        return tr(TEXTS[spec.name][1])
    return tr(spec.tip or spec.text.rstrip("…"))
