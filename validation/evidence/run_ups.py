"""Run-ups of the seven blades through 1B with engine order 4: the rate that each needs, and what decides it."""

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.config.document import read_document
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.run_ups import choice as run_up_choice
from r37core.run_ups.choice import RunUp, RunUpChoice
from r37core.run_ups.integration import RunUpIntegration
from r37core.run_ups.plan import RunUps
from r37core.run_ups.revolutions import record_run_up
from r37core.run_ups.tables import safe_rates
from r37core.stress.recovery import stress_operator
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE
from r37core.time_integration.simulate import Simulation

from .configuration import settings_of
from .pages import write_table

SCENE, MODE, ORDER = "abradable", "1B", 4
SHOWN = (100, 1000)
SEGMENT_RATES = (30.0, 100.0, 300.0, 1000.0)
FINEST = (2e-6, 1e-3)
"""Lead (rad) and stiffening that the others are compared with."""

TRIED = ((2e-6, 1e-2), (2e-6, 5e-2), (2e-4, 5e-2), (1e-3, 5e-2), (4e-3, 5e-2))
VARIED = "up_1000"
"""The run-up of config/run_ups.yaml that is varied; its rate is one of RATES."""

BLADES = ("Ref", "S100", "CS50")
RATES = (200.0, 300.0, 450.0, 700.0, 1000.0, 1500.0, 2200.0, 3200.0, 4600.0, 7000.0)
VARIANTS: dict[str, dict[str, Any]] = {
    "default": {},
    "half the step": {"time_step": 0.5},
    "the published scheme and step": {"published": True},
    "friction against rotation and vibration": {"vector": True},
    "begun 1% below the crossing": {"start": -0.01},
    "begun 0.5% below the crossing": {"start": -0.005},
    "ended 6% above the crossing": {"stop": 0.06},
    "twice the revolutions before": {"before": 400},
    "lining worn by the same run-up": {"worn": True},
}
FROM, TO, BEFORE, AFTER, ROUNDS = 1644.0, 1786.0, 200, 50, 3
"""Speeds (rad/s) and revolutions of the run-ups whose time is measured."""


def _crossing(campbell: xr.Dataset, blade: str) -> float:
    return float(campbell["crossing_speed"].sel(blade=blade, mode=MODE, engine_order=ORDER))


def rates(input: Any, output: Any, params: Any) -> None:
    """Table of the blades in the order of the rate that they need upwards. Inputs: campbell, summary, run_ups, rates."""
    campbell = read_dataset(input.campbell)
    summary = pd.read_csv(input.summary).query("scene == @SCENE and mode == @MODE and engine_order == @ORDER")
    runs, needed = (pd.read_csv(file).query("scene == @SCENE") for file in (input.run_ups, input.rates))
    slowest, rows = float(needed["slowest_rate_rad_s2"].min()), []
    for blade, resolved in runs.groupby("blade", sort=False):
        share = resolved["largest_stress_pa"] / resolved["yield_stress_pa"]
        upwards = resolved["direction"] == "up"
        # whole samples make rates that are nearly those asked for
        stress = [float(share[upwards & np.isclose(resolved["rate_rad_s2"], rate, rtol=1e-3)].max()) for rate in SHOWN]
        safe = needed[needed["blade"] == blade].set_index("direction")["rate_at_yield_rad_s2"]
        width = float(summary[summary["blade"] == blade]["length_ever_rad_s"].max())
        rows.append((blade, _crossing(campbell, blade), width, *stress, float(safe["up"]), float(safe["down"])))
    rows.sort(key=lambda row: -np.nan_to_num(row[-2]))
    head = [
        "blade",
        "crossing (rad/s)",
        "width above yield, constant speed (rad/s)",
        *(f"stress / yield at {rate}" for rate in SHOWN),
    ]
    cells = [
        [
            blade,
            f"{crossing:.0f}",
            f"{width:.0f}",
            *(f"{value:.2f}" for value in rest[:2]),
            *(_rate(v, slowest) for v in rest[2:]),
        ]
        for blade, crossing, width, *rest in rows
    ]
    write_table([*head, "up: below yield from (rad/s²)", "down: below yield from (rad/s²)"], cells, output.table)


def _rate(rate: float, slowest: float) -> str:
    return f"{float(f'{rate:.2g}'):g}" if np.isfinite(rate) else f"{slowest:g} or less"


def segments(input: Any, output: Any, params: Any) -> None:
    """Table of the error of constant-speed segments and modal intervals of several lengths. Inputs: campbell, contact."""
    settings, model = settings_of(Path.cwd()), read_contact_model(input.contact)
    scene, choice = settings.scenes[SCENE], settings.integration_choice("Ref", SCENE, 0.0)
    speed = _crossing(read_dataset(input.campbell), "Ref")

    def rms(rate: float, lead: float, stiffening: float) -> np.ndarray:
        run_up_choice.LARGEST_LEAD, run_up_choice.LARGEST_STIFFENING = lead, stiffening
        choice_of_rate = RunUpChoice(0.98 * speed, 1.012 * speed, None, rate, None, choice.revolutions, 0, worn=False)
        integration = RunUpIntegration(model, scene.scene, choice, choice_of_rate.run_up(choice.samples_per_revolution))
        result = record_run_up(integration, (), highest_order=20, stress=None, yield_stress=np.inf)
        return result["rms"][choice.revolutions :, 0, [0, 2]]

    finest = {rate: rms(rate, *FINEST) for rate in SEGMENT_RATES}
    rows = [
        [
            f"{lead:g}",
            f"{100 * stiffening:g}%",
            *(
                f"{100 * float((np.abs(rms(r, lead, stiffening) - best) / best.max(axis=0)).max()):.3f}%"
                for r, best in finest.items()
            ),
        ]
        for lead, stiffening in TRIED
    ]
    write_table(["lead (rad)", "stiffening", *(f"{rate:g} rad/s²" for rate in SEGMENT_RATES)], rows, output.table)


def variants(input: Any, output: Any, params: Any) -> None:
    """Table of the rates that three blades need upwards when one thing is varied. Inputs: campbell, contacts, models."""
    plan = RunUps(Sweep(read_settings(Path.cwd(), read_document(Path.cwd(), "config/run_ups.yaml"))))
    campbell = read_dataset(input.campbell)
    files = dict(zip(BLADES, zip(input.contacts, input.models, strict=True), strict=True))
    rows = [
        [name, *(_needed_rate(blade, files[blade], plan, campbell, changes) for blade in BLADES)]
        for name, changes in VARIANTS.items()
    ]
    write_table(["rate needed upwards (rad/s²)", *BLADES], rows, output.table)


def _needed_rate(blade: str, files: tuple[str, str], plan: RunUps, campbell: xr.Dataset, changes: dict[str, Any]) -> str:
    """Rate (rad/s2) that a blade needs upwards, interpolated between RATES; a bound where it is outside of them."""
    settings = plan.sweep.settings
    scene, material = settings.scenes[SCENE].scene, settings.blades[blade].material
    choice_of_run_up = plan.choices[blade, SCENE][VARIED]
    own = {name: value for name, value in changes.items() if hasattr(choice_of_run_up, name)}
    choice_of_run_up = replace(choice_of_run_up, **own)
    choice = plan.integration_choice(blade, SCENE, VARIED)
    choice = replace(choice, revolutions=choice_of_run_up.before, snapshot_revolutions=choice_of_run_up.before)
    if "time_step" in changes:
        choice = replace(choice, time_step=changes["time_step"] * choice.time_step)
    if "published" in changes:
        choice = replace(choice, time_step=1e-7, integrator=CENTRAL_DIFFERENCE, shorten=False)
    if "vector" in changes:
        scene = replace(scene, friction=replace(scene.friction, vector=True))
    model, recovery = read_contact_model(files[0]), stress_operator(read_reduced_model(files[1]), material)
    rows = []
    for rate in RATES:
        run_up = replace(choice_of_run_up, rate=rate).blade_run_up(
            choice.samples_per_revolution, campbell.sel(blade=blade), VARIED
        )
        integration = RunUpIntegration(model, scene, choice, run_up)
        result = record_run_up(integration, (), highest_order=20, stress=recovery, yield_stress=material.yield_stress)
        stress = float(result["max_von_mises"][choice_of_run_up.before :].max())
        rows.append({"rate_rad_s2": rate, "largest_stress_pa": stress, "status": "completed"})
    safe = safe_rates(pd.DataFrame(rows).assign(yield_stress_pa=material.yield_stress))
    if np.isfinite(safe["rate_at_yield_rad_s2"]):
        return f"{safe['rate_at_yield_rad_s2']:.0f}"
    return f"below {RATES[0]:g}" if np.isfinite(safe["lowest_safe_rate_rad_s2"]) else f"above {RATES[-1]:g}"


def cost(input: Any, output: Any, params: Any) -> None:
    """Table of the CPU time per step of run-ups of Ref and of runs at their mean speed, in turns. Input: contact."""
    settings, model, rows = settings_of(Path.cwd()), read_contact_model(input.contact), []
    for shown, scene in (("abradable lining", "abradable"), ("bare casing", "direct")):
        for rate in (SEGMENT_RATES[0], SEGMENT_RATES[-1]):
            choice = settings.integration_choice("Ref", scene, FROM)
            run_up = RunUp(FROM, TO, (TO**2 - FROM**2) / (4.0 * np.pi * rate), BEFORE, AFTER, False)
            lasting = round(run_up.revolutions) + BEFORE + AFTER
            constant = replace(choice, revolutions=lasting)

            def changing(scene=settings.scenes[scene].scene, choice=choice, run_up=run_up) -> int:
                integration = RunUpIntegration(model, scene, choice, run_up)
                for _ in integration.segments():
                    pass
                return integration.state.totals["steps"]

            def holding(scene=settings.scenes[scene].scene, choice=constant, lasting=lasting) -> int:
                simulation = Simulation(model, 0.5 * (FROM + TO), scene, choice)
                state = simulation.start()
                simulation.advance(state, lasting)
                return state.totals["steps"]

            changing(), holding()
            times = np.array([[_per_step(changing), _per_step(holding)] for _ in range(ROUNDS)])
            ratio = np.median(times[:, 0] / times[:, 1])
            rows.append([shown, f"{rate:g}", *(f"{1e9 * value:.0f}" for value in np.median(times, axis=0)), f"{ratio:.2f}"])
    head = ["scene", "rate (rad/s²)", "CPU time per step (ns)", "at constant speed (ns)", "ratio"]
    write_table(head, rows, output.table)


def _per_step(integrate: Callable[[], int]) -> float:
    began = time.process_time()
    steps = integrate()
    return (time.process_time() - began) / steps
