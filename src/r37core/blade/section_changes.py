"""Profiles with another stagger, camber, chord or thickness, each by a law over the span.

A changed profile is one of the same family: two arcs on the same cone whose angle to the rulings turns at a constant rate
(`profile.py`). Both arcs and the place of the maximum thickness keep their shares of the centreline's length. Added camber is
spread evenly over that length: the centreline turns by as much more on each centimetre. Then all three angles are rotated
alike, and all lengths scaled alike, until the chord line has the wanted direction and length. So stagger, camber and chord are
changed in one solution, and none of them moves another.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Self

import numpy as np
import scipy
from numpy import ndarray

from r37core.base.io import CarriedError

from .cone import Cone, ConstantRatePath
from .profile import BladeShapeError, ProfileParameters, centreline
from .profile_tables import check_profile_order

_SMALLER = "; a smaller change near this span may be possible"


@dataclass(frozen=True)
class SpanLaw:
    """Values at `spans`, fractions that rise from 0 to 1; a single value is the same over the whole span."""

    spans: tuple[float, ...]
    values: tuple[float, ...]

    @classmethod
    def constant(cls, value: float) -> Self:
        """Constant law: one value at every span."""
        return cls((0.0,), (value,))

    @classmethod
    def linear(cls, hub: float, tip: float) -> Self:
        """Linear law: in proportion to the span from hub to tip."""
        return cls((0.0, 1.0), (hub, tip))

    def evaluate(self, spans: Sequence[float]) -> ndarray:
        """Values at span fractions, shape (spans,): a spline as that of sweep and lean, at most cubic.

        Equal values give themselves to the last bit, so that a law of neutral values changes nothing.
        """
        if len(set(self.values)) == 1:
            return np.full(len(spans), self.values[0])
        order = min(3, len(self.values) - 1)
        spline = scipy.interpolate.make_interp_spline(self.spans, self.values, k=order)
        return np.asarray(spline(np.asarray(spans)))


@dataclass(frozen=True)
class SectionChange:
    """Angles added to a profile's stagger and camber (rad), shares of its chord and thickness; the defaults change nothing."""

    stagger: float = 0.0
    camber: float = 0.0
    chord: float = 1.0
    thickness: float = 1.0

    @property
    def names(self) -> list[str]:
        """Names of the changes that are not neutral."""
        return [field.name for field in fields(self) if getattr(self, field.name) != field.default]


class SectionChangeError(CarriedError, BladeShapeError):
    """A profile that cannot be changed so; `names`: the changes of it that are not neutral."""

    def __init__(self, text: str, names: Sequence[str]):
        super().__init__(text)
        self.names = tuple(names)


def changed_profiles(profiles: Sequence[ProfileParameters], laws: Mapping[str, SpanLaw]) -> tuple[ProfileParameters, ...]:
    """The profiles with changes by laws over the span, by the names of SectionChange's fields.

    Raises SectionChangeError for a profile that becomes impossible or crosses another.
    """
    if not laws:
        return tuple(profiles)
    spans = [profile.span for profile in profiles]
    values = {name: law.evaluate(spans) for name, law in laws.items()}
    changes = [SectionChange(**{name: float(several[i]) for name, several in values.items()}) for i in range(len(spans))]
    changed = tuple(changed_profile(profile, change) for profile, change in zip(profiles, changes, strict=True))
    names = {name for change in changes for name in change.names} - {"thickness"}
    if names:
        try:
            check_profile_order(changed)
        except BladeShapeError as error:
            raise SectionChangeError(f"{error}{_SMALLER}", sorted(names)) from None
    return changed


# it takes a millisecond, and a call of r37 reads the designs of a family several times
@lru_cache(maxsize=2**15)
def changed_profile(profile: ProfileParameters, change: SectionChange) -> ProfileParameters:
    """The profile with one change; neutral parts of it leave every bit. Raises SectionChangeError."""
    try:
        if set(change.names) - {"thickness"}:
            profile = _redrawn(profile, change)
        if change.thickness != 1.0:
            names = ("inlet_thickness", "maximum_thickness", "outlet_thickness")
            profile = replace(profile, **{name: change.thickness * getattr(profile, name) for name in names})
        if change.names:
            profile.check()
    except BladeShapeError as error:
        raise SectionChangeError(f"{error}{_SMALLER}", change.names) from None
    return profile


def _arcs(cone: Cone, angles: ndarray, lengths: ndarray) -> tuple[ConstantRatePath, ConstantRatePath]:
    """Two arcs with `angles` (rad) at inlet, transition and outlet, and `lengths` (m)."""
    rates = np.diff(angles) / lengths
    front = ConstantRatePath(cone, 0.0, 0.0, angles[0], rates[0])
    m, theta = (float(coordinate) for coordinate in front.point(lengths[0]))
    return front, ConstantRatePath(cone, m, theta, angles[1], rates[1])


def _chord(cone: Cone, angles: ndarray, lengths: ndarray) -> ndarray:
    """Direction (rad) and length (m) of the chord line of two arcs: its angle to the axis, and on the unrolled cone.

    The angle is that of `Profile.stagger`.
    """
    m, theta = _arcs(cone, angles, lengths)[1].point(lengths[1])
    # seen from half-way between the ends, where Profile.stagger has the centre of area
    rise = (cone.inlet_radius + cone.radius(m)) * np.sin(theta / 2.0)
    return np.array([np.arctan2(rise, cone.axial(m)), np.hypot(*cone.unroll(0.0, 0.0, m, theta))])


def _redrawn(profile: ProfileParameters, change: SectionChange) -> ProfileParameters:
    """Section redrawn with another stagger, camber and chord. Raises BladeShapeError where no arcs have them."""
    if not change.chord > 0.0:
        # a spline through shares may pass below them
        raise BladeShapeError(f"{profile.label}: the share of the chord is {100 * change.chord:g}%; it must be positive")
    line, names = centreline(profile), ("inlet_angle", "transition_angle", "outlet_angle")
    cone, lengths = line.front.cone, np.array([line.front_length, line.rear_length])
    angles = np.array([getattr(profile, name) for name in names])
    direction, length = _chord(cone, angles, lengths)
    wanted = np.array([direction + change.stagger, change.chord * length])
    # the added camber is spread evenly over the length
    cambered = angles + change.camber * (0.5 - np.array([0.0, lengths[0], lengths.sum()]) / lengths.sum())

    def miss(unknowns: ndarray) -> ndarray:
        rotation, scale = unknowns
        ends = _chord(cone, cambered + rotation, scale * lengths)
        return np.array([ends[0] - wanted[0], ends[1] / wanted[1] - 1.0])

    solution = scipy.optimize.root(miss, np.array([change.stagger, change.chord]), tol=1e-14)
    if not np.max(np.abs(miss(solution.x))) < 1e-9 or not solution.x[1] > 0.0:
        raise BladeShapeError(f"{profile.label}: no two arcs on the cone have this stagger, camber and chord")
    rotation, scale = solution.x
    front, rear = _arcs(cone, cambered + rotation, scale * lengths)
    m = profile.maximum_thickness_axial / np.cos(cone.half_angle)
    thickest = scale * (line.front.length_to(m) if m < line.rear.m else line.front_length + line.rear.length_to(m))
    beyond = thickest - scale * lengths[0]
    places = {
        "maximum_thickness_axial": cone.axial(front.meridional(thickest) if beyond < 0.0 else rear.meridional(beyond)),
        "transition_axial": cone.axial(rear.m),
        "outlet_axial": cone.axial(rear.meridional(scale * lengths[1])),
        "outlet_radius": cone.radius(rear.meridional(scale * lengths[1])),
    }
    drawn = dict(zip(names, cambered + rotation, strict=True)) | places
    return replace(profile, **{name: float(value) for name, value in drawn.items()})
