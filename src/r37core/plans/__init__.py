"""What runs when: paths, provenance, code hashes and plans, for the rules of the workflow. Works without Snakemake."""
