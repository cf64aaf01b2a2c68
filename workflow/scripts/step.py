"""Run a step: a function (input, output, params) of the package, which `params.step` names.

What it prints goes to the rule's log, a failure ends in one clear message, and a text that it returns is shown to the user.
"""

import sys
from contextlib import nullcontext

from r37core.base.io import function_named
from r37core.base.process_wide import one_thread
from r37core.console.failures import printed_warnings, reported, show


def run(params):
    params.cores = snakemake.threads
    warned = printed_warnings(params.locations) if hasattr(params, "locations") else nullcontext()
    # Snakemake lets linear algebra use all cores of a job, which are for its forks
    with warned, one_thread() if params.cores > 1 else nullcontext():
        shown = function_named(params.step)(snakemake.input, snakemake.output, params)
    if shown:
        print(shown)
        show(shown, sys.__stderr__)


about = "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items() if value)
with reported(snakemake.rule, snakemake.log[0], about):
    run(snakemake.params)
