"""What a flexible casing changes for the seven blades, and what it costs: tables of docs/elastic_casing.md.

Run: make claims ONLY=elastic_casing (a quarter of an hour on two idle cores). The script takes names of TABLES, for those
alone, and `span=30` for narrower windows. The scenes are elastic_abradable and elastic_direct of config/scenes.yaml, with
rings of several thicknesses, and without.
"""

import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.config import command_line_document
from r37core.config.declaring import in_si
from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.ring import Ring
from r37core.figures.style import PAGE, plt
from r37core.io import write_text
from r37core.product.reading import read_settings
from validation.published import INTERACTIONS
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from validation.studies.tables import markdown_table
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parents[2]
STUDIES = ROOT / "results/studies"
LINED, DIRECT = "elastic_abradable", "elastic_direct"
STIFF, SOFT = 1e9, 1e7
"""Of the flanges, radially and along the tangent (N/m2)."""

CASINGS = (None, *((thickness, foundation) for foundation in (STIFF, SOFT) for thickness in (4e-3, 2e-3, 1e-3)))
"""Thickness of the ring (m) and its flanges; None is rigid."""

KEPT = {"spectrum_highest_order": 20, "wear_angles": 8}
SPAN, STEP = 60.0, 2.0
"""Speeds, in rad/s, about a published peak, and from one to the next."""

DIRECT_SHARES = np.linspace(0.98, 1.06, 9)
"""Of the published peak of 1B with order 4."""

BESIDE = 10.0
"""Speeds, in rad/s, on either side of a peak of which none may diverge."""

DIAMETERS = (5, 10, 15, 20, 40)
GRID, ROUNDS = np.arange(800.0, 2000.0, 100.0), 3


def main(words):
    """Words of the command line: names of TABLES, and span=... (rad/s) about the published peaks."""
    spans = [float(word.removeprefix("span=")) for word in words if word.startswith("span=")]
    names, span = [word for word in words if word in TABLES], spans[0] if spans else SPAN
    with ProcessPoolExecutor(2) as pool:
        for name in names or TABLES:
            write_text(TABLES[name](pool, span), STUDIES / f"elastic_casing_{name}.md")


@cache
def settings():
    return read_settings(ROOT, command_line_document({"scenes": [LINED, DIRECT]}))


@cache
def contact(blade):
    model = read_reduced_model(ROOT / f"results/{blade}/rom_pressure_edge.nc")
    return contact_model(model, settings().structure.boundary.tip_line)


def casing_of(casing, diameters=20):
    """The shipped ring with another thickness and other flanges, and modes up to some nodal diameters."""
    thickness, stiffness = casing
    shipped = in_si(Ring, settings().scene_entries[LINED].casing.ring)
    other = {"thickness": thickness, "radial_foundation": stiffness, "tangential_foundation": stiffness}
    ring = replace(shipped, **other, highest_nodal_diameter=diameters)
    return ElasticCasing(ring.modes(), ring)


def ring_of(casing, diameters=20):
    """Modes of `casing_of`; none of a rigid casing."""
    return () if casing is None else casing_of(casing, diameters).modes


def with_casing(name, ring):
    scene = settings().scenes[name].scene
    return replace(scene, casing=replace(scene.casing, ring=ring))


def name_of(casing):
    return "rigid" if casing is None else f"{1e3 * casing[0]:g} mm, {'stiff' if casing[1] == STIFF else 'soft'}"


def run(task):
    """Rms (m) of the leading edge, normal and tangential, and of all waves round the casing (m)."""
    blade, name, speed, ring = task
    return integrated(blade, speed, settings().integration_choice(blade, name, speed), with_casing(name, ring))


def integrated(blade, speed, choice, scene):
    """What `run` returns, of a scene with or without a ring."""
    ring, choice = scene.casing.ring, replace(choice, snapshot_revolutions=0)
    result = run_speed(contact(blade), float(speed), scene, choice, ["casing"] if ring else [], **KEPT)
    waves = np.sum(result["casing_rms_forward"] ** 2 + result["casing_rms_backward"] ** 2) if ring else 0.0
    return *result["rms"][0, [0, 2]], np.sqrt(waves)


def about(row, span):
    """Speeds (rad/s) about a published interaction."""
    return round(row.peak) + np.arange(-span, span + 0.5 * STEP, STEP)


def clear_peak(speeds, rms):
    """Index of the largest rms over ascending speeds; None where it is no peak, for runs beside it diverge (NaN).

    Beside it: as far as BESIDE on either side, and further down to half its power.
    """
    if np.isnan(rms).all():
        return None
    peak = int(np.nanargmax(rms))
    near = np.abs(speeds - speeds[peak]) <= BESIDE
    low = np.flatnonzero(rms < rms[peak] / np.sqrt(2.0))
    first, last = low[low < peak].max(initial=-1), low[low > peak].min(initial=len(rms))
    near[first + 1 : last] = True
    return None if np.isnan(rms[near]).any() else peak


def peak_cell(speeds, rms):
    """Speed (rad/s) and height (mm) of the peak, where there is one, and how many runs diverge."""
    peak, diverged = clear_peak(speeds, rms), int(np.isnan(rms).sum())
    cell = "no peak" if peak is None else f"{speeds[peak]:.0f}, {1e3 * rms[peak]:.2f}"
    at_end = peak in (0, len(speeds) - 1)
    return cell + " at the end" * at_end + f" ({diverged} diverge)" * (diverged > 0)


def peaks_table(pool, span):
    """Peaks of the ten published interactions; draws those of order 4, too."""
    rows = []
    figure, panels = plt.subplots(1, 7, figsize=(PAGE, 1.9), sharey=True)
    axes_of = iter(panels)
    for row in INTERACTIONS:
        speeds = about(row, span)
        cells = [f"{row.blade} 1B/{row.engine_order}", f"{row.peak:g}"]
        axes = next(axes_of) if row.engine_order == 4 else None
        for casing in CASINGS:
            ring = ring_of(casing)
            runs = np.array(list(pool.map(run, [(row.blade, LINED, v, ring) for v in speeds], chunksize=8)))
            rms = np.hypot(*runs.T[:2])
            cells.append(peak_cell(speeds, rms))
            if axes:
                (line,) = axes.plot(speeds, 1e3 * rms, label=name_of(casing), linewidth=0.8)
                mark_diverged(axes, speeds, rms, CASINGS.index(casing), line.get_color())
                axes.set(title=row.blade, xlabel="rad/s")
        rows.append(cells)
        print(cells, flush=True)
    panels[0].set_ylabel("rms (mm)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(CASINGS))
    (STUDIES / "figures").mkdir(parents=True, exist_ok=True)
    figure.savefig(STUDIES / "figures/elastic_casing_peaks.png")
    note = f"Level `{settings().fidelity_name}`, every {STEP:g} rad/s within {span:g} of the published peak."
    return f"{markdown_table(['interaction', 'published (rad/s)', *map(name_of, CASINGS)], rows)}\n{note}\n"


def mark_diverged(axes, speeds, rms, row, colour):
    """Dots below the curves at speeds of runs that diverge, a row of them for each casing."""
    at = speeds[np.isnan(rms)]
    axes.plot(at, np.full(len(at), -0.6 * row), ".", color=colour, markersize=1.5)


def direct_table(pool, _):
    """Direct contact about 1B with order 4: means over the speeds, which move less than single runs."""
    rows, orders = [], {row.blade: row for row in INTERACTIONS if row.engine_order == 4}
    for blade, row in orders.items():
        cells = [blade, f"{DIRECT_SHARES[0] * row.peak:.0f} to {DIRECT_SHARES[-1] * row.peak:.0f}"]
        for casing in CASINGS:
            ring = ring_of(casing)
            runs = np.array(list(pool.map(run, [(blade, DIRECT, v, ring) for v in DIRECT_SHARES * row.peak])))
            diverged = int(np.isnan(runs[:, 0]).sum())
            means = " / ".join(f"{1e3 * value:.3f}" for value in np.nanmean(runs, axis=0)[: 3 if ring else 2])
            cells.append("all diverge" if diverged == len(runs) else means + f" ({diverged} diverge)" * (diverged > 0))
        rows.append(cells)
        print(cells, flush=True)
    return markdown_table(["blade", "speeds (rad/s)", *map(name_of, CASINGS)], rows)


def diameters_table(pool, span):
    """Peak of Ref 1B/4 with modes up to some nodal diameters."""
    row, rows = INTERACTIONS[0], []
    speeds = about(row, span)
    for casing in CASINGS[1:4]:
        cells = [name_of(casing)]
        for diameters in DIAMETERS:
            ring = ring_of(casing, diameters)
            runs = np.array(list(pool.map(run, [(row.blade, LINED, v, ring) for v in speeds], chunksize=8)))
            rms = np.hypot(*runs.T[:2])
            cells.append(peak_cell(speeds, rms))
        rows.append(cells)
        print(cells, flush=True)
    note = f"Level `{settings().fidelity_name}`, every {STEP:g} rad/s within {span:g} of the published peak."
    return f"{markdown_table(['ring', *(f'up to {number}' for number in DIAMETERS)], rows)}\n{note}\n"


def cost_table(*_):
    """Ratio of CPU times of the time integration, the reference blade, one after the other in one process."""
    rows = []
    for name in (LINED, DIRECT):
        for diameters in DIAMETERS[1::2]:
            ratios = [timed(name, ring_of((2e-3, STIFF), diameters), speed) for speed in GRID for _ in range(ROUNDS)]
            low, middle, high = np.percentile(ratios, [10, 50, 90])
            rows.append([name, str(diameters), f"{middle:.2f}", f"{low:.2f} to {high:.2f}"])
        print(rows[-1], flush=True)
    note = f"{len(GRID)} speeds from {GRID[0]:g} to {GRID[-1]:g} rad/s, {ROUNDS} rounds."
    return f"{markdown_table(['scene', 'nodal diameters up to', 'ratio of CPU times, median', '10% to 90%'], rows)}\n{note}\n"


def timed(name, ring, speed):
    """CPU time of the time integration with the ring as a multiple of that without."""
    times = []
    for modes in ((), ring):
        choice = replace(settings().integration_choice("Ref", name, speed), snapshot_revolutions=0)
        simulation = Simulation(contact("Ref"), float(speed), with_casing(name, modes), choice)
        simulation.advance(simulation.start(), 1)
        state, begun = simulation.start(), time.process_time()
        simulation.advance(state, choice.revolutions)
        times.append(time.process_time() - begun)
    return times[1] / times[0]


TABLES = {"peaks": peaks_table, "direct": direct_table, "diameters": diameters_table, "cost": cost_table}

if __name__ == "__main__":
    main(sys.argv[1:])
