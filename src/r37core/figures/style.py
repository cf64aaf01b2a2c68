"""One style for all figures: sizes that print as they are, colours told apart with any colour vision, PNG and PDF."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import cycle
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib

# a notebook has chosen its backend; for the rest no display is needed
if matplotlib.get_backend(auto_select=False) is None:
    matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from numpy import ndarray
from xarray import Dataset

from r37core.base.io import atomic_write
from r37core.base.units import RPM
from r37core.results.operating_range import OperatingRange
from r37core.rom.reduction_choice import QUADRATIC

COLUMN, PAGE = 3.5, 7.2
"""Widths (inch) of a figure that goes into one column of a journal and across its page, at the size of its text."""

COLOURS = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000",
    "#003F62", "#8A3D00", "#00573F", "#7A3F61", "#2B6E94", "#7F5700", "#888888",
)  # fmt: skip
"""Okabe and Ito's colours, and darker ones of them, in the explorer's order."""
CURVES = {
    "rms_normal": ("rms, normal (mm)", 1e3),
    "rms_tangential": ("rms, tangential (mm)", 1e3),
    "max_von_mises_ever": ("largest von Mises (GPa)", 1e-9),
}
"""Variable that is drawn over speed -> label of its axis, and what a unit there is in the SI, inverted."""

SPEED_LABEL = "speed (rad/s)"
RUN_UP_LABEL = "mean speed of the revolution (rad/s)"
"""Labels of axes of speeds, by which the operating range is marked."""

_SHIPPED = {"abradable": "abradable lining", "direct": "bare casing", "material_abradable": "abradable lining, all of the tip"}


def scene_words(scene: Any) -> str:
    """Name of a scene as figures have it: those of the benchmark in words, others as they are."""
    return _SHIPPED.get(str(scene), str(scene))


UNKNOWN: dict[str, Any] = {"facecolor": "none", "edgecolor": "0.5", "hatch": "////", "linewidth": 0.6}
"""Look of speeds at which the model's limits are left before yield is passed."""

ABOVE_YIELD = "above yield"
OUTSIDE = f"{ABOVE_YIELD}: outside the linear model"

PARAMETERS: dict[Any, Any] = {
    "figure.dpi": 110,
    "savefig.dpi": 200,
    "figure.constrained_layout.use": True,
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "figure.titlesize": 9,
    "axes.prop_cycle": plt.cycler(color=COLOURS),
    "axes.grid": True,
    "grid.alpha": 0.25,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    # letters stay letters
    "pdf.fonttype": 42,
    # no creation date, so that the same data give the same bytes
    "svg.hashsalt": "r37",
}
"""Matplotlib's parameters of all figures."""


def take_style() -> None:
    """Make the style that of Matplotlib, whatever a user's matplotlibrc says: it may ask for LaTeX where there is none."""
    matplotlib.rcdefaults()
    plt.rcParams.update(PARAMETERS)


take_style()


def blade_styles(blades: Iterable[Any]) -> dict[str, dict[str, str]]:
    """Colour and dashes of each blade, by its place in the whole list: the same in every figure and in the explorer."""
    looks = cycle({"color": colour, "linestyle": dashes} for dashes in ("-", "--", ":", "-.") for colour in COLOURS)
    return {str(blade): look for blade, look in zip(blades, looks, strict=False)}


def mode_colour(campbell: Dataset, mode: str) -> str:
    """Colour of a mode, by its place in the Campbell diagram: the same in every figure and in the explorer."""
    return COLOURS[list(campbell["mode"].values).index(mode) % len(COLOURS)]


def is_linear(data: Dataset) -> bool:
    """True for a dataset of runs of linear kinematics alone, by its attributes (results.datasets.write_sweep_dataset)."""
    kinds = [part.partition(":")[0] for part in str(data.attrs.get("contact")).split("; ")]
    return all(QUADRATIC not in f"{kind} {data.attrs.get('kinematics')}" for kind in kinds)


def stress_band(axes: Axes, places: Any, stress: Dataset, label: str, **look: Any) -> None:
    """Largest stress (GPa) before a run leaves the model, over `places`, and a band from it up to that of all revolutions."""
    inside, largest = (1e-9 * stress[f"max_von_mises_{name}"] for name in ("inside", "ever"))
    (line,) = axes.plot(places, inside, marker=".", markersize=3, label=label, **look)
    axes.fill_between(places, inside, largest, color=line.get_color(), alpha=0.12, linewidth=0.0)
    # also of a speed without neighbours
    axes.plot(places, largest, marker=".", markersize=2, **look | {"color": line.get_color(), "linewidth": 0.6})


def stress_label(stress: Dataset) -> str:
    """Label of an axis of stress_band, with the region of the stress where all runs have the same."""
    regions = set(map(str, stress["stress_region"].values.flat)) - {""} if "stress_region" in stress else set()
    return "\n".join(
        [
            "von Mises (GPa)",
            "inside the model",
            "to largest of all",
            *(fill(region, 30) for region in regions if len(regions) == 1),
        ]
    )


def yield_lines(axes: Axes, limits: Mapping[Any, float], named: bool = False, linear: bool = False) -> None:
    """A dashed line (GPa) at each of the yield stresses (Pa), each by its name, and a tint above the lowest.

    Several lines say whose they are. `named`: whether the legend says what line and tint are; `linear`: is_linear of the runs.
    """
    blades_of: dict[float, list[str]] = {}
    for blade, limit in limits.items():
        if np.isfinite(limit):
            blades_of.setdefault(1e-9 * limit, []).append(str(blade))
    for number, (limit, blades) in enumerate(sorted(blades_of.items())):
        label = "yield stress" if named and number == 0 else "_"
        axes.axhline(limit, color="0.3", linewidth=0.9, linestyle="--", label=label)
        if len(blades_of) > 1:
            where = axes.get_yaxis_transform()
            axes.text(1.0, limit, ", ".join(blades), fontsize=6, color="0.3", ha="right", va="bottom", transform=where)
    if blades_of:
        lowest, label = min(blades_of), (OUTSIDE if linear else ABOVE_YIELD) if named else "_"
        tint: dict[str, Any] = {"facecolor": "#B00020", "alpha": 0.08, "linewidth": 0.0, "zorder": 0.0, "label": label}
        # an artist does not stretch the axis; no stress reaches 1e6 GPa
        axes.add_artist(Rectangle((0.0, lowest), 1.0, 1e6 - lowest, transform=axes.get_yaxis_transform(), **tint))


def panels(rows: int, columns: int, height: float, **look: Any) -> tuple[Figure, Any]:
    """A figure across the page, of a height (inch), and its panels, shape (rows, columns); `look`: as of pyplot.subplots."""
    return plt.subplots(rows, columns, figsize=(PAGE, height), squeeze=False, **look)


def legend_below(figure: Any, axes: Iterable[Axes], columns: int, first: Mapping[str, Any] | None = None, **look: Any) -> None:
    """One legend of several panels below all of them, each label once, `first` the handles of these; none without any."""
    entries = dict(first or {})
    for panel in axes:
        handles, labels = panel.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    if entries:
        figure.legend(list(entries.values()), list(entries), loc="outside lower center", ncols=columns, **look)


def mark_diverged(axes: Axes, places: ndarray, colour: str = "red") -> None:
    """Crosses at the upper edge, worse than any number, at the places on the x axis where a run diverged."""
    if len(places):
        mark_above(axes, places, "x", color=colour, label="diverged", zorder=4)


def mark_above(axes: Axes, places: ndarray, marker: str, **look: Any) -> None:
    """Markers at the upper edge, at the places on the x axis."""
    axes.plot(places, np.full(len(places), 0.97), marker, transform=axes.get_xaxis_transform(), **look)


def crossings_seen(axes: Axes, campbell: Dataset | None) -> list[tuple[Any, float]]:
    """Engine orders and speeds (rad/s) of the crossings of 1B within a panel over speed; none without a Campbell diagram."""
    low, high = axes.get_xlim()
    crossings = () if campbell is None else campbell["crossing_speed"].sel(mode="1B").to_series().dropna().items()
    return [(order, speed) for order, speed in crossings if low <= speed <= high]


def mark_operating(figure: Figure, operating: OperatingRange) -> None:
    """Shade the judged range of operation and its dwells, with lines at its ends, in every panel with an axis of speeds."""
    spans = [(operating.first, operating.last, 0.12), *((dwell.start, dwell.stop, 0.2) for dwell in operating.dwell)]
    for axes in figure.axes:
        labels = {panel.get_xlabel() for panel in axes.get_shared_x_axes().get_siblings(axes)}
        if not labels & {SPEED_LABEL, RUN_UP_LABEL}:
            continue
        limits = axes.get_xlim(), axes.get_ylim()
        for begin, end, alpha in spans:
            axes.axvspan(begin, end, color=COLOURS[4], alpha=alpha, linewidth=0.0, zorder=-0.5)
        for end in (operating.first, operating.last):
            axes.axvline(end, color=COLOURS[4], linewidth=0.9, linestyle="-.")
        axes.set(xlim=limits[0], ylim=limits[1])


ALL_DIVERGED = "every run diverged"


def say(axes: Axes, text: str) -> None:
    """Write into the middle of a panel why it is empty."""
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes)


def empty_figure(text: str) -> Figure:
    """A small figure with nothing but the reason why it is empty."""
    figure, axes = plt.subplots(figsize=(4.0, 1.5))
    say(axes, text)
    axes.set_axis_off()
    return figure


def rpm_axis(axes: Axes, most_ticks: int = 9) -> None:
    """A second axis above one of speeds in rad/s, in revolutions per minute."""
    above = axes.secondary_xaxis("top", functions=_RPM)
    above.set_xlabel("rpm", fontsize=plt.rcParams["xtick.labelsize"])
    above.xaxis.set_major_locator(MaxNLocator(most_ticks))


_RPM = (lambda speed: np.multiply(speed, RPM), lambda turns: np.divide(turns, RPM))


def picture_figure(picture: Path | str) -> Figure:
    """A figure across the page that shows a picture as it is, so that what was rendered can be had as a PDF, too."""
    pixels = plt.imread(picture)
    figure = plt.figure(figsize=(PAGE, PAGE * pixels.shape[0] / pixels.shape[1]), layout="none")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.imshow(pixels, interpolation="none")
    axes.set_axis_off()
    return figure


def save(
    figure: Figure, files: Path | str | Sequence[Path | str], caption: str | None = None, dots_per_inch: float | None = None
) -> None:
    """Write the figure, one PNG or PDF or several, with its caption as a description, atomically, and close it.

    The same data give the same bytes. Not by Figure.savefig, which lays the figure out anew for each file and draws it twice.
    """
    figure.set_dpi(dots_per_inch or plt.rcParams["savefig.dpi"])
    if figure.axes and (layout := figure.get_layout_engine()):
        layout.execute(figure)
    figure.set_layout_engine("none")
    for file in [files] if isinstance(files, str | Path) else files:
        with atomic_write(file) as partial:
            if Path(file).suffix == ".pdf":
                about = {"Subject": caption, "Creator": None, "Producer": None, "CreationDate": None}
                FigureCanvasPdf(figure).print_pdf(partial, metadata=about)
            else:
                FigureCanvasAgg(figure).print_png(partial, metadata={"Software": None, "Description": caption})
    plt.close(figure)
