"""The share of the Goodman line on a blade at its worst speed, rendered off screen."""

from pathlib import Path
from typing import Any, Final

import matplotlib.pyplot as plt
import numpy as np
import pyvista
import xarray as xr
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from r37core.io import readable
from r37core.results.measures import has_strengths
from r37core.stress.goodman import Strengths

from .offscreen import look, new_plotter, rendered, without_margins
from .style import PAGE

_COLOUR_MAP: Final = "viridis"
_PIXELS, _HEIGHT = (700, 700), 3.4
_SIDES = {"from one side": (0.35, -1.0, -0.25), "from the other": (0.35, 1.0, 0.25)}


def draw_fatigue(mesh: Path | str, nodes: np.ndarray, response: xr.Dataset, title: str) -> Figure:
    """Draw the largest share of the Goodman line of each node, at the speed where one is largest, on both sides of the blade.

    `mesh`: a .vtu; `nodes`, shape (stress nodes,): its numbers of the nodes that have stress; `response`: of the blade in a
    scene. Grey has no stress. Without strengths, or a run that ended, the figure says so.
    """
    if not has_strengths(response) or not response["goodman_share"].notnull().any():
        figure, axes = plt.subplots(figsize=(4.0, 1.5))
        axes.set_axis_off()
        missing = "no run that ended" if has_strengths(response) else "no strengths in blades.yaml"
        axes.text(0.5, 0.5, f"{title}: {missing}", ha="center", va="center")
        return figure
    worst = response.isel(speed=int(response["goodman_share"].argmax("speed")))
    strengths = Strengths(float(worst["fatigue_strength"]), float(worst["ultimate_strength"]))
    share = strengths.share(worst["alternating_stress"].values, worst["mean_stress"].values)
    with readable(mesh):
        grid = pyvista.read(mesh)
    shown = np.full(grid.n_points, np.nan)
    shown[nodes] = share
    grid.point_data["shown"] = shown
    largest = float(share.max())
    figure, panels = plt.subplots(1, len(_SIDES), figsize=(0.6 * PAGE, _HEIGHT), layout="constrained")
    for axes, (side, seen_from) in zip(panels, _SIDES.items(), strict=True):
        axes.imshow(_rendered(grid, largest, grid.points[nodes[share.argmax()]], seen_from), interpolation="none")
        axes.set_title(side)
        axes.set_axis_off()
    bar = figure.colorbar(ScalarMappable(Normalize(0.0, largest), _COLOUR_MAP), ax=panels, shrink=0.8)
    bar.set_label("share of the Goodman line")
    if largest > 1.0:
        bar.ax.axhline(1.0, color="white")
    speed, stresses = float(worst["speed"]), [1e-6 * float(worst[f"goodman_{kind}_stress"]) for kind in ("alternating", "mean")]
    figure.suptitle(
        f"{title} at {speed:g} rad/s: largest share {largest:.3g}\n"
        f"alternating stress {stresses[0]:.0f} MPa, mean stress {stresses[1]:.0f} MPa"
    )
    return figure


def _rendered(grid: Any, largest: float, worst: np.ndarray, seen_from: tuple[float, float, float]) -> np.ndarray:
    """The blade coloured by "shown" up to `largest`, with a mark at its `worst` point, as pixels."""
    surface = grid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")
    plotter = new_plotter(1, _PIXELS)
    plotter.add_mesh(surface.extract_feature_edges(feature_angle=50.0), color="black", line_width=1.5)
    plotter.add_mesh(
        surface,
        scalars="shown",
        clim=(0.0, largest),
        cmap=_COLOUR_MAP,
        nan_color="lightgrey",
        ambient=0.55,
        diffuse=0.5,
        smooth_shading=True,
        split_sharp_edges=True,
        show_scalar_bar=False,
    )
    plotter.add_mesh(pyvista.Sphere(0.008 * float(np.ptp(grid.points[:, 0])), worst), color="red")
    look(plotter, seen_from=seen_from, zoom=1.25)
    return without_margins(rendered(plotter))
