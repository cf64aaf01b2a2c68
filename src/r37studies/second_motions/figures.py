"""Motions up, down and from rest over the speed."""

import xarray as xr
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.figures.response_curves import shade
from r37core.results.other_motions import swept

from .choice import DOWN, MOTIONS, REST, UP

COLOURS = {UP: "#D55E00", DOWN: "#0072B2", REST: "0.25"}
LINES = {UP: "-", DOWN: "-", REST: ":"}


def draw_second_motions(motions: xr.Dataset, title: str, blade: str) -> Figure:
    """One blade in one scene: motion and stress of the three motions."""
    pair = swept(motions)
    stress = "max_von_mises_median" in pair and bool(pair["max_von_mises_median"].notnull().any())
    figure, grid = style.panels(1 + stress, 1, 4.6 if stress else 2.7, sharex=True)
    panels = grid[:, 0]
    axes = panels[0]
    for motion in MOTIONS:
        mean, scatter = (1e3 * pair[name].sel(motion=motion) for name in ("motion_mean", "motion_scatter"))
        label = "from rest" if motion == REST else f"carried {motion}"
        if pair["revolutions"].max() > pair["revolutions"].min():
            label += f", {float(pair['revolutions'].sel(motion=motion)):g} revolutions"
        axes.plot(pair["speed"], mean, LINES[motion], color=COLOURS[motion], label=label, linewidth=1.0)
        axes.fill_between(pair["speed"], mean - scatter, mean + scatter, color=COLOURS[motion], alpha=0.15, linewidth=0)
    axes.set_ylabel("rms (mm)")
    if stress:
        axes = panels[1]
        for motion in MOTIONS:
            style.stress_band(axes, pair["speed"], pair.sel(motion=motion), "_", linestyle=LINES[motion], color=COLOURS[motion])
        style.yield_lines(axes, {blade: float(pair["yield_stress"])}, named=True, linear=style.is_linear(motions))
        axes.set_ylabel("von Mises (GPa)\nmedian to largest")
    for axes in panels:
        shade(axes, pair)
    panels[0].set_title(f"{title}: carried up and down, and from rest; leading edge, normal and tangential together")
    panels[-1].set_xlabel(style.SPEED_LABEL)
    style.rpm_axis(panels[0])
    style.legend_below(figure, panels, 4)
    return figure
