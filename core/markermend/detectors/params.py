"""Tunables of the published detection, with the paper's defaults."""

from __future__ import annotations

from dataclasses import dataclass

from markermend.parameters import check_ranges, tunable


@dataclass(frozen=True)
class PaperParams:
    """Parameters of the four stages of skurowski2022; lengths are in frames at 100 Hz.

    Each length is scaled by rate / 100, windows to the nearest odd number.

    Raises
    ------
    MethodError
        when a value lies outside the range its field names
    """

    slow: bool = tunable(True, "Look for slow changes, which trains a small network a marker")
    confirm: bool = tunable(
        False,
        "Beyond the paper: keep only what a second look confirms, with thresholds of each "
        "coordinate by itself, 1.5 mm at least, 3 mm for slow changes",
    )

    peak_window: int = tunable(19, "Window of the moving median (eq. 18)", "frames", 3)
    peak_k: float = tunable(3.0, "threshold₁ in σ of the high-passed differential (eq. 20)")
    peak_ratio: float = tunable(5.0, "threshold₂ for the ratio of the moving sums (eq. 24)", "", 1)
    peak_size: int = tunable(5, "maxSize, longest single peak (eq. 21 to 25)", "frames", 1)

    savgol_order: int = tunable(5, "L of the Savitzky–Golay high pass (eq. 27)", "", 1, 9)
    savgol_window: int = tunable(13, "M of the Savitzky–Golay high pass (eq. 27)", "frames", 3)

    noise_k: float = tunable(2.0, "Threshold for heavy noise in σ (eq. 29)")
    noise_length: int = tunable(20, "minLen, shortest heavy noise (eq. 28, 30)", "frames", 2)
    noise_element: int = tunable(
        19, "S of the closings (eq. 28, 30); 39 as printed, 2·minLen - 1", "frames", 1
    )

    step_k: float = tunable(3.0, "Threshold for step changes in σ (section 3.4.4)")
    step_length: int = tunable(20, "minLen, shortest step change (section 3.4.4)", "frames", 1)
    step_distance: int = tunable(
        200, "maxDist, how far to look for the step back (section 3.4.4)", "frames", 1
    )

    slow_order: int = tunable(7, "L of the residual's smoothing (section 3.4.5)", "", 1, 9)
    slow_window: int = tunable(11, "M of the residual's smoothing (section 3.4.5)", "frames", 3)
    slow_half_window: bool = tunable(
        False, "Read M of the residual's smoothing as half window, 2·M + 1 samples in all"
    )
    slow_k_top: float = tunable(3.0, "k_U, upper threshold in σ of the residual (section 3.4.5)")
    slow_top_length: int = tunable(20, "τ_U, shortest top (section 3.4.5)", "frames", 1)
    slow_k_base: float = tunable(0.5, "k_hv, lower threshold in σ (section 3.4.5)")
    slow_length: int = tunable(
        30, "τ_hv, shortest slow change (section 3.4.5); 50 as printed", "frames", 1
    )

    seed: int = tunable(0, "Seed of the networks")
    jobs: int = tunable(-1, "Processes to train networks in; -1 as many as there are cores", "", -1)

    def __post_init__(self) -> None:
        check_ranges(self)
