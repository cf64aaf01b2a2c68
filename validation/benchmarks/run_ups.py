"""Tables of docs/run_ups.md and docs/accuracy.md, from finished results of the default sweep and of config/run_ups.yaml.

Run: make claims ONLY=run_ups.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from r37core.config.document import read_document
from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.run_ups import schedule
from r37core.run_ups.choice import RunUpChoice
from r37core.run_ups.integration import RunUpIntegration
from r37core.run_ups.revolutions import record_run_up
from r37core.run_ups.tables import safe_rates
from r37core.stress.recovery import stress_operator
from validation.studies.tables import markdown_table
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE

RESULTS = Path("results")
SCENE, MODE, ORDER = "abradable", "1B", 4
SHOWN_RATES = (100, 300, 1000)
ACCURACY_BLADE, ACCURACY_RATES = "Ref", (30.0, 100.0, 300.0, 1000.0)
FINEST = (2e-6, 1e-3)
"""Lead (rad) and stiffening that the others are compared with."""

VARIED = "up_1000"
"""Of config/run_ups.yaml: what of it is varied, and its rate, is below."""

RATES = (200.0, 300.0, 450.0, 700.0, 1000.0, 1500.0, 2200.0, 3200.0, 4600.0, 7000.0)
VARIANTS = {
    "shipped": {},
    "half the step": {"time_step": 0.5},
    "the published scheme and step": {"published": True},
    "friction of constant direction": {"constant": True},
    "begun 1% below the crossing": {"start": -0.01},
    "begun 0.5% below it": {"start": -0.005},
    "ended 6% above it": {"stop": 0.06},
    "twice the revolutions before": {"before": 400},
    "lining worn by the same run-up": {"worn": True},
}
TRIED = ((2e-6, 1e-2), (2e-6, 5e-2), (2e-4, 5e-2), (1e-3, 5e-2), (4e-3, 5e-2))


def rates_table():
    """Blades in the order of the rate that they need on the way up, with the width of the interaction beside it."""
    campbell = read_dataset(RESULTS / "campbell.nc")
    summary = pd.read_csv(RESULTS / "summary.csv").query("scene == @SCENE and mode == @MODE and engine_order == @ORDER")
    runs, rates = (pd.read_csv(RESULTS / f"{name}.csv").query("scene == @SCENE") for name in ("run_ups", "run_up_rates"))
    rows = []
    for blade in dict.fromkeys(runs["blade"]):
        of_blade = runs[runs["blade"] == blade]
        share = of_blade["max_von_mises_pa"] / of_blade["yield_stress_pa"]
        row = {
            "blade": blade,
            "crossing (rad/s)": f"{float(campbell['crossing_speed'].sel(blade=blade, mode=MODE, engine_order=ORDER)):.0f}",
            "width": float(summary[summary["blade"] == blade]["width_above_yield_rad_s"].max()),
        }
        for direction in ("up", "down"):
            going = of_blade["direction"] == direction
            for rate in SHOWN_RATES:
                # whole samples make rates that are nearly those asked for
                near = np.isclose(of_blade["rate_rad_s2"], rate, rtol=1e-3)
                row[f"{direction} at {rate}"] = f"{float(share[going & near].max()):.2f}"
            needed = rates[(rates["blade"] == blade) & (rates["direction"] == direction)].iloc[0]
            row[direction] = float(needed["rate_at_yield_rad_s2"])
        rows.append(row)
    table = pd.DataFrame(rows)
    correlation = table["width"].corr(table["up"].fillna(0.0), method="spearman")
    slowest = float(rates["slowest_rate_rad_s2"].min())
    table = table.sort_values("up", ascending=False)
    for direction in ("up", "down"):
        passed = table.pop(direction)
        table[f"{direction}: below yield from (rad/s2)"] = [
            f"{float(f'{rate:.2g}'):g}" if np.isfinite(rate) else f"{slowest:g} or less" for rate in passed
        ]
    widths = table.pop("width")
    table.insert(2, "width above yield at constant speed (rad/s)", [f"{width:.0f}" for width in widths])
    explanation = (
        f"Columns with a rate (rad/s2): largest stress of the run-up as a share of yield. Rank correlation (Spearman) of the "
        f"width with the rate that is needed upwards: {correlation:.2f}."
    )
    return f"{markdown_table(list(table), table.values.tolist())}\n{explanation}\n"


def accuracy_table():
    """Error of constant-speed segments and modal intervals of other lengths, of one blade's way up the rising branch."""
    settings = read_settings(Path())
    scene, model = settings.scenes[SCENE], read_contact_model(RESULTS / ACCURACY_BLADE / "contact_pressure_edge.npz")
    choice = settings.integration_choice(ACCURACY_BLADE, SCENE, 0.0)
    speed = float(read_dataset(RESULTS / ACCURACY_BLADE / "campbell.nc")["crossing_speed"].sel(mode=MODE, engine_order=ORDER))
    errors = {tried: [] for tried in TRIED}

    def rms(rate, lead, stiffening):
        schedule.LARGEST_LEAD, schedule.LARGEST_STIFFENING = lead, stiffening
        choice_of_rate = RunUpChoice(0.98 * speed, 1.012 * speed, None, rate, None, choice.revolutions, 0, worn=False)
        run_up = choice_of_rate.run_up(choice.samples_per_revolution)
        integration = RunUpIntegration(model, scene.scene, choice, run_up)
        result = record_run_up(integration, (), highest_order=20, stress=None, yield_stress=np.inf)
        return result["rms"][choice.revolutions :, 0, [0, 2]]

    for rate in ACCURACY_RATES:
        finest = rms(rate, *FINEST)
        for tried in TRIED:
            errors[tried].append(float((np.abs(rms(rate, *tried) - finest) / finest.max(axis=0)).max()))
    rows = [
        {"lead (rad)": f"{lead:g}", "stiffening": f"{100 * stiffening:g}%"}
        | {
            f"{rate:g} rad/s2": f"{100 * error:.3f}%"
            for rate, error in zip(ACCURACY_RATES, errors[lead, stiffening], strict=True)
        }
        for lead, stiffening in TRIED
    ]
    return markdown_table(list(rows[0]), [list(row.values()) for row in rows])


def needed_rate(blade, settings, campbell, changes):
    """Rate (rad/s2) that a blade needs upwards, interpolated between RATES; text where it is none of them."""
    scene, material = settings.scenes[SCENE].scene, settings.blades[blade].material
    run_up_choice = settings.run_ups[blade, SCENE][VARIED]
    run_up_choice = replace(run_up_choice, **{name: value for name, value in changes.items() if hasattr(run_up_choice, name)})
    choice = settings.run_up_choice(blade, SCENE, VARIED)
    choice = replace(choice, revolutions=run_up_choice.before, snapshot_revolutions=run_up_choice.before)
    if "time_step" in changes:
        choice = replace(choice, time_step=changes["time_step"] * choice.time_step)
    if "published" in changes:
        choice = replace(choice, time_step=1e-7, integrator=CENTRAL_DIFFERENCE, shorten=False)
    if "constant" in changes:
        scene = replace(scene, friction=replace(scene.friction, vector=False))
    recovery = stress_operator(read_reduced_model(RESULTS / blade / "rom_pressure_edge.nc"), material)
    model = read_contact_model(RESULTS / blade / "contact_pressure_edge.npz")
    rows = []
    for rate in RATES:
        run_up = replace(run_up_choice, rate=rate).of_blade(choice.samples_per_revolution, campbell.sel(blade=blade), VARIED)
        integration = RunUpIntegration(model, scene, choice, run_up)
        result = record_run_up(integration, (), highest_order=20, stress=recovery, yield_stress=material.yield_stress)
        stress = float(result["max_von_mises"][run_up_choice.before :].max())
        rows.append({"rate_rad_s2": rate, "max_von_mises_pa": stress, "status": "completed"})
    safe = safe_rates(pd.DataFrame(rows).assign(yield_stress_pa=material.yield_stress))
    if np.isfinite(safe["rate_at_yield_rad_s2"]):
        return f"{safe['rate_at_yield_rad_s2']:.0f}"
    return f"below {RATES[0]:g}" if np.isfinite(safe["lowest_safe_rate_rad_s2"]) else f"above {RATES[-1]:g}"


def variants_table():
    """Rates that the blades need upwards when one thing is varied."""
    settings = read_settings(Path(), read_document(Path(), "config/run_ups.yaml"))
    campbell = read_dataset(RESULTS / "campbell.nc")
    blades = list(settings.blades)
    rows = [
        [name, *(needed_rate(blade, settings, campbell, changes) for blade in blades)] for name, changes in VARIANTS.items()
    ]
    return markdown_table(["rate needed upwards (rad/s2)", *blades], rows)


if __name__ == "__main__":
    write_text(variants_table(), RESULTS / "studies/run_up_variants.md")
    write_text(rates_table(), RESULTS / "studies/run_up_rates.md")
    write_text(accuracy_table(), RESULTS / "studies/run_up_accuracy.md")
