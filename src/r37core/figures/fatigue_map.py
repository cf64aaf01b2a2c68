"""The share of the Goodman line on a blade at its worst speed, rendered off screen."""

from pathlib import Path
from typing import Any, Final

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy import ndarray
from xarray import Dataset

from r37core.results.measures import has_strengths
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.statistic import Strengths

from . import style
from .offscreen import draw_edges, look, new_plotter, read_grid, rendered, sides, surface_of, without_margins

_COLOUR_MAP: Final = "viridis"
_PIXELS, _HEIGHT = (600, 800), 3.2
_DIRECTIONS = ((0.35, -1.0, -0.25), (0.35, 1.0, 0.25))


def draw_fatigue_map(mesh: Path, rom: Path, response: Dataset, title: str, further_runs: Dataset | None = None) -> Figure:
    """Draw as draw_fatigue does, in the region that decides, of the reduced model in the file `rom`.

    `further_runs`: of a verdict, of whose nodes nothing is known; the title says where one has a larger share.
    """
    region = next(iter(read_reduced_model(rom).stress_regions.values()))
    figure = draw_fatigue(mesh, region.points, response, f"{title}, {region.description}")
    if further_runs is not None and has_strengths(further_runs) and further_runs["goodman_share"].notnull().any():
        worst = further_runs.sel(speed=further_runs["goodman_share"].idxmax("speed"))
        if worst["goodman_share"] > response["goodman_share"].max():
            text = f"a further run of the verdict has {float(worst['goodman_share']):.3g}, at {float(worst['speed']):g} rad/s"
            figure.suptitle(f"{figure.get_suptitle()}\n{text}: not drawn")
    return figure


def draw_fatigue(mesh: Path | str, points: ndarray, response: Dataset, title: str) -> Figure:
    """Draw the largest share of the Goodman line of each point, at the speed where one is largest, on both sides of the blade.

    `mesh`: a .vtu; `points` (m), shape (stress points, 3): where stress is; `response`: of the blade in a
    scene. Between the dots stress is not computed. Without strengths, or a run that ended, the figure says so.
    """
    if not has_strengths(response) or not response["goodman_share"].notnull().any():
        missing = "no run that ended" if has_strengths(response) else "no strengths in blades.yaml"
        return style.empty_figure(f"{title}: {missing}")
    strengths = Strengths(float(response["fatigue_strength"]), float(response["ultimate_strength"]))
    shares = strengths.share(response["alternating_stress"].values, response["mean_stress"].values)
    worst = response.isel(speed=int(np.nan_to_num(shares).max(axis=1).argmax()))
    alternating, mean = (worst[f"{kind}_stress"].values for kind in ("alternating", "mean"))
    share = strengths.share(alternating, mean)
    grid, largest = read_grid(mesh), float(share.max())
    figure, (panels,) = style.panels(1, 4, _HEIGHT)
    for axes in panels:
        axes.set_axis_off()
    for number, (side, seen_from) in enumerate(zip(sides(grid), _DIRECTIONS, strict=True)):
        for axes, close_up in zip(panels[2 * number :], (None, points), strict=False):
            axes.imshow(_rendered(grid, points, share, seen_from, close_up), interpolation="none")
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


def _rendered(
    grid: Any, points: ndarray, share: ndarray, seen_from: tuple[float, float, float], close_up: ndarray | None
) -> ndarray:
    """The grey blade with a dot at each of the `points`, red at the worst one; `close_up`: those to look at, None: whole."""
    plotter = new_plotter(1, _PIXELS)
    size = 5 if close_up is None else 10
    shading: dict[str, Any] = {"ambient": 0.75, "diffuse": 0.3}
    draw_edges(plotter, surface := surface_of(grid))
    plotter.add_mesh(surface, color="lightgrey", smooth_shading=True, split_sharp_edges=True, **shading)
    worst = points[[share.argmax()]]
    plotter.add_points(worst, color="red", point_size=2 * size, render_points_as_spheres=True)
    plotter.add_points(
        points,
        point_size=size,
        render_points_as_spheres=True,
        show_scalar_bar=False,
        scalars=share,
        clim=(0.0, float(share.max())),
        cmap=_COLOUR_MAP,
        **shading,
    )
    look(plotter, seen_from=seen_from, zoom=1.15 if close_up is None else 1.2, close_up=close_up)
    return without_margins(rendered(plotter))
