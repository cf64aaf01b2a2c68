"""How a script that Snakemake calls runs: output goes to the rule's log, a failure ends in one clear message."""

from r37core.console.failures import reported


def run(snakemake, main):
    """Call `main(snakemake)` with everything printed going to the log; on an error print its message and exit 1."""
    about = "".join(f"{name} {value}, " for name, value in snakemake.wildcards.items())
    with reported(snakemake.rule, snakemake.log[0], about):
        main(snakemake)
