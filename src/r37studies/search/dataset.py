"""search.nc and search.csv: what a search writes, and its last line."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import about, read_dataset
from r37core.base.rounding import rounded_to
from r37core.base.units import shown_unit
from r37core.results.closing import counted
from r37studies.surrogate.designs import Design, best_first, not_dominated

from .plan import DATASET, TABLE
from .problem import START, UNKNOWN, SearchChoice


def search_dataset(tried: Mapping[str, Design], choice: SearchChoice) -> xr.Dataset:
    """All designs of a search that were `tried`, the start first."""
    designs = list(tried.values())
    order, front = _best(designs[1:], tried[START]), {design.name for design in not_dominated(designs)}
    dataset = xr.Dataset(coords=_coordinates(list(tried), choice))
    dataset = dataset.assign(_design_variables(designs, choice)).assign(_bound_variables(choice, tried[START]))
    dataset["not_dominated"] = ("design", np.array([name in front for name in tried], "i1"), _NOT_DOMINATED)
    places = [order.index(name) + 1 if name in order else 0 for name in tried]
    dataset["order"] = ("design", np.array(places, "i4"), _ORDER)
    return dataset


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
    off = abs(designs["objective_value"] - best["objective_value"].isel(design=0, drop=True))
    scatters = designs["objective_scatter"].fillna(0.0)
    tied = (off <= scatters + scatters.sel(design=name, drop=True)).all("objective") & (designs["feasible"] > 0)
    if (others := int(tied.sum()) - 1) > 0:
        numbers += f"; {counted(others, 'other')} cannot be told apart from it"
    return f"{text}; the best, {name}: {numbers}; its values are in {results / TABLE.removeprefix('<results>/')}"


def _against(best: xr.Dataset, start: xr.Dataset, objective: str) -> str:
    """An objective of two designs, with the digits that the scatter of both bears."""
    unit, factor = shown_unit(best["objective_unit"].sel(objective=objective).item())
    values, scatters = (
        [factor * float(design[f"objective_{kind}"].sel(objective=objective)) for design in (best, start)]
        for kind in ("value", "scatter")
    )
    here, there = (rounded_to(value, 2.0 * max(scatters)) for value in values)
    return f"{objective} {here}{f' {unit}' if unit else ''} (the start {there})"
