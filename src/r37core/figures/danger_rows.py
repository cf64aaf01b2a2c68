"""Rows over speed, one for each scene or blade: where its speeds are dangerous or unknown, and where stress stays above yield.

A row is dark where yield is passed inside the model, hatched where the model is left first, and has a line where most of the
later revolutions are above yield. All else that was run is below yield throughout, and light. At its end stands by which limits
the model is left first.
"""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from xarray import Dataset

from r37core.results.danger import ranges_of
from r37core.results.datasets import with_further_runs
from r37core.results.events import Danger
from r37core.results.exceedance import SpeedRange, ranges_above
from r37core.results.limits import Cause

from . import style

LINE_LOOK: dict[str, Any] = {
    "color": "white",
    "linewidth": 1.2,
    "path_effects": [withStroke(linewidth=3.0, foreground="black")],
}
"""Look of a line that is seen on every colour."""

LINE = Line2D([], [], **LINE_LOOK)
"""Handle of sustained speeds in a legend."""

LEGEND = {
    "dangerous: above yield, inside the model": Patch(facecolor="0.25"),
    "unknown: the model is left first": Patch(**style.UNKNOWN),
    "sustained: above yield in most later revolutions": LINE,
}
"""Label -> handle of a row's looks, whatever its colour."""

KINDS = ("dangerous", "unknown", "sustained")
"""Names of the kinds of speeds, in the order of ranges_of."""

ROW_HEIGHT = 0.2
"""Height (inch) of a row."""


def draw_danger_rows(
    axes: Axes,
    runs: Mapping[str, Dataset],
    colours: Sequence[Any],
    place: Callable[[str, float], float] = lambda _, speed: speed,
) -> None:
    """A row for each of the `runs`, name -> all speeds of a blade and scene, with their stress.

    `place`: where a speed (rad/s) of a name lies on the axis.
    """
    for number, ((name, response), colour) in enumerate(zip(runs.items(), colours, strict=True)):
        speeds, height = response["speed"].values, (number - 0.38, 0.76)
        ran = [SpeedRange(speeds[0], speeds[-1], truncated=True)] if len(speeds) else []
        spans = [
            [(place(name, part.begin), place(name, part.end) - place(name, part.begin)) for part in parts]
            for parts in (ran, *kinds_of(response).values())
        ]
        looks = ({"facecolor": colour, "alpha": 0.12}, {"facecolor": colour}, style.UNKNOWN | {"edgecolor": colour})
        for part, look in zip(spans[:3], looks, strict=True):
            axes.broken_barh(part, height, **{"linewidth": 0.0} | look)
        for begin, width in spans[3]:
            axes.plot([begin, begin + width], [number, number], solid_capstyle="butt", **LINE_LOOK)
        if causes := causes_text(response):
            axes.text(1.01, number, f"by {causes}", fontsize=6, va="center", transform=axes.get_yaxis_transform())
    axes.set_yticks(range(len(runs)), list(runs))
    axes.set_ylim(max(len(runs), 1) - 0.5, -0.5)
    axes.grid(visible=False, axis="y")


def shown_runs(rms: Dataset, stress: Dataset | None, further_runs: Dataset | None) -> tuple[Dataset, Dataset | None, Dataset]:
    """The two datasets with the further runs of a verdict in place of the sweep's, and the runs with motion and stress."""
    rms = with_further_runs("rms", rms, further_runs)
    if stress is None:
        return rms, None, rms
    stress = with_further_runs("stress", stress, further_runs)
    return rms, stress, xr.merge([rms, stress], join="left", compat="override")


def kinds_of(response: Dataset) -> dict[str, list[SpeedRange]]:
    """Ranges of dangerous, unknown and sustained speeds; without stress unknown are all at which the model is left."""
    if "max_von_mises_inside" in response and response["max_von_mises_inside"].notnull().any():
        return dict(zip(KINDS, ranges_of(response).values(), strict=True))
    left = response["exit_revolution"].notnull().values.astype(float)
    return dict(zip(KINDS, ([], ranges_above(response["speed"].values, left, 0.5), []), strict=True))


def causes_text(response: Dataset) -> str:
    """Limits by which runs leave the model before they pass yield, those of the most runs first: heat, force."""
    danger = response.get("yield_danger", response["exit_cause"] > 0)
    causes = response["exit_cause"].values[danger.values == Danger.UNKNOWN]
    return ", ".join(Cause(cause).text for cause, _ in Counter(causes.tolist()).most_common())
