"""The command r37: a folder for a study, a Campbell diagram, a look at a configuration, without writing Python.

The calls are imported when they are first used, so that a word that computes nothing answers at once.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

import r37

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with these arguments, or those of the process.

    Gives its exit status: 1 after one line of refusal, and as a shell has it after Ctrl-C or where nobody reads on.
    """
    try:
        try:
            return _run(_parser().parse_args(arguments))
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt:
        print("r37: interrupted", file=sys.stderr)
        return 128 + signal.SIGINT
    except BrokenPipeError:
        # head, or a pager, has read enough; Python would flush what is left when it ends
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE


def _run(options: argparse.Namespace) -> int:
    try:
        with warnings.catch_warnings():
            # as one line: whoever uses the command did not write the line of code that warns
            warnings.showwarning = lambda message, *_, **__: print(f"r37: {message}", file=sys.stderr)
            options.run(options)
    except (ValueError, MemoryError, r37.InputFileError) as refusal:
        print(f"r37: {refusal}", file=sys.stderr)
        return 1
    return 0


_FIRST = """First, write a study and run it; what a run has found stands in results/:
  r37 init study && cd study && r37 check config/config.yaml
  snakemake all_blades --cores 2 --config fidelity=draft
With requirements in config/config.yaml, snakemake verdict says of each blade: meets, fails or cannot tell."""
"""Closing text of `r37 --help`."""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="r37",
        description="blade-tip rubbing in a compressor",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog=_FIRST,
    )
    parser.add_argument("--version", action="version", version=f"r37 {r37.__version__}", help="print the version and end")
    commands = parser.add_subparsers(required=True, metavar="command")
    diagram = commands.add_parser("campbell", help="natural frequencies and crossings of a blade")
    diagram.set_defaults(run=_campbell)
    diagram.add_argument("blade", help="its name, or a blades.yaml: each blade of it")
    diagram.add_argument("--config", help="a config.yaml in place of the shipped one")
    diagram.add_argument("--blades", help="a blades.yaml in place of the configuration's")
    diagram.add_argument("--fidelity", help="an accuracy level in place of the configuration's")
    check = commands.add_parser("check", help="validate a configuration, and count its simulations")
    check.set_defaults(run=_check)
    check.add_argument("config", nargs="*", help="a config.yaml and files of changes on top; without any the shipped one")
    folder = commands.add_parser("init", help="write a folder for a study of one's own: configuration, Snakefile, profiles")
    folder.set_defaults(run=_init)
    folder.add_argument("folder", help="new or empty")
    report = commands.add_parser("report", help="pack a finished run into report.zip, for a colleague")
    report.set_defaults(run=_report)
    report.add_argument("results", nargs="?", default="results", help="folder of the run; without it results")
    return parser


def _init(options: argparse.Namespace) -> None:
    r37.init(options.folder)
    print(f"{options.folder}: edit config/, then, in that folder: snakemake all_blades --cores 2")


def _report(options: argparse.Namespace) -> None:
    done = subprocess.run([sys.executable, "-m", "r37core.console.report", options.results], check=False)
    sys.exit(done.returncode)


def _campbell(options: argparse.Namespace) -> None:
    is_file = options.blade.endswith((".yaml", ".yml"))
    if is_file and options.blades is not None:
        raise r37.ConfigError(f"--blades: found {options.blades} beside the file {options.blade}; allowed: one of them")
    file = options.blade if is_file else options.blades
    names = r37.blades(file=file, config=options.config) if is_file else [options.blade]
    for name in names:
        if len(names) > 1:
            print(name)
        chosen = r37.blade(name, file=file, config=options.config)
        dataset = r37.campbell(chosen, fidelity=options.fidelity, config=options.config)
        print(_campbell_table(dataset).to_string(float_format=lambda number: f"{number:.6g}", na_rep=""))


def _campbell_table(dataset: xr.Dataset) -> pd.DataFrame:
    """A row per mode, with the five lowest engine orders that it crosses; the dataset has all."""
    import pandas as pd

    frequency = dataset["frequency"]
    fastest = f"at {frequency['speed'].values[-1]:.6g} rad/s (Hz)"
    table = pd.DataFrame({"at rest (Hz)": frequency.isel(speed=0).values}, index=dataset["mode"].to_index())
    table[fastest] = frequency.isel(speed=-1).values
    crossings = [dataset["crossing_speed"].sel(mode=mode).dropna("engine_order").to_series() for mode in table.index]
    texts = [[f"{order}: {speed:.6g}" for order, speed in of.items()] for of in crossings]
    table["crosses engine orders at (rad/s)"] = [", ".join(of[:5]) or "none" for of in texts]
    return table


def _check(options: argparse.Namespace) -> None:
    from r37core.config.remarks import remarks_at_end
    from r37core.product.extensions import load_settings
    from r37core.product.remarks import remarks

    from .call_configuration import read_configuration

    first, *changes = options.config or [None]
    configuration = read_configuration(first).changed_by(changes)
    settings = load_settings(configuration.document, configuration.root)
    print(f"blades: {', '.join(settings.blade_names)}")
    print(f"scenes: {', '.join(settings.scene_names)}")
    print(f"level: {settings.fidelity_name}")
    for remark in [*remarks(settings), *remarks_at_end(settings)]:
        print(remark)
