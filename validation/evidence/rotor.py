"""Whole rotors of the seven blades, and several rotors of two of them."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.results.danger import ratio_to_yield
from r37core.results.exceedance import length_of, ranges_above
from r37core.results.regions import read_judged
from r37core.time_integration.status import RunStatus

from .pages import write_table

ORDER = 4
WINDOW = (-0.06, 0.10)
"""Speeds about a crossing, as shares of it."""

SINGLE, NOT_RUN = "single", "-"
KINDS = {
    SINGLE: "a single blade",
    "equal": "36 equal blades",
    "mistuned_0p2": "0.2% of mistuning",
    "mistuned_1": "1%",
    "mistuned_1_other": "1%, another draw",
    "mistuned_3": "3%",
    "own_linings": "1%, a lining for each blade",
    "longer_20": "equal, blade 1 longer by 20 um",
    "longer_50": "equal, blade 1 longer by 50 um",
}
"""Scenes of validation/rotors.yaml."""


def rotor_ratio(rotor: xr.Dataset) -> xr.DataArray:
    """Stress of the worst blade as a share of yield, over speed; infinite where the run diverged."""
    worst = rotor["blade_max_von_mises_ever"].max("blade_number") / rotor["yield_stress"]
    return worst.where(rotor["status"] != RunStatus.DIVERGED, np.inf)


def length_about(ratio: xr.DataArray, crossing: float) -> float:
    """Length (rad/s) of the speeds about a crossing with a stress above yield."""
    near = ratio.sel(speed=slice(*(crossing * (1.0 + share) for share in WINDOW)))
    return length_of(ranges_above(near["speed"].values, near.values, 1.0))


def blades(input: Any, output: Any, params: Any) -> None:
    """Single blades and rotors about the crossing of 1B with ORDER. Input: singles, rotors, campbells."""
    rows = []
    for single_file, rotor_file, campbell_file in zip(input.singles, input.rotors, input.campbells, strict=True):
        single, rotor = ratio_to_yield(read_judged(single_file)), read_dataset(rotor_file)
        ratio, crossings = rotor_ratio(rotor), read_dataset(campbell_file)["crossing_speed"].sel(mode="1B")
        cells = [f"{length_about(of, float(crossings.sel(engine_order=ORDER))):.0f}" for of in (single, ratio)]
        worst = rotor.isel(speed=int(ratio.argmax()))
        others = float(worst["blade_rms"].max() / worst["blade_rms"].median())
        rows.append([Path(single_file).parts[-3], *cells, _at_once(rotor), f"{others:.0f}"])
    head = [
        "blade",
        "single (rad/s)",
        "rotor (rad/s)",
        "blades above yield at once, median (most)",
        "leader's rms over the median blade's",
    ]
    write_table(head, rows, output.table)


def _at_once(rotor: xr.Dataset) -> str:
    above = (rotor["blades_ever_above_yield"] * rotor.sizes["blade_number"]).values.round()
    some = above[above > 0.0]
    return f"{np.median(some):.0f} ({some.max():.0f})" if some.size else "none"


def kinds(input: Any, output: Any, params: Any) -> None:
    """Length above yield of several rotors, and how many blades are at once. Input: files of each blade and kind.

    Params: windows, the blade and the first and last speed (rad/s) of each column.
    """
    tables = {Path(file).parts[-3:-1]: read_dataset(file) for file in input}
    rows = [[words] for words in KINDS.values()]
    for blade, first, last in params.windows.values():
        for row, kind in zip(rows, KINDS, strict=True):
            row += _in_window(tables[blade, kind].sel(speed=slice(first, last)), kind)
    heads = [head for name in params.windows for head in (f"{name} (rad/s)", f"{name}: blades")]
    write_table(["rotor", *heads], rows, output.table)


def _in_window(rotor: xr.Dataset, kind: str) -> list[str]:
    """Length above yield, and blades at once, of some speeds of a rotor or of a single blade; a dash where none was run."""
    if not rotor.sizes["speed"]:
        return [NOT_RUN, NOT_RUN]
    ratio = ratio_to_yield(rotor) if kind == SINGLE else rotor_ratio(rotor)
    length = length_of(ranges_above(ratio["speed"].values, ratio.values, 1.0))
    return [f"{length:.0f}", NOT_RUN if kind == SINGLE else _at_once(rotor)]
