"""How a script that Snakemake calls runs: output goes to the rule's log, a failure ends in one clear message."""

import sys
import warnings
from contextlib import contextmanager

from r37core.console.failures import note, reported


def run(snakemake, main):
    """Call `main(snakemake)` with everything printed going to the log; on an error print its message and exit 1."""
    about = "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items())
    with reported(snakemake.rule, snakemake.log[0], about):
        main(snakemake)


@contextmanager
def warnings_told(place):
    """Tell what a mesh or matrices are warned of, after `place`: in the log, on the screen, and when the run ends."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    for warning in caught:
        print(line := f"{place}: {warning.message}")
        if issubclass(warning.category, UserWarning):
            print(line, file=sys.__stderr__)
            note(line)
