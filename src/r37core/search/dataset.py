"""search.nc, search.csv and blades.yaml of the best designs: what a search writes, with predictions between its designs."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import scipy
import xarray as xr

from r37core.base.dataset_file import about, read_dataset
from r37core.base.io import write_text
from r37core.base.rounding import rounded_to
from r37core.base.units import shown_unit
from r37core.base.varied_number import VariedNumber, with_value
from r37core.base.yaml_file import yaml_text
from r37core.results.closing import counted

from .gaussian_processes import Fit, fit
from .plan import BEST, DATASET
from .problem import FEWEST_DONE, START, UNKNOWN, Design, SearchChoice, SearchVariable, best_first, not_dominated, shares

POINTS = 41
"""Number of points of a slice."""

_SAMPLE = 1024


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


def slices(
    variables: Sequence[SearchVariable], evaluated: Sequence[Design], at: Sequence[float], points: int, seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Surrogate of each objective at `points` values of each variable, the others as in the design `at`.

    These values [variable, point], its mean and its standard deviation [objective, variable, point], in units of the
    objectives; NaN where too few designs could be built.
    """
    along = np.linspace(0.0, 1.0, points)
    places = np.tile(shares(variables, [at])[0], (len(variables), points, 1))
    for number in range(len(variables)):
        places[number, :, number] = along
    bands = np.full((2, len(evaluated[0].objectives), len(variables), points), np.nan)
    for number, process in enumerate(objective_fits(variables, evaluated, seed)):
        bands[:, number] = np.reshape(process.at(places.reshape(-1, len(variables))), (2, len(variables), points))
    values = [variable.lowest + along * (variable.highest - variable.lowest) for variable in variables]
    return np.array(values), *bands


def sensitivity(
    variables: Sequence[SearchVariable], evaluated: Sequence[Design], seed: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """First-order and total Sobol' indices [objective, variable] of the surrogates, the variables uniform over their ranges.

    The third [objective] is the share of the variance that a surrogate predicts at designs it was not told of, 1 at best, 0
    or less where the indices mean nothing: designs are left out one at a time with the hyperparameters of all. NaN where all
    designs have the same objective, or too few could be built.
    Source: Saltelli et al. (2010), Comput. Phys. Commun. 181, 259-270, in scipy.stats.sobol_indices; Q2 as in Marrel et al.
    (2009), Reliab. Eng. Syst. Saf. 94, 742-751.
    """
    objectives = len(evaluated[0].objectives)
    first, total = np.full((2, objectives, len(variables)), np.nan)
    predicted = np.full(objectives, np.nan)
    for number, process in enumerate(objective_fits(variables, evaluated, seed)):
        if process.process is None:
            continue
        first[number], total[number] = _indices(process, len(variables), seed)
        misses = process.numbers - [process.without(index) for index in range(len(process.numbers))]
        predicted[number] = 1.0 - np.mean(misses**2) / np.var(process.numbers)
    return first, total, predicted


def objective_fits(variables: Sequence[SearchVariable], evaluated: Sequence[Design], seed: int) -> list[Fit]:
    """The process of each objective over shares of the ranges; none where fewer than `FEWEST_DONE` designs could be built."""
    known = sorted((design for design in evaluated if design.is_done), key=lambda design: (design.values, design.name))
    if len(known) < FEWEST_DONE:
        return []
    points = shares(variables, [design.values for design in known])
    objectives = np.array([design.objectives for design in known]).T
    scatters = np.array([design.scatters for design in known]).T
    return [fit(points, *each, seed) for each in zip(objectives, scatters, strict=True)]


def _indices(process: Fit, variables: int, seed: int) -> np.ndarray:
    """First-order and total index of each variable [2, variable]."""
    if variables == 1:
        # all of the variance is of the one variable, for which scipy has no indices
        return np.ones((2, 1))
    dists = [scipy.stats.uniform()] * variables
    sobol = scipy.stats.sobol_indices(func=lambda points: process.at(points.T)[0], n=_SAMPLE, dists=dists, rng=seed)
    return np.array([sobol.first_order, sobol.total_order])


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
    off = abs(designs["objective_value"] - best["objective_value"].isel(design=0, drop=True))
    scatters = designs["objective_scatter"].fillna(0.0)
    tied = (off <= scatters + scatters.sel(design=name, drop=True)).all("objective") & (designs["feasible"] > 0)
    if (others := int(tied.sum()) - 1) > 0:
        numbers += f"; {counted(others, 'other')} cannot be told apart from it"
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
