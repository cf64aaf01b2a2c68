"""The benchmark's lined scene, the only one that the peaks in validation.published are of."""

from __future__ import annotations

from dataclasses import replace

from .casing import Casing
from .scene import Friction, Lining, Scene

LINED = Scene(
    casing=Casing(clearance=3.56e-4, lobes=2, width=0.15, amplitude=2.0, rise_fraction=0.2),
    lining=Lining(
        thickness=5e-3,
        elastic_modulus=20e9,
        plastic_modulus=5e9,
        yield_stress=1.5,
        bar_width=1e-3,
        bars=10_000,
    ),
    friction=Friction(coefficient=0.15, vector=True),
    damping_ratio=5e-4,
    exact_gap=False,
    divergence_limit=0.1,
)
"""Source: section 5 of the benchmark; the lining's bars as docs/validation.md chooses them."""


def is_lined_benchmark(scene: Scene) -> bool:
    """Whether a scene is the benchmark's lined one, whatever it is called; the divergence limit only says when a run ends."""
    return replace(scene, divergence_limit=LINED.divergence_limit) == LINED
