"""The steps of requirements: further runs, and the verdict."""

from contextlib import nullcontext
from dataclasses import replace
from math import nan
from pathlib import Path
from typing import Any

import xarray as xr

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import as_list
from r37core.base.plain import from_plain
from r37core.fem.assembly import mesh_volume
from r37core.fem.material import Material
from r37core.machine_code.kept import content_digest
from r37core.mesh.mesh_files import read_vtu
from r37core.results.joining import Along, join
from r37core.results.operating_range import OperatingRange
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table, write_table
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from r37core.stress.statistic import Strengths
from r37core.sweep.parts import Parts
from r37studies.agreement import disagreements

from .choice import Requirements
from .evidence import Evidence, judged_part
from .judging import REST
from .looks import JudgedBlade, joined_looks, looks_in, looks_of
from .table import verdict_table


def look(input: Any, output: Any, params: Any) -> None:
    """Run what could overturn the verdict on one blade and scene. Inputs: response, model, and stress. Output: looks (nc).

    Inputs, of the model on a coarser mesh: coarser_contact and coarser_rom, empty where it cannot have the contact nodes.
    Params: material, scene, choice, results, kept, yield_stress, strengths, requirements, operating, known (Judged.known_of),
    provenance.
    """
    files = [input.model, *([input.stress] if hasattr(input, "stress") else [])]
    made_of = [params.code, params.results, params.kept, *map(content_digest, files)]
    parts, strengths = Parts(Path(output.looks).with_suffix(""), made_of), from_plain(Strengths, params.strengths)
    blade = JudgedBlade.read(input, params, yield_stress=params.yield_stress, strengths=strengths, parts=parts)
    blade = replace(blade, stress=blade.stress and dict([*blade.stress.items()][:1]))
    if hasattr(input, "coarser_contact") and Path(input.coarser_contact).stat().st_size:
        made_of += [content_digest(file) for file in (input.coarser_contact, input.coarser_rom)]
        parts, material = Parts(blade.parts.folder / "coarser", made_of), from_plain(Material, params.material)
        # the region that decides is the same
        operators = {name: stress_operator(read_reduced_model(input.coarser_rom), material) for name in blade.stress or {}}
        coarser = replace(blade, model=read_contact_model(input.coarser_contact), parts=parts, stress=operators or None)
        blade = replace(blade, coarser=coarser)
    evidence = Evidence(
        judged_part(read_judged(input.response)), operating=from_plain(OperatingRange, params.operating), **params.known
    )
    looks = looks_of(blade, from_plain(Requirements, params.requirements), evidence)
    write_dataset(joined_looks(dict(looks)), output.looks, params.provenance)


def judge(input: Any, output: Any, params: Any) -> None:
    """Judge each blade and scene. Outputs: verdict (csv), runs (nc): the further ones from rest.

    Inputs: datasets by kind, looks of `looked`, volumes (geometry or mesh of each blade with a density); if there, members,
    motions, run_ups and measured. Params: pairs, known (Judged.known_of of each), looked (those of them with looks),
    requirements, operating, densities.
    """
    files = dict(input.items())
    shapes = zip(params.densities.items(), as_list(files.pop("volumes")), strict=True)
    masses = {}
    for (blade, density), file in shapes:
        # of a geometry, or of the mesh of another program
        if file.endswith(".nc"):
            masses[blade] = density * float(read_dataset(file)["volume"])
        else:
            mesh = read_vtu(file)
            masses[blade] = density * mesh_volume(mesh.blocks, mesh.points)
    doubted = disagreements(read_table(files.pop("measured"))) if "measured" in files else {}
    looked = zip(map(tuple, params.looked), as_list(files.pop("looks", [])), strict=True)
    looks = {pair: looks_in(read_dataset(file)) for pair, file in looked}
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    requirements, operating = from_plain(Requirements, params.requirements), from_plain(OperatingRange, params.operating)
    known = {
        pair: {**fields, "mass": masses.get(pair[0], nan), "looks": looks.get(pair, {})}
        for pair, fields in zip(map(tuple, params.pairs), params.known, strict=True)
    }
    table = verdict_table(known, requirements, operating, datasets)
    notes = ((row.note, doubted.get((row.blade, row.scene))) for row in table.itertuples())
    table["note"] = ["; ".join(filter(None, both)) for both in notes]
    write_table(table, output.verdict, digits=6)
    runs = {
        pair: fields["looks"].get(REST, xr.Dataset()).drop_vars("followed", errors="ignore") for pair, fields in known.items()
    }
    join(runs, Along(), output.runs, "Further runs of a verdict from rest, over blade, scene and speed", {}, nullcontext)
