"""What a run keeps of its configuration, and what it says when it replaces another's results."""

from __future__ import annotations

import json

from r37core.config import Settings

CONFIGURATION = "configuration.json"
"""In the folder of the results."""


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
