"""Waves of the rings of a flexible casing: how flexible the rings are, which waves the rotor overtakes, and why those grow."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from r37core.base.dataset_file import read_dataset
from r37core.contact.elastic_casing import flexibility, flexibility_of, nodal_diameters_for, slowest_wave
from r37core.contact.scene import Scene
from r37core.results.casing_coincidence import coincidence_table
from r37core.time_integration.problem import Problem

from .elastic_casing import FASTEST, LINING, RINGS, SCENES, STIFF, Runs, shown
from .pages import write_table

SHOWN = (0, 2, 20)
DIAMETERS = (5, 10, 20, 40)
NEAR = (1600.0, 1800.0)
"""Speeds (rad/s) about the interaction of Ref's 1B with engine order 4."""

ABOVE = np.arange(1550.0, 2000.0, 25.0)
ABOUT = np.arange(1660.0, 1781.0, 10.0)
NO_DAMPING, STRONG = 1e-9, 0.05
GROWS = 1.01
"""Factor per revolution from which on a motion counts as growing."""

STIFFNESSES = (1e4, 1e6, 1e8)
"""Stiffness of one spring between leading edge and casing (N/m)."""


def rings(input: Any, output: Any, params: Any) -> None:
    """Table of the frequencies of the rings, and of the waves that the rotor overtakes first."""
    runs, rows = Runs(()), []
    for casing in RINGS:
        elastic = runs.casing(casing)
        frequencies = {mode.nodal_diameter: mode.frequency / 2.0 / np.pi for mode in elastic.modes if mode.radial}
        number, critical = slowest_wave(elastic.ring)
        overtaken = [mode.nodal_diameter for mode in elastic.overtaken(FASTEST)]
        below = f"{overtaken[0]} to {overtaken[-1]}" if overtaken else "none"
        rows.append([shown(casing), *(f"{frequencies[n]:.0f}" for n in SHOWN), f"{critical:.0f}", str(number), below])
    heads = ["lowest critical speed (rad/s)", "its n", f"n overtaken at {FASTEST:g} rad/s"]
    write_table(["casing", *(f"n = {n} (Hz)" for n in SHOWN), *heads], rows, output.table)


def flexibilities(input: Any, output: Any, params: Any) -> None:
    """Table of the static displacement of the wall under a unit force, by modes up to some number and by all of them."""
    runs, rows = Runs(()), []
    for casing in RINGS:
        whole = 1e6 * flexibility(runs.casing(casing).ring)
        parts = [1e6 * flexibility_of(runs.casing(casing, number).modes) for number in DIAMETERS]
        needed = nodal_diameters_for(runs.casing(casing).ring, 0.95, 100)
        rows.append([shown(casing), *(f"{part:.4f}" for part in parts), f"{whole:.4f}", str(needed)])
    write_table(["casing (µm/N)", *(f"up to {n}" for n in DIAMETERS), "all", "n for 95%"], rows, output.table)


def coincidences(input: Any, output: Any, params: Any) -> None:
    """Table of the coincidences of Ref's 1B with each ring near its interaction with engine order 4. Input: campbell."""
    campbell, runs = read_dataset(input.campbell), Runs(())
    table = coincidence_table(campbell.sel(blade=["Ref"]), {shown(casing): runs.casing(casing) for casing in RINGS})
    near = table[(table["mode"] == "1B") & table["speed_rad_s"].between(*NEAR)]
    rows = [
        [row.scene, str(row.nodal_diameter), row.wave, f"{row.speed_rad_s:.0f}", f"{row.frequency_hz:.0f}", row.simulated]
        for row in near.itertuples()
    ]
    heads = [
        "ring",
        "nodal diameters",
        "wave",
        "speed (rad/s)",
        "frequency in the rotor's frame (Hz)",
        "simulated up to n = 20",
    ]
    write_table(heads, rows, output.table)


def overtaken(input: Any, output: Any, params: Any) -> None:
    """Table of runs on stiff flanges above the critical speed of short waves, with these waves and without."""
    runs, rows = Runs(input.files), []
    for casing in (ring for ring in RINGS if ring[1] == STIFF):
        every = runs.casing(casing, runs.casing(casing).overtaken(FASTEST)[-1].nodal_diameter)
        speeds = ABOVE[every.critical_speed < ABOVE]
        for name, scene in SCENES.items():
            cells = [
                _counted(runs, speeds, name, runs.scene(name, runs.casing(casing).modes)),
                _counted(runs, speeds, name, runs.scene(name, every.modes)),
                _counted(runs, speeds, name, _changed(runs.scene(name, every.modes), ring_damping=0.0)),
            ]
            number = str(every.ring.highest_nodal_diameter)
            rows.append([shown(casing), scene, f"{speeds[0]:.0f} to {speeds[-1]:.0f}", number, *cells])
    heads = ["up to n = 20", "up to the last one", "the same, ring without damping"]
    write_table(["ring", "scene", "speeds (rad/s)", "last wave overtaken, n", *heads], rows, output.table)


def causes(input: Any, output: Any, params: Any) -> None:
    """Table of runs on soft flanges that diverge, without each of the possible causes."""
    neither = {"friction": 0.0, "blade_damping": NO_DAMPING}
    ways: dict[str, dict[str, float]] = {
        "default": {},
        "no friction": {"friction": 0.0},
        "no damping of the blade": {"blade_damping": NO_DAMPING},
        "neither, ring undamped": {**neither, "ring_damping": 0.0},
        f"ring damped by {STRONG:.0%}": {"ring_damping": STRONG},
    }
    runs, rows = Runs(input.files), []
    for casing in (ring for ring in RINGS if ring[1] != STIFF):
        for name, scene in SCENES.items():
            flexible = runs.scene(name, runs.casing(casing).modes)
            cells = [_counted(runs, ABOUT, name, _changed(flexible, **way)).split(",")[0] for way in ways.values()]
            rows.append([shown(casing), scene, *cells])
    write_table(["ring", "scene", *ways], rows, output.table)


def growth(input: Any, output: Any, params: Any) -> None:
    """Table of speeds at which one spring between leading edge and casing makes waves grow, and of the largest factor."""
    runs, rows = Runs(input.files), []
    for casing in RINGS:
        factors = np.array([_growth(runs, casing, speed) for speed in ABOUT])
        counts, largest = (factors > GROWS).sum(axis=0), factors.max(axis=0)
        rows.append([shown(casing), *(f"{n} of {len(ABOUT)}, {top:.3g}" for n, top in zip(counts, largest, strict=True))])
    write_table(["casing", *(f"{stiffness:.0e} N/m" for stiffness in STIFFNESSES)], rows, output.table)


def _changed(
    scene: Scene, friction: float | None = None, blade_damping: float | None = None, ring_damping: float | None = None
) -> Scene:
    """The scene with another friction coefficient and other damping ratios, where they are given."""
    ring = scene.casing.ring
    if ring_damping is not None:
        ring = tuple(replace(mode, damping_ratio=ring_damping) for mode in ring)
    return replace(
        scene,
        casing=replace(scene.casing, ring=ring),
        friction=scene.friction if friction is None else replace(scene.friction, coefficient=friction),
        damping_ratio=scene.damping_ratio if blade_damping is None else blade_damping,
    )


def _counted(runs: Runs, speeds: np.ndarray, name: str, scene: Scene) -> str:
    """Number of runs of Ref that diverge, and the mean rms (mm) of the others."""
    rms = np.array([np.hypot(*runs.rms("Ref", name, speed, scene)[:2]) for speed in speeds])
    diverged = int(np.isnan(rms).sum())
    return f"{diverged} of {len(speeds)}" + (f", {1e3 * np.nanmean(rms):.3f}" if diverged < len(speeds) else "")


def _growth(runs: Runs, casing: tuple[float, float], speed: float) -> list[float]:
    """Growth per revolution of the fastest growing motion, for each stiffness, without friction and damping.

    The model is linear: the modes of Ref, those of the ring in the rotor's frame, and a spring (N/m) between leading edge and
    casing that is always closed. In that frame q'' - 2 n Omega J q' + (omega^2 - n^2 Omega^2) q = f, with J a quarter turn.
    """
    scene = runs.scene(LINING, runs.casing(casing).modes)
    problem = Problem(runs.contact("Ref"), speed, scene, runs.settings.integration_choice("Ref", LINING, speed))
    ring, row = problem.casing.ring, problem.contact.displacement_operator[0, 0]
    blade, pairs = len(row) - len(ring.frequencies), len(ring.modes)
    turning = np.tile(ring.nodal_diameters * speed, 2)
    stiff = np.concatenate([problem.blade.frequencies[:blade] ** 2, ring.frequencies**2 - turning**2])
    gyroscopic = np.zeros((len(row), len(row)))
    first, second = np.arange(blade, blade + pairs), np.arange(blade + pairs, len(row))
    gyroscopic[first, second], gyroscopic[second, first] = -2.0 * turning[:pairs], 2.0 * turning[:pairs]
    factors = []
    for stiffness in STIFFNESSES:
        pressed = np.diag(stiff) + stiffness * np.outer(row, row)
        system = np.block([[np.zeros_like(gyroscopic), np.eye(len(row))], [-pressed, gyroscopic]])
        factors.append(np.exp(np.linalg.eigvals(system).real.max() * 2.0 * np.pi / speed))
    return factors
