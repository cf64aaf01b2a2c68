"""Readings of what the benchmark leaves open. Light: the workflow imports it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Reading:
    """One reading: `changes`: dotted path in the scene's entry of scenes.yaml -> value; `model`: parts of a model's name.

    `steps`: time step as a multiple of the base level's; comparing readings does not need the published one.
    """

    what: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    model: Mapping[str, Any] = field(default_factory=dict)
    steps: float = 2.0


_NUMERICAL = {
    "double_step": Reading("twice the published step"),
    "mesh_10000": Reading("mesh of 10,000 nodes", model={"nodes": 10000}),
    "mesh_40000": Reading("mesh of 40,000 nodes", model={"nodes": 40000}),
}

LINED = {
    "benchmark": Reading("as shipped", steps=1.0),
    "vector": Reading("friction along rotation and vibration", {"friction.form": "vector"}),
    "against": Reading("friction against the rotation", {"friction.direction": "against_rotation"}),
    "shared": Reading("one ring shared by the nodes", {"lining.rings": "shared"}),
    "against_shared": Reading(
        "vector friction against the rotation, one shared ring, the whole tip's area at every node",
        {
            "friction.form": "vector",
            "friction.direction": "against_rotation",
            "lining.rings": "shared",
            "lining.natural_bar_areas": 7.0,
        },
    ),
    "exact_gap": Reading("radius of the displaced node in the gap", {"gap": "exact"}),
    "area_half": Reading("half the natural bar area", {"lining.natural_bar_areas": 0.5}),
    "area_double": Reading("twice the natural bar area", {"lining.natural_bar_areas": 2.0}),
    "yield_mpa": Reading("yield stress in MPa", {"lining.yield_stress_pa": 1.5e6}),
    "camber": Reading("nodes on the camber line", model={"line": "camber"}),
    "inside": Reading("corners not among the nodes", model={"ends": "inside"}),
    "half_step": Reading("half the published step", steps=0.5),
} | _NUMERICAL
"""Readings of the abradable scene, and numerical variants of the shipped one."""

RIGID = {
    "benchmark": Reading("as shipped", steps=1.0),
    "vector": Reading("friction along rotation and vibration", {"friction.form": "vector"}),
    "against": Reading("friction against the rotation", {"friction.direction": "against_rotation"}),
    "against_vector": Reading(
        "vector friction against the rotation", {"friction.direction": "against_rotation", "friction.form": "vector"}
    ),
    "after": Reading("friction added after the normal solve", {"friction.coupling": "after"}),
    "exact_gap": Reading("radius of the displaced node in the gap", {"gap": "exact"}),
    "camber": Reading("nodes on the camber line", model={"line": "camber"}),
    "inside": Reading("corners not among the nodes", model={"ends": "inside"}),
} | _NUMERICAL
"""Readings of the direct scene."""
