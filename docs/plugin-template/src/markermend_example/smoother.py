"""A smoothing method: a moving median."""

from dataclasses import dataclass, field

from scipy.ndimage import median_filter

from markermend.smoothers.registry import Smoother


@dataclass(frozen=True)
class MedianParams:
    """Parameters of :data:`median`."""

    window: int = field(default=5, metadata={"unit": "frames", "min": 3, "help": "Odd length"})


def smooth_median(signals, params):
    """Take the median of each coordinate over the window, gap by gap."""
    return signals.each_stretch(
        lambda values: median_filter(values, (params.window, 1), mode="nearest"), params.window
    )


median = Smoother(
    name="median",
    label="Moving median",
    summary="Takes single outliers away and keeps edges.",
    params=MedianParams,
    run=smooth_median,
)
