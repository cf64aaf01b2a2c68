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

from r37core.base.io import readable
from r37core.results.measures import has_strengths
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.operator import mapped_region
from r37core.stress.statistic import Strengths

from .offscreen import look, new_plotter, rendered, without_margins
from .style import PAGE, empty_figure

_COLOUR_MAP: Final = "viridis"
_PIXELS, _HEIGHT = (600, 800), 3.2
_DIRECTIONS = ((0.35, -1.0, -0.25), (0.35, 1.0, 0.25))


def draw_fatigue_map(mesh: Path, rom: Path, response: xr.Dataset, title: str) -> Figure:
    """Draw as draw_fatigue does, with nodes of the reduced model in the file `rom`."""
    regions = read_reduced_model(rom).stress_regions
    region = regions[mapped_region(regions)]
    return draw_fatigue(mesh, region.nodes.nodes[region.evaluated], response, f"{title}, {region.description}")


def draw_fatigue(mesh: Path | str, nodes: np.ndarray, response: xr.Dataset, title: str) -> Figure:
    """Draw the largest share of the Goodman line of each node, at the speed where one is largest, on both sides of the blade.

    `mesh`: a .vtu; `nodes`, shape (stress nodes,): its numbers of the nodes that have stress; `response`: of the blade in a
    scene. Grey has no stress. Without strengths, or a run that ended, the figure says so.
    """
    if not has_strengths(response) or not response["goodman_share"].notnull().any():
        missing = "no run that ended" if has_strengths(response) else "no strengths in blades.yaml"
        return empty_figure(f"{title}: {missing}")
    strengths = Strengths(float(response["fatigue_strength"]), float(response["ultimate_strength"]))
    shares = strengths.share(response["alternating_stress"].values, response["mean_stress"].values)
    worst = response.isel(speed=int(np.nan_to_num(shares).max(axis=1).argmax()))
    alternating, mean = (worst[f"{kind}_stress"].values for kind in ("alternating", "mean"))
    share = strengths.share(alternating, mean)
    with readable(mesh):
        grid = pyvista.read(mesh)
    largest, surface = float(share.max()), _surface(grid, nodes, share)
    figure, panels = plt.subplots(1, 4, figsize=(PAGE, _HEIGHT), layout="constrained")
    for axes in panels:
        axes.set_axis_off()
    for number, (side, seen_from) in enumerate(zip(_sides(grid), _DIRECTIONS, strict=True)):
        for axes, close_up in zip(panels[2 * number :], (None, grid.points[nodes]), strict=False):
            axes.imshow(_rendered(surface, grid.points[nodes], share, seen_from, close_up), interpolation="none")
        panels[2 * number].set_title(side)
        panels[2 * number + 1].set_title("region of the stress")
    bar = figure.colorbar(ScalarMappable(Normalize(0.0, largest), _COLOUR_MAP), ax=panels, shrink=0.8)
    bar.set_label("share of the Goodman line")
    if largest > 1.0:
        bar.ax.axhline(1.0, color="white")
    node = share.argmax()
    figure.suptitle(
        f"{title} at {float(worst['speed']):g} rad/s: largest share {largest:.3g}\n"
        f"alternating stress {1e-6 * alternating[node]:.0f} MPa, mean stress {1e-6 * mean[node]:.0f} MPa"
    )
    return figure


def _sides(grid: Any) -> tuple[str, str]:
    """Names of the sides that are seen from negative and from positive y."""
    pressure, suction = (grid.points[grid.point_data[f"tip_{side}_edge"] > 0, 1].mean() for side in ("pressure", "suction"))
    return ("pressure side", "suction side") if pressure < suction else ("suction side", "pressure side")


def _surface(grid: Any, nodes: np.ndarray, share: np.ndarray) -> Any:
    """The surface of the blade with the values "shown" at some `nodes`, NaN elsewhere."""
    shown = np.full(grid.n_points, np.nan)
    shown[nodes] = share
    grid.point_data["shown"] = shown
    return grid.extract_surface(nonlinear_subdivision=1, algorithm="dataset_surface")


def _rendered(
    surface: Any, points: np.ndarray, share: np.ndarray, seen_from: tuple[float, float, float], close_up: np.ndarray | None
) -> np.ndarray:
    """The blade coloured by "shown", a red dot at the worst of the `points` and, in a `close_up` of them, one at each."""
    plotter = new_plotter(1, _PIXELS)
    colours: dict[str, Any] = {"clim": (0.0, float(share.max())), "cmap": _COLOUR_MAP, "show_scalar_bar": False}
    plotter.add_mesh(surface.extract_feature_edges(feature_angle=50.0), color="black", line_width=1.5)
    plotter.add_mesh(
        surface,
        scalars="shown",
        nan_color="lightgrey",
        ambient=0.75,
        diffuse=0.3,
        smooth_shading=True,
        split_sharp_edges=True,
        **colours,
    )
    worst = points[[share.argmax()]]
    plotter.add_points(worst, color="red", point_size=20 if close_up is not None else 12, render_points_as_spheres=True)
    if close_up is not None:
        plotter.add_points(
            points, scalars=share, point_size=10, render_points_as_spheres=True, ambient=0.75, diffuse=0.3, **colours
        )
    look(plotter, seen_from=seen_from, zoom=1.15 if close_up is None else 1.2, close_up=close_up)
    return without_margins(rendered(plotter))
