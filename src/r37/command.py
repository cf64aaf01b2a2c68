"""The command r37: a Campbell diagram, a response, or a look at a configuration, without writing Python."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
import xarray as xr

from r37core.config import load_settings
from r37core.dataset_file import write_dataset
from r37core.io import InputFileError
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.status import RunStatus

from .call_configuration import read_configuration
from .simulations import campbell, sweep


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with these arguments, or those of the process. Gives its exit status: 1 after one line of refusal."""
    given = _parser().parse_args(arguments)
    try:
        given.run(given)
    except (ValueError, InputFileError) as refusal:
        print(f"r37: {refusal}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="r37", description="blade-tip rubbing in a compressor")
    commands = parser.add_subparsers(required=True, metavar="command")
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument("--config", help="a config.yaml in place of the shipped one")
    common.add_argument("--fidelity", help="an accuracy level in place of the configuration's")
    common.add_argument("--output", type=Path, help="netCDF file to write the dataset to")
    diagram = commands.add_parser("campbell", parents=[common], help="natural frequencies and crossings of a blade")
    diagram.set_defaults(run=_campbell)
    response = commands.add_parser("simulate", parents=[common], help="response of a blade in a scene")
    response.set_defaults(run=_simulate)
    for command in (diagram, response):
        command.add_argument("blade")
    response.add_argument("scene")
    response.add_argument("speeds", nargs="+", type=float, metavar="speed", help="rad/s")
    check = commands.add_parser("check", help="validate a configuration, and count its simulations")
    check.set_defaults(run=_check)
    check.add_argument("config", nargs="?", help="a config.yaml; without it the shipped one")
    return parser


def _campbell(given: argparse.Namespace) -> None:
    dataset = campbell(given.blade, fidelity=given.fidelity, config=given.config)
    table = pd.DataFrame({"at rest (Hz)": dataset["frequency"].isel(speed=0).values}, index=dataset["mode"].to_index())
    crossings = dataset["crossing_speed"].sel(mode="1B").dropna("engine_order")
    for order in crossings["engine_order"].values[:_MOST_ORDERS]:
        table[f"crosses {order} (rad/s)"] = dataset["crossing_speed"].sel(engine_order=order).values
    _show(table)
    _write(dataset, given.output)


_MOST_ORDERS = 6
"""Engine orders of the table, from the lowest that 1B crosses; the dataset has all."""


def _simulate(given: argparse.Namespace) -> None:
    dataset = sweep(given.blade, given.scene, given.speeds, fidelity=given.fidelity, config=given.config)
    edge, table = dataset.sel(tip_point="leading_edge"), pd.DataFrame(index=dataset["speed"].to_index().rename("speed (rad/s)"))
    table["rms, normal (mm)"] = 1e3 * edge["rms_normal"].values
    table["rms, tangential (mm)"] = 1e3 * edge["rms_tangential"].values
    if "max_von_mises" in dataset:
        table["largest von Mises (MPa)"] = 1e-6 * dataset["max_von_mises"].values
    table["status"] = [RunStatus(int(status)).text for status in dataset["status"].values]
    _show(table)
    _write(dataset, given.output)


def _check(given: argparse.Namespace) -> None:
    configuration = read_configuration(given.config)
    settings = load_settings(configuration.document, configuration.root)
    certain, most = sum(len(plan.certain) for plan in settings.speed_plans.values()), Sweep(settings).most_runs
    print(f"blades: {', '.join(settings.blade_names)}")
    print(f"scenes: {', '.join(settings.scene_names)}")
    print(f"level: {settings.fidelity_name}")
    print(f"simulations: {certain}" if most == certain else f"simulations: {certain} to about {most}")
    for remark in settings.remarks:
        print(remark)


def _show(table: pd.DataFrame) -> None:
    print(table.to_string(float_format=lambda number: f"{number:.6g}", na_rep=""))


def _write(dataset: xr.Dataset, file: Path | None) -> None:
    if file is not None:
        write_dataset(dataset, file)
