"""Pictures of datasets: plain functions that give a figure, the convention of matplotlib's own pyplot.

They are the workflow's pictures. Matplotlib's parameters and backend stay those of the caller.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import xarray as xr

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot_campbell(campbell: xr.Dataset, title: str | None = None) -> Figure:
    """Campbell diagram and dynamic clearance of one blade, of what `r37.campbell` gives.

    A plain function, as those of matplotlib.pyplot. `title`: in place of the blade's name.
    """

    def draw() -> Figure:
        from r37core.figures.campbell_diagram import draw_campbell

        return draw_campbell(campbell, title or _label(campbell, "blade"))

    return _drawn(draw)


def plot_response(response: xr.Dataset, campbell: xr.Dataset | None = None, title: str | None = None) -> Figure:
    """Rms of the leading edge and largest stress over speed, of what `r37.sweep` gives.

    A plain function, as those of matplotlib.pyplot. `campbell`: what `r37.campbell` gives, to mark the crossings of 1B.
    `title`: in place of the blade's name.
    """
    name = title or _label(response, "blade")
    scenes = response.drop_vars("scene", errors="ignore").expand_dims(scene=[_label(response, "scene")])
    if "speed" not in scenes.dims:
        scenes = scenes.expand_dims("speed")

    def draw() -> Figure:
        from r37core.figures.response_curves import draw_response

        return draw_response(name, campbell, scenes, scenes if "max_von_mises" in scenes else None)

    return _drawn(draw)


def _drawn(draw: Callable[[], Figure]) -> Figure:
    """What `draw` gives in the workflow's style."""
    import matplotlib
    import matplotlib.pyplot as plt

    # chosen now, as pyplot would when it draws: the style takes one without a display where none has been
    matplotlib.get_backend()
    with plt.rc_context():
        from r37core.figures.style import PARAMETERS

        plt.rcParams.update(PARAMETERS)
        return draw()


def _label(dataset: xr.Dataset, name: str) -> str:
    """Which blade or scene a dataset is of: a part of a joined one says so in a coordinate, others in an attribute."""
    return str(dataset[name].item() if name in dataset.coords else dataset.attrs.get(name, ""))
