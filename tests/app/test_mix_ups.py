"""Mix-ups, which are of several markers, in the plots of each of them."""

from __future__ import annotations

from plots import SHIFT

from markermend.artifact import Artifact, Kind
from markermend_app.sight import Sight


def test_a_swap_is_seen_chosen_and_framed_on_the_other_marker_alone(bench):
    swap = Artifact("CLAV", "xyz", 250, 280, Kind.STEP, counterpart="STRN")
    bench.document.decisions.add_detected([swap], "test")
    bench.document.show(["STRN"])
    bench.panel.framing.set_view(0, 399)
    bench.click(265)
    assert bench.document.current == swap
    bench.document.show(["STRN"])
    assert all(row.edges.visible for row in bench.panel.rows)
    sight = Sight(bench.document)
    sight.set_view(0, 399)
    assert sight.lost is None


def test_edges_meet_those_of_a_swap_on_the_other_marker(bench):
    bench.document.decisions.add_detected(
        [Artifact("CLAV", "xyz", 250, 280, Kind.STEP, counterpart="STRN")], "test"
    )
    bench.document.show(["STRN"])
    bench.panel.framing.set_view(0, 399)
    bench.drag(281, 320, keys=SHIFT)
    assert bench.document.selection.start == 280
