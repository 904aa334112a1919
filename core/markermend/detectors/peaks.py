"""Single peaks: one to a few samples thrown out of line, alone in their neighbourhood.

Section 3.4.2 of skurowski2022, read as follows. In (20) the magnitude of the differential is
compared with the threshold; otherwise no negative flank would survive and the ratio in (23)
would always be 1. In (23) 0/0 is 0. The structuring element of (25) is as long as the window
of the sums: a lone peak makes a run of candidates one frame shorter than that, so it is kept,
and peaks close to each other make longer runs, which are left to the heavy noise stage. Such a
run is wider than the peak in it; what is reported are the samples between its first and its
last differential above the threshold.

A peak smaller than about twice what the marker moves in a frame stays hidden: among samples that
far apart it hardly changes its rank, and the median follows it.

Beyond the paper, only with ``confirm``: a moving median cuts the corners of fast motion, and what
it cuts looks like small peaks; so does the edge of a step in motion. A peak is kept only if
interpolation across it moves it by more than threshold₁, and its first and last sample to the
same side, each by half of that at least.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import uniform_filter1d

from markermend.arrays import BoolArray, FloatArray, runs
from markermend.artifact import Kind
from markermend.detectors.channels import judged, thresholds
from markermend.detectors.finding import Finding, mask_of
from markermend.detectors.highpass import differential, median_high_pass, scaled, scaled_odd
from markermend.detectors.morphology import top_hat
from markermend.detectors.params import PaperParams
from markermend.predictors.bridging import bridge

LEAST_FLANK = 0.5


def find_peaks(
    signal: FloatArray, seen: BoolArray, rate: float, params: PaperParams
) -> list[Finding]:
    """Find isolated peaks on each channel.

    Parameters
    ----------
    signal : (frames, channels) mm, without NaN
    seen : (frames, channels) bool; unseen samples and gap edges are never part of a peak
    rate : frames per second
    params : ``peak_*`` and ``confirm``

    Returns
    -------
    Findings whose ratio is the largest differential over threshold₁ and whose amplitude is the
    largest distance from the interpolation across the peak.
    """
    longest = scaled(params.peak_size, rate)
    window = 2 * longest + 3
    valid = judged(seen)
    change = differential(median_high_pass(signal, scaled_odd(params.peak_window, rate)))
    change[~valid] = 0.0
    threshold = thresholds(params.peak_k, change, valid, confirm=params.confirm)
    change[np.abs(change) <= threshold] = 0.0
    candidates = _balance(change, window) > params.peak_ratio
    isolated = top_hat(candidates, window)

    found = []
    for channel in np.flatnonzero(isolated.any(axis=0)):
        strength = np.abs(change[:, channel])
        for run_start, run_stop in runs(isolated[:, channel]):
            flanks = run_start + np.flatnonzero(strength[run_start:run_stop])
            if len(flanks) < 2 or flanks[-1] - flanks[0] > longest:
                continue
            start, stop = int(flanks[0]), int(flanks[-1])
            ratio = float(strength[start : stop + 1].max() / threshold[channel])
            found.append(Finding(int(channel), start, stop, Kind.PEAK, ratio, 0.0))
    deviation = signal - bridge(signal, seen & ~mask_of(found, signal.shape))
    kept = []
    for f in found:
        out = deviation[f.start : f.stop, f.channel]
        size = float(np.abs(out).max())
        if not params.confirm or (size > threshold[f.channel] and _one_sided(out, size)):
            kept.append(replace(f, amplitude_mm=size))
    return kept


def _one_sided(out: FloatArray, size: float) -> bool:
    """Whether first and last sample stick out to the same side; at a step's edge they do not."""
    return bool(out[0] * out[-1] > 0 and min(abs(out[0]), abs(out[-1])) > LEAST_FLANK * size)


def _balance(change: FloatArray, window: int) -> FloatArray:
    """Moving sum of magnitudes over magnitude of the moving sum (skurowski2022, eq. 21 to 23)."""
    total = np.abs(uniform_filter1d(change, window, axis=0, mode="constant"))
    magnitude = uniform_filter1d(np.abs(change), window, axis=0, mode="constant")
    # A running mean leaves dust of the order of the rounding where there was nothing to add.
    dust = 1e-9 * np.abs(change).max(initial=0.0)
    magnitude[magnitude <= dust] = 0.0
    return magnitude / np.maximum(total, max(dust, np.finfo(np.float64).tiny))
