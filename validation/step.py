"""Run a step of the evidence: a function (input, output, params) that `params.step` names. Its log has what it prints."""

from importlib import import_module

from r37core.console.failures import reported

with reported(snakemake.rule, snakemake.log[0], "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items())):
    module, function = snakemake.params.step.rsplit(".", 1)
    getattr(import_module(module), function)(snakemake.input, snakemake.output, snakemake.params)
