"""Steps of the workflow (docs/architecture.md): models, cases and reports of studies."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import xarray as xr

from r37core.blade.geometry_file import read_geometry
from r37core.dataset_file import read_dataset, write_dataset
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.figures.style import save
from r37core.io import as_list, write_json, write_text
from r37core.mesh.generate import generate_mesh
from r37core.plain import from_plain
from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import EVERYWHERE, BoundaryChoice, ReductionChoice
from r37core.rom.rom_file import write_reduced_model

from .case import Case, ModelChoice
from .costs import Stopwatch, peak_memory
from .runner import run_case_of_files


def model(input: Any, output: Any, params: Any) -> None:
    """Mesh, assemble and reduce for a study. Input: geometry. Outputs: rom, contact, cost (CPU and wall s, memory in bytes).

    Params: choice, reduction (what the choice leaves open), material, provenance.
    """
    choice = from_plain(ModelChoice, params.choice)
    base, material = from_plain(ReductionChoice, params.reduction), from_plain(Material, params.material)
    reduction = replace(
        base,
        boundary=BoundaryChoice(choice.tip_line, choice.boundary_nodes, choice.corners, contact=base.boundary.contact),
        fixed_interface_modes=choice.fixed_interface_modes,
        stress_submesh=EVERYWHERE if choice.whole_blade_stress else base.stress_submesh,
    )
    # as in fidelity.yaml: a multiple of 7, for 8 evenly spaced boundary nodes
    tip_elements = 7 * max(1, round(0.04 * np.sqrt(choice.nodes)))
    blade, clock = read_geometry(input.geometry), Stopwatch()
    with clock:
        mesh = generate_mesh(blade, choice.nodes, layers=1, tip_elements=tip_elements)
        reduced = reduce_blade(mesh, assemble(mesh, material), reduction)
    cost = {"cpu_s": clock.cpu, "wall_s": clock.wall, "peak_memory_bytes": peak_memory()}
    write_reduced_model(reduced, output.rom, params.provenance)
    write_contact_model(contact_model(reduced, choice.tip_line), output.contact)
    write_json(cost, output.cost)


def case(input: Any, output: Any, params: Any) -> None:
    """Run one case of a study. Inputs: contact, and rom, cost, ... if needed. Params: case. Output: response (nc)."""
    run_case_of_files(from_plain(Case, params.case), dict(input.items()), output.response)


def report(input: Any, output: Any, params: Any) -> None:
    """Report of a study. Inputs: cases (their responses), and what else it reads. Params: study, cases, values."""
    responses = {name: read_dataset(file) for name, file in zip(params.cases, as_list(input.cases), strict=True)}
    contents = import_module(f"r37core.studies.{params.study}.report").report(responses, input, params.values)
    for name, content in contents.items():
        file = getattr(output, name)
        if isinstance(content, str):
            write_text(content, file)
        elif isinstance(content, xr.Dataset):
            write_dataset(content, file)
        elif callable(content):
            content(file)
        else:
            save(content, file)
