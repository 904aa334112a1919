"""What repair methods are called and said to do, where a take has joints instead of markers too.

Repairs load late: who asks looks at an artifact already.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from markermend_app.words import tr

SUMMARIES: Mapping[str, str] = MappingProxyType(
    {
        "bilstm": (
            "Long short-term memory in both directions predict the joint from its parent and "
            "siblings; trains for seconds."
        ),
        "bolero": "DynaMMo held softly to the distances that joints of a segment keep.",
        "ffnn_lin": (
            "A network of 8 linear neurons predicts the joint from its parent and siblings."
        ),
        "ffnn_loose": (
            "A small network trained on this take predicts the joint from its body; slow."
        ),
        "ffnn_tanh": (
            "A network of 8 tanh neurons predicts the joint from its parent and siblings."
        ),
        "glr": "Least squares on all joints whose distance varies little.",
        "gru": (
            "60 gated recurrent neurons predict the joint from its parent and siblings; trains for "
            "seconds."
        ),
        "lstm": (
            "60 long short-term memory neurons predict the joint from its parent and siblings; "
            "trains for seconds."
        ),
        "msvd": "Completes the matrix of all joints by its main components; for long intervals.",
        "pattern": ("Follows one other joint and joins both borders; for joints that move alike."),
        "pca": "Rebuilds the joint from the main components of the others.",
        "rigid": ("Moves the joint with three or more others of its group; for rigid segments."),
        "swap": "Gives the joint and its counterpart their own samples back; nothing is invented.",
    }
)
"""What methods do to joints, by their names, where their summaries speak of markers."""


def label_of(method: str, *, joints: bool) -> str:
    """What a repair method is called; by its name where the plugin that brought it is gone."""
    from markermend.repairs.registry import REPAIRS

    if joints and method == "swap":
        return tr("Swap joints")
    return tr(REPAIRS[method].label) if method in REPAIRS else method


def summary_of(method: str, *, joints: bool) -> str:
    """What a repair method does, in one sentence."""
    from markermend.repairs.registry import REPAIRS

    said = SUMMARIES.get(method) if joints else None
    return tr(said or REPAIRS[method].summary)
