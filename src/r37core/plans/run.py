"""What a run keeps of its configuration, what it says when it replaces another's results, and what a part of one may make."""

from __future__ import annotations

import json
from collections.abc import Collection

from r37core.config import ConfigError, Settings

CONFIGURATION = "configuration.json"
"""In the folder of the results."""

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
