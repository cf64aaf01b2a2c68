"""How every script runs: output goes to the rule's log, a failure ends in one clear message."""

import contextlib
import sys
import traceback


def run(snakemake, main):
    """Call `main(snakemake)` with everything printed going to the log; on an error print its message and exit 1."""
    with open(snakemake.log[0], "w", encoding="utf-8") as log:
        try:
            with contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
                main(snakemake)
        except Exception as error:
            traceback.print_exc(file=log)
            print(f"rule {snakemake.rule}: {error} (details in {snakemake.log[0]})", file=sys.stderr)
            sys.exit(1)
