"""Messages of the pipeline and its extensions: remarks before it starts, refused targets, and its last lines."""

import json
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path

import r37core
from r37core.base.io import InputFileError, function_named
from r37core.config import ConfigError, Settings
from r37core.config.remarks import remarks_of_pipeline
from r37core.config.settings import merged_settings
from r37core.plans.extension import Extension
from r37core.plans.extent import sizes
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.results.closing import counted

from .extensions import EXTENSIONS, whole_extent


def remarks(settings: Settings) -> list[str]:
    """How large a run is, and remarks of the pipeline and of all extensions."""
    lines = [line for extension in EXTENSIONS for line in extension.remarks(settings)]
    return [*sizes(settings, whole_extent(settings)), *remarks_of_pipeline(settings), *lines]


def check_asked(settings: Settings, targets: Collection[str]) -> None:
    """ConfigError for a target that makes all of one extension, and nothing else, where nothing is asked for of that."""
    sweep = Sweep(settings)
    for extension in EXTENSIONS:
        name = extension.name
        if name in targets and not any(extension.all_targets(sweep).values()):
            allowed = f"some under {name} in config.yaml" if extension.simulated(sweep) else "some that ask for it"
            file = f"config/{name}.yaml"
            if (settings.root / file).exists():
                command = f"snakemake {name} --cores 2 --configfile config/config.yaml {file}"
                allowed += f", or a file that has some, as in: {command}"
            refused = f"the target {name} and none of the blades and scenes that are run"
            raise ConfigError(f"{name}: found {refused}; allowed: {allowed}")


def lines_of_extensions(settings: Settings, began: float) -> list[str]:
    """A line for each extension that has made something since `began` (time in s, as file times are)."""
    lines = (line_of_extension(extension, Sweep(settings), settings.results, began) for extension in EXTENSIONS)
    return [line for line in lines if line]


def line_of_extension(extension: Extension, sweep: Sweep, results: Path, began: float) -> str:
    """Findings of an extension, in the folder `results`, and where to look; empty where all that it made is older."""
    files = [results / file.removeprefix("<results>/") for file in filled(extension.all_targets(sweep))]
    made = [file for file in files if file.exists() and file.stat().st_mtime >= began]
    if not made:
        return ""
    closing = f"{counted(len(made), 'file')} made"
    if extension.closing:
        # a file that cannot be read, or lacks a column, is no failure of the run that has ended: what reads it next refuses it
        with suppress(InputFileError, KeyError):
            closing = function_named(extension.closing)(results)
    # what a person opens, the best first
    order = {".html": 0, ".png": 1, ".csv": 2}
    best = min((file for file in files if file.exists()), key=lambda file: order.get(file.suffix, len(order)))
    look_at = results / extension.look_at.removeprefix("<results>/") if extension.look_at else best
    return f"{extension.name}: {closing}; look at {look_at}"


CONFIGURATION = "configuration.json"
"""File in the folder of the results with what the run was made with."""


def replaced_level(settings: Settings) -> list[str]:
    """A line for the user when the results that lie there were made with another fidelity level."""
    file = settings.results / CONFIGURATION
    try:
        before = json.loads(file.read_text(encoding="utf-8"))["fidelity"]
    except (OSError, ValueError, KeyError):
        return []
    now = merged_settings(settings)["fidelity"]
    if before == now:
        return []
    name = settings.fidelity_name
    names = f"the former {name}" if name in before else f"{', '.join(before)} by {name}"
    return [
        f"fidelity: results in {settings.results} that depend on the level are replaced, {names}; "
        "give this run a name (run.name in config.yaml, or --config run='{name: ...}') to keep both"
    ]


def source_folder(root: Path) -> Path:
    """The folder that r37core is imported from, whose code is hashed.

    Raises ConfigError unless that belongs to the rules in the folder `root`: it is the repository's, or both are installed.
    """
    imported = Path(r37core.__file__).resolve().parent.parent
    beside = (root / "src").resolve()
    if imported not in (beside, root.resolve().parent):
        raise ConfigError(
            f"r37core: found the package in {imported}; allowed: the one beside the Snakefile, {beside} "
            "(make setup there, and use its .venv/bin/snakemake)"
        )
    return imported
