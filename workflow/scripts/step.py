"""Run a step: a function (input, output, params) of the package, which `params.step` names.

What it prints goes to the rule's log, a failure ends in one clear message, and a text that it returns is shown to the user.
"""

import os
import sys
from contextlib import nullcontext
from importlib import import_module

from r37core.console.failures import printed_warnings, reported, show


def run(params):
    module, function = params.step.rsplit(".", 1)
    params.cores = snakemake.threads
    warned = printed_warnings(params.locations) if hasattr(params, "locations") else nullcontext()
    with warned, one_thread() if params.cores > 1 else nullcontext():
        shown = getattr(import_module(module), function)(snakemake.input, snakemake.output, params)
    if shown:
        print(shown)
        show(shown, sys.__stderr__)


def one_thread():
    """One thread of linear algebra: Snakemake has it use the cores of a job, which are for forks, and adds in another order."""
    from threadpoolctl import threadpool_limits

    # for libraries that are loaded later, and for those that are
    os.environ.update({f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "OMP", "MKL")})
    return threadpool_limits(1)


about = "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items() if value)
with reported(snakemake.rule, snakemake.log[0], about):
    run(snakemake.params)
