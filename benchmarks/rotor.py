"""Tables and figure of docs/rotor.md: whole rotors of the seven blades about 1B/4 and 1B/5, from models of the default sweep.

Run: make claims ONLY=rotor. Finished rotors are kept in results/studies/rotor, and not run again.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import sys
from dataclasses import replace
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import pandas as pd

from r37core.config.rotor_section import RotorSection
from r37core.dataset_file import read_dataset
from r37core.io import atomic_write
from r37core.product.reading import read_settings
from r37core.results.measures import range_above_yield
from r37core.rom.contact_model import read_contact_model
from r37core.stress.operator import read_stress_operator
from r37core.time_integration.speed_run import run_speed

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
GROWTH = (1, 2, 6, 36)
GROWN = 0.9
"""Share of its largest motion that a blade has reached when it is said to be grown."""


def rotors(order):
    """Name -> section of all rotors about a crossing; None is a single blade."""
    kinds = {"single": None, "tuned": {"blades": NUMBER}}
    for percent in MISTUNINGS if order == ORDERS[0] else MISTUNINGS[:1]:
        kinds |= {f"mistuned_{percent:g}_{seed}": mistuned(percent, seed) for seed in SEEDS}
    if order == ORDERS[0]:
        kinds |= {f"apart_{seed}": {**mistuned(MISTUNINGS[0], seed), "lining": "separate"} for seed in SEEDS}
        kinds |= {f"blades_{number}": {"blades": number} for number in GROWTH[1:-1]}
        kinds |= {f"longer_{1e6 * longer:g}": {"blades": NUMBER, "longer_m": {1: longer}} for longer in LONGER}
    return kinds


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
    scene, section = settings.scenes[SCENE].scene, rotors(order)[name]
    if section is not None:
        scene = replace(scene, rotor=RotorSection.model_validate(section).rotor())
    model = read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
    stress = read_stress_operator(RESULTS / blade / "stress_pressure_edge.npz")
    limit, rows = settings.blades[blade].material.yield_stress, []
    for share in SHARES:
        speed = crossing(blade, order) * (1.0 + share)
        choice = settings.integration_choice(blade, SCENE, speed)
        run = run_speed(model, speed, scene, choice, ("stress",), stress=stress, spectrum_highest_order=1, wear_angles=1)
        maxima = run["blade_maximum"] if section else run["revolution_maxima"][None, :, 0, 0]
        last = run["blade_max_von_mises"] if section else np.array([float(run["max_von_mises"])])
        rms = run["blade_rms"] if section else run["rms"][:1, 0]
        largest = maxima[int(np.nan_to_num(rms).argmax())]
        rows.append(
            {
                "speed": speed,
                "share": share,
                "stress": float(np.nanmax(last)) / limit,
                "ever": float(np.nanmax(run["revolution_von_mises"])) / limit,
                "above": int(np.sum(last > limit)),
                "rms": float(np.nanmax(rms)),
                "median_rms": float(np.median(rms)),
                "leader": int(run["leader"]) if section else 1,
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


if __name__ == "__main__":
    FOLDER.mkdir(parents=True, exist_ok=True)
    orders = ORDERS[:1] if "first" in sys.argv else ORDERS
    jobs = [(blade, order, name) for order in orders for name in rotors(order) for blade in BLADES]
    with multiprocessing.get_context("spawn").Pool(int(os.environ.get("CORES", "2"))) as pool:
        for _ in pool.imap_unordered(run_rotor, jobs, chunksize=1):
            pass
