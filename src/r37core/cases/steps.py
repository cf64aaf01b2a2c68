"""Steps of the workflow (docs/architecture.md): models of cases, and the cases."""

from dataclasses import replace
from typing import Any

import numpy as np

from r37core.base.io import write_json, write_text
from r37core.base.plain import from_plain
from r37core.blade.geometry_file import read_geometry
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import read_vtu
from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import ReducedModel, contact_model
from r37core.rom.reduction_choice import BoundaryError, ReductionChoice
from r37core.rom.region_choice import EVERYWHERE
from r37core.rom.rom_file import write_reduced_model

from .case import OWN_MESH, Case, ModelChoice
from .runner import peak_memory, run_case_of_files, timed


def model(input: Any, output: Any, params: Any) -> None:
    """Mesh, assemble and reduce for some cases. Input: geometry or mesh. Outputs: rom, contact, cost.

    The cost has CPU and wall time (s) and memory (bytes), or the reason why the mesh cannot have the boundary nodes: the other
    files are empty then. Params: choice, reduction (what the choice leaves open), material, provenance.
    """
    choice = from_plain(ModelChoice, params.choice)
    base, material = from_plain(ReductionChoice, params.reduction), from_plain(Material, params.material)
    nodes, corners = choice.boundary_nodes or None, choice.tip_ends == "corners"
    reduction = replace(
        base,
        boundary=replace(base.boundary, tip_line=choice.tip_line, nodes=nodes, corners=corners),
        fixed_interface_modes=choice.fixed_interface_modes,
        stress_regions={"whole": EVERYWHERE} if choice.stress_region == "whole" else base.stress_regions,
    )

    def reduced_model() -> ReducedModel:
        mesh = read_vtu(input.mesh) if choice.nodes == OWN_MESH else _meshed(input.geometry, choice.nodes)
        return reduce_blade(mesh, assemble(mesh, material), reduction, material)

    try:
        reduced, cpu, wall = timed(reduced_model)
    except BoundaryError as error:
        write_json({"refused": str(error)}, output.cost)
        for file in (output.rom, output.contact):
            write_text("", file)
        return
    write_json({"cpu_s": cpu, "wall_s": wall, "peak_memory_bytes": peak_memory()}, output.cost)
    write_reduced_model(reduced, output.rom, params.provenance)
    write_contact_model(contact_model(reduced, choice.tip_line), output.contact)


def _meshed(geometry: str, nodes: int) -> BladeMesh:
    # as in fidelity.yaml: a multiple of 7, for 8 evenly spaced boundary nodes
    tip_elements = 7 * max(1, round(0.04 * np.sqrt(nodes)))
    return generate_mesh(read_geometry(geometry), nodes, layers=1, tip_elements=tip_elements)


def run(input: Any, output: Any, params: Any) -> None:
    """Run one case. Inputs: contact, and rom, cost, campbell if needed. Params: case. Output: response (nc)."""
    run_case_of_files(from_plain(Case, params.case), dict(input.items()), output.response)
