"""Detection as published by Skurowski and Pawlyta (2022), section 3.4.

Four stages in order, from the simplest artifact to the hardest: single peaks, heavy noise, step
changes, slow changes. Each coordinate is judged by itself, and what a stage finds is bridged by
interpolation before the next one looks. Lengths are meant at 100 Hz and scaled to the take's
rate. Then detections of one kind on the axes of one marker become one artifact, and steps that
another trajectory complements are named as swaps.

How misprints are read stands with each stage. Readings that concern all of them:

- The σ of the sudden stages is that of all coordinates together. With each coordinate's own, as
  many samples of an undamaged coordinate lie beyond 2 σ as of any other, and closing joins them:
  heavy noise is then right in 1 sample of 100, where the paper was in 92 to 96. The residuals of
  slow changes, one network a marker, are measured by their own σ; by the σ of all together less
  than 1 sample of 100 is right.
- No threshold has a floor: on an undamaged take they still lie among its noise, and flag it.
- S of heavy noise is 19 frames and τ_hv of slow changes 30, not 39 and 50: see there.

Deviations that remain: samples not seen, and two frames at each edge of a gap, are never judged;
trajectories without a name are not judged; the network is trained by L-BFGS on coordinates
relative to the neighbours. What needs more than that comes only with ``confirm``: thresholds of
each coordinate by itself, 1.5 mm at least, and a second look at what was found.

Sensitivity and precision in percent, 5 % share, 5 / 10 mm, mean of 5 simulations, sudden artifacts
under 1 mm left out, on 32 s of a simulated person who stands, smoothed at 12 Hz, and as published:

========  ==================  ==================  ======================
class     sensitivity         precision           published
========  ==================  ==================  ======================
peak      99 / 99             97 / 99             66 / 90, above 50
noise     100 / 100           72 / 74             88 and more, 92 to 96
step      90 / 90             100 / 100           70 to 75, 73 to 88
slow      58 / 58             7 / 7               50 / 75, 10 to 20
========  ==================  ==================  ======================

Lively takes are harder: where a moving median follows poorly, on acrobatics of 7 s, 3 / 34 % of
the peaks are found, heavy noise to 98 % at 5 / 17 % precision, steps wholly, slow changes not.
The paper draws lengths from a Poisson process. Were they exponential rather than Poisson, shorter
than minLen or longer than maxDist would be 15 % of the step samples; that would explain its lower
figures.
"""

from __future__ import annotations

from dataclasses import replace

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

SUDDEN_SHARE = 0.15
SUDDEN = (("single peaks", find_peaks), ("heavy noise", find_noise), ("step changes", find_steps))


def detect_paper(
    take: Take, params: PaperParams, mesh: Mesh | None, progress: Progress
) -> list[Artifact]:
    """Run the four stages.

    Parameters
    ----------
    take : the recording
    params : tunables of all stages
    mesh : the body's structure, inferred when None and needed
    progress : told before each stage and after each network; may raise to stop

    Returns
    -------
    Artifacts of kinds peak, noise, step and slow, in no particular order.
    """
    markers = [i for i, label in enumerate(take.labels) if not is_unlabelled(label)]
    if not markers:
        return []
    sudden_share = SUDDEN_SHARE if params.slow else 1.0
    report = part(progress, 0.0, sudden_share)
    found = _find_sudden(take, markers, params, report)
    artifacts = name_swaps(take, to_artifacts(take, found))
    if params.slow:
        report(1.0, "the body's structure")
        body = mesh if mesh is not None else infer_mesh(take)
        trusted = trusted_samples(take, ~damage_mask(take, artifacts))
        slow = find_slow(take, body, markers, trusted, params, part(progress, sudden_share, 1.0))
        artifacts += to_artifacts(take, slow)
    return artifacts


def _find_sudden(
    take: Take, markers: list[int], params: PaperParams, report: Progress
) -> list[Finding]:
    """Peaks, then heavy noise, then steps of some markers, each bridged for the next stage."""
    signal, seen = channels(take, markers)
    known = seen.copy()
    found: list[Finding] = []
    for done, (what, stage) in enumerate(SUDDEN):
        report(done / len(SUDDEN), what)
        new = stage(bridge(signal, known), seen, take.rate, params)
        found = absorb_peaks(found, new, take.rate, params) if params.confirm else found + new
        known &= ~mask_of(found, signal.shape)
    return [replace(f, channel=3 * markers[f.channel // 3] + f.channel % 3) for f in found]
