"""Readings of what the benchmark leaves open: the shipped one, and each choice turned once. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Reading:
    """One reading: `changes`: dotted path in a scene's entry of scenes.yaml -> value; `model`: parts of a model's name.

    `quick`: the time integration of the study's quick level in place of the base level's; `steps`: its time step times this;
    `fine`: wide windows on the fine grid of speeds, else narrow ones on the coarse grid; `surveys`: the whole range of
    speeds; `blades`: whose interactions, None: all.
    """

    what: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    model: Mapping[str, Any] = field(default_factory=dict)
    quick: bool = False
    steps: float = 1.0
    fine: bool = False
    surveys: bool = False
    blades: tuple[str, ...] | None = None

    @property
    def only_lining(self) -> bool:
        """Whether it says nothing about direct contact."""
        return bool(self.changes) and all(path.startswith("lining.") for path in self.changes)


SHIPPED = "shipped"
SURVEY = "survey"
BASELINE = "baseline"

CONVERGENCE = {
    "double_step": Reading("twice the published step", steps=2.0),
    "half_step": Reading("half the published step", steps=0.5, blades=("Ref",)),
    "mesh_10000": Reading("mesh of 10,000 nodes", model={"nodes": 10000}),
    "mesh_40000": Reading("mesh of 40,000 nodes", model={"nodes": 40000}, blades=("Ref",)),
    "quick": Reading("time integration of the quick level", quick=True),
    "nudged": Reading("clearance 0.01% larger", {"casing.clearance_m": 3.56e-4 * 1.0001}),
}
"""The shipped reading with one numerical choice changed; `nudged` shows what the motion's sensitivity alone does."""


def _turned(what: str, changes: Mapping[str, Any] | None = None, **model: Any) -> Reading:
    return Reading(what, changes or {}, {"nodes": 10000} | model, quick=True)


TURNED = {
    BASELINE: _turned("as shipped"),
    "radial": _turned("radial normal: a cylindrical casing", {"casing.cone_angle_deg": 0}),
    "along": _turned("friction along the rotation", {"friction.direction": "along_rotation"}),
    "constant": _turned("constant friction: the vibration's part of the sliding neglected", {"friction.form": "constant"}),
    "shared": _turned("one ring shared by the nodes", {"lining.rings": "shared"}),
    **{
        f"width_{width:g}": _turned(f"bars {width:g} mm wide", {"lining.bar_width_m": 1e-3 * width})
        for width in (0.5, 0.8, 1.25, 2.0)
    },
    "camber": _turned("nodes on the camber line", tip_line="camber"),
    "suction": _turned("nodes on the suction edge", tip_line="suction_edge"),
    "inside": _turned("corners not among the nodes", ends="inside"),
    "exact": _turned("exact gap", {"gap": "exact"}),
    "after": _turned("friction added after the normal solve", {"friction.coupling": "after"}),
    "yield_mpa": _turned("yield stress of the lining in MPa", {"lining.yield_stress_pa": 1.5e6}),
}
"""Each choice turned once, cheaply: time integration of the quick level, 10,000 nodes. Compare with the first."""

READINGS = {
    SHIPPED: Reading("as shipped", fine=True),
    SURVEY: Reading("as shipped, the whole range", quick=True, surveys=True),
    **CONVERGENCE,
    **TURNED,
}
