"""Build a model unlike its level's. Input: geometry.nc. Params: choice, reduction, ... Outputs: rom, contact, cost."""

from job import run

from r37core.blade.geometry_file import read_geometry
from r37core.fem.material import Material
from r37core.io import write_json
from r37core.rom.contact_model import write_contact_model
from r37core.rom.contact_reduction import contact_model
from r37core.rom.reduction_choice import ReductionChoice
from r37core.rom.rom_file import write_reduced_model
from r37core.studies.models import ModelChoice, build_model


def main(snakemake):
    params = snakemake.params
    base = ReductionChoice.from_plain(params.reduction)
    blade = read_geometry(snakemake.input[0])
    choice = ModelChoice(**params.choice)
    model, cost = build_model(blade, Material(**params.material), choice, base)
    write_reduced_model(model, snakemake.output.rom, params.provenance)
    write_contact_model(contact_model(model, choice.tip_line), snakemake.output.contact)
    write_json(cost, snakemake.output.cost)


run(snakemake, main)
