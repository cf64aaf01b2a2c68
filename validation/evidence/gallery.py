"""Pictures of docs/gallery.md: our counterparts of figures of the paper, at level `standard`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from published import INTERACTIONS, REFERENCE

from r37core.base.dataset_file import read_dataset
from r37core.config.settings import judged_region
from r37core.figures import style
from r37core.figures.campbell_diagram import draw_campbell
from r37core.figures.maps import draw_spectral_map

from .configuration import settings_of
from .gallery_shapes import draw_mesh, draw_modes
from .published_figures import (
    COARSE,
    FINE,
    SCENES,
    draw_histories,
    draw_reference,
    draw_revolution,
    draw_stress_over_speed,
    draw_wear,
    draw_widths,
)
from .published_runs import runs_of, stress_of_run, swept
from .published_windows import source

_DOTS_PER_INCH = 120
"""So that the pages of docs/ stay small."""


def charts(input: Any, output: Any, params: Any) -> None:
    """All pictures but the rendered ones. Inputs: model, campbell."""
    responses, shipped = swept(source("standard").responses), runs_of("standard")
    diagram, both = read_dataset(input.campbell), {"lined": responses[REFERENCE, True], "direct": responses[REFERENCE, False]}
    drawn: dict[str, Callable[[], Figure]] = {
        "campbell": lambda: draw_campbell(diagram, REFERENCE),
        "reference": lambda: draw_reference(both["lined"], both["direct"]),
        "spectrum_lined": lambda: draw_spectral_map(both["lined"], diagram, f"{REFERENCE}, {SCENES['lined'][0]}"),
        "spectrum_direct": lambda: draw_spectral_map(both["direct"], diagram, f"{REFERENCE}, {SCENES['direct'][0]}"),
        "revolution": lambda: draw_revolution(instants(input.model, both["lined"]), INTERACTIONS[0].peak),
        "histories": lambda: draw_histories(shipped),
        "stress": lambda: draw_stress_over_speed(both),
        "wear_content": lambda: draw_wear(both["lined"]),
        "widths": lambda: draw_widths(shipped),
    }
    for name, draw in drawn.items():
        style.save(draw(), output[name], dots_per_inch=_DOTS_PER_INCH)


def instants(model: str, response: Any) -> np.ndarray:
    """Largest stress (Pa) at FINE instants of the last revolution at the published peak with lining, shape (FINE,)."""
    assert FINE % COARSE == 0
    changes = {"snapshots_per_revolution": FINE, "snapshot_revolutions": 1}
    run = stress_of_run(settings_of(Path.cwd()), model, response, INTERACTIONS[0].peak, changes)
    return run["operator"].max_von_mises(run["snapshots"])


def shapes(input: Any, output: Any, params: Any) -> None:
    """The rendered pictures. Inputs: mesh, modes."""
    draw_modes(Path(input.modes) / "modes_0.vtu", output.modes)
    draw_mesh(input.mesh, judged_region(settings_of(Path.cwd()), REFERENCE), output.mesh)
