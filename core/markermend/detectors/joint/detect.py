"""The joint detector, end to end."""

from __future__ import annotations

from markermend.arrays import IntArray
from markermend.artifact import Artifact, trusted_samples
from markermend.detectors.channels import channels
from markermend.detectors.counterpart import name_swaps
from markermend.detectors.joint.confidence import confidences
from markermend.detectors.joint.frozen import find_frozen
from markermend.detectors.joint.lost import find_lost, with_lost
from markermend.detectors.joint.neighbours import nearest_markers
from markermend.detectors.joint.params import JointParams
from markermend.detectors.joint.shifted import find_shifted
from markermend.detectors.joint.slow import (
    drift_artifacts,
    find_drifts,
    prepare,
    shipped_judge,
    started,
)
from markermend.detectors.joint.strays import find_strays
from markermend.detectors.joint.sudden import find_sudden
from markermend.detectors.joint.texture import stand_out, texture_mm
from markermend.detectors.joint.verdict import to_artifacts
from markermend.detectors.joint.witness import LARGEST_WEIGHT, ask, with_witness
from markermend.mesh import Mesh
from markermend.progress import Progress, part
from markermend.take import Take, is_unlabelled


def detect_joint(
    take: Take, params: JointParams, mesh: Mesh | None, progress: Progress
) -> list[Artifact]:
    """Find peaks, heavy noise, steps, swaps and slow changes.

    Each coordinate is searched for jumps and short blocks that no smooth motion explains, the
    clearest first, and for stretches that jitter; jumps that are taken back, at once or slowly,
    become steps. How sure each is comes from how far it stands out, how large it is and how its
    neighbours move meanwhile; in a take full of small jumps these are believed less. Then the axes
    of a marker are joined, and steps that another trajectory complements are named as swaps. With
    all these bridged, slow changes are what stands out of the body's prediction by more than the
    marker's own habit explains.

    Parameters
    ----------
    take : the recording; trajectories without a name are only looked at as partners of a swap
    params : tunables
    mesh : not needed
    progress : told what is being done; may raise to stop

    Returns
    -------
    Artifacts in no particular order.
    """
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    if not markers:
        return []
    neighbours = nearest_markers(take, markers)
    if not params.slow:
        return _sudden(take, markers, neighbours, params, part(progress, 0.0, 1.0))
    least = 1.0 - params.sensitivity
    with started(take, len(markers), params.jobs):
        sudden = _sudden(take, markers, neighbours, params, part(progress, 0.0, 0.1))
        off = find_shifted(take, markers, trusted_samples(take, sudden))
        ground = prepare(take, markers, sudden)
    slow = part(progress, 0.1, 1.0)
    drifts = find_drifts(ground, neighbours, shipped_judge(), least, params.jobs, slow)
    shifted = [a for a in off if a.confidence >= least and a.amplitude_mm >= params.least_mm]
    returning = drift_artifacts(take, markers, [d for d in drifts if d.size_mm >= params.least_mm])
    begins = {a.marker: a.start for a in shifted}
    kept = [a for a in returning if a.stop <= begins.get(a.marker, take.frames)]
    return [*sudden, *shifted, *kept]


def _sudden(
    take: Take,
    markers: list[int],
    neighbours: IntArray,
    params: JointParams,
    report: Progress,
) -> list[Artifact]:
    """Peaks, heavy noise, steps and swaps, and what only the rest of the body shows."""
    report(0.0, "jumps, peaks and heavy noise")
    signal, seen = channels(take, markers)
    peak = max(1, round(params.peak_ms / 1000 * take.rate))
    found = [
        s
        for s in find_sudden(signal, seen, neighbours, take.rate, peak)
        if s.size_mm >= params.least_mm
    ]
    report(0.8, "what is wrong, and how sure that is")
    least = 1.0 - params.sensitivity
    sure = confidences(found)
    sudden = to_artifacts(take, markers, found, sure, least)
    witness = ask(take, sudden)
    if witness is not None:
        # Fainter ones may come up to the least by what it says.
        faint = least / (least + LARGEST_WEIGHT * (1 - least))
        fainter = to_artifacts(take, markers, found, sure, faint)
        sudden = [a for a in with_witness(take, fainter, witness) if a.confidence >= least]
    sudden = name_swaps(take, stand_out(sudden, texture_mm(sudden, take), least))
    return _with_unseen_jumps(take, sudden, markers, neighbours, least)


def _with_unseen_jumps(
    take: Take, sudden: list[Artifact], markers: list[int], neighbours: IntArray, least: float
) -> list[Artifact]:
    """Sudden artifacts with those that only the rest of the body shows."""
    frozen = find_frozen(take, markers, neighbours, trusted_samples(take, sudden))
    frozen = [a for a in frozen if a.confidence >= least]
    # A marker that repeats itself seems to slide off and jump back, or to stay off after its jump.
    kept = [
        a
        for a in sudden
        if not any(a.marker == f.marker and f.overlaps(a.start - 1, a.stop + 1) for f in frozen)
    ]
    trusted = trusted_samples(take, [*kept, *frozen])
    lost = find_lost(take, markers, trusted)
    kept = with_lost(kept, [a for a in lost if a.confidence >= least])
    strays = find_strays(take, markers, trusted_samples(take, [*kept, *frozen]))
    return [*kept, *frozen, *(a for a in strays if a.confidence >= least)]
