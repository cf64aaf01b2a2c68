"""What a run checks before it starts: its package, what a part of it may make, and whose results it replaces."""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path

import r37core
from r37core.config import ConfigError, Settings

CONFIGURATION = "configuration.json"
"""File in the folder of the results with what the run was made with."""

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
