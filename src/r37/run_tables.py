"""Datasets and tables over all runs of a calculation, made by the steps of the workflow with the parameters of its rules."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from r37core.config import plain
from r37core.designs.plan import Families
from r37core.io import Named
from r37core.plans import paths
from r37core.plans.dataset_plan import Datasets
from r37core.product.sampling import sampling_of
from r37core.rotors.plan import ROTOR_OF_RUN, rotor_runs
from r37core.tolerances.plan import DATASET, TABLE, Tolerances

from .calculation import Calculation
from .jobs import in_parallel
from .structure_files import StructureFiles

_CAMPBELL, _SUMMARY = "<results>/campbell.nc", "<results>/summary.csv"


def make_tables(calculation: Calculation) -> None:
    """All that a run ends in but its pictures, of responses that are there. Raises what the steps raise."""
    settings, sweep = calculation.settings, calculation.sweep
    calculation.campbells()
    _campbell(calculation)
    datasets = {kind: f"<results>/{kind}.nc" for kind in sweep.kinds}
    for kind, file in datasets.items():
        _dataset(calculation, kind, file)
    sampling = sampling_of(settings)
    if sampling:
        _tolerances(calculation)
    calculation.step(
        "results.steps.summary",
        {**datasets, **({"ranges": sampling.ranges} if sampling else {}), "campbell": _CAMPBELL},
        {"table": _SUMMARY},
        choice=plain(settings.config.interactions),
    )
    ranked = {kind: file for kind, file in datasets.items() if kind in ("rms", "stress")}
    calculation.step(
        "results.steps.ranking",
        {**ranked, **({"members": sampling.dataset} if sampling else {})},
        {"table": "<results>/ranking.csv"},
        runs=sweep.runs_with("rms"),
    )
    _designs(calculation, ranked)
    _rotors(calculation)


def rotors_of_runs(calculation: Calculation) -> dict[tuple[str, str], str]:
    """rotor.nc of each blade in each scene with a rotor, of responses that are there. Raises what the steps raise."""
    runs = {pair: Named(member="", blade=pair[0], scene=pair[1]) for pair in rotor_runs(calculation.sweep)}
    files = {pair: paths.fill(ROTOR_OF_RUN, **vars(run)) for pair, run in runs.items()}
    in_parallel([_rotor(calculation, run, files[pair]) for pair, run in runs.items()], calculation.cores)
    return files


def _rotor(calculation: Calculation, run: Named, file: str) -> Callable[[], None]:
    speed_files = calculation.sweep.speed_files(run)
    return calculation.task(
        "rotors.steps.rotor_of_run",
        {"speeds": speed_files},
        {"rotor": file},
        speeds=calculation.sweep.speeds(run, Named(speeds=speed_files)),
        yield_stress=calculation.sweep.yield_stress(run),
        provenance=calculation.made.sweep(run),
    )


def _rotors(calculation: Calculation) -> None:
    files = rotors_of_runs(calculation)
    if not files:
        return
    calculation.step(
        "rotors.steps.join",
        {"rotors": list(files.values())},
        {"dataset": "<results>/rotor.nc", "table": "<results>/rotors.csv"},
        runs=list(files),
        fidelity=calculation.settings.fidelity_name,
    )


def _campbell(calculation: Calculation) -> None:
    blades = list(calculation.settings.blades)
    calculation.step(
        "results.steps.campbell_of_all",
        {"campbells": [paths.fill(paths.CAMPBELL, blade=blade) for blade in blades]},
        {"campbell": _CAMPBELL},
        blades=blades,
        fidelity=calculation.settings.fidelity_name,
    )


def _dataset(calculation: Calculation, kind: str, file: str) -> None:
    joined, wildcards = Datasets(calculation.sweep), Named(kind=kind)
    calculation.step(
        "results.steps.sweep_dataset",
        {"responses": joined.responses(wildcards)},
        {"dataset": file},
        kind=kind,
        runs=joined.runs(wildcards),
        fidelity=calculation.settings.fidelity_name,
    )


def _designs(calculation: Calculation, ranked: dict[str, str]) -> None:
    settings = calculation.settings
    families = Families(settings)
    if not families.designs:
        return
    geometry = {paths.fill(paths.GEOMETRY, blade=name): StructureFiles(settings, name).geometry() for name in families.designs}
    calculation.linked(geometry)
    calculation.step(
        "designs.steps.tabulate",
        {**ranked, "campbell": _CAMPBELL, "summary": _SUMMARY, "geometry": list(geometry)},
        {"table": "<results>/designs.csv"},
        designs=families.designs,
        densities=families.densities,
        scenes=list(settings.scenes),
    )


def _tolerances(calculation: Calculation) -> None:
    planned = calculation.settings.made(Tolerances)
    calculation.step(
        "tolerances.steps.join",
        {"responses": planned.responses},
        {"dataset": DATASET},
        members=planned.runs,
        numbers=planned.numbers,
        values=planned.values,
        fidelity=calculation.settings.fidelity_name,
    )
    of_sample: dict[str, Any] = {"responses": planned.responses_of_sample, "campbells": planned.campbells_of_sample}
    calculation.step(
        "tolerances.steps.table",
        {**planned.nominal, **of_sample},
        {"table": TABLE},
        members=planned.runs_of_sample,
        choice=plain(calculation.settings.config.interactions),
    )
