"""What the extensions show in the explorer, as inputs and parameters of its rule."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from r37core.plans.extension import Panel
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep

from .extensions import EXTENSIONS

_PACKAGE = Path(__file__).parent.parent


def panel_files(sweep: Sweep) -> dict[str, str]:
    """Extension -> the dataset that its panels show; those of extensions that have one in this run."""
    return {name: file for name, panel in _panels(sweep).items() for file in filled(panel.dataset(sweep))}


def panel_modules(sweep: Sweep) -> list[str]:
    """Modules of the functions that make the panels' contents, which the explorer's step imports by name."""
    return [panel.contents.rpartition(".")[0] for panel in _panels(sweep).values()]


def panel_parameters(sweep: Sweep) -> dict[str, Any]:
    """Parameters of the explorer's step: functions and programs of the panels."""
    panels = _panels(sweep)
    return {
        "panels": {name: f"r37core.{panel.contents}" for name, panel in panels.items()},
        "programs": [str(_PACKAGE / panel.program) for panel in panels.values()],
    }


def _panels(sweep: Sweep) -> dict[str, Panel]:
    """Extension -> its panel, of those that have one in this run."""
    panels = {extension.name: extension.panel for extension in EXTENSIONS if extension.panel}
    return {name: panel for name, panel in panels.items() if filled(panel.dataset(sweep))}
