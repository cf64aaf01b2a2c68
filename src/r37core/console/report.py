"""Snakemake's report of a finished run, with the configuration of that run: `r37 report RESULTS`."""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from r37core.base.io import READ_ONLY
from r37core.config.settings import results_folder
from r37core.product.remarks import CONFIGURATION


def main(arguments: Sequence[str] | None = None) -> int:
    """Write report.zip into the folder of a run's results; its exit status, 1 after a line of refusal."""
    results = Path((sys.argv[1:] if arguments is None else arguments)[0])
    try:
        config = configuration_of(results)
        if not os.access(results, os.W_OK):
            raise ValueError(f"{results}: cannot be written; {READ_ONLY}")
    except ValueError as refusal:
        print(refusal, file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, CONFIGURATION)
        file.write_text(json.dumps(config), encoding="utf-8")
        command = ["all_blades", "--report", f"{results}/report.zip", "--configfile", str(file), "--replace-workflow-config"]
        done = subprocess.run([sys.executable, "-m", "snakemake", *command], check=False)
    if done.returncode:
        remedy = "where results are missing, give the command of the run again, then r37 report"
        print(f"{results}: no report; {remedy}", file=sys.stderr)
    return done.returncode


def configuration_of(results: Path) -> Mapping[str, Any]:
    """Settings of the run in the folder `results`, of config.yaml and command line; ValueError where no run lies there."""
    file = results / CONFIGURATION
    try:
        config: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))["config"]
        folder = results_folder(config["run"].get("name"))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        runs = sorted(str(path.parent) for path in Path().glob(f"{results_folder('*')}/{CONFIGURATION}"))
        others = f"; runs with a name: {', '.join(runs)}" if runs else ""
        raise ValueError(
            f"report: found {results}, where no {CONFIGURATION} of a run lies; allowed: the folder of a run, as in: "
            f"r37 report, or r37 report {results_folder('NAME')}{others}"
        ) from None
    if results.resolve() != folder.resolve():
        raise ValueError(f"report: found {results}, a copy of the results in {folder}; allowed: {folder}")
    return config


if __name__ == "__main__":
    sys.exit(main())
