"""Waves of the rings of elastic_casing.py: how flexible they are, which the rotor meets and overtakes, and why those grow.

Run: snakemake campbell; python validation/benchmarks/elastic_casing_waves.py (some five minutes on two cores), or with names of TABLES
after it for those alone; or make claims ONLY=elastic_casing.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

import numpy as np
from elastic_casing import (
    CASINGS,
    DIRECT,
    LINED,
    ROOT,
    STIFF,
    STUDIES,
    casing_of,
    contact,
    integrated,
    name_of,
    settings,
    with_casing,
)

from r37core.contact.elastic_casing import flexibility, flexibility_of, nodal_diameters_for, slowest_wave
from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.results.casing_coincidence import coincidence_table
from validation.studies.tables import markdown_table
from r37core.time_integration.problem import Problem

RINGS = CASINGS[1:]
SHOWN = (0, 1, 2, 4, 8, 20)
DIAMETERS = (5, 10, 20, 30, 40, 60, 80, 100)
FASTEST = 2000.0
"""The benchmark's highest speed (rad/s)."""

NEAR = (1600.0, 1800.0)
"""Speeds (rad/s) about the interaction of Ref's 1B with order 4."""

ABOVE = np.arange(1550.0, 2000.0, 25.0)
ABOUT = np.arange(1660.0, 1781.0, 10.0)
NO_DAMPING, STRONG = 1e-9, 0.05
GROWS = 1.01
"""Factor per revolution from which on a motion counts as growing."""

STIFFNESSES = (1e4, 1e5, 1e6, 1e7, 1e8)
"""Of one spring between leading edge and casing (N/m)."""


def main(names):
    with ProcessPoolExecutor(2) as pool:
        for name in names or TABLES:
            write_text(TABLES[name](pool), STUDIES / f"elastic_casing_{name}.md")
            print(name, flush=True)


def rings_table(_):
    """Frequencies of the rings, and the waves that the rotor overtakes first."""
    rows = []
    for casing in RINGS:
        own = casing_of(casing)
        of = {mode.nodal_diameter: mode.frequency / 2.0 / np.pi for mode in own.modes if mode.radial}
        number, critical = slowest_wave(own.ring)
        overtaken = [mode.nodal_diameter for mode in own.overtaken(FASTEST)]
        below = f"{overtaken[0]} to {overtaken[-1]}" if overtaken else "none"
        rows.append([name_of(casing), *(f"{of[n]:.0f}" for n in SHOWN), f"{critical:.0f}", str(number), below])
    heads = ["lowest critical speed (rad/s)", "its n", f"n overtaken at {FASTEST:g} rad/s"]
    return markdown_table(["casing", *(f"n = {n} (Hz)" for n in SHOWN), *heads], rows)


def flexibility_table(_):
    """How far a force that rests pushes the wall out, by modes up to some number and by all of them."""
    rows = []
    for casing in RINGS:
        whole = 1e6 * flexibility(casing_of(casing).ring)
        parts = [1e6 * flexibility_of(casing_of(casing, number).modes) for number in DIAMETERS]
        needed = nodal_diameters_for(casing_of(casing).ring, 0.95, DIAMETERS[-1])
        rows.append([name_of(casing), *(f"{part:.4f}" for part in parts), f"{whole:.4f}", str(needed)])
    return markdown_table(["casing (um/N)", *(f"up to {n}" for n in DIAMETERS), "all", "n for 95%"], rows)


def coincidences_table(_):
    """Coincidences of Ref's 1B with each ring near its interaction with order 4."""
    campbell = read_dataset(ROOT / "results/campbell.nc")
    table = coincidence_table(campbell.sel(blade=["Ref"]), {name_of(casing): casing_of(casing) for casing in RINGS})
    near = table[(table["mode"] == "1B") & table["speed_rad_s"].between(*NEAR)]
    rows = [
        [row.scene, str(row.nodal_diameter), row.wave, f"{row.speed_rad_s:.0f}", f"{row.frequency_hz:.0f}", row.simulated]
        for row in near.itertuples()
    ]
    heads = ["ring", "nodal diameters", "wave", "speed (rad/s)", "in the rotor's frame (Hz)", "in simulations up to n = 20"]
    return markdown_table(heads, rows)


def changed(scene, friction=None, blade_damping=None, ring_damping=None):
    """The scene with other friction and damping ratios, where they are given."""
    ring = scene.casing.ring
    if ring_damping is not None:
        ring = tuple(replace(mode, damping_ratio=ring_damping) for mode in ring)
    return replace(
        scene,
        casing=replace(scene.casing, ring=ring),
        friction=scene.friction if friction is None else replace(scene.friction, coefficient=friction),
        damping_ratio=scene.damping_ratio if blade_damping is None else blade_damping,
    )


def rms_of(task):
    """Rms (m) of Ref's leading edge, normal and tangential together; NaN where the run diverges."""
    name, speed, modes, changes = task
    scene = changed(with_casing(name, modes), **changes)
    return np.hypot(*integrated("Ref", speed, settings().integration_choice("Ref", name, speed), scene)[:2])


def counted(pool, name, speeds, modes, **changes):
    """How many runs diverge, and the mean rms (m) of the others."""
    rms = np.array(list(pool.map(rms_of, [(name, speed, modes, changes) for speed in speeds], chunksize=4)))
    diverged = int(np.isnan(rms).sum())
    return f"{diverged} of {len(speeds)}" + (f", {1e3 * np.nanmean(rms):.3f}" if diverged < len(speeds) else "")


def overtaken_table(pool):
    """Stiff flanges: what the short waves that the shipped number leaves out do above their critical speed."""
    rows = []
    for casing in ((2e-3, STIFF), (1e-3, STIFF)):
        every = casing_of(casing, casing_of(casing).overtaken(FASTEST)[-1].nodal_diameter)
        speeds = ABOVE[every.critical_speed < ABOVE]
        for name in (LINED, DIRECT):
            cells = [
                counted(pool, name, speeds, casing_of(casing).modes),
                counted(pool, name, speeds, every.modes),
                counted(pool, name, speeds, every.modes, ring_damping=0.0),
            ]
            number = str(every.ring.highest_nodal_diameter)
            rows.append([name_of(casing), name, f"{speeds[0]:.0f} to {speeds[-1]:.0f}", number, *cells])
            print(rows[-1], flush=True)
    heads = ["up to n = 20", "up to the last one", "the same, ring without damping"]
    return markdown_table(["ring", "scene", "speeds (rad/s)", "last wave overtaken, n", *heads], rows)


def causes_table(pool):
    """Soft flanges about Ref 1B/4: runs that diverge, without what might be thought to make them."""
    ways = {
        "as shipped": {},
        "no friction": {"friction": 0.0},
        "no damping of the blade": {"blade_damping": NO_DAMPING},
        "neither": {"friction": 0.0, "blade_damping": NO_DAMPING},
        "neither, ring undamped": {"friction": 0.0, "blade_damping": NO_DAMPING, "ring_damping": 0.0},
        f"as shipped, ring damped by {STRONG:.0%}": {"ring_damping": STRONG},
    }
    rows = []
    for casing in RINGS[3:]:
        for name in (LINED, DIRECT):
            modes = casing_of(casing).modes
            cells = [counted(pool, name, ABOUT, modes, **way).split(",")[0] for way in ways.values()]
            rows.append([name_of(casing), name, *cells])
            print(rows[-1], flush=True)
    note = f"Ref, every {ABOUT[1] - ABOUT[0]:g} rad/s from {ABOUT[0]:g} to {ABOUT[-1]:g}, level `{settings().fidelity_name}`. "
    note += f"Damping of the blade is {settings().scenes[LINED].scene.damping_ratio:g} as shipped, else {NO_DAMPING:g}."
    return f"{markdown_table(['ring', 'scene', *ways], rows)}\n{note}\n"


def growth(casing, speed):
    """Per stiffness, the factor by which the fastest growing motion grows in a revolution, without friction and damping.

    Linear: the modes of Ref and those of the ring in the rotor's frame, and a spring (N/m) between leading edge and casing
    that is never open. In that frame q'' - 2 n Omega J q' + (omega^2 - n^2 Omega^2) q = f, with J a quarter of a turn.
    """
    scene = with_casing(LINED, casing.modes)
    problem = Problem(contact("Ref"), speed, scene, settings().integration_choice("Ref", LINED, speed))
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


def growth_table(_):
    """Of how many speeds a spring between leading edge and casing alone makes waves grow."""
    rows = []
    for casing in RINGS:
        factors = np.array([growth(casing_of(casing), speed) for speed in ABOUT])
        counts, largest = (factors > GROWS).sum(axis=0), factors.max(axis=0)
        rows.append([name_of(casing), *(f"{n} of {len(ABOUT)}, {top:.3g}" for n, top in zip(counts, largest, strict=True))])
        print(rows[-1], flush=True)
    return markdown_table(["casing", *(f"{stiffness:.0e} N/m" for stiffness in STIFFNESSES)], rows)


TABLES = {
    "rings": rings_table,
    "flexibility": flexibility_table,
    "coincidences": coincidences_table,
    "growth": growth_table,
    "causes": causes_table,
    "overtaken": overtaken_table,
}

if __name__ == "__main__":
    main(sys.argv[1:])
