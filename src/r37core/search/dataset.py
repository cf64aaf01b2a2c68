"""search.nc, search.csv and blades.yaml of the best designs: what a search writes."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import about, read_dataset
from r37core.base.io import write_text
from r37core.base.rounding import rounded_to
from r37core.base.units import shown_unit
from r37core.base.varied_number import VariedNumber, with_value
from r37core.base.yaml_file import yaml_text
from r37core.results.closing import counted

from .plan import BEST, DATASET
from .problem import START, UNKNOWN, Design, SearchChoice, best_first, not_dominated
from .surrogate import sensitivity, slices

POINTS = 41
"""Number of points of a slice."""


def search_dataset(tried: Mapping[str, Design], choice: SearchChoice) -> xr.Dataset:
    """All designs of a search that were `tried`, the start first."""
    designs = list(tried.values())
    known = [design for design in designs if not np.isnan(design.values).any()]
    order, front = _best(designs[1:], tried[START]), {design.name for design in not_dominated(designs)}
    dataset = xr.Dataset(coords=_coordinates(list(tried), choice))
    dataset = dataset.assign(_design_variables(designs, choice)).assign(_bound_variables(choice, tried[START]))
    dataset["not_dominated"] = ("design", np.array([name in front for name in tried], "i1"), _NOT_DOMINATED)
    places = [order.index(name) + 1 if name in order else 0 for name in tried]
    dataset["order"] = ("design", np.array(places, "i4"), _ORDER)
    return dataset.assign(_surrogate_variables(known, choice, tried[order[0]].values)) if order else dataset


def _best(tried: Sequence[Design], start: Design) -> list[str]:
    """Names of the feasible designs, the best first: those that no other beats, then the others.

    Both are in the order of the sum of their objectives, each as a share of the start's, so that what the start has least of
    counts most; where that is 0 or not known, as a share of the largest.
    """
    ordered = best_first(tried)
    largest = np.max([each.objectives for each in ordered], axis=0, initial=0.0)
    scales = np.where(np.array(start.objectives) > 0.0, start.objectives, np.where(largest > 0.0, largest, 1.0))
    front = {each.name for each in not_dominated(tried)}
    ranked = sorted(ordered, key=lambda each: (each.name not in front, float(np.sum(each.objectives / scales))))
    return [each.name for each in ranked]


_NOT_DOMINATED = about("1", "whether the design keeps all constraints and no other that does is better in all objectives")
_ORDER = about("1", "place among the best designs, 1 the first; 0 for one that cannot be built or breaks a constraint")


def _coordinates(designs: list[str], choice: SearchChoice) -> dict[str, object]:
    objectives, constraints = choice.objectives.values(), [each.quantity for each in choice.constraints.values()]
    return {
        "design": designs,
        "variable": [variable.key for variable in choice.variables],
        "objective": list(choice.objectives),
        "constraint": list(choice.constraints),
        "objective_unit": ("objective", [quantity.unit for quantity in objectives]),
        "objective_measure": ("objective", [quantity.measure for quantity in objectives]),
        "constraint_unit": ("constraint", [quantity.unit for quantity in constraints]),
    }


def _design_variables(designs: Sequence[Design], choice: SearchChoice) -> dict[str, object]:
    objectives, scatters, feasible = (
        [getattr(each, name) for each in designs] for name in ("objectives", "scatters", "is_feasible")
    )
    constraints = [[design.quantities.get(name, UNKNOWN)[0] for name in choice.constraints] for design in designs]
    over = ("design", "objective")
    return {
        "value": (("design", "variable"), [design.values for design in designs], about("1", "in the unit of the key")),
        "round": ("design", [design.round for design in designs], about("1", "that proposed the design; -1 of the start")),
        "refused": ("design", [design.refused for design in designs], {"long_name": "why it cannot be built"}),
        "feasible": ("design", np.array(feasible, "i1"), about("1", "whether it can be built and keeps all constraints")),
        "objective_value": (over, objectives, about("1", "in the unit of the objective")),
        "objective_scatter": (over, scatters, about("1", "standard deviation by chance")),
        "constraint_value": (
            ("design", "constraint"),
            np.array(constraints, float),
            about("1", "in the unit of the constraint"),
        ),
    }


def _bound_variables(choice: SearchChoice, start: Design) -> dict[str, object]:
    bounds = [constraint.bounds(start.quantities[name][0]) for name, constraint in choice.constraints.items()]
    lowest, highest = np.array(bounds, float).reshape(-1, 2).T
    return {
        "lowest": ("variable", [variable.lowest for variable in choice.variables], about("1", "bound of the variable")),
        "highest": ("variable", [variable.highest for variable in choice.variables], about("1", "bound of the variable")),
        "constraint_lowest": ("constraint", lowest, about("1", "what has to be reached, in the unit of the constraint")),
        "constraint_highest": ("constraint", highest, about("1", "what may not be passed, in the unit of the constraint")),
    }


def _surrogate_variables(known: list[Design], choice: SearchChoice, at: Sequence[float]) -> dict[str, object]:
    """Slices through the best design, and what each variable does."""
    values, mean, deviation = slices(choice.variables, known, at, POINTS, choice.seed)
    first, total, predicted = sensitivity(choice.variables, known, choice.seed)
    axes = ("objective", "variable")
    return {
        "slice_value": (("variable", "point"), values, about("1", "values of the variable, through the best design")),
        "slice_mean": ((*axes, "point"), mean, about("1", "mean of the surrogate of the objective")),
        "slice_deviation": ((*axes, "point"), deviation, about("1", "standard deviation of the surrogate")),
        "sensitivity_first": (axes, first, about("1", "share of the surrogate's variance by the variable alone")),
        "sensitivity_total": (axes, total, about("1", "share in which the variable has a part")),
        "surrogate_q2": ("objective", predicted, about("1", "share of the variance that it predicts, each left out")),
    }


def search_table(search: xr.Dataset) -> pd.DataFrame:
    """A row for each design: values, objectives with their scatter, constraints, round, and why it was refused."""
    table = pd.DataFrame({"design": search["design"].values, "round": search["round"].values})
    for key in search["variable"].values:
        table[str(key)] = search["value"].sel(variable=key).values
    for name in search["objective"].values:
        table[str(name)] = search["objective_value"].sel(objective=name).values
        table[f"{name}_scatter"] = search["objective_scatter"].sel(objective=name).values
    for name in search["constraint"].values:
        table[str(name)] = search["constraint_value"].sel(constraint=name).values
    for name in ("feasible", "not_dominated", "order", "refused"):
        table[name] = search[name].values
    return table


BLADES_HEADER = """\
# The best designs of a search: entries to paste into your blades.yaml, or a file of its own with the blades they start from. To
# run them at another level, with tolerances or in other scenes:
#   snakemake all_blades --configfile config/config.yaml --config blades_file={file} blades='[{names}]' \\
#     fidelity=standard run='{{name: best}}'
"""

SCENES_HEADER = """\
# The scenes of a search and of its best designs, as a file of their own. To run these, with the blade of the search or, where
# that varies, those of blades.yaml next to this file:
#   snakemake all_blades --configfile config/config.yaml --config blades_file=FILE blades='[BLADE]' \\
#     scenes_file={file} scenes='[{names}]' fidelity=standard run='{{name: best}}'
"""


def write_entries(
    search: xr.Dataset,
    designs: Sequence[str],
    entries: Mapping[str, Any],
    varied: Mapping[str, Sequence[str]],
    header: str,
    file: Path | str,
) -> list[str]:
    """Write the `designs`, the best first, as YAML (name_best1, name_best2, ...) after the entries that they start at.

    `entries`: of the blade with its bases, or of the scenes; `varied`: name of an entry that is searched -> variables of the
    search that it has. One without is the start's. Names of the new entries.
    """
    parts = [yaml_text(dict(entries))]
    names: list[str] = []
    for place, design in enumerate(designs, 1):
        values = dict(zip(search["variable"].values.tolist(), search["value"].sel(design=design).values.tolist(), strict=True))
        made = {}
        for name, keys in varied.items():
            content = dict(entries[name])
            for key in keys:
                content = with_value(content, VariedNumber.named(key).key, values[key])
            if keys:
                made[f"{name}_best{place}"] = content
        names += made
        parts.append(f"# {design}: {_objectives(search, design)}; the start: {_objectives(search, START)}\n{yaml_text(made)}")
    write_text("\n".join([header.format(file=file, names=", ".join([*varied, *names])), *parts]), file)
    return names


def _objectives(search: xr.Dataset, design: str) -> str:
    of = search.sel(design=design)
    values = zip(of["objective"].values, of["objective_value"].values, of["objective_unit"].values, strict=True)
    return ", ".join(f"{name} {float(value):.4g} {unit}" for name, value, unit in values)


def closing(results: Path) -> str:
    """How many designs there are, how many keep the constraints, and what the best one has in place of the start's."""
    search = read_dataset(results / DATASET.removeprefix("<results>/"))
    start, designs = search.isel(design=0), search.isel(design=slice(1, None))
    text = f"{counted(designs.sizes['design'], 'design')}, {int(designs['feasible'].sum())} of them keep all constraints"
    best = designs.isel(design=designs["order"].values == 1)
    if not best.sizes["design"]:
        return text
    (name,) = best["design"].values
    numbers = ", ".join(_against(best.isel(design=0), start, objective) for objective in search["objective"].values)
    return f"{text}; the best, {name}: {numbers}; entries in {results / BEST.removeprefix('<results>/')}"


def _against(best: xr.Dataset, start: xr.Dataset, objective: str) -> str:
    """An objective of two designs, with the digits that the scatter of both bears."""
    unit, factor = shown_unit(best["objective_unit"].sel(objective=objective).item())
    values, scatters = (
        [factor * float(design[f"objective_{kind}"].sel(objective=objective)) for design in (best, start)]
        for kind in ("value", "scatter")
    )
    here, there = (rounded_to(value, 2.0 * max(scatters)) for value in values)
    return f"{objective} {here}{f' {unit}' if unit else ''} (the start {there})"
