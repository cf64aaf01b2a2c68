"""rotor.nc: numbers of every blade of a rotor at every speed, of one blade shape and scene, and of all."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import SPEED, Variable, dataset_of, read_dataset
from r37core.results.closing import counted
from r37core.results.columns import MOST_REVOLUTIONS
from r37core.results.events import OF_EXIT, OF_YIELD
from r37core.results.joining import Along
from r37core.results.response import in_statistic, run_row
from r37core.results.table_file import read_table
from r37core.results.variables import OF_STRESS
from r37core.results.variables import VARIABLES as RESPONSE
from r37core.stress.statistic import UNKNOWN, stress_statistic
from r37core.time_integration.rotor_numbers import span_maxima
from r37core.time_integration.speed_arrays import ARRAYS
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus
from r37studies.closing import largest_stress_text

_BLADES = ("blade_number",)

OF_ALL_SPEEDS = {
    **{name: ARRAYS[name] for name in ("blade_angle", "blade_frequency_factor", "blade_longer", "lined")},
    "yield_stress": OF_STRESS["yield_stress"],
}
"""Variables that no speed changes."""

_WORST = {
    name: replace(RESPONSE[name], dims=())
    for name in (*OF_EXIT, *OF_YIELD, "max_von_mises_ever", "share_of_revolutions_above_yield")
}
"""Variables of the worst of all blades, in the region that decides, which say how dangerous a speed is."""

VARIABLES = {
    **_WORST,
    **{name: ARRAYS[name] for name in ("blade_rms", "blade_peak", "blade_maximum", "blade_contact", "blade_worn")},
    "blade_max_von_mises_ever": Variable(
        _BLADES, "Pa", "largest von Mises stress of any revolution in the region that decides", "f4"
    ),
    "blade_von_mises": Variable((*_BLADES, "stress_span"), "Pa", "largest von Mises stress in the span", "f4"),
    "blade_share_of_revolutions_above_yield": Variable(
        _BLADES, "1", "share of the last half's revolutions in which that stress exceeds yield"
    ),
    **{name: ARRAYS[name] for name in ("leader", "wear_harmonic", "max_wear", "nodal_diameter_share", "status")},
    "diverged_revolution": Variable((), "1", "revolution at which the first blade diverged"),
}
"""Dimensions are those beyond the speed."""

RUNS = Along(rows="run", dim="speed", names=(*VARIABLES, *OF_ALL_SPEEDS, "speed"), coordinates=("blade", "scene", "speed"))
"""Rotors of all blades and scenes: each speed is a run; NaN where a rotor has fewer blades."""

AXES = {
    "blade_number": ARRAYS["blade_number"],
    "span": Variable(("span",), "1", "last revolution of the span", "i4"),
    "stress_span": Variable(("stress_span",), "1", "last revolution of the span", "i4"),
    "lobes": Variable(("lobes",), "1", "number of lobes", "i4"),
    "nodal_diameter": ARRAYS["nodal_diameter"],
}


def rotor_dataset(files: Iterable[Path | str], speeds: Sequence[float], yield_stress: float) -> xr.Dataset:
    """Numbers of every blade of a rotor, from the files of the `speeds` (rad/s); `yield_stress` (Pa): of the blades' material.

    Raises InputFileError for a file that cannot be read.
    """
    rows = [_row(read_speed(file), yield_stress) for file in files]
    values = (
        rows[0] | {name: np.stack([row[name] for row in rows]) for name in VARIABLES if name in rows[0]} | {"speed": speeds}
    )
    changing = dataset_of(VARIABLES, values, {"speed": SPEED, **AXES}, {}, ("speed",))
    return changing.assign(dataset_of(OF_ALL_SPEEDS, values, {}, {}))


def _row(run: dict[str, np.ndarray], yield_stress: float) -> dict[str, np.ndarray]:
    """Numbers of one speed, and the coordinates that they need."""
    revolutions = len(run["revolution_maximum"])
    row = run | {"yield_stress": np.array(yield_stress), "span": _ends(revolutions, int(run["span_revolutions"]))}
    worst = run_row(run, yield_stress, UNKNOWN)
    row |= {name: np.ravel(worst[name])[0] for name in _WORST if name in worst}
    if "wear_harmonic" in run:
        row["lobes"] = np.arange(len(run["wear_harmonic"]))
    if "blade_revolution_von_mises" in run:
        stress = run["blade_revolution_von_mises"]
        row["blade_von_mises"], length = span_maxima(stress)
        row["stress_span"] = revolutions - stress.shape[1] + _ends(stress.shape[1], length)
        judged = in_statistic(run, run["blade_revolution_von_mises"])
        if run["status"] == RunStatus.DIVERGED:
            judged = np.full_like(judged, np.nan)
        statistic = stress_statistic(judged, yield_stress)
        row["blade_max_von_mises_ever"] = np.where(run["status"], np.nan, np.fmax.reduce(stress, axis=1))
        row["blade_share_of_revolutions_above_yield"] = statistic["share_of_revolutions_above_yield"]
    return row


def _ends(revolutions: int, span: int) -> np.ndarray:
    """Last revolution of each span, of which the last one may be shorter."""
    return np.minimum(np.arange(span, revolutions + span, span), revolutions)


def worst_place(rotor: xr.Dataset, measure: str) -> int:
    """Place of the speed at which a measure of any blade is largest."""
    return int(np.nan_to_num(rotor[measure].max("blade_number").values).argmax())


def blades_above_yield(rotor: xr.Dataset) -> int:
    """The most blades that are above yield in most revolutions at one speed; runs that diverged do not count."""
    return int((rotor["blade_share_of_revolutions_above_yield"] > MOST_REVOLUTIONS).sum("blade_number").max())


def rotor_table(files: Mapping[tuple[str, str], Path | str]) -> pd.DataFrame:
    """A row for each blade and scene: the speed of the largest stress, how many blades are above yield, and which leads there.

    Motion is `blade_rms`. A run that diverged counts as the worst where none ended. How long any blade is above yield is in
    ranking.csv, as for single blades.
    """
    rows = []
    for (blade, scene), file in files.items():
        dataset = read_dataset(file)
        row = {"blade": blade, "scene": scene, "blades": dataset.sizes["blade_number"], "speeds": dataset.sizes["speed"]}
        row["diverged_speeds"] = int((dataset["status"] == RunStatus.DIVERGED).sum())
        stress = "blade_max_von_mises_ever"
        worst_run = dataset.isel(speed=worst_place(dataset, stress if stress in dataset else "blade_rms"))
        if stress in dataset:
            row |= {"largest_stress_pa": float(worst_run[stress].max()), "blades_above_yield": blades_above_yield(dataset)}
        row |= {"worst_speed_rad_s": float(worst_run["speed"]), "leader_by_motion": int(worst_run["leader"])}
        if stress in dataset:
            row["leader_by_stress"] = float(worst_run[stress].idxmax())
        shares = worst_run["nodal_diameter_share"]
        row |= {
            "leader_motion_m": float(worst_run["blade_rms"].max()),
            "median_motion_m": float(worst_run["blade_rms"].median()),
            "nodal_diameter": float(shares.idxmax()),
            "nodal_diameter_share": float(shares.max()),
        }
        rows.append(row)
    return pd.DataFrame(rows)


def closing(results: Path) -> str:
    """Closing line: how many rotors there are, how many of their runs diverged, and the largest stress of any blade."""
    table = read_table(results / "rotors.csv")
    text = counted(len(table), "rotor")
    if diverged := int(table["diverged_speeds"].sum()):
        text += f", {diverged} of {counted(int(table['speeds'].sum()), 'run')} diverged"
    return text + largest_stress_text(table, "worst_speed_rad_s")
