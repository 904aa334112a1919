"""The actions of hand work: on a swept range, on a trajectory, on an artifact."""

from __future__ import annotations

from markermend.artifact import Kind
from markermend_app.actions.action import Action, current, marker, swept
from markermend_app.style import theme

_EDGES = (
    ("start_earlier", "Begin one frame earlier", "["),
    ("start_later", "Begin one frame later", "{"),
    ("end_earlier", "End one frame earlier", "}"),
    ("end_later", "End one frame later", "]"),
)

HAND_WORK: tuple[Action, ...] = (
    Action(
        "sweep",
        "Begin or end a selection at the cursor",
        "By hand",
        ("V",),
        "",
        "Select from here to where the cursor is when it is pressed again, without the mouse",
        marker,
    ),
    Action(
        "mark_selection",
        "Mark selection",
        "By hand",
        ("M",),
        "mark",
        "Make an artifact of the swept range",
        swept,
    ),
    Action(
        "repair_selection",
        "Repair selection",
        "By hand",
        ("Shift+F",),
        "repair",
        "Replace the swept range of the marker by the best repair",
        swept,
    ),
    Action(
        "smooth",
        "Smooth…",
        "By hand",
        ("S",),
        "noise",
        "Take the noise out of the swept range, a marker, its group or the take, seen before",
        marker,
    ),
    Action(
        "cut_selection",
        "Cut selection",
        "By hand",
        ("X",),
        "erase",
        "Make the swept range missing; the gap comes under review",
        swept,
    ),
    Action(
        "swap_selection",
        "Swap selection with another marker…",
        "By hand",
        ("W",),
        "swap",
        "Exchange the swept range with that of another marker, from here to there",
        swept,
    ),
    Action(
        "move_selection",
        "Give selection to another marker…",
        "By hand",
        ("E",),
        "labels",
        "The swept range has the wrong name: it becomes part of another marker",
        swept,
    ),
    Action(
        "rename_marker",
        "Rename marker…",
        "|By hand",
        ("F2",),
        "labels",
        "Give the foremost marker another name in the whole take",
        marker,
    ),
    Action(
        "merge_marker",
        "Merge marker…",
        "By hand",
        ("Ctrl+M",),
        "unlabelled",
        "Take an unlabelled trajectory into the foremost marker, or give all of it to another one",
        marker,
    ),
    Action(
        "choose_references",
        "Choose the markers to follow",
        "|By hand",
        ("K",),
        "body",
        "Click markers in the 3D view, or press Return on them in the tree; the repair follows "
        "these only",
        current,
        True,
    ),
    Action(
        "split_artifact",
        "Split artifact at the cursor",
        "|By hand",
        ("/",),
        "",
        "Make two artifacts of the one under review",
        current,
    ),
    Action(
        "join_artifacts",
        "Join artifacts",
        "By hand",
        ("J",),
        "",
        "Make one of those selected in the queue, else of this one and the next on its marker",
        current,
    ),
    *(Action(name, text, "By hand/Edges", (key,), enabled=current) for name, text, key in _EDGES),
    *(
        Action(
            f"class_{kind}",
            theme.KIND_NAME[kind],
            "By hand/Class",
            (f"Ctrl+{number}",),
            str(kind),
            "Call the artifact under review this",
            current,
        )
        for number, kind in enumerate(Kind, 1)
    ),
)
