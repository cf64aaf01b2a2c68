"""Build a model of a study. Input: geometry.nc. Params: choice, reduction, ... Outputs: rom, contact, cost."""

from job import run

from r37core.blade.geometry_file import read_geometry
from r37core.fem.material import Material
from r37core.io import write_json
from r37core.plain import from_plain
from r37core.rom.contact_model import write_contact_model
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import write_reduced_model
from r37core.studies.case import ModelChoice
from r37core.studies.models import build_model


def main(snakemake):
    params, made = snakemake.params, snakemake.output
    choice = from_plain(ModelChoice, params.choice)
    base, material = from_plain(ReductionChoice, params.reduction), from_plain(Material, params.material)
    model, cost = build_model(read_geometry(snakemake.input[0]), material, choice, base)
    write_reduced_model(model, made.rom, params.provenance)
    write_contact_model(contact_model(model, choice.tip_line), made.contact)
    write_json(cost, made.cost)


run(snakemake, main)
