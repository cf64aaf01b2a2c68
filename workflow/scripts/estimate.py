"""What the whole sweep will cost. Inputs: samples (JSON). Params: workflow_s_per_job, cores, fidelity. Outputs: JSON, table."""

import json

from job import run

from r37core.io import atomic_write
from r37core.studies.estimate import describe, project_costs, time_start_up

# what the script of a simulation imports, Snakemake's own part of it included
IMPORTS = "from snakemake import script; import r37core.march.speed_run, r37core.march.speed_file"


def main(snakemake):
    params = snakemake.params
    samples = []
    for file in snakemake.input:
        with open(file, encoding="utf-8") as stream:
            samples.append(json.load(stream))
    estimate = project_costs(samples, time_start_up(IMPORTS), params.workflow_s_per_job, params.cores)
    with atomic_write(snakemake.output.json) as partial:
        partial.write_text(json.dumps(estimate, indent=1) + "\n", encoding="utf-8")
    with atomic_write(snakemake.output.table) as partial:
        partial.write_text(describe(estimate, params.fidelity), encoding="utf-8")


run(snakemake, main)
