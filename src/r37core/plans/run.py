"""What a run checks before it starts: its package, what a part of it may make, and whose results it replaces."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path

import r37core
from r37core.config import ConfigError, Settings

from .run_up_plan import RunUps
from .sweep_plan import Sweep

CONFIGURATION = "configuration.json"
"""In the folder of the results."""

RUN_UPS = "run_ups"
"""The rule that makes the run-ups and nothing else."""

RESPONSES = "responses"
"""The rule that makes what lies in the folders of the blades, and nothing of all blades together."""


def check_part(settings: Settings, targets: Collection[str]) -> None:
    """ConfigError for a part of the blades with other targets: datasets of a part would replace those of all blades."""
    part = settings.config.run.part
    if part is not None and set(targets) != {RESPONSES}:
        raise ConfigError(
            f"run.part: found {part} with the target {', '.join(sorted(targets)) or 'all_blades'}; "
            f"allowed: the target {RESPONSES}, as in: "
            f"snakemake {RESPONSES} --config run='{{part: {part}}}'; then all_blades without a part"
        )


def check_run_ups(settings: Settings, targets: Collection[str]) -> None:
    """ConfigError for the target of the run-ups where none are asked for."""
    if RUN_UPS in targets and not RunUps(Sweep(settings)).files:
        raise ConfigError(
            f"run_ups: found the target {RUN_UPS} and no run-up of the blades and scenes that are run; "
            "allowed: some under run_ups in config.yaml, or a file that has some, as in: "
            f"snakemake {RUN_UPS} --cores 2 --configfile config/config.yaml config/run_ups.yaml"
        )


def replaced_level(settings: Settings) -> list[str]:
    """A line for the user when the results that lie there were made with another fidelity level."""
    file = settings.results / CONFIGURATION
    try:
        before = json.loads(file.read_text(encoding="utf-8"))["fidelity"]
    except (OSError, ValueError, KeyError):
        return []
    now = settings.merged()["fidelity"]
    if before == now:
        return []
    name = settings.fidelity_name
    names = f"the former {name}" if name in before else f"{', '.join(before)} by {name}"
    return [
        f"fidelity: results in {settings.results} that depend on the level are replaced, {names}; "
        "give this run a name (run.name in config.yaml, or --config run='{name: ...}') to keep both"
    ]


def check_tree(root: Path) -> None:
    """Raise ConfigError unless r37core is imported from the folder `root` of the Snakefile, whose code is hashed."""
    imported, beside = Path(r37core.__file__).resolve().parent, (root / "src" / "r37core").resolve()
    if imported != beside:
        raise ConfigError(
            f"r37core: found the package in {imported}; allowed: the one beside the Snakefile, {beside} "
            "(make setup there, and use its .venv/bin/snakemake)"
        )
