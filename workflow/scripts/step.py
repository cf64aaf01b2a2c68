"""Run a step: a function (input, output, params) of the package, which `params.step` names.

What it prints goes to the rule's log, a failure ends in one clear message, and a text that it returns is shown to the user.
"""

import sys
import warnings
from contextlib import contextmanager, nullcontext
from importlib import import_module

from r37core.console.failures import note, reported, show


@contextmanager
def printed_warnings(locations):
    """Print what an import is warned of, after the location of its key: in the log, on the screen, and when the run ends."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    location = locations.get("mesh") or locations["matrices"]
    for warning in caught:
        print(line := f"{location}: {warning.message}")
        if issubclass(warning.category, UserWarning):
            show(line, sys.__stderr__)
            note(line)


def run(params):
    module, function = params.step.rsplit(".", 1)
    params.address = snakemake.report_href
    with printed_warnings(params.locations) if hasattr(params, "locations") else nullcontext():
        shown = getattr(import_module(module), function)(snakemake.input, snakemake.output, params)
    if shown:
        print(shown)
        show(shown, sys.__stderr__)


about = "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items() if value)
with reported(snakemake.rule, snakemake.log[0], about):
    run(snakemake.params)
