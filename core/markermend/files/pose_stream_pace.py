"""When poses of a stream come: how many of them are missing, and how many there are a second."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import gcd, isfinite, nan
from statistics import median_low

from markermend.arrays import BoolArray, FloatArray
from markermend.files.pose_clock import by_times
from markermend.files.pose_rows import Header
from markermend.poses.live import Live
from markermend.poses.pose import Pose
from markermend.poses.prior import Prior

# A pose is late that took longer than so many usual ones, of the last few; fewer tell nothing.
_LATE, _LATELY, _FEWEST = 1.5, 31, 3
# Times of so many poses tell the rate; by less than this share another is about the same.
_TELL, _ABOUT = 6, 0.1
# No sensor is slower, or faster.
_SLOWEST_HZ, _FASTEST_HZ = 1.0, 1000.0
# Beyond it, nanoseconds of centuries, a number is no time; and no more poses are missing at once.
_LARGEST, _MOST = 1e19, 1e6


class Pace:
    """Says how many poses are missing before each, by the numbers of frames and by times.

    Whoever numbers every second or tenth frame misses none. Where numbers and times tell
    different things, more are missing; where numbers go back, as many as they do.
    """

    def __init__(self) -> None:
        self._frame: int | None = None
        self._step, self._time = 0, nan
        # How long poses took.
        self._took: deque[float] = deque(maxlen=_LATELY)

    def missed(self, frame: int, time: float) -> int:
        """How many poses are missing between the last and this one.

        Parameters
        ----------
        frame : its number
        time : in any unit; NaN where it has none
        """
        last, self._frame = self._frame, frame
        before, self._time = self._time, time if abs(time) < _LARGEST else nan
        if last is None:
            return 0
        self._step = gcd(self._step, frame - last) or 1
        steps = max(abs(frame - last) // self._step, 1)
        took = self._time - before
        usual = median_low(self._took) if len(self._took) >= _FEWEST else 0.0
        if isfinite(took):
            self._took.append(took / steps)
        if took > _LATE * usual > 0:
            steps = max(steps, round(min(took / usual, _MOST)))
        return steps - 1


class PacedLive:
    """Cleans poses of a stream by :class:`markermend.poses.live.Live`, told what is missing.

    Where nobody says how many poses there are a second, the first few tell by their times.

    Parameters
    ----------
    first : one pose, at the rate that is assumed
    prior : how bodies move
    header : of the stream; None where its rate is not to be told by times
    warn : told, in a sentence, of a rate that is told by times

    Attributes
    ----------
    live : what cleans them
    rate : poses per second
    """

    def __init__(
        self, first: Pose, prior: Prior | None, header: Header | None, warn: Callable[[str], None]
    ) -> None:
        self._header, self._warn, self._pace = header, warn, Pace()
        self._frames: list[int] = []
        self._times: list[float] = []
        self.live, self.rate = Live(first, prior), first.rate

    def __call__(
        self, frame: int, time: float, places: FloatArray, turns: FloatArray, seen: BoolArray
    ) -> tuple[FloatArray, FloatArray]:
        """Clean one pose.

        Parameters
        ----------
        frame, time : as of :meth:`Pace.missed`
        places, turns, seen : as :class:`markermend.poses.live.Live` takes them, mm
        """
        missed = self._pace.missed(frame, time)
        if self._header is not None:
            self._frames.append(frame)
            self._times.append(time)
            if len(self._times) == _TELL:
                self._go_by_times(self._header)
        return self.live(places, turns, seen, missed)

    def _go_by_times(self, header: Header) -> None:
        """Go on at the rate that times tell."""
        step = gcd(*(frame - self._frames[0] for frame in self._frames)) or 1
        frames = [(frame - self._frames[0]) // step for frame in self._frames]
        clock, self._header = by_times(self._times, frames, header), None
        near = abs(clock.rate - self.rate) <= _ABOUT * self.rate
        if not clock.told or near or not _SLOWEST_HZ <= clock.rate <= _FASTEST_HZ:
            return
        self._warn(
            f"The stream's times tell {clock.rate:.3g} poses a second, which is what was assumed;"
            " give the rate where that is wrong."
        )
        self.rate = clock.rate
        self.live.come_at(clock.rate)
