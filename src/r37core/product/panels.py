"""What the wings show in the explorer, as inputs and parameters of its rule."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from r37core.plans.code import CodeHashes
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep

from .wings import WINGS

_PACKAGE = Path(__file__).parent.parent


def panel_files(sweep: Sweep) -> dict[str, str]:
    """Wing -> the dataset that its panels show; those of wings that have one in this run."""
    files = {wing.name: filled(wing.panel.dataset(sweep)) for wing in WINGS if wing.panel}
    return {name: file for name, (file,) in ((name, several) for name, several in files.items() if several)}


def panel_parameters(sweep: Sweep, code: CodeHashes) -> dict[str, Any]:
    """Parameters of the explorer's step: its code with that of the panels, their functions and their programs, by wing."""
    panels = {wing.name: wing.panel for wing in WINGS if wing.panel and wing.name in panel_files(sweep)}
    modules = [panel.contents.rpartition(".")[0] for panel in panels.values()]
    return {
        **code.step("explorer.steps.explorer", *modules),
        "panels": {name: f"r37core.{panel.contents}" for name, panel in panels.items()},
        "programs": [str(_PACKAGE / panel.program) for panel in panels.values()],
    }
