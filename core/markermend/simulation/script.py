"""What the performer is asked to do: a list of activities, turned into steps and gestures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from markermend.errors import MethodError
from markermend.simulation.footsteps import Footstep


@dataclass(frozen=True)
class Activity:
    """One thing to do: ``"stand"``, ``"reach"``, ``"walk"``, ``"turn"`` or ``"sit"``."""

    name: str
    duration_s: float


DEFAULT_SCRIPT = (
    Activity("stand", 2.5),
    Activity("reach", 6.0),
    Activity("walk", 5.5),
    Activity("turn", 4.0),
    Activity("walk", 5.5),
    Activity("turn", 4.0),
    Activity("sit", 8.0),
    Activity("reach", 4.5),
)
"""Repeated as often as the take is long."""


@dataclass(frozen=True)
class Gesture:
    """A pose that is taken up, held and left again.

    Attributes
    ----------
    pose : ``"reach"``, ``"sit"``, ``"lean"`` (trunk forward while getting down or up), ``"look"``
    start_s, rise_s, hold_s, fall_s : when, and how long each part lasts
    angles : radians; for a reach flexion, abduction, inward rotation, elbow, trunk bend, trunk
        twist; for a look head twist and bend; otherwise one share
    side : arm that reaches, else empty
    """

    pose: str
    start_s: float
    rise_s: float
    hold_s: float
    fall_s: float
    angles: tuple[float, ...] = (1.0,)
    side: str = ""


@dataclass
class Plan:
    """Steps and gestures of a whole take, where the feet stand at first and where they got to."""

    centre: tuple[float, float]
    heading: float
    half_width: float
    start: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    steps: list[Footstep] = field(default_factory=list)
    gestures: list[Gesture] = field(default_factory=list)

    def foot(self, side: str) -> tuple[float, float, float]:
        """Place and yaw of a foot beside the current centre; toes point outwards a little."""
        sign = 1.0 if side == "L" else -1.0
        x = self.centre[0] - sign * self.half_width * np.sin(self.heading)
        y = self.centre[1] + sign * self.half_width * np.cos(self.heading)
        return float(x), float(y), self.heading + sign * 0.12


def make_plan(
    activities: Sequence[Activity], duration_s: float, height_mm: float, rng: np.random.Generator
) -> Plan:
    """Plan a take.

    Parameters
    ----------
    activities : done in order, over again until the take is full
    duration_s : length of the take
    height_mm : body height
    rng : the performer's whims

    Returns
    -------
    Plan

    Raises
    ------
    MethodError
        for an unknown activity, or one that leaves no time to do it
    """
    known = {"stand": _stand, "reach": _reach, "walk": _walk, "turn": _turn, "sit": _sit}
    for activity in activities:
        if activity.name not in known:
            names = ", ".join(known)
            raise MethodError(f"The performer knows {names}, not “{activity.name}”.")
        if activity.duration_s < 1.0:
            raise MethodError(f"“{activity.name}” needs at least a second.")
    if not activities:
        raise MethodError("The performer needs at least one activity.")
    heading = float(rng.uniform(-0.06, 0.06))
    plan = Plan((-1.45 * height_mm, 0.0), heading, 0.052 * height_mm)
    plan.start = {side: plan.foot(side) for side in "LR"}
    now, turn = 0.0, 0
    while now < duration_s:
        activity = activities[turn % len(activities)]
        known[activity.name](plan, now, activity.duration_s, height_mm, rng)
        now += activity.duration_s
        turn += 1
    return plan


def _look(plan: Plan, start: float, rng: np.random.Generator) -> None:
    """Glance somewhere for a second or two."""
    twist = float(rng.choice([-1.0, 1.0]) * rng.uniform(0.35, 0.95))
    angles = (twist, float(rng.uniform(-0.3, 0.4)))
    plan.gestures.append(Gesture("look", start, 0.7, float(rng.uniform(0.3, 1.0)), 0.8, angles))


def _stand(
    plan: Plan, start: float, duration: float, height_mm: float, rng: np.random.Generator
) -> None:
    for moment in np.arange(start + 0.4, start + duration - 2.0, 2.8):
        _look(plan, float(moment), rng)


def _reach(
    plan: Plan, start: float, duration: float, height_mm: float, rng: np.random.Generator
) -> None:
    """Reach out with one hand, then the other, then both."""
    count = max(1, int(duration / 2.1))
    slot = duration / count
    first = int(rng.integers(2))
    for i in range(count):
        arms = "LR" if i % 3 == 2 else "LR"[(i + first) % 2]
        low = rng.random() < 0.3
        flexion = float(rng.uniform(0.7, 1.1) if low else rng.uniform(1.2, 2.4))
        elbow, outward = float(rng.uniform(0.15, 0.7)), float(rng.uniform(-0.05, 0.7))
        bend = float(rng.uniform(0.3, 0.5) if low else rng.uniform(0.0, 0.15))
        twist = float(rng.uniform(0.1, 0.35))
        begin = start + i * slot + 0.1
        move_s = min(1.0, 0.42 * slot)
        hold_s = max(0.0, slot - 2 * move_s - 0.2)
        for side in arms:
            sign = 0.0 if len(arms) == 2 else -1.0 if side == "L" else 1.0
            share = 1.0 / len(arms)
            angles = (flexion, outward, 0.0, elbow, share * bend, sign * twist)
            plan.gestures.append(Gesture("reach", begin, move_s, hold_s, move_s, angles, side))
        look = (
            0.4 * twist * (0.0 if len(arms) == 2 else 1.0 if arms == "R" else -1.0),
            float(0.35 - 0.25 * flexion),
        )
        plan.gestures.append(Gesture("look", begin - 0.1, 0.7, hold_s + 0.3, 0.8, look))


def _walk(
    plan: Plan, start: float, duration: float, height_mm: float, rng: np.random.Generator
) -> None:
    """Walk along a gentle curve; the last step closes the feet."""
    beat = 0.55
    count = max(2, int((duration - 0.35) / beat))
    length = 0.37 * height_mm
    bend = float(rng.uniform(-0.04, 0.04))
    _look(plan, start + float(rng.uniform(0.2, 0.5)) * duration, rng)
    side = "LR"[int(rng.integers(2))]
    for i in range(count):
        stride = length * (0.7 if i == 0 else 0.0 if i == count - 1 else rng.normal(1.0, 0.02))
        plan.heading += bend
        x, y = plan.centre
        plan.centre = (
            float(x + stride * np.cos(plan.heading)),
            float(y + stride * np.sin(plan.heading)),
        )
        land = start + 0.35 + (i + 0.8) * beat
        plan.steps.append(Footstep(side, land - 0.43, land, *plan.foot(side)))
        side = "R" if side == "L" else "L"


def _turn(
    plan: Plan, start: float, duration: float, height_mm: float, rng: np.random.Generator
) -> None:
    """Turn round on the spot in small steps, the inner foot first."""
    count = max(2, 2 * int((duration - 0.3) / 1.1))
    beat = (duration - 0.3) / count
    way = float(rng.choice([-1.0, 1.0]))
    # Back along the line walked, which goes through the middle of the room.
    x, y = plan.centre
    home = np.arctan2(-y, -x)
    whole = way * ((way * (home - plan.heading)) % (2 * np.pi))
    if abs(whole) < np.pi / 3:
        whole += way * 2 * np.pi
    first = plan.heading
    # The head turns before the feet do.
    plan.gestures.append(Gesture("look", start - 0.3, 0.7, 0.4 * duration, 1.0, (0.5 * way, 0.1)))
    side = "L" if way > 0 else "R"
    for i in range(count):
        plan.heading = first + whole * 2 * (i // 2 + 1) / count
        land = start + 0.2 + (i + 0.85) * beat
        plan.steps.append(Footstep(side, land - 0.72 * beat, land, *plan.foot(side)))
        side = "R" if side == "L" else "L"


def _sit(
    plan: Plan, start: float, duration: float, height_mm: float, rng: np.random.Generator
) -> None:
    """Sit down on a stool, stay, look around, stand up."""
    down, up = min(1.9, 0.3 * duration), min(1.7, 0.28 * duration)
    hold = max(0.0, duration - down - up - 0.4)
    plan.gestures.append(Gesture("sit", start + 0.2, down, hold, up))
    plan.gestures.append(Gesture("lean", start + 0.1, 0.55 * down, 0.1 * down, 0.6 * down))
    rising = start + 0.2 + down + hold - 0.35
    plan.gestures.append(Gesture("lean", rising, 0.5 * up, 0.05, 0.75 * up))
    for moment in np.arange(start + down + 0.6, start + down + hold - 1.4, 2.4):
        _look(plan, float(moment), rng)
