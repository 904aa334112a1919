"""Detection as published by Skurowski and Pawlyta (2022), section 3.4.

Four stages in order, from the simplest artifact to the hardest: single peaks, heavy noise, step
changes, slow changes. Each coordinate is judged by itself, and what a stage finds is bridged by
interpolation before the next one looks. Lengths are meant at 100 Hz and scaled to the take's
rate. Then detections of one kind on the axes of one marker become one artifact, and steps that
another trajectory complements are named as swaps.

How misprints are read stands with each stage. Beyond the paper: thresholds for sudden changes
are at least 1.5 mm (``least_mm``), because on a marker that rests three times its spread is a
fraction of a millimetre; samples not seen, and two frames at each edge of a gap, are never
judged; trajectories without a name are not judged.
"""

from __future__ import annotations

from dataclasses import replace

from markermend.arrays import BoolArray
from markermend.artifact import Artifact, damage_mask
from markermend.detectors.channels import channels
from markermend.detectors.counterpart import name_swaps
from markermend.detectors.finding import Finding, mask_of, to_artifacts
from markermend.detectors.noise import absorb_peaks, find_noise
from markermend.detectors.params import PaperParams
from markermend.detectors.peaks import find_peaks
from markermend.detectors.slow import find_slow
from markermend.detectors.steps import find_steps
from markermend.mesh import Mesh, infer_mesh
from markermend.predictors.bridging import bridge
from markermend.predictors.inputs import trusted_samples
from markermend.progress import Progress, part
from markermend.take import Take, is_unlabelled

# Markers filtered at a time: bounds memory on long takes and lets progress be told.
BLOCK = 8
SUDDEN_SHARE = 0.15


def detect_paper(
    take: Take, params: PaperParams, mesh: Mesh | None, progress: Progress
) -> list[Artifact]:
    """Run the four stages.

    Parameters
    ----------
    take : the recording
    params : tunables of all stages
    mesh : the body's structure, inferred when None and needed
    progress : told after each block of markers and each network; may raise to stop

    Returns
    -------
    Artifacts of kinds peak, noise, step and slow, in no particular order.
    """
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    sudden_share = SUDDEN_SHARE if params.slow else 1.0
    report = part(progress, 0.0, sudden_share)
    found: list[Finding] = []
    for first in range(0, len(markers), BLOCK):
        report(first / len(markers), "peaks, heavy noise and steps")
        found += _find_sudden(take, markers[first : first + BLOCK], params)
    artifacts = name_swaps(take, to_artifacts(take, found))
    if params.slow and markers:
        report(1.0, "the body's structure")
        body = mesh if mesh is not None else infer_mesh(take)
        trusted = trusted_samples(take, ~_damage(take, artifacts))
        slow = find_slow(take, body, markers, trusted, params, part(progress, sudden_share, 1.0))
        artifacts += to_artifacts(take, slow)
    return artifacts


def _find_sudden(take: Take, markers: list[int], params: PaperParams) -> list[Finding]:
    """Peaks, then heavy noise, then steps of some markers, each bridged for the next stage."""
    signal, seen = channels(take, markers)
    known = seen.copy()
    found: list[Finding] = []
    for stage in (find_peaks, find_noise, find_steps):
        new = stage(bridge(signal, known), seen, take.rate, params)
        found = absorb_peaks(found, new, take.rate, params)
        known &= ~mask_of(found, signal.shape)
    return [replace(f, channel=3 * markers[f.channel // 3] + f.channel % 3) for f in found]


def _damage(take: Take, artifacts: list[Artifact]) -> BoolArray:
    """(frames, markers, 3) bool: samples that artifacts cover, a swap's counterpart included."""
    mask = damage_mask(take, artifacts)
    for a in artifacts:
        if a.counterpart is not None:
            mask[a.start : a.stop, take.index(a.counterpart)] = True
    return mask
