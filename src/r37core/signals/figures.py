"""Time signals: spectrograms, tracks of single orders beside what tip timing tells, contact force over the casing's angle."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from r37core.base.units import RPM
from r37core.figures import style
from r37core.figures.maps import draw_cells

from .orders import order_tracks, spectrogram, strongest_orders

_TRACKS = 5
_HIGHEST_ORDER = 20


def draw_spectrograms(signals: xr.Dataset, title: str) -> Figure:
    """Engine order over revolution of every signal (columns) at every speed (rows) of one blade and scene."""
    if not signals.sizes["speed"]:
        return _nothing(title)
    channels, turn, per_revolution = _channels(signals), signals["turn"].values, _per_revolution(signals)
    figure, panels = _grid(signals, len(channels), f"spectrograms: {title}")
    for row, speed in enumerate(signals["speed"].values):
        for axes, (name, unit, values) in zip(panels[row], channels, strict=True):
            orders, revolutions, amplitudes = spectrogram(values.sel(speed=speed).values, turn, per_revolution)
            low = orders <= _HIGHEST_ORDER
            if not len(revolutions):
                style.say(axes, "too short")
                continue
            shown = np.maximum(amplitudes[low], 1e-30)
            top = max(float(shown[1:].max()), 1e-29)
            norm = LogNorm(top / 1e4, top)
            picture = draw_cells(axes, revolutions, orders[low], shown, norm=norm, cmap="magma")
            figure.colorbar(picture, ax=axes, label=unit)
            axes.grid(False)
            if row == 0:
                axes.set_title(name, fontsize=9)
    _label(signals, panels, "engine order")
    return figure


def draw_orders(signals: xr.Dataset, title: str) -> Figure:
    """Amplitude of the strongest whole engine orders over revolution, and the displacement that tip timing tells.

    Signals in columns, at every speed (rows) of one blade and scene; the last column, where there are probes, has the leading
    edge's arrivals, a curve for each probe.
    """
    if not signals.sizes["speed"]:
        return _nothing(title)
    channels, timed = _channels(signals), "arrival_displacement" in signals
    figure, panels = _grid(signals, len(channels) + timed, f"engine orders over time: {title}")
    per_revolution, turn = _per_revolution(signals), signals["turn"].values
    for row, speed in enumerate(signals["speed"].values):
        for axes, (name, unit, values) in zip(panels[row], channels, strict=False):
            signal = values.sel(speed=speed).values
            orders = strongest_orders(signal, turn, per_revolution, _TRACKS, _HIGHEST_ORDER)
            revolutions, amplitudes = order_tracks(signal, turn, per_revolution, orders)
            for order, amplitude in zip(orders, amplitudes, strict=True):
                axes.plot(revolutions, amplitude, label=f"{order}", **_look(order))
            axes.set_ylabel(unit)
            # room for the legend
            axes.set_ylim(0.0, 1.35 * max(float(amplitudes.max(initial=0.0)), 1e-30))
            _legend(axes, "order", _TRACKS)
            if row == 0:
                axes.set_title(name, fontsize=9)
        if timed:
            _draw_timing(panels[row, -1], signals.sel(speed=speed), first=row == 0)
    _label(signals, panels, None)
    return figure


def draw_contact_forces(signals: xr.Dataset, title: str) -> Figure:
    """Normal force on the tip over the casing angle of its leading edge, at every speed (rows) of one blade and scene.

    The last revolution as a line, the range of all in the last half of the run as a band, and the clearance.
    """
    if not signals.sizes["speed"]:
        return _nothing(title)
    rows, per_revolution = signals.sizes["speed"], _per_revolution(signals)
    figure, panels = plt.subplots(rows, 1, figsize=(style.PAGE, 1.5 * rows + 0.9), sharex=True, squeeze=False)
    figure.suptitle(f"contact force: {title}")
    for axes, speed in zip(panels[:, 0], signals["speed"].values, strict=True):
        _draw_contact_force(axes, signals.sel(speed=speed), per_revolution)
    _label(signals, panels, None)
    panels[-1, 0].set_xlabel("casing angle of the leading edge (degrees); the blade moves to the left")
    figure.legend(*style.legend_entries([*panels[:, 0], *figure.axes]), loc="outside lower center", ncols=3)
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
    axes.set_ylabel("N")
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


def _draw_timing(axes: Axes, run: xr.Dataset, first: bool) -> None:
    arrivals = 1e3 * run["arrival_displacement"].sel(tip_point="leading_edge")
    for probe in arrivals["probe"].values:
        curve = arrivals.sel(probe=probe)
        axes.plot(curve["revolution"], curve, ".-", markersize=2, linewidth=0.8, label=f"{probe:g}")
    axes.set_ylabel("mm")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.35 * (high - low))
    _legend(axes, "probe (degrees)", 4)
    if first:
        axes.set_title("tip timing, leading edge", fontsize=9)


def _look(order: int) -> dict[str, str]:
    """Colour and dashes of an engine order, the same in every panel."""
    repeats, colour = divmod(order - 1, len(style.COLOURS))
    return {"color": style.COLOURS[colour], "linestyle": ("-", "--", ":")[repeats % 3]}


def _legend(axes: Axes, title: str, columns: int) -> None:
    gaps: dict[str, Any] = {"handlelength": 1.4, "handletextpad": 0.3, "columnspacing": 0.6, "borderpad": 0.1}
    legend = axes.legend(loc="upper left", ncols=columns, title=title, fontsize=6, title_fontsize=6, **gaps)
    # panels keep their width, however many entries
    legend.set_in_layout(False)


def _channels(signals: xr.Dataset) -> list[tuple[str, str, xr.DataArray]]:
    """Name, unit and values in it: the leading edge's normal and tangential motion, then the gauges."""
    edge = signals.sel(tip_point="leading_edge")
    channels = [(f"{name}, leading edge", "mm", 1e3 * edge[name]) for name in ("normal", "tangential")]
    if "strain" in signals:
        channels += [(f"gauge {name}", "µm/m", 1e6 * signals["strain"].sel(gauge=name)) for name in signals["gauge"].values]
    return channels


def _per_revolution(signals: xr.Dataset) -> int:
    return round(1.0 / float(np.diff(signals["turn"].values[:2])[0]))


def _grid(signals: xr.Dataset, columns: int, title: str) -> tuple[Figure, np.ndarray]:
    rows = signals.sizes["speed"]
    figure, panels = plt.subplots(rows, columns, figsize=(2.4 * columns, 1.7 * rows + 0.5), sharex=True, squeeze=False)
    figure.suptitle(title)
    return figure, panels


def _label(signals: xr.Dataset, panels: np.ndarray, vertical: str | None) -> None:
    for axes, speed in zip(panels[:, 0], signals["speed"].values, strict=True):
        interaction = str(signals["interaction"].sel(speed=speed).values)
        about = f"{interaction}\n{speed:g} rad/s, {RPM * speed:.0f} rpm".strip()
        axes.set_ylabel("\n".join(filter(None, (about, vertical or axes.get_ylabel()))), fontsize=8)
    for axes in panels[-1]:
        axes.set_xlabel("revolution")


def _nothing(title: str) -> Figure:
    figure, axes = plt.subplots(figsize=(4.0, 1.5))
    style.say(axes, f"{title}: no interaction, no signals")
    axes.set_axis_off()
    return figure
