"""Rotors against a single blade: speeds above yield, and how many blades are above it at once."""

from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.figures.style import plt
from r37core.results.danger import ratio_to_yield
from r37core.results.exceedance import length_of, ranges_above
from r37core.results.regions import read_judged
from r37core.time_integration.status import RunStatus

from .tables import write_table

BLADES = ("Ref", "CS100")
"""Blades of the rotors: without sweep, and with most speeds above yield on a lining."""

SINGLE = "single"
KINDS = {
    "equal": "36 equal blades",
    "mistuned_1": "1% of mistuning, seed 0",
    "mistuned_1_other": "1% of mistuning, seed 1",
    "mistuned_1_third": "1% of mistuning, seed 2",
}
"""Rotors of validation/decisions.yaml."""

COLUMNS = ("blade", "rotor", "above yield (rad/s)", "first, last (rad/s)", "largest stress / yield", "most blades at once")


def kinds(input: Any, output: Any, params: Any) -> None:
    """Speeds above yield of a single blade and of rotors of it. Inputs: files of BLADES by scene. Outputs: table, picture."""
    rows = []
    figure, panels = plt.subplots(len(BLADES), 1, figsize=(5.2, 5.4), layout="constrained")
    for place, (blade, axes) in enumerate(zip(BLADES, panels, strict=True)):
        single = ratio_to_yield(read_judged(input[SINGLE][place]))
        rows.append([blade, "a single blade", *_cells(single), "1"])
        axes.plot(single["speed"], single, "o-", color="black", markersize=3, label="a single blade")
        for kind, words in KINDS.items():
            rotor = read_dataset(input[kind][place])
            worst, most = _worst(rotor), rotor["blades_ever_above_yield"].max() * rotor.sizes["blade_number"]
            rows.append([blade, words, *_cells(worst), f"{float(most):.0f}"])
            axes.plot(worst["speed"], worst, ".-", markersize=4, linewidth=1.0, label=f"worst of {words}")
        axes.axhline(1.0, color="0.3", linewidth=0.9, linestyle="--", label="yield")
        axes.set(title=blade, ylabel="largest stress / yield")
    panels[-1].set_xlabel(style.SPEED_LABEL)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    style.save(figure, output.picture)
    write_table(list(COLUMNS), rows, output.table)


def _worst(rotor: xr.Dataset) -> xr.DataArray:
    """Largest stress of any blade over yield at each speed; infinite where the run diverged."""
    worst = rotor["blade_max_von_mises_ever"].max("blade_number") / rotor["yield_stress"]
    return worst.where(rotor["status"] != RunStatus.DIVERGED, np.inf)


def _cells(ratio: xr.DataArray) -> list[str]:
    """Length above yield, its first and last speed (rad/s), and the largest ratio."""
    ranges = ranges_above(ratio["speed"].values, ratio.values, 1.0)
    ends = f"{ranges[0].begin:.0f}, {ranges[-1].end:.0f}" if ranges else "-"
    return [f"{length_of(ranges):.0f}", ends, f"{float(ratio.max()):.2f}"]
