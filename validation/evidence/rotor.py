"""Rotors against a single blade: speeds above yield in most revolutions and ever, and how many blades are at once."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.figures.style import plt
from r37core.results.danger import danger_of, ranges_of
from r37core.results.exceedance import SpeedRange, length_of
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .tables import write_table

BLADES = ("Ref", "CS100")
"""Blades of the rotors: without sweep, and with most speeds above yield on a lining."""

KINDS = {
    "single": "a single blade",
    "single_twice": "a single blade, runs twice as long",
    "equal": "36 equal blades",
    "mistuned_1": "1% of mistuning, seed 0",
    "mistuned_1_other": "1% of mistuning, seed 1",
    "mistuned_1_third": "1% of mistuning, seed 2",
    "mistuned_1_twice": "seed 0, runs twice as long",
}
"""Scenes of validation/decisions.yaml."""

AVOIDED = (-8.0, 6.0)
"""Range about 1B/4, in percent of its speed, that is run and that the page advises to avoid."""

COLUMNS = (
    *("blade", "rotor", "above yield in most revolutions (rad/s)", "ranges (rad/s)", "from 1B/4 (%)"),
    *("ever above yield (rad/s)", "ever: from 1B/4 (%)"),
    *("largest stress / yield", "blades at once in most revolutions"),
)


def kinds(input: Any, output: Any, params: Any) -> None:
    """Speeds above yield of a single blade and of rotors of it. Outputs: table, picture.

    Inputs: responses of BLADES by scene, of a rotor with the stress of any blade; campbell; rotors (csv).
    """
    rows, crossings = [], read_dataset(input.campbell)["crossing_speed"].sel(mode="1B", engine_order=4)
    at_once = read_table(input.rotors).set_index(["blade", "scene"])["blades_above_yield"]
    figure, panels = plt.subplots(len(BLADES), 1, figsize=(5.6, 5.4), layout="constrained", sharex=True)
    for place, (blade, axes) in enumerate(zip(BLADES, panels, strict=True)):
        drawn, crossing = {}, float(crossings.sel(blade=blade))
        for kind, words in KINDS.items():
            judged = read_judged(input[kind][place])
            ever, _, most = ranges_of(judged).values()
            drawn[words] = {"ever above yield": ever, "in most revolutions": most}
            blades = at_once.get((blade, kind), int(bool(most)))
            where = ", ".join(f"{part.begin:.0f} to {part.end:.0f}" for part in most) or "-"
            row = [blade, words, f"{length_of(most):.0f}", where, _distance(most, crossing)]
            row += [f"{length_of(ever):.0f}", _distance(ever, crossing)]
            rows.append([*row, f"{danger_of(judged)['largest_stress_over_yield']:.2f}", str(blades)])
        _bars(axes, drawn, crossing)
        axes.axvline(0.0, color="0.3", linestyle="--", linewidth=0.9, label="1B/4 of one blade")
        axes.set_xlim(AVOIDED)
        axes.set_title(f"{blade}, 1B/4 at {crossing:.0f} rad/s", loc="left", fontweight="bold")
    panels[-1].set_xlabel("speed, from 1B/4 (%)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    style.save(figure, output.picture)
    write_table(list(COLUMNS), rows, output.table)


def _distance(ranges: Sequence[SpeedRange], crossing: float) -> str:
    """How far the first and the last speed of all ranges are from a `crossing` (rad/s), in percent of it."""
    ends = (ranges[0].begin, ranges[-1].end) if ranges else ()
    return ", ".join(f"{_percent(end, crossing):+.1f}" for end in ends) or "-"


def _percent(speed: float, crossing: float) -> float:
    return 100.0 * (speed / crossing - 1.0)


def _bars(axes: Axes, drawn: Mapping[str, Mapping[str, Sequence[SpeedRange]]], crossing: float) -> None:
    """Ranges by kind of rotor, in percent from a `crossing`, a line for each, those in most revolutions on those ever."""
    for place, ranges in enumerate(drawn.values()):
        for (label, parts), colour in zip(ranges.items(), ("#F2C6A7", "#D55E00"), strict=True):
            # a thin edge, so that what is narrower than a dot is seen
            bars = [(_percent(part.begin, crossing), 100.0 * part.length / crossing) for part in parts]
            axes.broken_barh(bars, (place - 0.3, 0.6), color=colour, linewidth=0.5, label=label if place == 0 else "")
    axes.set(yticks=np.arange(len(drawn)), yticklabels=list(drawn), ylim=(len(drawn) - 0.5, -0.5))
    axes.grid(visible=False, axis="y")
