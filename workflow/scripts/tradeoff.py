"""Gather the cases of the trade-off study. Inputs: cases. Params: references, tolerance. Outputs: dataset, tables, figures."""

from job import run

from r37core.dataset_file import read_dataset, write_dataset
from r37core.figures.style import save
from r37core.io import write_text
from r37core.studies.tradeoff import gather_cases
from r37core.studies.tradeoff_figures import draw_parameter, draw_pareto
from r37core.studies.tradeoff_table import level_table, parameter_tables


def main(snakemake):
    params, made = snakemake.params, snakemake.output
    together = gather_cases([read_dataset(file) for file in snakemake.input], params.references)
    write_dataset(together, made.dataset, params.provenance)
    write_text(level_table(together, params.tolerance), made.levels)
    write_text(parameter_tables(together, params.references), made.table)
    for parameter, file in zip(params.parameters, made.parameters, strict=True):
        save(draw_parameter(together, parameter), file)
    save(draw_pareto(together), made.pareto)


run(snakemake, main)
