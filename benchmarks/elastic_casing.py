"""What a casing that gives way changes for the seven blades, and what it costs: tables of docs/elastic_casing.md.

Run: make claims ONLY=elastic_casing (a quarter of an hour on two cores). The scenes are
elastic_abradable and elastic_direct of config/scenes.yaml, with rings of several thicknesses, and without.
"""

import os
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.config import command_line_document, read_settings
from r37core.config.si_fields import in_si
from r37core.contact.ring import Ring, critical_speed
from r37core.dataset_file import read_dataset
from r37core.figures.style import PAGE, plt
from r37core.io import write_text
from r37core.published import INTERACTIONS
from r37core.results.casing_coincidence import coincidence_table
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.tables import markdown_table
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parent.parent
STUDIES = ROOT / "results/studies"
LINED, DIRECT = "elastic_abradable", "elastic_direct"
STIFF, SOFT = 1e9, 1e7
"""Of the flanges, radially and along the tangent (N/m2)."""

CASINGS = (None, *((thickness, foundation) for foundation in (STIFF, SOFT) for thickness in (4e-3, 2e-3, 1e-3)))
"""Thickness of the ring (m) and its flanges; None is rigid."""

KEPT = {"spectrum_highest_order": 20, "wear_angles": 8}
ABOUT = np.arange(-60.0, 61.0, 2.0)
"""Speeds, in rad/s, about a published peak."""

DIRECT_SHARES = np.linspace(0.98, 1.06, 9)
"""Of the published peak of 1B with order 4."""

NEAR = (1600.0, 1800.0)
"""Speeds (rad/s) about the interaction of Ref's 1B with order 4."""

DIAMETERS = (5, 10, 15, 20, 40)
GRID, ROUNDS = np.arange(800.0, 2000.0, 100.0), 3


def main():
    with ProcessPoolExecutor(2) as pool:
        write_text(peaks_table(pool), STUDIES / "elastic_casing_peaks.md")
        write_text(direct_table(pool), STUDIES / "elastic_casing_direct.md")
        write_text(diameters_table(pool), STUDIES / "elastic_casing_diameters.md")
    write_text(rings_table(), STUDIES / "elastic_casing_rings.md")
    write_text(meeting_table(), STUDIES / "elastic_casing_coincidences.md")
    write_text(cost_table(), STUDIES / "elastic_casing_cost.md")


@cache
def settings():
    return read_settings(ROOT, command_line_document({"scenes": [LINED, DIRECT]}))


@cache
def contact(blade):
    model = read_reduced_model(ROOT / f"results/{blade}/rom_pressure_edge.nc")
    return contact_model(model, settings().structure.boundary.tip_line)


def ring_of(casing, diameters=20):
    """Modes of the shipped ring with another thickness and other flanges; none of a rigid casing."""
    if casing is None:
        return ()
    thickness, stiffness = casing
    shipped = in_si(Ring, settings().scene_entries[LINED].casing.ring)
    other = {"thickness": thickness, "radial_foundation": stiffness, "tangential_foundation": stiffness}
    return replace(shipped, **other, highest_nodal_diameter=diameters).modes()


def with_casing(name, ring):
    scene = settings().scenes[name].scene
    return replace(scene, casing=replace(scene.casing, ring=ring))


def name_of(casing):
    return "rigid" if casing is None else f"{1e3 * casing[0]:g} mm, {'stiff' if casing[1] == STIFF else 'soft'}"


def run(task):
    """Rms (m) of the leading edge, normal and tangential, and of all waves round the casing (m)."""
    blade, name, speed, ring = task
    choice = replace(settings().integration_choice(blade, name, speed), energy=False, snapshot_revolutions=0)
    found = run_speed(contact(blade), float(speed), with_casing(name, ring), choice, ["casing"] if ring else [], **KEPT)
    waves = np.sum(found["casing_rms_forward"] ** 2 + found["casing_rms_backward"] ** 2) if ring else 0.0
    return *found["rms"][0, [0, 2]], np.sqrt(waves)


def peaks_table(pool):
    """Peaks of the ten published interactions, every 2 rad/s about them; draws those of order 4, too."""
    rows = []
    figure, panels = plt.subplots(1, 7, figsize=(PAGE, 1.9), sharey=True)
    axes_of = iter(panels)
    for one in INTERACTIONS:
        speeds = round(one.peak) + ABOUT
        cells = [f"{one.blade} 1B/{one.engine_order}", f"{one.peak:g}"]
        axes = next(axes_of) if one.engine_order == 4 else None
        for casing in CASINGS:
            ring = ring_of(casing)
            found = np.array(list(pool.map(run, [(one.blade, LINED, v, ring) for v in speeds], chunksize=8)))
            rms = np.hypot(*found.T[:2])
            peak, diverged = int(np.nanargmax(rms)), int(np.isnan(rms).sum())
            notes = [" at the end"] * (peak in (0, len(speeds) - 1)) + [f" ({diverged} diverge)"] * (diverged > 0)
            cells.append(f"{speeds[peak]:.0f}, {1e3 * rms[peak]:.2f}{''.join(notes)}")
            if axes:
                axes.plot(speeds, 1e3 * rms, label=name_of(casing), linewidth=0.8)
                axes.set(title=one.blade, xlabel="rad/s")
        rows.append(cells)
        print(cells, flush=True)
    panels[0].set_ylabel("rms (mm)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(CASINGS))
    (STUDIES / "figures").mkdir(parents=True, exist_ok=True)
    figure.savefig(STUDIES / "figures/elastic_casing_peaks.png")
    return markdown_table(["interaction", "published (rad/s)", *map(name_of, CASINGS)], rows)


def direct_table(pool):
    """Direct contact about 1B with order 4: means over the speeds, which little moves less than single runs."""
    rows, orders = [], {one.blade: one for one in INTERACTIONS if one.engine_order == 4}
    for blade, one in orders.items():
        cells = [blade, f"{DIRECT_SHARES[0] * one.peak:.0f} to {DIRECT_SHARES[-1] * one.peak:.0f}"]
        for casing in CASINGS:
            ring = ring_of(casing)
            found = np.array(list(pool.map(run, [(blade, DIRECT, v, ring) for v in DIRECT_SHARES * one.peak])))
            diverged = int(np.isnan(found[:, 0]).sum())
            means = " / ".join(f"{1e3 * value:.3f}" for value in np.nanmean(found, axis=0)[: 3 if ring else 2])
            cells.append("all diverge" if diverged == len(found) else means + f" ({diverged} diverge)" * (diverged > 0))
        rows.append(cells)
        print(cells, flush=True)
    return markdown_table(["blade", "speeds (rad/s)", *map(name_of, CASINGS)], rows)


def diameters_table(pool):
    """Peak of Ref 1B/4 with modes up to some nodal diameters."""
    one, rows = INTERACTIONS[0], []
    speeds = round(one.peak) + ABOUT
    for casing in CASINGS[1:4]:
        cells = [name_of(casing)]
        for diameters in DIAMETERS:
            ring = ring_of(casing, diameters)
            found = np.array(list(pool.map(run, [(one.blade, LINED, v, ring) for v in speeds], chunksize=8)))
            rms = np.hypot(*found.T[:2])
            cells.append(f"{speeds[np.nanargmax(rms)]:.0f}, {1e3 * np.nanmax(rms):.2f} ({np.isnan(rms).sum()} diverge)")
        rows.append(cells)
        print(cells, flush=True)
    return markdown_table(["ring", *(f"up to {number}" for number in DIAMETERS)], rows)


def rings_table():
    """Frequencies of the rings, and how far a force pushes the wall out."""
    rows = []
    for casing in CASINGS[1:]:
        modes = [mode for mode in ring_of(casing) if mode.radial]
        given_way = sum(1.0 / mode.modal_mass / mode.frequency**2 for mode in modes)
        of = {mode.nodal_diameter: mode.frequency / 2.0 / np.pi for mode in modes}
        critical = critical_speed(ring_of(casing))
        cells = [name_of(casing), *(f"{of[n]:.0f}" for n in (0, 1, 2, 4, 8, 20)), f"{1e6 * given_way:.3f}", f"{critical:.0f}"]
        rows.append(cells)
    heads = [f"n = {n} (Hz)" for n in (0, 1, 2, 4, 8, 20)]
    return markdown_table(["casing", *heads, "static, at the force (um/N)", "lowest critical speed (rad/s)"], rows)


def meeting_table():
    """Coincidences of Ref's 1B with each ring near its interaction with order 4."""
    campbell = read_dataset(ROOT / "results/campbell.nc")
    rings = {name_of(casing): ring_of(casing) for casing in CASINGS[1:]}
    table = coincidence_table(campbell.sel(blade=["Ref"]), rings)
    near = table[(table["mode"] == "1B") & table["speed_rad_s"].between(*NEAR)]
    rows = [
        [row.scene, str(row.nodal_diameter), row.wave, f"{row.speed_rad_s:.0f}", f"{row.frequency_hz:.0f}"]
        for row in near.itertuples()
    ]
    return markdown_table(["ring", "nodal diameters", "wave", "speed (rad/s)", "in the rotor's frame (Hz)"], rows)


def cost_table():
    """Ratio of CPU times of the march, the reference blade, one after the other in one process."""
    rows = []
    for name in (LINED, DIRECT):
        for diameters in DIAMETERS[1::2]:
            ratios = [timed(name, ring_of((2e-3, STIFF), diameters), speed) for speed in GRID for _ in range(ROUNDS)]
            low, middle, high = np.percentile(ratios, [10, 50, 90])
            rows.append([name, str(diameters), f"{middle:.2f}", f"{low:.2f} to {high:.2f}"])
        print(rows[-1], flush=True)
    said = f"{len(GRID)} speeds from {GRID[0]:g} to {GRID[-1]:g} rad/s, {ROUNDS} rounds."
    return f"{markdown_table(['scene', 'nodal diameters up to', 'ratio of CPU times, median', '10% to 90%'], rows)}\n{said}\n"


def timed(name, ring, speed):
    """CPU time of the march with the ring as a multiple of that without."""
    times = []
    for modes in ((), ring):
        choice = replace(settings().integration_choice("Ref", name, speed), energy=False, snapshot_revolutions=0)
        simulation = Simulation(contact("Ref"), float(speed), with_casing(name, modes), choice)
        simulation.advance(simulation.start(), 1)
        state, begun = simulation.start(), time.process_time()
        simulation.advance(state, choice.revolutions)
        times.append(time.process_time() - begun)
    return times[1] / times[0]


if __name__ == "__main__":
    main()
