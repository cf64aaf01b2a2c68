"""search.nc and search.csv: what a search writes, and its last line."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.rounding import rounded_to
from r37core.base.units import shown_unit, unit_of
from r37core.base.variable import about
from r37core.results.closing import counted
from r37studies.surrogate.designs import Design, best_first, not_dominated

from .designs import START, UNKNOWN, SearchChoice
from .plan import DATASET, TABLE


def search_dataset(tried: Mapping[str, Design], choice: SearchChoice) -> xr.Dataset:
    """All designs of a search that were `tried`, the start first."""
    designs, start, entry = list(tried.values()), tried[START], choice.entry
    order, front = _best(designs[1:], start), {design.name for design in not_dominated(designs)}
    constraints = [[design.quantities.get(name, UNKNOWN)[0] for name in entry.constraints] for design in designs]
    bounds = [constraint.bounds(start.quantities[name][0]) for name, constraint in entry.constraints.items()]
    lowest, highest = np.array(bounds, float).reshape(-1, 2).T
    of_design, of_objective, of_constraint = ("design",), ("design", "objective"), ("design", "constraint")

    def listed(name: str) -> list[Any]:
        return [getattr(design, name) for design in designs]

    places = np.array([order.index(name) + 1 if name in order else 0 for name in tried], "i4")
    variables = {
        "value": (("design", "variable"), listed("values"), "in the unit of the key"),
        "round": (of_design, listed("round"), "that proposed the design; -1 of the start"),
        "feasible": (of_design, np.array(listed("is_feasible"), "i1"), "whether it can be built and keeps all constraints"),
        "objective_value": (of_objective, listed("objectives"), "in the unit of the objective"),
        "objective_scatter": (of_objective, listed("scatters"), "standard deviation by chance"),
        "constraint_value": (of_constraint, np.array(constraints, float), "in the unit of the constraint"),
        "lowest": (("variable",), [low for low, _ in entry.variables.values()], "bound of the variable"),
        "highest": (("variable",), [high for _, high in entry.variables.values()], "bound of the variable"),
        "constraint_lowest": (("constraint",), lowest, "what has to be reached, in the unit of the constraint"),
        "constraint_highest": (("constraint",), highest, "what may not be passed, in the unit of the constraint"),
        "not_dominated": (
            of_design,
            np.array([name in front for name in tried], "i1"),
            "whether the design keeps all constraints and no other that does is better in all objectives",
        ),
        "order": (
            of_design,
            places,
            "place among the best designs, 1 the first; 0 for one that cannot be built or breaks a constraint",
        ),
    }
    described = {name: (dims, values, about("1", words)) for name, (dims, values, words) in variables.items()}
    described["refused"] = (of_design, listed("refused"), {"long_name": "why it cannot be built"})
    objectives = entry.objectives.values()
    names = {"design": list(tried), "variable": list(entry.variables), "objective": list(entry.objectives)}
    names |= {"constraint": list(entry.constraints)}
    measures = {
        "objective_unit": ("objective", [unit_of(each.measure) for each in objectives]),
        "objective_measure": ("objective", [each.measure for each in objectives]),
        "constraint_unit": ("constraint", [unit_of(each.measure) for each in entry.constraints.values()]),
    }
    return xr.Dataset(described, names | measures)


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


def search_table(search: xr.Dataset) -> pd.DataFrame:
    """A row for each design: values, objectives with their scatter, constraints, round, and why it was refused."""
    table = pd.DataFrame({"design": search["design"].values, "round": search["round"].values})
    for axis, kinds in (("variable", {"value": ""}), ("objective", _OF_OBJECTIVES), ("constraint", {"constraint_value": ""})):
        for name in search[axis].values:
            for kind, end in kinds.items():
                table[f"{name}{end}"] = search[kind].sel({axis: name}).values
    return table.assign(**{name: search[name].values for name in ("feasible", "not_dominated", "order", "refused")})


_OF_OBJECTIVES = {"objective_value": "", "objective_scatter": "_scatter"}


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
