"""Run an item of the evidence, or a run of the product behind it, whose name is a wildcard. Its log has what it prints."""

from evidence.made_from import note
from evidence.plan import Item, Plan, make

from r37core.base.process_wide import one_thread
from r37core.console.failures import reported

plan, name = Plan(), snakemake.wildcards.name
# the same bits on any number of cores
with reported(name, snakemake.log[0]), one_thread():
    make(plan, name, snakemake.threads)
    part = plan.part(name)
    if isinstance(part, Item):
        note(plan, part.files)
