"""How the bodies of others bend: what a noisy recording cannot tell of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.arrays import FloatArray
from markermend.poses.body.bending import LOCAL, TURN, OthersBends, local_coordinates
from markermend.poses.nuitrack import MIRROR, twins


@dataclass(frozen=True, eq=False)
class Suppleness:
    """How bodies with certain joints bend about the mean of each recording.

    Attributes
    ----------
    joints : names, without the root
    parents : (joints,) names of the joints that they hang on, the root's among them
    covariance : (joints · 6, joints · 6) of their
        :func:`markermend.poses.body.bending.local_coordinates`: radians, and their mean bone
        lengths
    """

    joints: tuple[str, ...]
    parents: tuple[str, ...]
    covariance: FloatArray

    def of(self, joints: Sequence[str], parents: Sequence[str], times: float = 1.0) -> OthersBends:
        """The same of a body's joints, as far as they hang on the same ones.

        Parameters
        ----------
        joints, parents : names, as those of this
        times : how many times as short the unit is that the body's positions are measured in

        Returns
        -------
        OthersBends
            of the joints in their order; 0 and not told where a joint hangs elsewhere
        """
        own = dict(zip(self.joints, self.parents, strict=True))
        body = list(zip(joints, parents, strict=True))
        hangs = np.array([own.get(name) == on for name, on in body], dtype=bool)
        # Of what is not told any place will do: it counts nothing.
        pairs = zip(joints, hangs, strict=True)
        place = [self.joints.index(name) if same else 0 for name, same in pairs]
        columns = (np.array(place, dtype=int)[:, None] * LOCAL + np.arange(LOCAL)).ravel()
        told = hangs.repeat(LOCAL)
        scale = told * np.where(np.arange(len(told)) % LOCAL < TURN, 1.0, times)
        covariance = self.covariance[np.ix_(columns, columns)]
        return OthersBends(scale[:, None] * covariance * scale, told)


def suppleness(
    features: FloatArray, joints: Sequence[str], parents: Sequence[int], order: Sequence[int]
) -> Suppleness:
    """Learn from a recording how a body bends, and its mirror image.

    Parameters
    ----------
    features : (frames, joints, 7) relative to axes that follow the root, without NaN
    joints : names of all, the root among them
    parents : index of each joint's parent, -1 for the root
    order : joints, parents first

    Returns
    -------
    Suppleness
        of all joints but the root, parents first; half of it is the mirror image's
    """
    turned = features[:, twins(joints)] * MIRROR
    bent = [joint for joint in order if parents[joint] >= 0]
    both = []
    for body in (features, turned):
        local = local_coordinates(body, parents, bent)[1]
        both.append(np.cov(local, rowvar=False, bias=True))
    names = [joints[joint] for joint in bent]
    above = [joints[parents[joint]] for joint in bent]
    return Suppleness(tuple(names), tuple(above), np.mean(both, axis=0))


def averaged_suppleness(
    parts: Sequence[Suppleness | None], weights: Sequence[float]
) -> Suppleness | None:
    """One of several, each by its weight.

    Parameters
    ----------
    parts : of the same joints; those that know nothing are left out
    weights : one each

    Returns
    -------
    None where nobody knows anything, or joints hang on others in one of them
    """
    told = [(one, weight) for one, weight in zip(parts, weights, strict=True) if one is not None]
    if not told:
        return None
    joints, parents = told[0][0].joints, told[0][0].parents
    covariance = np.zeros_like(told[0][0].covariance)
    for one, weight in told:
        same = one.of(joints, parents)
        if not same.told.all():
            return None
        covariance += weight * same.covariance
    return Suppleness(joints, parents, covariance / sum(weight for _, weight in told))
