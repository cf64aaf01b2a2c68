"""Time signals: contact force over the casing's angle, and the displacement that tip timing reports."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.base.units import RPM
from r37core.figures import style

_NOTHING = "no interaction, no signals"


def draw_contact_forces(signals: xr.Dataset, title: str) -> Figure:
    """Normal force on the tip over the casing angle of its leading edge, at every speed (rows) of one blade and scene.

    The last revolution as a line, the range of all in the last half of the run as a band, and the clearance.
    """
    if not signals.sizes["speed"]:
        return style.empty_figure(f"{title}: {_NOTHING}")
    figure, panels = _rows(signals, f"contact force: {title}")
    per_revolution = round(1.0 / float(np.diff(signals["turn"].values[:2])[0]))
    for axes, speed in zip(panels, signals["speed"].values, strict=True):
        _draw_contact_force(axes, signals.sel(speed=speed), per_revolution)
    panels[-1].set_xlabel("casing angle of the leading edge (degrees); the blade moves to the left")
    figure.legend(*style.legend_entries([*panels, *figure.axes]), loc="outside lower center", ncols=3)
    return figure


def draw_tip_timing(signals: xr.Dataset, title: str) -> Figure:
    """Displacement of the leading edge that tip timing reports, at every speed (rows) of a blade and scene.

    A curve for each probe.
    """
    if not signals.sizes["speed"]:
        return style.empty_figure(f"{title}: {_NOTHING}")
    figure, panels = _rows(signals, f"tip timing, leading edge: {title}")
    for axes, speed in zip(panels, signals["speed"].values, strict=True):
        arrivals = 1e3 * signals["arrival_displacement"].sel(speed=speed, tip_point="leading_edge")
        for probe in arrivals["probe"].values:
            curve = arrivals.sel(probe=probe)
            axes.plot(curve["revolution"], curve, ".-", markersize=2, linewidth=0.8, label=f"{probe:g} degrees")
        _label(axes, signals.sel(speed=speed), "mm")
    panels[-1].set_xlabel("revolution")
    figure.legend(*style.legend_entries(panels), loc="outside lower center", ncols=4, title="probe")
    return figure


def _draw_contact_force(axes: Axes, run: xr.Dataset, per_revolution: int) -> None:
    """One speed: force in N on the left, clearance in mm on the right."""
    force = run["contact_force"].values.reshape(-1, per_revolution)
    angle, clearance = (run[name].values[-per_revolution:] for name in ("casing_angle", "clearance"))
    order = np.argsort(angle)
    beside = axes.twinx()
    beside.fill_between(angle[order], 1e3 * clearance[order], color="0.75", alpha=0.5, linewidth=0.0, label="clearance (mm)")
    beside.axhline(0.0, color="0.6", linewidth=0.6)
    beside.set_ylabel("mm", fontsize=8)
    beside.grid(False)
    axes.set_zorder(beside.get_zorder() + 1)
    axes.patch.set_visible(False)
    _label(axes, run, "N")
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 45))
    known = force[np.isfinite(force).all(axis=1)]
    if not len(known):
        style.say(axes, "no contact force: a run that diverged, or an integrator other than exact_modal")
        return
    late = known[len(known) // 2 :]
    look: dict[str, Any] = {"color": style.COLOURS[4], "alpha": 0.4, "linewidth": 0.0}
    lowest, highest = (edge(late, axis=0)[order] for edge in (np.min, np.max))
    axes.fill_between(angle[order], lowest, highest, label="range of the last half of the run", **look)
    axes.plot(angle[order], known[-1][order], color=style.COLOURS[0], linewidth=1.0, label="last revolution (N)")
    axes.set_ylim(bottom=0.0)


def _rows(signals: xr.Dataset, title: str) -> tuple[Figure, np.ndarray]:
    """A figure with a panel for each speed, one below the other."""
    rows = signals.sizes["speed"]
    figure, panels = plt.subplots(rows, 1, figsize=(style.PAGE, 1.5 * rows + 0.9), sharex=True, squeeze=False)
    figure.suptitle(title)
    return figure, panels[:, 0]


def _label(axes: Axes, run: xr.Dataset, unit: str) -> None:
    """Label of a panel: interaction, speed and unit."""
    speed = float(run["speed"])
    about = (str(run["interaction"].values), f"{speed:g} rad/s, {RPM * speed:.0f} rpm", unit)
    axes.set_ylabel("\n".join(filter(None, about)), fontsize=8)
