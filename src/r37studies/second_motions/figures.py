"""Motions up, down and from rest over the speed, and what dwells find."""

import pandas as pd
import xarray as xr
from matplotlib.figure import Figure

from r37core.figures import style
from r37core.figures.response_curves import shade
from r37core.results.other_motions import swept

from .choice import DOWN, MOTIONS, REST, UP
from .lasting import HIGH, LOW, Lasting

COLOURS = {UP: "#D55E00", DOWN: "#0072B2", REST: "0.25"}
LINES = {UP: "-", DOWN: "-", REST: ":"}
MARKERS = {Lasting.LASTING: "o", Lasting.SWITCHING: "D", Lasting.TRANSIENT: "x", Lasting.DIVERGED: "P"}


def draw_second_motions(motions: xr.Dataset, dwells: pd.DataFrame, title: str, blade: str, scene: str) -> Figure:
    """One blade in one scene: motion and stress of the three motions, and what becomes of the larger one in dwells."""
    pair = swept(motions)
    stress = "max_von_mises_median" in pair and bool(pair["max_von_mises_median"].notnull().any())
    blade_dwells = dwells[(dwells["blade"] == blade) & (dwells["scene"] == scene)]
    shares = blade_dwells["share_of_time_high"].notna().any()
    exponents = blade_dwells[[f"lyapunov_exponent_{which}" for which in (HIGH, LOW)]].notna().any(axis=None)
    count = 1 + int(stress) + int(shares) + int(exponents)
    figure, grid = style.panels(count, 1, 1.9 * count + 0.8, sharex=True)
    panels = grid[:, 0]
    left = iter(panels)
    axes = next(left)
    for motion in MOTIONS:
        mean, scatter = (1e3 * pair[name].sel(motion=motion) for name in ("motion_mean", "motion_scatter"))
        label = "from rest" if motion == REST else f"carried {motion}"
        if pair["revolutions"].max() > pair["revolutions"].min():
            label += f", {float(pair['revolutions'].sel(motion=motion)):g} revolutions"
        axes.plot(pair["speed"], mean, LINES[motion], color=COLOURS[motion], label=label, linewidth=1.0)
        axes.fill_between(pair["speed"], mean - scatter, mean + scatter, color=COLOURS[motion], alpha=0.15, linewidth=0)
    axes.set_ylabel("rms (mm)")
    for kind, marker in MARKERS.items():
        those = blade_dwells[blade_dwells["high"] == str(kind)]
        if len(those):
            place = those["speed_rad_s"], 1e3 * those["level_high_m"]
            axes.plot(*place, marker, color="0.1", fillstyle="none", markersize=5, label=f"largest motion {kind}")
    if stress:
        axes = next(left)
        for motion in MOTIONS:
            style.stress_band(axes, pair["speed"], pair.sel(motion=motion), "_", linestyle=LINES[motion], color=COLOURS[motion])
        style.yield_lines(axes, {blade: float(pair["yield_stress"])}, named=True, linear=style.is_linear(motions))
        axes.set_ylabel("von Mises (GPa)\nmedian to largest")
    if shares:
        axes = next(left)
        axes.plot(blade_dwells["speed_rad_s"], blade_dwells["share_of_time_high"], ".", color="0.1")
        axes.set(ylabel="share of time\nin largest motion", ylim=(-0.05, 1.05))
    if exponents:
        axes = next(left)
        for which, label, fill in ((HIGH, "largest", "full"), (LOW, "smallest", "none")):
            values = blade_dwells[f"lyapunov_exponent_{which}"]
            name = f"exponent, {label} motion"
            axes.plot(blade_dwells["speed_rad_s"], values, "o", color="0.1", fillstyle=fill, markersize=3, label=name)
        axes.axhline(0.0, color="0.6", linewidth=0.8)
        axes.set_ylabel("exponent\nper revolution")
    for axes in panels:
        shade(axes, pair)
    panels[0].set_title(f"{title}: carried up and down, and from rest; leading edge, normal and tangential together")
    panels[-1].set_xlabel(style.SPEED_LABEL)
    style.rpm_axis(panels[0])
    style.legend_below(figure, panels, 4)
    return figure
