"""What a run says before it starts, and refuses of its targets."""

from __future__ import annotations

from collections.abc import Collection

from r37core.config import ConfigError, Settings
from r37core.config.remarks import remarks_of_spine
from r37core.plans.sweep_plan import Sweep

from .wings import WINGS


def remarks(settings: Settings) -> list[str]:
    """Of the spine and of all wings."""
    return [*remarks_of_spine(settings), *(line for wing in WINGS for line in wing.remarks(settings))]


def check_asked(settings: Settings, targets: Collection[str]) -> None:
    """ConfigError for a target that makes all of one wing, and nothing else, where nothing is asked for of that."""
    for wing in WINGS:
        if wing.name in targets and not any(wing.all_targets(Sweep(settings)).values()):
            allowed = f"some under {wing.name} in config.yaml" if wing.simulated(Sweep(settings)) else "some that ask for it"
            file = f"config/{wing.name}.yaml"
            if (settings.root / file).exists():
                allowed += (
                    f", or a file that has some, as in: snakemake {wing.name} --cores 2 --configfile config/config.yaml {file}"
                )
            raise ConfigError(
                f"{wing.name}: found the target {wing.name} and none of the blades and scenes that are run; allowed: {allowed}"
            )
