"""Tables and figure of docs/rotor.md: whole rotors of the seven blades about 1B/4 and 1B/5, from models of the default sweep.

Run: make claims ONLY=rotor. Finished rotors are kept in results/studies/rotor, and not run again.
"""

from __future__ import annotations

import json
import multiprocessing
import os
from dataclasses import replace
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import pandas as pd

from r37core.config.rotor_section import RotorSection
from r37core.dataset_file import read_dataset
from r37core.figures.style import save
from r37core.io import atomic_write, write_text
from r37core.product.reading import read_settings
from r37core.results.measures import range_above_yield
from r37core.rom.contact_model import read_contact_model
from r37core.rotors.dataset import rotor_dataset
from r37core.rotors.figures import draw_rotor
from r37core.stress.operator import read_stress_operator
from r37core.time_integration.compiled.passage import Passage
from r37core.time_integration.rotor_simulation import BladesSimulation
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import write_speed
from r37core.time_integration.speed_run import run_speed
from validation.studies.tables import markdown_table

RESULTS = Path("results")
FOLDER = RESULTS / "studies/rotor"
BLADES = ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
SCENE, ORDERS = "abradable", (4, 5)
NUMBER = 36
SHARES = np.arange(-0.06, 0.1001, 0.005)
"""Speeds, as shares of the crossing's above it."""

SEEDS = (0, 1, 2)
MISTUNINGS = (1.0, 0.2, 3.0)
"""Standard deviations (%)."""

LONGER = (2e-5, 5e-5)
LONGER_OF = ("Ref", "S100", "CS100")
"""Blades of which one is longer than the others."""

GROWTH = (1, 2, 6, 36)
GROWN = 0.9
"""Share of its largest motion that a blade has reached when it is said to be grown."""


def rotors(order):
    """Name -> section of all rotors about a crossing."""
    kinds = {"single": {"blades": 1}, "tuned": {"blades": NUMBER}}
    for percent in MISTUNINGS if order == ORDERS[0] else MISTUNINGS[:1]:
        kinds |= {f"mistuned_{percent:g}_{seed}": mistuned(percent, seed) for seed in seeds(order, percent)}
    if order == ORDERS[0]:
        kinds |= {f"apart_{seed}": {**mistuned(MISTUNINGS[0], seed), "lining": "separate"} for seed in SEEDS[:1]}
        kinds |= {f"longer_{1e6 * longer:g}": {"blades": NUMBER, "longer_m": {1: longer}} for longer in LONGER}
        kinds |= {f"blades_{number}": {"blades": number} for number in GROWTH[1:-1]}
    return kinds


def seeds(order, percent):
    """Of the samples about a crossing."""
    return SEEDS if order == ORDERS[0] and percent < MISTUNINGS[-1] else SEEDS[:2]


def mistuned(percent, seed):
    """A rotor whose blades' frequencies differ."""
    return {"blades": NUMBER, "mistuning_spread_percent": {"normal": percent}, "seed": seed}


def crossing(blade, order):
    """Speed (rad/s) at which 1B has the frequency of an engine order."""
    return float(read_dataset(RESULTS / blade / "campbell.nc")["crossing_speed"].sel(mode="1B", engine_order=order))


def run_rotor(job):
    """One blade shape, crossing and rotor at all speeds: a row for each."""
    blade, order, name = job
    file = FOLDER / f"{blade}_{order}_{name}.csv"
    if file.exists():
        return
    settings = read_settings(Path())
    scene = replace(settings.scenes[SCENE].scene, rotor=RotorSection.model_validate(rotors(order)[name]).rotor())
    model = read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
    stress = read_stress_operator(RESULTS / blade / "stress_pressure_edge.npz")
    limit, rows = settings.blades[blade].material.yield_stress, []
    for share in SHARES:
        speed = crossing(blade, order) * (1.0 + share)
        choice = settings.integration_choice(blade, SCENE, speed)
        run = run_speed(model, speed, scene, choice, ("stress",), stress=stress, spectrum_highest_order=1, wear_angles=1)
        last, motion = run["blade_max_von_mises"], run["blade_rms"]
        largest = run["blade_maximum"][scene.rotor.numbers.index(int(run["leader"]))]
        rows.append(
            {
                "speed": speed,
                "share": share,
                "stress": float(np.nanmax(last)) / limit,
                "ever": float(np.nanmax(run["revolution_von_mises"])) / limit,
                "above": int(np.sum(last > limit)),
                "motion": float(np.nanmax(motion)),
                "median_motion": float(np.median(motion)),
                "leader": int(run["leader"]),
                "grown": int(np.argmax(largest >= GROWN * np.nanmax(largest))) + 1,
                "history": json.dumps([float(f"{value:.4g}") for value in largest]),
            }
        )
    with atomic_write(file) as partial:
        pd.DataFrame(rows).to_csv(partial, index=False)
    print(job, f"{len(rows)} speeds", flush=True)


def read(blade, order, name):
    """Rows of a finished rotor."""
    return pd.read_csv(FOLDER / f"{blade}_{order}_{name}.csv")


def length(table, column="stress"):
    """Length of speed (rad/s) above yield."""
    return range_above_yield(table["speed"].values, table[column].values).length


def lengths(blade, order, kind, column="stress"):
    """Lengths (rad/s) with any blade above yield: of a rotor, or of each sample of a kind."""
    names = [name for name in rotors(order) if name == kind or name.rpartition("_")[0] == kind]
    return [length(read(blade, order, name), column) for name in names]


def span(values):
    """Lowest and highest value in words."""
    low, high = f"{min(values):.0f}", f"{max(values):.0f}"
    return low if low == high else f"{low} to {high}"


def lengths_table():
    """Length of speed with any blade above yield about 1B/4, of single blades and rotors."""
    kinds = {
        "single blade": "single",
        f"{NUMBER} equal blades": "tuned",
        "0.2%": "mistuned_0.2",
        "1%": "mistuned_1",
        "1% (first sample), a lining for each blade": "apart",
        "3%": "mistuned_3",
    }
    rows = [[blade, *(span(lengths(blade, ORDERS[0], kind)) for kind in kinds.values())] for blade in BLADES]
    return markdown_table(["rad/s above yield at 1B/4", *kinds], rows)


def worst_table():
    """At the worst speed of rotors with 1% of mistuning: stress, how many blades are above yield, and what the others do."""
    rows = []
    for order in ORDERS:
        for blade in BLADES:
            tables = [read(blade, order, f"mistuned_{MISTUNINGS[0]:g}_{seed}") for seed in seeds(order, MISTUNINGS[0])]
            worst = [table.loc[table["stress"].fillna(0.0).idxmax()] for table in tables]
            above = pd.concat(tables).query("above > 0")["above"]
            rows.append(
                [
                    f"{blade}, 1B/{order}",
                    span(lengths(blade, order, "single")),
                    span(lengths(blade, order, "tuned")),
                    span(lengths(blade, order, f"mistuned_{MISTUNINGS[0]:g}")),
                    f"{max(row['stress'] for row in worst):.1f}",
                    "none" if above.empty else f"{above.median():.0f} (1 to {above.max():.0f})",
                    f"{max(row['motion'] / max(row['median_motion'], 1e-12) for row in worst):.0f}",
                ]
            )
    heads = [
        "blade and crossing",
        "single (rad/s above yield)",
        "tuned",
        "1% of mistuning",
        "largest stress over yield",
        f"blades of {NUMBER} above yield at once, median (range)",
        "leader's motion over the median blade's",
    ]
    return markdown_table(heads, rows)


def growth_table():
    """Revolutions to full growth of equal blades at the worst speed of the single one, and of the leader of mistuned ones."""
    rows = []
    for blade in BLADES:
        single = read(blade, ORDERS[0], "single")
        worst = single["stress"].fillna(0.0).idxmax()
        names = ["single", *(f"blades_{number}" for number in GROWTH[1:-1]), "tuned"]
        cells = [f"{read(blade, ORDERS[0], name).loc[worst, 'grown']:.0f}" for name in names]
        grown = []
        for seed in SEEDS:
            table = read(blade, ORDERS[0], f"mistuned_{MISTUNINGS[0]:g}_{seed}")
            grown.append(table.loc[table["stress"].fillna(0.0).idxmax(), "grown"])
        rows.append([blade, f"{single.loc[worst, 'speed']:.0f}", *cells, span(grown)])
    heads = ["blade", "speed (rad/s)", *(f"{number} equal" for number in GROWTH), "36, 1% of mistuning"]
    return markdown_table(heads, rows)


def longer_table():
    """What one longer blade does in a rotor of equal blades."""
    rows = []
    for blade in LONGER_OF:
        cells = []
        for kind in ("tuned", *(f"longer_{1e6 * longer:g}" for longer in LONGER)):
            table = read(blade, ORDERS[0], kind)
            above = table.query("stress > 1.0")
            leads = f", blade 1 leads at {(above['leader'] == 1).sum()} of {len(above)}" if kind != "tuned" else ""
            most = f", at most {int(table['above'].max())} blades" if len(above) else ""
            cells.append(f"{length(table):.0f}{most}{leads}")
        rows.append([blade, *cells])
    heads = ["rad/s above yield at 1B/4", "equal", *(f"blade 1 longer by {1e6 * by:g} um" for by in LONGER)]
    return markdown_table(heads, rows)


def ranking_table():
    """Order of the seven blades by their length above yield, and rank correlations with that of single blades."""
    columns = {"single": "single", "tuned": "tuned"}
    columns |= {f"{percent:g}%": f"mistuned_{percent:g}" for percent in sorted(MISTUNINGS)}
    medians = pd.DataFrame(
        {head: {blade: float(np.median(lengths(blade, ORDERS[0], kind))) for blade in BLADES} for head, kind in columns.items()}
    )
    rows = []
    for head in columns:
        correlation = medians[head].corr(medians["single"], method="spearman")
        rows.append([head, ", ".join(medians[head].sort_values(kind="stable").index), f"{correlation:.2f}"])
    return markdown_table(["rotor", "fewest speeds above yield first", "rank correlation with single blades"], rows)


def one_time_grid(model, speed, scene, choice, number):
    """rms (mm, tangential) of a blade of a tuned rotor whose blades all do their steps at the same instants."""
    angles = 2.0 * np.pi * np.arange(number) / number
    blades = [Simulation(replace(model, theta=model.theta + angle), speed, scene, choice) for angle in angles]
    states, samples = [blade.start() for blade in blades], choice.revolutions * choice.samples_per_revolution
    outs, passages = [blade.room(0, samples) for blade in blades], []
    for blade, state, out in zip(blades, states, outs, strict=True):
        state.wear = states[0].wear
        passages.append(Passage(blade.engine, state, out))
    for _ in range(samples):
        for passage in passages:
            passage.go_on(1)
    return _tangential(outs[0].samples)


def _tangential(samples):
    return 1e3 * float(np.sqrt(np.mean(samples[len(samples) // 2 :, 2] ** 2)))


def steps_table():
    """A tuned rotor pass by pass, and on one time grid, on which blades meet bars as wide as a step at other places of them."""
    settings, blade, speed, rows = read_settings(Path()), "Ref", 1700.0, []
    scene, model = settings.scenes[SCENE].scene, read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
    choice = settings.integration_choice(blade, SCENE, speed)
    rotor = replace(scene, rotor=RotorSection.model_validate({"blades": NUMBER}).rotor())
    for parts in (1, 2, 4, 8):
        finer = replace(choice, time_step=choice.time_step / parts)
        alone = Simulation(model, speed, scene, finer)
        record = alone.advance(alone.start(), finer.revolutions)
        together = BladesSimulation(model, speed, rotor, finer)
        passed = together.run(together.start(), finer.revolutions)
        grid = [one_time_grid(model, speed, scene, finer, number) for number in (32, NUMBER)]
        values = [_tangential(record.samples), _tangential(passed.blades[5].samples), *grid]
        step, bars = 1e6 * alone.problem.grid.time_step, alone.problem.casing.bars
        rows.append([f"{step:.2g}", f"{bars}", *(f"{value:.4g}" for value in values)])
    columns = ["single blade", f"{NUMBER}, pass by pass", "32, one time grid", f"{NUMBER}, one time grid"]
    return markdown_table(["step (us)", "bars", *columns], rows)


def draw():
    """The rotor of Ref with 1% of mistuning, as the workflow draws it."""
    settings, blade = read_settings(Path()), BLADES[0]
    section = RotorSection.model_validate(mistuned(MISTUNINGS[0], SEEDS[0]))
    scene = replace(settings.scenes[SCENE].scene, rotor=section.rotor())
    model = read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
    stress = read_stress_operator(RESULTS / blade / "stress_pressure_edge.npz")
    files, speeds = [], [float(speed) for speed in crossing(blade, ORDERS[0]) * (1.0 + SHARES)]
    for number, speed in enumerate(speeds):
        choice = settings.integration_choice(blade, SCENE, speed)
        run = run_speed(model, speed, scene, choice, ("stress", "wear"), stress=stress, spectrum_highest_order=1, wear_angles=1)
        files.append(FOLDER / f"speed_{number}.npz")
        write_speed(run, files[-1], {})
    dataset = rotor_dataset(files, speeds, settings.blades[blade].material.yield_stress)
    save(draw_rotor(dataset, f"{blade}, 1% of mistuning"), FOLDER / "rotor.png")


TABLES = {
    "lengths": lengths_table,
    "worst": worst_table,
    "growth": growth_table,
    "longer": longer_table,
    "ranking": ranking_table,
    "steps": steps_table,
}

if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    jobs = [
        (blade, order, name)
        for order in ORDERS
        for name in rotors(order)
        for blade in (LONGER_OF if name.startswith("longer") else BLADES)
    ]
    with multiprocessing.get_context("spawn").Pool(int(os.environ.get("CORES", "2"))) as pool:
        for _ in pool.imap_unordered(run_rotor, jobs, chunksize=1):
            pass
    for name, table in TABLES.items():
        write_text(table(), RESULTS / f"studies/rotor_{name}.md")
    draw()
