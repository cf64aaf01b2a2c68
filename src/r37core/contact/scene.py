"""A scene: what the blade meets. Plain numbers only, so that its repr tells whether it was edited."""

from dataclasses import dataclass, replace
from typing import Annotated, Literal, Self

import numpy as np
from numpy import ndarray

from r37core.base.declared import Key, speed_keys

from .casing import Casing


@dataclass(frozen=True)
class Rotor:
    """Blades whose roots stand still: all meet the same casing, and are coupled by what they wear of its lining and, where it
    is elastic, by what they bend it.

    `numbers` of the blades, from 1; `angles` (rad) at which they stand, in the sense of growing theta: the rotor turns against
    it, so a blade passes the casing after those at smaller angles. `frequency_factors`: all frequencies of a blade over those
    of the reduced model; `longer` (m): by how much a blade is longer than that. `shared_lining`: whether all wear one lining,
    or each its own.
    """

    numbers: tuple[int, ...]
    angles: tuple[float, ...]
    frequency_factors: tuple[float, ...]
    longer: tuple[float, ...]
    shared_lining: bool = True

    @property
    def order(self) -> tuple[int, ...]:
        """Places of the blades in the order in which they pass the casing; of two at one angle the first goes first."""
        return tuple(map(int, np.argsort(np.mod(self.angles, 2.0 * np.pi), kind="stable")))


@dataclass(frozen=True)
class Lining:
    """Lining in front of the casing, as bars in rings: every contact node has a ring of its own.

    Law after Legrand, Batailly and Pierre, J. Comput. Nonlinear Dyn. 7 (2012): yield in compression with linear hardening;
    the plastic shortening is the wear. A node presses an area of lining at a time: the length of tip that it stands for, along
    the casing's meridian, times `contact_length`. The published model has in its place that of one bar, the same for all
    nodes: `bar_area`, or `bar_width` times the arc length of a bar.
    """

    thickness: Annotated[float, Key("Distance from its surface to the casing behind it", "_m", ge=1e-6, le=1)]
    elastic_modulus: Annotated[float, Key("Elastic modulus of a bar", "_pa", ge=1e3, le=1e15)]
    plastic_modulus: Annotated[float, Key("Hardening modulus of a bar as it wears", "_pa", ge=0, le=1e15)]
    yield_stress: Annotated[float, Key("Stress at which a bar starts to wear", "_pa", ge=0, le=1e15)]
    bars: Annotated[int, Key("Number of bars round the circumference: the resolution of wear", ge=10, le=1_000_000)] = 10000
    contact_length: Annotated[
        float, Key("Circumferential length of lining that the tip presses at a time", "_m", ge=1e-6, le=1)
    ] = 1.585e-4
    bar_width: Annotated[
        float | None,
        Key("Published model: pressed width at each contact node, times the arc length of a bar", "_m", ge=1e-6, le=1),
    ] = None
    bar_area: Annotated[
        float | None, Key("Published model: pressed area at each contact node, in place of bar_width_m", "_m2", ge=1e-12, le=1)
    ] = None

    @property
    def published(self) -> bool:
        """True where the pressed area is that of a bar."""
        return self.bar_width is not None or self.bar_area is not None

    def arc(self, radius: float) -> float:
        """Arc length (m) of a bar at `radius` (m)."""
        return 2.0 * np.pi * radius / self.bars

    def pressed_areas(self, tip_lengths: ndarray, radius: float) -> ndarray:
        """Area (m2) of lining that each contact node presses at a time, shape (nodes,).

        `tip_lengths` (m), shape (nodes,): lengths of tip that the nodes stand for; `radius` (m) of the tip, of the published
        model. Raises ValueError for a node that stands for no length of tip, which would meet no lining.
        """
        if not self.published:
            if not np.all(tip_lengths > 0.0):
                raise ValueError(
                    "lining of the scene (scenes.yaml): a contact node stands for no length of tip along the casing's "
                    "meridian, so it would meet no lining; allowed: two or more contact nodes, one behind the other along "
                    "the axis or the radius, or the published lining's bar_width_m or bar_area_m2"
                )
            return tip_lengths * self.contact_length
        area = self.arc(radius) * (self.bar_width or 0.0) if self.bar_area is None else self.bar_area
        return np.full(len(tip_lengths), area)

    def bar_surfaces(self, tip_lengths: ndarray, radius: float) -> ndarray:
        """Surface (m2) of the casing under a bar of each contact node's ring, shape (nodes,); arguments of pressed_areas."""
        return self.pressed_areas(tip_lengths, radius) if self.published else tip_lengths * self.arc(radius)

    @property
    def stiffness(self) -> float:
        """Elastic stiffness (N/m) per pressed area (m2)."""
        return self.elastic_modulus / self.thickness


@dataclass(frozen=True)
class BareCasing:
    """A casing without lining, as a wear law that wears nothing: no thickness, no bars, no force."""

    thickness: float = 0.0
    bars: int = 0
    stiffness: float = 0.0

    def pressed_areas(self, tip_lengths: ndarray, radius: float) -> ndarray:
        """Area (m2) of lining that each contact node presses at a time, shape (nodes,): 0."""
        return np.zeros(len(tip_lengths))

    bar_surfaces = pressed_areas


@dataclass(frozen=True)
class Friction:
    """Always-sliding Coulomb friction.

    `vector`: along the real sliding velocity (rotation plus vibration), else the vibration is neglected.
    """

    coefficient: Annotated[float, Key("Coulomb coefficient", ge=0, le=10)]
    vector: Annotated[
        bool,
        Key(
            "Friction against the full sliding velocity (vector) or the rotation alone (constant)",
            name="form",
            words={"constant": False, "vector": True},
        ),
    ] = True
    heat_share: Annotated[
        float, Key("Share of the friction's heat that enters the tip, which melts by it; the rest wears off", ge=1e-3, le=1)
    ] = 0.1


@dataclass(frozen=True)
class DampingTable:
    """Damping ratio of a mode over its frequency: linear between `frequencies` (Hz), constant beyond the ends."""

    frequencies: Annotated[tuple[float, ...], Key("Ascending frequencies", "_hz", ge=0, le=1e12, entries=2)]
    ratios: Annotated[tuple[float, ...], Key("Damping ratio at each frequency", ge=0, lt=1, entries=2)]

    def damping(self, frequencies: ndarray, speed: float | ndarray) -> ndarray:
        """Damping ratios of modes: a damping law has this method, with the arguments and shapes of Scene.damping."""
        return np.interp(frequencies / (2.0 * np.pi), self.frequencies, self.ratios)


@dataclass(frozen=True)
class DampingRow:
    """Damping ratio of a mode at a speed, and its range; linear between the speeds of its rows, constant beyond."""

    ratio: Annotated[float, Key("Damping ratio", ge=0, lt=1)]
    mode: Annotated[int, Key("Number of the mode by frequency at the speed; 0: all that have no rows", ge=0, le=100)] = 0
    speed: Annotated[float | None, speed_keys("Speed: linear between rows, constant beyond; a single row needs none")] = None
    lowest: Annotated[float | None, Key("Lowest ratio, which a verdict tries", ge=0, lt=1)] = None
    highest: Annotated[float | None, Key("Highest ratio, which a verdict tries", ge=0, lt=1)] = None


@dataclass(frozen=True)
class Scene:
    """Surroundings of the blade: casing, lining or None, friction or None, and how the gap is measured.

    `exact_gap`: distance of the displaced node from the conical, lobed casing, instead of the clearance at the undeformed
    node's angle less the normal displacement. `rotor`: the blades that meet it, None for a single one.
    """

    casing: Casing
    lining: Lining | None
    friction: Friction | None
    damping_ratio: float | DampingTable | tuple[DampingRow, ...]
    exact_gap: Annotated[
        bool,
        Key(
            "Clearance less the normal displacement (linear), or distance of the displaced node from the casing",
            name="gap",
            words={"linear": False, "exact": True},
        ),
    ] = False
    divergence_limit: Annotated[float, Key("Tip displacement above which a run ends as diverged", "_m", ge=1e-6, le=100)] = 0.1
    rotor: Rotor | None = None

    @property
    def lined(self) -> bool:
        """True where a lining lies in front of the casing."""
        return self.lining is not None

    @property
    def wear_law(self) -> Lining | BareCasing:
        """The lining; without one a law that wears nothing."""
        return self.lining or BareCasing()

    def damping(self, frequencies: ndarray, speed: float | ndarray) -> float | ndarray:
        """Damping ratios of modes of the `frequencies` (rad/s), in their shape; one number where it is that of every mode.

        `frequencies`, shape (modes,) at a `speed` (rad/s), or (speeds, modes): all modes from the lowest on.
        """
        table = self.damping_ratio
        if isinstance(table, float | int):
            return table
        if not isinstance(table, tuple):
            return table.damping(frequencies, speed)
        ratios = np.empty(frequencies.shape)
        for mode in sorted({row.mode for row in table}):
            speeds, mode_ratios = zip(*sorted((row.speed or 0.0, row.ratio) for row in table if row.mode == mode), strict=True)
            target = ratios[..., mode - 1 : mode] if mode else ratios
            target[...] = np.interp(speed, speeds, mode_ratios)[..., None]
        return ratios

    def damped(self, bound: Literal["lowest", "highest"]) -> Self:
        """The scene with damping at a bound of its range; the scene itself without a range."""
        if not isinstance(self.damping_ratio, tuple):
            return self
        bounds = {row: getattr(row, bound) for row in self.damping_ratio}
        rows = (row if ratio is None else replace(row, ratio=ratio) for row, ratio in bounds.items())
        return replace(self, damping_ratio=tuple(rows))

    def scaled_friction(self, factor: float) -> Self | None:
        """The scene with its coefficient of friction times a `factor`; None without friction."""
        if self.friction is None:
            return None
        return replace(self, friction=replace(self.friction, coefficient=factor * self.friction.coefficient))

    @property
    def grown(self) -> Self:
        """The scene with lobes that are full-grown from the start, and the clearance of its end."""
        revolutions, change = self.casing.change_revolutions[:1], self.casing.change[-1:]
        grown = replace(self.casing, rise_fraction=0.0, rise_revolutions=None, change_revolutions=revolutions, change=change)
        return replace(self, casing=grown)

    def rising_over(self, revolutions: float) -> Self:
        """The scene with lobes that grow as in a run of so many `revolutions`, however long a run is."""
        if self.casing.rise_revolutions is not None:
            return self
        return replace(self, casing=replace(self.casing, rise_revolutions=self.casing.rise_fraction * revolutions))
