"""Steps of the workflow (docs/architecture.md): models, cases and reports of studies."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import xarray as xr

from r37core.blade.geometry_file import read_geometry
from r37core.dataset_file import read_dataset, write_dataset
from r37core.fem.material import Material
from r37core.figures.style import save
from r37core.io import as_list, write_json, write_text
from r37core.plain import from_plain
from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import write_reduced_model

from .case import Case, ModelChoice
from .models import build_model
from .runner import run_case_of_files


def model(input: Any, output: Any, params: Any) -> None:
    """Build a model of a study. Input: geometry. Outputs: rom, contact, cost.

    Params: choice, reduction, material, provenance.
    """
    choice = from_plain(ModelChoice, params.choice)
    base, material = from_plain(ReductionChoice, params.reduction), from_plain(Material, params.material)
    made, cost = build_model(read_geometry(input.geometry), material, choice, base)
    write_reduced_model(made, output.rom, params.provenance)
    write_contact_model(contact_model(made, choice.tip_line), output.contact)
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
