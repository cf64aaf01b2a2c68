"""Reduced model from matrices of another program. Input: their files. Params: source, places, reduction. Output: rom.nc."""

from job import run, warnings_told

from r37core.exchange.importing.matrices_in import import_matrices
from r37core.exchange.importing.source import MatricesSource
from r37core.exchange.refusal import placed
from r37core.plain import from_plain
from r37core.rom.reduction_choice import ReductionChoice, boundary_placed
from r37core.rom.rom_file import write_reduced_model


def main(snakemake):
    params = snakemake.params
    choice = from_plain(ReductionChoice, params.reduction)
    with boundary_placed(params.contact["place"]), placed(params.places), warnings_told(params.places["matrices"]):
        model = import_matrices(from_plain(MatricesSource, params.source), choice, params.folder["folder"])
    print(f"{model.columns} columns, {model.size} independent at {model.tolerance:g}")
    write_reduced_model(model, snakemake.output[0], params.provenance)


run(snakemake, main)
