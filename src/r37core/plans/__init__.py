"""Plan of a run: paths, provenance, code hashes and plans, for the rules of the workflow. Works without Snakemake."""
