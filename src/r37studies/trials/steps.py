"""Steps of the workflow (docs/architecture.md): models of cases, the cases, and the tables of a preset."""

from dataclasses import replace
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named, as_list, function_named, read_json, write_json, write_text
from r37core.base.plain import from_plain
from r37core.fem.steps import mesh as mesh_blade
from r37core.results.table_file import write_table
from r37core.rom.contact_model import read_contact_model
from r37core.rom.reduction_choice import BoundaryError
from r37core.rom.rom_file import read_reduced_model
from r37core.rom.steps import contact_model, reduced_model
from r37core.stress.recovery import stress_operators

from .case import Case
from .case_table import refusal
from .runner import run_case, timed


def model(input: Any, output: Any, params: Any) -> None:
    """Mesh, assemble and reduce for some cases. Input: geometry or mesh. Outputs: rom, contact, cost.

    The cost has CPU time (s), or the reason why the mesh cannot have the boundary nodes: the other files are
    empty then. Params: those of the reduced model (r37core.plans.stages); choice, in place of some, with mesh and tip_line.
    """
    values = Named(**{**dict(params.items()), **params.choice})

    def make() -> None:
        with TemporaryDirectory() as folder:
            mesh = getattr(input, "mesh", f"{folder}/mesh.vtu")
            if hasattr(input, "geometry"):
                mesh_blade(input, Named(msh=f"{folder}/mesh.msh", vtu=mesh), values)
            reduced_model(Named(mesh=mesh), output, values)
            contact_model(output, output, values)

    try:
        _, cpu = timed(make)
        write_json({"cpu_s": cpu}, output.cost)
    except BoundaryError as error:
        write_json({"refused": str(error)}, output.cost)
        for file in (output.rom, output.contact):
            write_text("", file)


def run(input: Any, output: Any, params: Any) -> None:
    """Run one case. Inputs: contact; rom for the stress, cost of the model, campbell for the speeds. Params: case.

    Output: response (nc). Raises ValueError for a crossing that the Campbell diagram does not have.
    """
    case, files = from_plain(Case, params.case), dict(input.items())
    costs = {f"model_{name}": value for name, value in (read_json(files["cost"]) if "cost" in files else {}).items()}
    if "model_refused" in costs:
        write_dataset(refusal(costs["model_refused"]), output.response)
        return
    if case.crossing:
        speed = crossing_speed(read_dataset(files["campbell"]), case)
        case = replace(case, speeds=tuple(float(share * speed) for share in case.speeds))
    material = case.material if "stress" in case.results else None
    operators = stress_operators(read_reduced_model(files["rom"]), material) if material else None
    write_dataset(
        run_case(case, read_contact_model(files["contact"]), operators), output.response, {"blade": case.blade, **costs}
    )


def crossing_speed(campbell: xr.Dataset, case: Case) -> float:
    """Highest speed (rad/s) in the diagram at which the mode of a case crosses an engine order.

    As far as there are some, only crossings count at which all speeds of the case lie in the diagram, too. Raises ValueError
    where there is none.
    """
    speeds = campbell["crossing_speed"].sel(mode=case.crossing)
    inside = speeds.where(case.speeds[-1] * speeds <= campbell["speed"].max())
    speed = float(inside.max() if inside.notnull().any() else speeds.max())
    if not np.isfinite(speed):
        raise ValueError(
            f"config.yaml: {case.crossing} of {case.blade} crosses no engine order below structure.maximum_speed_rad_s; choose "
            "a higher one"
        )
    return speed


def report(input: Any, output: Any, params: Any) -> None:
    """Tabulate the cases of a preset. Inputs: cases, the responses of those that were run. Output: table (csv).

    Params: table, the function that makes it, and its values, see PRESETS; reasons, of all cases, as of Trials.
    """
    files = iter(as_list(input.cases))
    responses = {name: refusal(why) if why else read_dataset(next(files)) for name, why in params.reasons.items()}
    write_table(function_named(f"{params.table}")(responses, **params.values), output.table, digits=6)
