"""Steps of the workflow (docs/architecture.md): a search, round by round, and what is made of all its designs."""

import math
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list, read_json, write_json
from r37core.base.origin import origin
from r37core.base.plain import from_plain
from r37core.base.varied_number import BLADE, VariedNumber
from r37core.blade.definition import shape_from_plain
from r37core.blade.geometry_file import read_geometry
from r37core.exchange.step_file import write_step
from r37core.machine_code.kept import content_digest
from r37core.results.operating_range import OperatingRange
from r37core.results.ranking import robustness
from r37core.results.regions import read_judged
from r37core.results.table_file import write_table
from r37core.rom.contact_model import read_contact_model
from r37core.rom.region_choice import RegionChoice
from r37core.stress.operator import judged_operator, read_stress_operators

from .dataset import BLADES_HEADER, SCENES_HEADER, search_dataset, search_table, write_entries
from .problem import SearchChoice
from .quantity import DesignStructure, Quantity, contact_value, static_stress, structure_value
from .rounds import first_round, progress, read_round, round_after, tried_after, write_round


def propose_round(input: Any, output: Any, params: Any) -> str:
    """Ask for designs, and say how far the search is. Output: round (json). Params: choice, round, number (of its designs).

    Inputs after the first round: before (the round before), built (which of its designs could not be), start, measures.
    """
    choice = from_plain(SearchChoice, params.choice)
    if params.round == 0:
        asked = first_round(params.number, choice)
    else:
        refused, before = read_json(input.built), read_round(input.before)
        names = [name for name in before.new if name not in refused]
        gave = {name: read_json(file) for name, file in zip(names, as_list(input.measures), strict=True)}
        tried = tried_after(before, params.round, refused, gave)
        asked = round_after(tried, read_json(input.start), params.number, choice)
    write_round(asked, output.round)
    return progress(asked, choice, params.round)


def shape(input: Any, output: Any, params: Any) -> None:
    """Test whether a design can be built. Output: shape (json). Params: shape, edges, mesh, stress_region."""
    # gmsh takes a second to load, which rounds have no use for
    from r37core.fem.mesh_quality import check_quality, mesh_quality
    from r37core.mesh.generate import generate_mesh

    refused, level = params.shape["refused"], params.mesh
    if refused is None and params.shape["definition"] is not None:
        try:
            blade = shape_from_plain(params.shape["definition"]).build(round_edges=params.edges == "round")
            mesh = generate_mesh(blade, level["nodes"], level["layers"], level["tip_elements"])
            check_quality(mesh, mesh_quality(mesh), level["minimum_scaled_jacobian"])
            region = from_plain(RegionChoice, params.stress_region)
            # elements next to contact nodes, which are known with the model, count here
            if not region.elements(mesh, np.empty(0, dtype=int)):
                raise ValueError(f"the stress region ({region.description()}) has no elements")
        except ValueError as error:
            refused = str(error)
    write_json({"refused": refused}, output.shape)


def built(input: Any, output: Any, params: Any) -> None:
    """Which designs of a round cannot be built, and why. Inputs: shapes. Output: built (json)."""
    refused = {Path(file).parent.name: read_json(file)["refused"] for file in as_list(input.shapes)}
    write_json({name: reason for name, reason in refused.items() if reason is not None}, output.built)


def measure(input: Any, output: Any, params: Any) -> None:
    """Quantities of a design. Inputs: geometry, campbell, contact, stress, responses. Output: measures (json).

    Params: quantities, scenes (how many of the responses are of each, the nominal one first), density, highest_speed,
    operating (the range, or None).
    """
    operating = params.operating and from_plain(OperatingRange, params.operating)
    quantities = from_plain(dict[str, Quantity], params.quantities)
    speeds = {quantity.speed or params.highest_speed for quantity in quantities.values()}
    stiffening = read_contact_model(input.contact).rotation_stiffening
    structure = DesignStructure(
        volume=float(read_dataset(input.geometry)["volume"]),
        density=params.density,
        campbell=read_dataset(input.campbell),
        static_stress=static_stress(judged_operator(read_stress_operators(input.stress)), stiffening, sorted(speeds)),
    )
    files = iter(as_list(input.responses))
    nominal, members = {}, {}
    for scene, number in params.scenes.items():
        nominal[scene] = robustness(read_judged(next(files)), operating=operating)
        several = map(read_judged, islice(files, number - 1))
        members[scene] = [robustness(member, chance_scatter=False, operating=operating) for member in several]
    values = {
        name: contact_value(quantity, nominal, members)
        if quantity.needs_contact
        else (structure_value(quantity, structure, params.highest_speed), 0.0)
        for name, quantity in quantities.items()
    }
    known = {name: [number if math.isfinite(number) else None for number in value] for name, value in values.items()}
    write_json(known, output.measures)


def join(input: Any, output: Any, params: Any) -> None:
    """Join all designs. Input: round, the last. Params: choice, fidelity. Outputs: dataset (nc), table (csv)."""
    made = {"fidelity": params.fidelity, "input_hash": content_digest(input.round)[:32]} | origin("Designs of a search")
    dataset = search_dataset(read_round(input.round), from_plain(SearchChoice, params.choice))
    write_dataset(dataset, output.dataset, made)
    write_table(search_table(dataset), output.table, digits=6)


def best(input: Any, output: Any, params: Any) -> None:
    """Write the best designs. Inputs: dataset, shapes (of designs with a blade of their own). Output: folder.

    Params: number; entries, of the start and its bases, where its blade varies; scenes, entries where they vary, and
    varied_in_scenes, by which variables.
    """
    search, folder = read_dataset(input.dataset), Path(output.folder)
    ordered = search.isel(design=np.flatnonzero(search["order"].values > 0)).sortby("order")
    designs = ordered["design"].values[: params.number].tolist()
    folder.mkdir(parents=True)
    if params.scenes:
        scenes = params.scenes, params.varied_in_scenes
        write_entries(search, designs, *scenes, SCENES_HEADER, folder / "scenes.yaml")
    if params.entries:
        numbers = map(VariedNumber.named, search["variable"].values.tolist())
        varied = {list(params.entries)[-1]: [number.key for number in numbers if number.kind == BLADE]}
        names = write_entries(search, designs, params.entries, varied, BLADES_HEADER, folder / "blades.yaml")
        files = {Path(file).parent.parent.name: file for file in as_list(input.shapes)}
        for name, design in zip(names, designs, strict=True):
            write_step(read_geometry(files[design]), folder / f"{name}.step")
