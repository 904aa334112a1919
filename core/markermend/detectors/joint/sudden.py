"""Sudden artifacts of each coordinate: what jumps, blocks and jitter amount to."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from markermend.arrays import BoolArray, FloatArray, IntArray
from markermend.artifact import Kind
from markermend.detectors.finding import overlap
from markermend.detectors.joint.fallen import moved_on_body
from markermend.detectors.joint.jumps import Jumps, find_jumps, reach_at, segments
from markermend.detectors.joint.noise import Noise, find_noise
from markermend.detectors.joint.partners import find_partners
from markermend.detectors.joint.shapes import judge
from markermend.detectors.joint.slides import Slide, find_slides
from markermend.detectors.joint.steps import LONGEST_S, pair_jumps
from markermend.progress import heed

LEAST_SCORE = 4.5
"""Standard errors from which a shape is written down; confidence decides what is flagged."""
CUT_OFF_SCORE, CUT_OFF_MM, CUT_OFF_AXES_MM = 10.0, 5.0, 6.5
"""What a lone jump must be to count as a step whose other edge is hidden by a gap or an end: its
score and size, or its size on all axes of the marker."""
DOUBTFUL_SCORE = 6.0
"""A pair below leaves its jumps to partners that are clearer."""
CLEAR_NOISE = 1.5
"""Noise below, times the least that counts, hides no edge of a step."""
ALONG_MM = 1.0
"""What the other axes jump with it need not stand out so far."""
LONG_CUT_OFF_S, LONG_CUT_OFF_MM = 0.35, 20.0
"""A gap so far from the jump rather has nothing to do with it, unless a marker's breadth is off."""
AT_END_MM, AT_END_S = 1.0, 1.0
"""So near an end of the take smaller ones count: no gap has left a trajectory a little off."""
MOSTLY = 0.5
SHARED = 0.4
"""A jump of which the neighbours do so much is a blow to the body."""
OWN = 0.2
"""A small jump near an end must be the marker's own: its neighbours do no more than this of it."""
LEVEL_MISMATCH = 0.1
"""Two slides that differ no more are the edges of one step."""
SHORT_STEP = 2
"""Blocks are looked for up to so many times the longest peak; beyond, edges are jumps."""


class Course(StrEnum):
    """How a step begins and ends; a peak can be cut off as well."""

    LEVEL = "level"
    """It jumps off and jumps back."""
    FALLEN = "fallen"
    """It jumps off and stays off up to an end of the take; its place on the body is another."""
    CUT_OFF = "cut off"
    """Only one jump is seen; a gap or an end of the take hides the other."""
    BUILDS_UP = "builds up"
    """It slides off and jumps back."""
    RELAXES = "relaxes"
    """It jumps off and slides back."""
    OVERSHOOTS = "overshoots"
    """It slides off, jumps to the other side and slides back."""


@dataclass(frozen=True)
class Sudden:
    """A sudden artifact of one coordinate.

    Attributes
    ----------
    channel : 3 × marker + axis
    start, stop : half-open interval of frames
    kind : peak, noise or step
    size_mm : of the deviation; of noise its standard deviation
    score : size over its standard error; for noise over the least that counts
    beside_mm : how far the nearest markers jump in that same frame, their median; 0 for noise,
        which is compared with theirs when it is found
    course : how it begins and ends
    """

    channel: int
    start: int
    stop: int
    kind: Kind
    size_mm: float
    score: float
    beside_mm: float
    course: Course = Course.LEVEL


def find_sudden(
    signal: FloatArray,
    seen: BoolArray,
    neighbours: IntArray,
    rate: float,
    peak_frames: int,
) -> list[Sudden]:
    """Find sudden artifacts.

    Parameters
    ----------
    signal : (frames, 3 × markers) mm, without NaN
    seen : (frames, 3 × markers) bool
    neighbours : (markers, k) columns of the nearest other markers, k may be 0
    rate : frames per second
    peak_frames : longest peak

    Returns
    -------
    Sudden artifacts by channel and start; on one channel they do not overlap, but for a peak on
    a step
    """
    jumps, rest = find_jumps(
        signal, seen, rate, least_score=LEAST_SCORE, longest=SHORT_STEP * peak_frames
    )
    heed()
    noise = find_noise(signal, rest, seen, neighbours, rate)
    jumps = _outside(jumps, noise, reach_at(rate))
    heed()
    beside = _beside(signal, seen, neighbours, jumps, rate)
    own = beside <= SHARED * np.abs(jumps.size)
    slides = find_slides(jumps, own, signal, seen, rate)
    lone = _lone(jumps, seen)
    slides = _unmatched(slides, pair_jumps(jumps, rate, (), lone), jumps)
    pairs = pair_jumps(jumps, rate, {s.jump for s in slides}, lone)
    doubtful = [p for p in pairs if p[2] < DOUBTFUL_SCORE]
    pairs = [p for p in pairs if p[2] >= DOUBTFUL_SCORE]
    paired = {i for first, last, _ in pairs for i in (first, last)} | {s.jump for s in slides}
    alone = [int(i) for i in np.flatnonzero(jumps.length == 0) if int(i) not in paired]
    calm = seen.copy()
    for n in noise:
        if n.ratio >= CLEAR_NOISE:
            calm[n.start : n.stop, n.channel] = False
    steps = [(int(jumps.channel[i]), int(jumps.frame[i]), int(jumps.frame[j])) for i, j, _ in pairs]
    partners = find_partners(jumps, alone, signal, rest, calm, neighbours, rate, steps)
    found = [
        Sudden(n.channel, n.start, n.stop, Kind.NOISE, n.sigma_mm, n.ratio, 0.0) for n in noise
    ]
    found += _blocks(jumps, beside, partners, peak_frames, reach_at(rate))
    found += [_sliding(jumps, slide, float(beside[slide.jump])) for slide in slides]
    matched = {i for i, _, _ in partners}
    pairs += [p for p in doubtful if not matched & set(p[:2])]
    for first, last, clear in pairs:
        size = 0.5 * (abs(float(jumps.size[first])) + abs(float(jumps.size[last])))
        start, stop = int(jumps.frame[first]), int(jumps.frame[last])
        moved = float(max(beside[first], beside[last]))
        channel = int(jumps.channel[first])
        found.append(Sudden(channel, start, stop, Kind.STEP, size, clear, moved))
    for i, frame, clear in partners:
        start, stop = sorted((int(jumps.frame[i]), frame))
        size, moved = abs(float(jumps.size[i])), float(beside[i])
        found.append(Sudden(int(jumps.channel[i]), start, stop, Kind.STEP, size, clear, moved))
    paired |= {i for i, _, _ in partners} | {i for p in doubtful for i in p[:2]}
    found += _cut_off(jumps, paired, beside, signal, seen, neighbours, rate, peak_frames)
    return sorted(_once(found), key=lambda s: (s.channel, s.start, s.stop))


def _unmatched(
    slides: list[Slide], pairs: list[tuple[int, int, float]], jumps: Jumps
) -> list[Slide]:
    """Slides without those whose jumps take each other back: level ground looks bent in motion."""
    sliding = {s.jump for s in slides}
    edges = {
        i
        for first, last, _ in pairs
        if {first, last} <= sliding
        and abs(jumps.size[first] + jumps.size[last]) <= LEVEL_MISMATCH * abs(jumps.size[first])
        for i in (first, last)
    }
    return [s for s in slides if s.jump not in edges]


def _once(found: list[Sudden]) -> list[Sudden]:
    """Without those that a clearer one of their class and coordinate mostly covers."""
    kept: dict[tuple[int, str], list[Sudden]] = {}
    for s in sorted(found, key=lambda s: (-s.score, s.channel, s.start, s.stop)):
        others = kept.setdefault((s.channel, s.kind.value), [])
        if all(overlap((s.start, s.stop), (o.start, o.stop)) < MOSTLY for o in others):
            others.append(s)
    return [s for same in kept.values() for s in same]


def _blocks(
    jumps: Jumps,
    beside: FloatArray,
    partners: list[tuple[int, int, float]],
    peak_frames: int,
    reach: int,
) -> list[Sudden]:
    """Peaks and short steps, but for those that are a step's faint edge misread."""
    edges = [(int(jumps.channel[i]), frame, score) for i, frame, score in partners]
    found = []
    for i in np.flatnonzero(jumps.length > 0):
        channel, start = int(jumps.channel[i]), int(jumps.frame[i])
        stop, score = start + int(jumps.length[i]), float(jumps.score[i])
        if any(
            c == channel and start - reach <= f <= stop + reach and score < s for c, f, s in edges
        ):
            continue
        kind = Kind.PEAK if stop - start <= peak_frames else Kind.STEP
        size = abs(float(jumps.size[i]))
        found.append(Sudden(channel, start, stop, kind, size, score, float(beside[i])))
    return found


def _cut_off(
    jumps: Jumps,
    paired: set[int],
    beside: FloatArray,
    signal: FloatArray,
    seen: BoolArray,
    neighbours: IntArray,
    rate: float,
    peak_frames: int,
) -> list[Sudden]:
    """Steps and peaks of which one edge is seen: a gap or an end of the take hides the other."""
    begin, end = segments(seen)
    found = []
    for i in np.flatnonzero(
        (jumps.length == 0) & (jumps.score >= CUT_OFF_SCORE) & (np.abs(jumps.size) >= AT_END_MM)
    ):
        if int(i) in paired:
            continue
        channel, frame = int(jumps.channel[i]), int(jumps.frame[i])
        first, last = int(begin[frame, channel]), int(end[frame, channel])
        # The shorter piece is the one that went wrong.
        start, stop = (first, frame) if frame - first < last - frame else (frame, last)
        size = abs(float(jumps.size[i]))
        every = [int(i), *_along(jumps, int(i), paired)]
        large = size >= CUT_OFF_MM or np.linalg.norm(jumps.size[every]) >= CUT_OFF_AXES_MM
        at_end = start == 0 or stop == len(seen)
        course, long = Course.CUT_OFF, stop - start > LONGEST_S * rate
        short = at_end and reach_at(rate) <= stop - start <= AT_END_S * rate
        between = (jumps.channel == channel) & (jumps.frame >= start) & (jumps.frame < stop)
        between[i] = False
        # Small ones must be of one level: what jumps within may be motion as well.
        own = short and beside[i] <= OWN * size and not between.any()
        if not (large or own):
            continue
        if not at_end and stop - start > LONG_CUT_OFF_S * rate and size < LONG_CUT_OFF_MM:
            continue
        if long:
            shared = beside[i] > SHARED * size
            if (
                not at_end
                or shared
                or not moved_on_body(signal, seen, neighbours, channel // 3, frame, rate)
            ):
                continue
            course = Course.FALLEN
        kind = Kind.PEAK if stop - start <= peak_frames else Kind.STEP
        for j in every:
            size, score = abs(float(jumps.size[j])), float(jumps.score[j])
            one, moved = int(jumps.channel[j]), float(beside[j])
            found.append(Sudden(one, start, stop, kind, size, score, moved, course))
    return found


def _along(jumps: Jumps, i: int, paired: set[int]) -> list[int]:
    """Jumps of the other axes of a marker at the moment at which it jumps for sure."""
    channel, frame = jumps.channel[i], jumps.frame[i]
    same = (jumps.channel // 3 == channel // 3) & (jumps.channel != channel)
    same &= (np.abs(jumps.frame - frame) <= 1) & (jumps.length == 0)
    same &= np.abs(jumps.size) >= ALONG_MM
    return [int(j) for j in np.flatnonzero(same) if int(j) not in paired]


def _lone(jumps: Jumps, seen: BoolArray) -> set[int]:
    """Jumps with a single frame between them and a gap or an end of the take."""
    begin, end = segments(seen)
    at = jumps.frame, jumps.channel
    alone = (jumps.frame - begin[at] == 1) | (end[at] - jumps.frame == 1)
    return {int(i) for i in np.flatnonzero(alone & (jumps.length == 0))}


def _sliding(jumps: Jumps, slide: Slide, moved: float) -> Sudden:
    """A jump with its slow sides."""
    channel, frame = int(jumps.channel[slide.jump]), int(jumps.frame[slide.jump])
    course = Course.BUILDS_UP if slide.before else Course.RELAXES
    if slide.before and slide.after:
        course = Course.OVERSHOOTS
    start, stop = frame - slide.before, frame + slide.after
    return Sudden(channel, start, stop, Kind.STEP, slide.size_mm, slide.score, moved, course)


def _outside(jumps: Jumps, noise: list[Noise], reach: int) -> Jumps:
    """Jumps that no fit through heavy noise has made."""
    inside = np.zeros(len(jumps), dtype=bool)
    for n in noise:
        inside |= (
            (jumps.channel == n.channel)
            & (jumps.frame + jumps.length > n.start - reach)
            & (jumps.frame < n.stop + reach)
        )
    return jumps.take(~inside)


def _beside(
    signal: FloatArray, seen: BoolArray, neighbours: IntArray, jumps: Jumps, rate: float
) -> FloatArray:
    """Median over neighbours of how far each jumps where a marker does, (jumps,) mm."""
    if not neighbours.shape[1] or not len(jumps):
        return np.zeros(len(jumps))
    begin, end = segments(seen)
    around = neighbours[jumps.channel // 3]
    count, k = around.shape
    channel = (3 * around[:, :, None] + np.arange(3)).ravel()
    frame, length = (np.repeat(v, 3 * k) for v in (jumps.frame, jumps.length))
    moved = np.zeros(len(channel))
    for one in np.unique(length):
        at = np.flatnonzero(length == one)
        f, c = frame[at], channel[at]
        moved[at] = judge(signal, c, f, int(one), reach_at(rate), begin[f, c], end[f, c]).size
    distance = np.sqrt((moved.reshape(count, k, 3) ** 2).sum(axis=2))
    return np.asarray(np.median(distance, axis=1))
