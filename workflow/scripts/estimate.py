"""What the whole sweep will cost. Inputs: samples (JSON). Params: workflow_s_per_job, cores, fidelity. Outputs: JSON, table."""

from job import run

from r37core.io import read_json, write_json, write_text
from r37core.studies.estimate import describe, project_costs, time_start_up

# what the script of a simulation imports
IMPORTS = "import r37core.time_integration.speed_run, r37core.time_integration.speed_file"


def main(snakemake):
    params = snakemake.params
    samples = [read_json(file) for file in snakemake.input]
    estimate = project_costs(samples, time_start_up(IMPORTS), params.workflow_s_per_job, params.cores)
    write_json(estimate, snakemake.output.json)
    write_text(describe(estimate, params.fidelity), snakemake.output.table)


run(snakemake, main)
