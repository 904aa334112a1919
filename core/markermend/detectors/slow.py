"""Slow changes: a trajectory leaves the place its body gives it, and returns.

Section 3.4.5 of skurowski2022: the residual of the loose network (eq. 31), smoothed, then
thresholded with hysteresis. Its smoothing (Savitzky–Golay, L = 7, M = 11) hardly smooths when M
is the window, as the text of section 3.3.1 has it; ``slow_half_window`` reads M as its design
matrix does, 2·M + 1 samples. Samples that earlier stages found damaged are bridged in the
residual, so that no interpolation across them is taken for a deviation; where the marker was
not seen, or most of its neighbours were not, the residual is 0 and a hill ends. The spread is
that of each coordinate's own residual.

τ_hv is printed as 50 frames. The hill of a triangle above 0.5 σ is 2 to 15 frames shorter than
the drift, so that hardly any of the published experiment's, 50 frames long on average, would
pass; with 30 frames the published sensitivity is met (``slow_length``). The network sees the
drift in training and follows it the more, the longer it trains; scaled conjugate gradient is not
at hand, and the paper names no end. Measured at 5 / 10 mm on a simulated person who stands,
sensitivity at precision in percent: 15 iterations 57 / 70 at 2, 30 iterations 61 / 62 at 4, 60
iterations 41 / 32 at 11 / 8, 120 iterations 20 / 25 at 9 / 28. It trains for 45. In lab
coordinates 60 iterations find 37 / 29 at 5 / 4, and where the person moves about nothing: on
acrobatics the residual after 25 to 30 iterations is 99 mm, relative to the neighbours 16 mm.

Beyond the paper, only with ``confirm``: the network works on coordinates relative to the mean of
the neighbours and trains for 400 iterations, and the upper threshold is at least 3 mm.
"""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray, runs
from markermend.artifact import Kind
from markermend.detectors.channels import LEAST_SAMPLES, spread
from markermend.detectors.finding import Finding
from markermend.detectors.highpass import savgol_low_pass, scaled, scaled_odd
from markermend.detectors.params import PaperParams
from markermend.errors import DataError
from markermend.mesh import Mesh
from markermend.predictors.bridging import bridge
from markermend.predictors.ffnn import LEAST_ROWS, FfnnParams, fit_and_predict
from markermend.predictors.inputs import Inputs, gather, neighbours_of
from markermend.processes import in_processes
from markermend.progress import Progress
from markermend.take import Take

# Below this many frames of training in all, starting processes costs more than they save.
WORTH_PROCESSES = 40_000
# Smallest upper threshold when findings are confirmed.
LEAST_MM = 3.0
_ROUNDING_MM = 1e-6
LOOSE = FfnnParams(iterations=45)
CLOSE = FfnnParams()


def find_slow(
    take: Take,
    mesh: Mesh,
    markers: list[int],
    trusted: BoolArray,
    params: PaperParams,
    progress: Progress,
) -> list[Finding]:
    """Find slow changes of the named markers.

    Parameters
    ----------
    take : the recording
    mesh : the body's structure
    markers : columns to look at; those without neighbours or with few frames are passed over
    trusted : (frames, markers, 3) bool, false where missing or found damaged already
    params : ``slow_*``, ``confirm``, ``seed`` and ``jobs``
    progress : told after each marker; may raise to stop

    Returns
    -------
    Findings whose ratio is the highest smoothed residual over the upper threshold and whose
    amplitude is the largest residual.
    """
    tasks: list[tuple[int, Inputs]] = []
    for marker in markers:
        try:
            inputs = gather(take.positions, trusted, marker, neighbours_of(take, mesh, marker))
        except DataError:
            continue
        if inputs.fit.sum() >= LEAST_ROWS:
            tasks.append((marker, inputs))

    found: list[Finding] = []
    # Closing at once stops the processes when progress raises.
    with closing(_predictions(tasks, take.rate, params)) as predictions:
        for done, ((marker, inputs), predicted) in enumerate(zip(tasks, predictions, strict=True)):
            progress(done / len(tasks), f"slow changes of {take.labels[marker]}")
            seen = take.present[:, marker]
            found += _judge(marker, inputs, predicted, seen, take.rate, params)
    return found


def _predictions(
    tasks: list[tuple[int, Inputs]], rate: float, params: PaperParams
) -> Generator[FloatArray, None, None]:
    """Train one network a marker, in several processes where that pays; results in order."""
    work = sum(int(inputs.fit.sum()) for _, inputs in tasks)
    network = CLOSE if params.confirm else LOOSE
    jobs = params.jobs if work >= WORTH_PROCESSES else 1
    each = ((inputs, rate, network, params.seed + marker) for marker, inputs in tasks)
    with in_processes(fit_and_predict, each, jobs or -1) as results:
        yield from results


def _judge(
    marker: int,
    inputs: Inputs,
    predicted: FloatArray,
    seen: BoolArray,
    rate: float,
    params: PaperParams,
) -> list[Finding]:
    """Look for hills and valleys in the residual of one marker."""
    judged = inputs.fit & ~np.isnan(predicted[:, 0])
    if judged.sum() < LEAST_SAMPLES:
        return []
    residual = bridge(inputs.own - predicted, np.repeat(judged[:, None], 3, axis=1))
    residual[~(seen & inputs.usable)] = 0.0
    sigma = spread(residual, np.repeat(judged[:, None], 3, axis=1))
    m = 2 * params.slow_window + 1 if params.slow_half_window else params.slow_window
    window = scaled_odd(m, rate, least=params.slow_order + 2)
    smooth = savgol_low_pass(residual, params.slow_order, window)

    found = []
    for axis in range(3):
        top = params.slow_k_top * float(sigma[axis])
        if params.confirm:
            top = max(top, LEAST_MM)
        if top < _ROUNDING_MM:
            # The neighbours foretell it exactly: nothing but rounding could stand out.
            continue
        base = params.slow_k_base * float(sigma[axis])
        for sign in (1.0, -1.0):
            hills = hysteresis(
                sign * smooth[:, axis],
                top,
                base,
                scaled(params.slow_top_length, rate),
                scaled(params.slow_length, rate),
            )
            for start, stop in hills:
                height = float((sign * smooth[start:stop, axis]).max())
                found.append(
                    Finding(
                        3 * marker + axis,
                        int(start),
                        int(stop),
                        Kind.SLOW,
                        height / top,
                        float(np.abs(residual[start:stop, axis]).max()),
                    )
                )
    return found


def hysteresis(
    signal: FloatArray, top: float, base: float, shortest_top: int, shortest: int
) -> IntArray:
    """Intervals above ``base`` that hold a long enough stretch above ``top``.

    Parameters
    ----------
    signal : (frames,)
    top, base : upper and lower threshold
    shortest_top, shortest : least length above ``top``, and of the whole interval, in frames

    Returns
    -------
    (k, 2) half-open intervals, in order (skurowski2022, section 3.4.5, steps 2 to 5)
    """
    tops = runs(signal > top)
    tops = tops[tops[:, 1] - tops[:, 0] >= shortest_top]
    hills = runs(signal > base)
    hills = hills[hills[:, 1] - hills[:, 0] >= shortest]
    held = np.searchsorted(tops[:, 0], hills[:, 1]) - np.searchsorted(tops[:, 0], hills[:, 0])
    return hills[held > 0]
