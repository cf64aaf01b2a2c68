"""Steps of the workflow (docs/architecture.md): models of cases, the cases, and the tables of a preset."""

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list, function_named, read_json, write_json, write_text
from r37core.base.plain import from_plain
from r37core.blade.geometry_file import read_geometry
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.machine_code.kept import content_digest
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import read_vtu
from r37core.results.table_file import write_table
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.reduction_choice import BoundaryChoice, BoundaryError, ReductionChoice
from r37core.rom.region_choice import RegionChoice
from r37core.rom.rom_file import read_reduced_model, write_reduced_model
from r37core.stress.recovery import stress_operators
from r37core.sweep.parts import Parts
from r37studies.other_models import tip_elements

from .case import Case
from .case_table import refusal
from .runner import peak_memory, run_case, timed


def model(input: Any, output: Any, params: Any) -> None:
    """Mesh, assemble and reduce for some cases. Input: geometry or mesh. Outputs: rom, contact, cost.

    The cost has CPU and wall time (s) and memory (bytes), or the reason why the mesh cannot have the boundary nodes: the other
    files are empty then. Params: choice (nodes of a mesh that is generated, boundary, reduction, stress_regions), material,
    provenance.
    """
    choice, material = params.choice, from_plain(Material, params.material)
    boundary = from_plain(BoundaryChoice, choice["boundary"])
    reduction = from_plain(ReductionChoice, choice["reduction"])
    regions = from_plain(dict[str, RegionChoice], choice["stress_regions"])

    def reduced_model() -> ReducedModel:
        if hasattr(input, "mesh"):
            mesh = read_vtu(input.mesh)
        else:
            nodes = choice["nodes"]
            mesh = generate_mesh(read_geometry(input.geometry), nodes, layers=1, tip_elements=tip_elements(nodes))
        return reduce_blade(mesh, assemble(mesh, material), material, boundary, reduction, regions)

    try:
        reduced, cpu, wall = timed(reduced_model)
    except BoundaryError as error:
        write_json({"refused": str(error)}, output.cost)
        for file in (output.rom, output.contact):
            write_text("", file)
        return
    write_json({"cpu_s": cpu, "wall_s": wall, "peak_memory_bytes": peak_memory()}, output.cost)
    write_reduced_model(reduced, output.rom, params.provenance)
    write_contact_model(contact_model(reduced, boundary.tip_line), output.contact)


def run(input: Any, output: Any, params: Any) -> None:
    """Run one case. Inputs: contact; rom for the stress, cost of the model, campbell for the speeds. Params: case.

    Output: response (nc). Raises ValueError for a crossing that the Campbell diagram does not have. A case that was interrupted
    goes on.
    """
    case, files = from_plain(Case, params.case), dict(input.items())
    costs = {f"model_{name}": value for name, value in (read_json(files["cost"]) if "cost" in files else {}).items()}
    if "model_refused" in costs:
        write_dataset(refusal(costs["model_refused"]), output.response)
        return
    if case.crossing:
        speed = crossing_speed(read_dataset(files["campbell"]), case)
        case = replace(case, speeds=tuple(float(share * speed) for share in case.speeds))
    read, costs["reading_cpu_s"], _ = timed(lambda: read_contact_model(files["contact"]))
    material = case.material if "stress" in case.results else None
    operators, costs["recovery_cpu_s"], _ = timed(
        lambda: stress_operators(read_reduced_model(files["rom"]), material) if material else None
    )
    made_of = [params.code, *(content_digest(files[name]) for name in ("contact", "rom") if name in files)]
    parts = Parts(Path(output.response).with_suffix(".parts"), made_of)
    write_dataset(run_case(case, read, operators, parts), output.response, {"blade": case.blade, **costs})
    shutil.rmtree(parts.folder, ignore_errors=True)


def crossing_speed(campbell: xr.Dataset, case: Case) -> float:
    """Speed (rad/s) of the crossing of a case; without an engine order the highest one in the diagram.

    As far as there are some, only crossings count at which all speeds of the case lie in the diagram, too. Raises ValueError
    where there is none.
    """
    assert case.crossing
    mode, engine_order = case.crossing
    speeds = campbell["crossing_speed"].sel(mode=mode)
    if engine_order:
        speeds = speeds.sel(engine_order=[engine_order])
    inside = speeds.where(case.speeds[-1] * speeds <= campbell["speed"].max())
    speed = float(inside.max() if inside.notnull().any() else speeds.max())
    if not np.isfinite(speed):
        order = f"engine order {engine_order}" if engine_order else "any engine order"
        raise ValueError(
            f"config.yaml: {mode} of {case.blade} does not cross {order} below structure.maximum_speed_rad_s; choose another "
            "engine_order, or a higher structure.maximum_speed_rad_s"
        )
    return speed


def report(input: Any, output: Any, params: Any) -> None:
    """Tabulate the cases of a preset. Inputs: cases, the responses of those that were run. Outputs: TABLES of the preset.

    Params: module and values of the tables, see PRESETS; reasons, of all cases, as of Trials.
    """
    files = iter(as_list(input.cases))
    responses = {name: refusal(why) if why else read_dataset(next(files)) for name, why in params.reasons.items()}
    made = function_named(f"{params.module}.tables")(responses, **params.values)
    for name, file in output.items():
        if file.endswith(".csv"):
            write_table(made[name], file, digits=6)
        else:
            write_dataset(made[name], file)
