"""What a run says before it starts, and refuses of its targets."""

from __future__ import annotations

from collections.abc import Collection

from r37core.config import ConfigError, Settings
from r37core.config.remarks import remarks_of_pipeline
from r37core.plans.sweep_plan import Sweep

from .extensions import EXTENSIONS


def remarks(settings: Settings) -> list[str]:
    """Of the pipeline and of all extensions."""
    return [*remarks_of_pipeline(settings), *(line for extension in EXTENSIONS for line in extension.remarks(settings))]


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
