"""Other words for actions, as operators know them from elsewhere; the palette finds by them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

SYNONYMS: Mapping[str, str] = MappingProxyType(
    {
        "open": "load import read file c3d trc csv bvh amc",
        "review_batch": "queue takes multiple pipeline",
        "review_folder": "directory takes multiple pipeline",
        "open_demo": "example sample tutorial",
        "export": "save write file c3d trc csv copy as",
        "report": "html quality statistics summary print",
        "joint_centres": "centre of rotation hip knee elbow shoulder functional score skeleton "
        "pose kinematics bones csv",
        "close_take": "discard unload",
        "quit": "exit leave",
        "undo": "back revert history",
        "redo": "again forward history",
        "clear_selection": "deselect escape cancel",
        "filter": "search find narrow",
        "preferences": "settings options configure units millimetres language theme dark colours "
        "axis autosave threads processes sensitivity preset shortcuts",
        "detect": "find analyse scan check errors problems gaps spikes",
        "detect_slow": "drift creep slide slippage",
        "accept": "confirm keep yes",
        "reject": "ignore false alarm dismiss no",
        "repair": "fill gap fix interpolate spline pattern rigid body apply",
        "compare": "candidates methods alternatives",
        "reopen": "reset undecide pending",
        "remove": "delete dismiss",
        "repair_accepted": "fill gaps fix batch all",
        "repair_alike": "fill gaps fix all similar same",
        "reject_alike": "ignore all similar same false alarms",
        "previous": "back gap problem last",
        "next": "forward gap problem jump",
        "note": "comment annotate remark text",
        "sweep": "select range region interval",
        "mark_selection": "flag label artifact gap range",
        "repair_selection": "fill gap fix interpolate range",
        "smooth": "filter butterworth spline kalman savitzky golay low-pass denoise jitter",
        "cut_selection": "delete erase crop samples unlabel hide",
        "swap_selection": "exchange switch flip markers labels",
        "move_selection": "relabel assign reassign trajectory labels",
        "rename_marker": "label relabel name",
        "merge_marker": "join stitch combine unlabelled trajectory fragment label identify",
        "choose_references": "donor source pattern rigid body cluster",
        "split_artifact": "divide cut",
        "join_artifacts": "merge combine",
        "play": "playback run stop video animate",
        "to_start": "rewind beginning first",
        "to_end": "last finish",
        "region_start": "roi crop trim in point range frames",
        "region_end": "roi crop trim out point range frames",
        "region_selection": "roi crop trim region of interest range frames",
        "region_whole": "roi crop trim region of interest reset all frames",
        "fit": "zoom all full reset frame home",
        "before_after": "original raw source compare ghost",
        "prediction": "model expected body rigid",
        "overview_mode": "heat map gaps damage residual timeline",
        "plots": "graph curves analog force plates emg channels speed velocity acceleration "
        "residual cameras distance events",
        "theme_light": "bright white appearance",
        "theme_dark": "night black mode appearance",
        "theme_contrast": "accessibility appearance",
        "theme_system": "automatic appearance",
        "reset_layout": "panels docks windows default restore arrange",
        "manual": "help documentation guide handbook",
        "tour": "tutorial introduction getting started guide help",
        "shortcuts": "hotkeys keys bindings cheat sheet nexus qtm motive customise preset",
        "about": "version licence",
    }
)
"""Words by the name of an action, with spaces between them."""
