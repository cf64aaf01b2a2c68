"""The ranking of the seven blades, and how sure it is."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.config import Settings
from r37core.contact.scene import Scene
from r37core.results.columns import MOST_REVOLUTIONS, SOME_REVOLUTIONS
from r37core.results.exceedance import Exceedance, exceedance_of
from r37core.results.measures import motion
from r37core.results.ranking import read_ranking
from r37core.results.regions import read_judged
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.stress.operator import StressOperator, judged_operator, read_stress_operators
from r37core.stress.revolutions import largest_of_revolutions
from r37core.stress.statistic import stress_statistic
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed

from .configuration import settings_of
from .pages import write_table

SCENES = {"abradable": "lining", "direct": "bare casing"}
"""Scenes of the benchmark, and what they are in words."""

ON_PATCHES = {"abradable": "material_abradable", "direct": "direct"}
"""Scenes on patches, which the published lining is not made for."""

KEPT = {"spectrum_highest_order": 1, "wear_angles": 1}
_DIFFERS = 1e-5
_OVER_THE_RANGE = np.linspace(760.0, 1990.0, 6).round().tolist()
_RANGES = 3


@dataclass(frozen=True)
class Models:
    """A blade's contact model and its stress operator."""

    contact: ContactModel
    stress: StressOperator

    @classmethod
    def read(cls, contact: str, stress: str) -> Models:
        """Models in two files of a run."""
        return cls(read_contact_model(contact), judged_operator(read_stress_operators(stress)))


def length_text(length: float, scatter: float = np.nan) -> str:
    """A length (rad/s), with its scatter where it is above 0."""
    return f"{length:.0f}" + (f" ± {max(scatter, 1.0):.0f}" if scatter > 0.0 else "")


def lengths(response: xr.Dataset) -> str:
    """Certain and, in brackets, possible length (rad/s) of a response."""
    exceedance = exceedance_of(response)
    certain = length_text(exceedance.length(MOST_REVOLUTIONS), exceedance.scatter_of_length(MOST_REVOLUTIONS))
    return f"{certain} ({exceedance.length(SOME_REVOLUTIONS):.0f})"


REGIONS = {"": "airfoil", "_airfoil_unfiltered": "airfoil, all modes", "_box": "box"}
"""End of a column of lengths, and the region of the stress in words."""


def rankings(input: Any, output: Any, params: Any) -> None:
    """Lengths above yield and ranks in both scenes, in each region of the stress. Input: ranking."""
    _write_lengths([(words, input.ranking, [end]) for end, words in REGIONS.items()], output.table)


CHECKS = {
    "standard": ("standard", [""]),
    "standard, every 5 rad/s": ("fine", [""]),
    "standard, worst motion": ("standard", ["", "_worst"]),
    "with rotation": ("rotation", [""]),
}
"""What a column has in words -> name of the run, and ends of the columns of lengths, of which the largest counts."""


def checks(input: Any, output: Any, params: Any) -> None:
    """Lengths and ranks at the next level, and with the stress of rotation. Inputs: rankings by run."""
    _write_lengths([(words, input[run], ends) for words, (run, ends) in CHECKS.items()], output.table)


def _write_lengths(kinds: list[tuple[str, str, list[str]]], file: str) -> None:
    """A column for each scene and kind. `kinds`: words, ranking, ends of the columns of lengths."""
    columns = {}
    for scene, on_patches in ON_PATCHES.items():
        for words, ranking, ends in kinds:
            table = read_ranking(ranking).set_index("blade")
            table = table[table["scene"] == on_patches]
            if len(table):
                lengths = table[[f"length_most_revolutions{end}_rad_s" for end in ends]].max(axis=1)
                columns[f"{SCENES[scene]}: {words}"] = lengths
    write_ranks(pd.DataFrame(columns).loc[table.index], file)


def write_ranks(lengths: pd.DataFrame, file: str) -> None:
    """Lengths (rad/s) of the blades as whole numbers, in brackets their ranks, which equal numbers share."""
    ranks = lengths.round().rank(method="min")
    cells = [[f"{lengths.loc[blade, name]:.0f} ({ranks.loc[blade, name]:.0f})" for name in lengths] for blade in lengths.index]
    write_table(["blade", *lengths], [[str(blade), *row] for blade, row in zip(lengths.index, cells, strict=True)], file)


def _lengths_of_row(row: pd.Series) -> str:
    certain = length_text(row["length_most_revolutions_rad_s"], row["length_most_revolutions_scatter_rad_s"])
    return f"{certain} ({row['length_some_revolutions_rad_s']:.0f})"


def speeds(input: Any, output: Any, params: Any) -> None:
    """Lengths at fewer speeds than every 1 rad/s, and at the adaptive ones of the main job. Input: every, adaptive."""
    rows = []
    for every, adaptive in zip(input.every, input.adaptive, strict=True):
        response, few = read_judged(every), read_judged(adaptive)
        halves = " | ".join(lengths(response.isel(speed=slice(first, None, 2))) for first in (0, 1))
        grids = [lengths(response.isel(speed=slice(None, None, step))) for step in (10, 20)]
        rows.append([blade_of(every), lengths(response), halves, *grids, lengths(few), str(few.sizes["speed"])])
    head = ["blade", "every 1 rad/s", "every 2: even, odd", "every 10", "every 20", "adaptive", "adaptive: runs"]
    write_table(head, [[cell.replace(" | ", ", ") for cell in row] for row in rows], output.table)


def adaptive(input: Any, output: Any, params: Any) -> None:
    """Lengths at every 1 rad/s and at the adaptive speeds of the main job, in both scenes. Input: every, adaptive."""
    cells: dict[str, list[str]] = {}
    for files in zip(input.every, input.adaptive, strict=True):
        cells.setdefault(blade_of(files[0]), []).extend(lengths(read_judged(file)) for file in files)
    head = [f"{words}: {which}" for words in SCENES.values() for which in ("every 1 rad/s", "adaptive")]
    write_table(["blade", *head], [[blade, *row] for blade, row in cells.items()], output.table)


def blade_of(file: str) -> str:
    """Blade of a response's file."""
    return Path(file).parts[-3]


def statistic(input: Any, output: Any, params: Any) -> None:
    """Scatter of what may be read off a run, against neighbours 1 rad/s away. Input: files, responses at every 1 rad/s."""
    names = {"last revolution": "max_von_mises_last_revolution", "median of the last 100": "max_von_mises_median"}
    rows = [[blade_of(file), *(f"{scatter(read_judged(file)[name].values):.1f}" for name in names.values())] for file in input]
    write_table(["largest stress: scatter (%)", *names], rows, output.table)


def scatter(values: np.ndarray) -> float:
    """Standard deviation (%) of equally spaced values, from their distance to the line between two neighbours."""
    off = values[1:-1] / (0.5 * (values[:-2] + values[2:])) - 1.0
    # such a distance has 1.5 times the variance; the median of many, robustly
    return float(100.0 * 1.4826 * np.median(np.abs(off)) / np.sqrt(1.5))


def missed(input: Any, output: Any, params: Any) -> None:
    """Largest stress of every revolution against that of all nodes at all instants. Input: contacts, stresses, responses."""
    settings, off = settings_of(Path.cwd()), {scene: [] for scene in SCENES}
    for contact, stress in zip(input.contacts, input.stresses, strict=True):
        models, blade = Models.read(contact, stress), Path(contact).parent.name
        for scene, differences in off.items():
            (response,) = (file for file in input.responses if Path(file).parts[-3:-1] == (blade, scene))
            differences += [_missed_at(settings, models, blade, scene, at) for at in steep_speeds(read_judged(response))]
    rows = []
    for scene, differences in off.items():
        several = np.array(differences)
        some, share = np.count_nonzero((several > _DIFFERS).any(axis=1)), np.mean(several > _DIFFERS)
        rows.append([SCENES[scene], str(len(several)), str(some), f"{100 * share:.2f}%", f"{100 * several.max():.2f}%"])
    head = ["scene", "runs", "with a revolution that differs", "of all revolutions", "largest difference"]
    write_table(head, rows, output.table)


def _missed_at(settings: Settings, models: Models, blade: str, scene: str, speed: float) -> np.ndarray:
    """Relative difference of each revolution's largest stress from that of all nodes and instants."""
    choice = settings.integration_choice(blade, scene, speed)
    simulation = Simulation(models.contact, speed, settings.scenes[scene].scene, choice)
    states = simulation.advance(simulation.start(), choice.revolutions).snapshots
    shapes, parts = models.contact.to_reduced @ simulation.problem.contact.state_shapes, choice.snapshots_per_revolution
    found = largest_of_revolutions(models.stress, states, shapes, np.empty(0), parts)
    every = [models.stress.max_von_mises(one @ shapes.T).max() for one in np.split(states, len(states) // parts)]
    return np.abs(found / np.array(every) - 1.0)


def steep_speeds(response: xr.Dataset) -> list[float]:
    """Speeds over the range (rad/s), the tops of the widest ranges above yield and 2 rad/s above each."""
    ranges = sorted(exceedance_of(response).ranges(MOST_REVOLUTIONS), key=lambda part: part.length)[-_RANGES:]
    inside = [response.sel(speed=slice(part.begin, part.end)) for part in ranges]
    tops = [float(part["speed"][int(np.argmax(motion(part)))]) for part in inside]
    return [*_OVER_THE_RANGE, *(min(top + more, 2000.0) for top in tops for more in (0.0, 2.0))]


def length_of_runs(settings: Settings, models: Models, blade: str, scene: Scene, speeds: np.ndarray) -> float:
    """Length (rad/s) above yield in most revolutions, from runs of its own."""
    return exceedance_of_runs(settings, models, blade, scene, speeds).length(MOST_REVOLUTIONS)


def exceedance_of_runs(settings: Settings, models: Models, blade: str, scene: Scene, speeds: np.ndarray) -> Exceedance:
    """Exceedance of a blade from runs of its own, in a scene like the shipped one with a lining or without."""
    limit, shares, lined = settings.blades[blade].material.yield_stress, [], scene.lining is not None
    name = next(name for name, chosen in settings.scenes.items() if (chosen.scene.lining is not None) == lined)
    for speed in speeds:
        choice = settings.integration_choice(blade, name, float(speed))
        run = run_speed(models.contact, float(speed), scene, choice, ("stress",), stress={"judged": models.stress}, **KEPT)
        statistic = stress_statistic(run["revolution_von_mises"][0], limit)
        shares.append(1.0 if run["status"] else float(statistic["share_of_revolutions_above_yield"]))
    coordinates = {"speed": np.asarray(speeds, float)}
    content = {"share_of_revolutions_above_yield": ("speed", shares), "status": ("speed", np.zeros(len(shares), int))}
    return exceedance_of(xr.Dataset(content | {"lined": float(lined)}, coordinates))


def chances(input: Any, output: Any, params: Any) -> None:
    """Range of the length over the members, and the chance to be better than the next blade. Input: ranking."""
    table = read_ranking(input.ranking).query("scene == 'direct'").sort_values("rank").set_index("blade")
    rows = []
    for blade, after in zip(table.index, [*table.index[1:], None], strict=True):
        row = table.loc[blade]
        low, high = (row[f"length_most_revolutions_rad_s_{end}"] for end in ("low", "high"))
        better = "" if after is None else f"{100 * float(row[f'chance_better_than_{after}']):.0f}"
        rows.append([blade, _lengths_of_row(row), f"{low:.0f} to {high:.0f}", better])
    write_table(["blade", "nominal (rad/s)", "members (rad/s)", "better than the blade below (%)"], rows, output.table)
