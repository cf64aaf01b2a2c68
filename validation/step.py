"""Run an item of the evidence, or a run of the product behind it, whose name is a wildcard. Its log has what it prints."""

from evidence.plan import Plan, make

from r37core.console.failures import reported

with reported(snakemake.wildcards.name, snakemake.log[0]):
    make(Plan(), snakemake.wildcards.name, snakemake.threads)
