"""The joint detector, end to end."""

from __future__ import annotations

from markermend.artifact import Artifact, damage_mask
from markermend.detectors.channels import channels
from markermend.detectors.counterpart import name_swaps
from markermend.detectors.finding import to_artifacts as published
from markermend.detectors.joint.confidence import confidences
from markermend.detectors.joint.neighbours import nearest_markers
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.sudden import find_sudden
from markermend.detectors.joint.verdict import to_artifacts
from markermend.detectors.params import PaperParams
from markermend.detectors.slow import find_slow
from markermend.mesh import Mesh, infer_mesh
from markermend.predictors.inputs import trusted_samples
from markermend.progress import Progress, part
from markermend.take import Take, is_unlabelled


def detect_joint(
    take: Take, params: JointParams, mesh: Mesh | None, progress: Progress
) -> list[Artifact]:
    """Find peaks, heavy noise, steps and swaps; slow changes where asked to.

    Each coordinate is searched for jumps and short blocks that no smooth motion explains, the
    clearest first, and for stretches that jitter; jumps that are taken back become steps. How
    sure each is comes from how far it stands out, how large it is and how its neighbours move
    meanwhile. Then the axes of a marker are joined, and steps that another trajectory
    complements are named as swaps.

    Parameters
    ----------
    take : the recording; trajectories without a name are only looked at as partners of a swap
    params : tunables
    mesh : the body's structure, inferred when None and needed for slow changes
    progress : told what is being done; may raise to stop

    Returns
    -------
    Artifacts in no particular order.
    """
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    if not markers:
        return []
    report = part(progress, 0.0, 0.1 if params.slow else 1.0)
    report(0.0, "jumps, peaks and heavy noise")
    signal, seen = channels(take, markers)
    peak = max(1, round(params.peak_ms / 1000 * take.rate))
    neighbours = nearest_markers(take, markers)
    found = [
        s
        for s in find_sudden(signal, seen, neighbours, take.rate, peak)
        if s.size_mm >= params.least_mm
    ]
    report(0.8, "what is wrong, and how sure that is")
    least = 1.0 - params.sensitivity
    sudden = name_swaps(take, to_artifacts(take, markers, found, confidences(found), least))
    if not params.slow:
        return sudden
    return sudden + _slow(take, sudden, markers, mesh, part(progress, 0.1, 1.0))


def _slow(
    take: Take,
    sudden: list[Artifact],
    markers: list[int],
    mesh: Mesh | None,
    progress: Progress,
) -> list[Artifact]:
    """Slow changes as published, on what the sudden artifacts leave."""
    damage = damage_mask(take, sudden)
    for a in sudden:
        if a.counterpart is not None:
            damage[a.start : a.stop, take.index(a.counterpart)] = True
    body = mesh if mesh is not None else infer_mesh(take)
    trusted = trusted_samples(take, ~damage)
    return published(take, find_slow(take, body, markers, trusted, PaperParams(), progress))
