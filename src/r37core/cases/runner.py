"""The runner of cases: a case in, an ordinary response.nc out, with what it cost."""

import math
import resource
import tempfile
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from r37core.base.dataset_file import SPEED, Variable, read_dataset, write_dataset
from r37core.base.io import atomic_write, read_json
from r37core.results.netcdf import create_variable
from r37core.results.response import write_response
from r37core.rom.contact_model import ContactModel, read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.operator import StressOperator
from r37core.stress.recovery import stress_operator
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.speed_file import read_speed, write_speed
from r37core.time_integration.speed_job import prepared
from r37core.time_integration.speed_run import run_speed

from .case import Case, Crossing

COSTS = {
    "cpu_s": Variable(("speed",), "s", "CPU time of the time integration"),
    "wall_s": Variable(("speed",), "s", "wall time of the time integration"),
    "file_cpu_s": Variable(("speed",), "s", "CPU time of writing the run's file"),
    "bytes_written": Variable(("speed",), "1", "bytes of the run's file"),
}
"""Costs of every speed, which the response of a case has next to the results."""


class Stopwatch:
    """Adds up CPU and wall seconds of this process over the blocks it is used for."""

    def __init__(self) -> None:
        self.cpu = self.wall = 0.0

    def __enter__(self) -> None:
        self._start = time.process_time(), time.perf_counter()

    def __exit__(self, *_: object) -> None:
        self.cpu += time.process_time() - self._start[0]
        self.wall += time.perf_counter() - self._start[1]


def peak_memory() -> float:
    """Largest memory (bytes) of this process so far."""
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


def run_case_of_files(case: Case, files: Mapping[str, str], output: Path | str) -> None:
    """Run a case from its files: `contact`; `rom` for the stress, `cost` of the model, `campbell` for the speeds.

    Raises ValueError for a crossing that the Campbell diagram does not have.
    """
    model_costs = read_json(files["cost"]) if "cost" in files else {}
    if "refused" in model_costs:
        case = replace(case, scene=None, refused=model_costs["refused"])
    if case.scene is None:
        write_refusal(case, output)
        return
    if case.crossing:
        case = _about_the_crossing(case, case.crossing, read_dataset(files["campbell"]))
    reading, recovering = Stopwatch(), Stopwatch()
    with reading:
        model = read_contact_model(files["contact"])
    with recovering:
        recovery = None
        if "stress" in case.results and case.material:
            recovery = stress_operator(read_reduced_model(files["rom"]), case.material)
    costs = {f"model_{name}": value for name, value in model_costs.items()}
    run_case(case, model, recovery, output, costs | {"reading_cpu_s": reading.cpu, "recovery_cpu_s": recovering.cpu})


def _about_the_crossing(case: Case, crossing: Crossing, campbell: xr.Dataset) -> Case:
    """The case with its speeds in rad/s."""
    speed = crossing_speed(campbell, crossing, case.speeds[-1])
    if not np.isfinite(speed):
        order = f"engine order {crossing.engine_order}" if crossing.engine_order else "any engine order"
        raise ValueError(
            f"config.yaml: {crossing.mode} of {case.blade} does not cross {order} below structure.maximum_speed_rad_s; choose "
            "another engine_order, or a higher structure.maximum_speed_rad_s"
        )
    return replace(case, speeds=tuple(float(share * speed) for share in case.speeds))


def crossing_speed(campbell: xr.Dataset, crossing: Crossing, highest_share: float) -> float:
    """Speed (rad/s) of a crossing, NaN where there is none; without an engine order the highest one in the diagram.

    As far as there are some, only crossings count whose `highest_share` lies in the diagram, too.
    """
    speeds = campbell["crossing_speed"].sel(mode=crossing.mode)
    if crossing.engine_order:
        return float(speeds.sel(engine_order=crossing.engine_order))
    inside = speeds.where(highest_share * speeds <= campbell["speed"].max())
    return float(inside.max() if inside.notnull().any() else speeds.max())


def run_case(
    case: Case,
    model: ContactModel,
    recovery: StressOperator | None,
    output: Path | str,
    costs: Mapping[str, float] | None = None,
) -> None:
    """Run a case with speeds in rad/s; `costs` (s, bytes) become attributes of its response.

    A case that the configuration, a time step or a model refuses has no speeds, and the reason as attribute `refused`.
    """
    attributes = {"blade": case.blade, "case": case.what, **(costs or {})}
    try:
        with tempfile.TemporaryDirectory() as folder:
            Runs(case, model, recovery, Path(folder)).write(output, attributes)
    except ValueError as error:
        write_refusal(replace(case, refused=str(error)), output, attributes)


def write_refusal(case: Case, output: Path | str, attributes: Mapping[str, Any] | None = None) -> None:
    """A response without speeds, whose attribute `refused` has the reason."""
    nothing = xr.Dataset(coords={"speed": ("speed", np.empty(0), SPEED.attributes)})
    write_dataset(nothing, output, {**(attributes or {}), "refused": case.refused.split(";")[0]})


class Runs:
    """The runs of one case: files in a folder, and their costs, by speed (rad/s)."""

    def __init__(self, case: Case, model: ContactModel, recovery: StressOperator | None, folder: Path):
        assert case.scene is not None
        self.case, self.scene, self.model, self.recovery, self.folder = case, case.scene, model, recovery, folder
        self.files: dict[float, Path] = {}
        self.costs: dict[float, dict[str, float]] = {}
        self.histories = set(case.speeds if case.history_speeds is None else case.history_speeds)
        for number, speed in enumerate(case.speeds, 1):
            self.run(speed)
            if number % 100 == 0:
                print(f"{number} of {len(case.speeds)} speeds", flush=True)

    def _choice(self, speed: float) -> IntegrationChoice:
        case, choice = self.case, self.case.choice
        if "stress" in case.results:
            snapshot_revolutions = choice.revolutions if speed in self.histories else choice.revolutions_in_statistic
            choice = replace(choice, snapshot_revolutions=snapshot_revolutions)
        else:
            choice = replace(choice, snapshots_per_revolution=0, snapshot_revolutions=0)
        if case.share_of_limit is not None:
            middle = case.speeds[len(case.speeds) // 2]
            step = case.share_of_limit * 2.0 / self.model.modes_at(1.01 * middle)[0][-1]
            choice = replace(choice, time_step=step, shorten=False)
        if case.half_step:
            # of the step taken, which divides the sampling instants: half of the one asked for may give the same
            choice = replace(choice, time_step=0.5 * stable_problem(self.model, speed, self.scene, choice).grid.time_step)
        return choice

    def run(self, speed: float) -> None:
        """Simulate one speed (rad/s) and note what it costs."""
        case, integration, writing = self.case, Stopwatch(), Stopwatch()
        choice, file = self._choice(speed), self.folder / f"{speed!r}.npz"
        # compiled before it is timed
        prepared(self.model, speed, self.scene, choice)
        with integration:
            run = run_speed(self.model, speed, self.scene, choice, case.results, motion=None, stress=self.recovery, **case.kept)
        with writing:
            write_speed(run, file, {})
        self.files[speed] = file
        self.costs[speed] = {
            "cpu_s": integration.cpu,
            "wall_s": integration.wall,
            "file_cpu_s": writing.cpu,
            "bytes_written": file.stat().st_size,
        }

    def write(self, output: Path | str, attributes: Mapping[str, object]) -> None:
        """The response of all runs, ascending, with COSTS."""
        speeds, reducing, partial = sorted(self.files), Stopwatch(), self.folder / "response.nc"
        instants = self.case.choice.snapshots_per_revolution
        with reducing:
            write_response(
                [self.files[speed] for speed in speeds],
                speeds,
                partial,
                stress_history_speeds=sorted(self.histories) if self.recovery else (),
                yield_stress=self.case.material.yield_stress if self.case.material else math.inf,
                provenance=attributes,
            )
        with netCDF4.Dataset(partial, "a") as dataset:
            for name, variable in COSTS.items():
                values = [self.costs[speed][name] for speed in speeds]
                create_variable(dataset, name, variable)[:] = values
            if "instants" in self.case.results and self.recovery:
                dataset.createDimension("instant", instants)
                meaning = "largest von Mises stress at each instant of the last revolution"
                stress = create_variable(dataset, "max_von_mises_of_instant", Variable(("speed", "instant"), "Pa", meaning))
                for row, speed in enumerate(speeds):
                    run_case_values = self.recovery.max_von_mises(read_speed(self.files[speed])["snapshots"])
                    # a run that diverged has none
                    stress[row] = run_case_values if len(run_case_values) else np.nan
            dataset.setncatts({"reduction_cpu_s": reducing.cpu, "peak_memory_bytes": peak_memory()})
            # text where write_response puts text alone
            dataset.setncatts({name: value for name, value in attributes.items() if isinstance(value, float)})
        with atomic_write(output) as final:
            final.write_bytes(partial.read_bytes())


def energy_share(response: xr.Dataset) -> np.ndarray:
    """Part of the energy balance that stays open, as a share of all that went in and out, shape (speeds,)."""
    turned_over = np.abs(response["contact_work"].values) + response["damping_loss"].values
    residual = response["energy_residual"].values
    return np.divide(residual, turned_over, out=np.zeros_like(residual), where=turned_over > 0.0)
