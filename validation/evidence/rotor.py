"""Rotors against a single blade: dangerous, unknown and sustained speeds, and how many blades are above yield at once."""

from collections.abc import Sequence
from functools import partial
from typing import Any

from r37core.base.dataset_file import read_dataset
from r37core.figures import style
from r37core.figures.danger_rows import LEGEND, draw_danger_rows
from r37core.figures.style import plt
from r37core.results.danger import danger_of, ranges_of
from r37core.results.exceedance import SpeedRange
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .tables import danger_cell, write_table

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
    *("blade", "rotor", "dangerous / unknown / sustained (rad/s)", "dangerous: from 1B/4 (%)", "unknown: from 1B/4 (%)"),
    *("sustained: from 1B/4 (%)", "largest stress / yield", "blades at once in most revolutions"),
)


def kinds(input: Any, output: Any, params: Any) -> None:
    """Speeds of a single blade and of rotors of it that are not below yield inside the model. Outputs: table, picture.

    Inputs: responses of BLADES by scene, of a rotor with the stress of any blade; campbell; rotors (csv).
    """
    rows, crossings = [], read_dataset(input.campbell)["crossing_speed"].sel(mode="1B", engine_order=4)
    at_once = read_table(input.rotors).set_index(["blade", "scene"])["blades_above_yield"]
    figure, panels = plt.subplots(len(BLADES), 1, figsize=(5.6, 5.4), layout="constrained", sharex=True)
    for place, (blade, axes) in enumerate(zip(BLADES, panels, strict=True)):
        drawn, crossing = {}, float(crossings.sel(blade=blade))
        for kind, words in KINDS.items():
            judged = read_judged(input[kind][place])
            drawn[words], ranges = judged, list(ranges_of(judged).values())
            blades = at_once.get((blade, kind), int(bool(ranges[-1])))
            row = [blade, words, danger_cell(judged), *(_distance(parts, crossing) for parts in ranges)]
            rows.append([*row, f"{danger_of(judged)['largest_stress_over_yield']:.2f}", str(blades)])
        draw_danger_rows(axes, drawn, ["#D55E00"] * len(drawn), partial(_percent, crossing))
        axes.axvline(0.0, color="0.3", linestyle="--", linewidth=0.9)
        axes.set_xlim(AVOIDED)
        axes.set_title(f"{blade}, 1B/4 at {crossing:.0f} rad/s", loc="left", fontweight="bold")
    panels[-1].set_xlabel("speed, from 1B/4 of one blade (%)")
    figure.legend(LEGEND.values(), LEGEND, loc="outside upper center")
    style.save(figure, output.picture)
    write_table(list(COLUMNS), rows, output.table)


def _distance(ranges: Sequence[SpeedRange], crossing: float) -> str:
    """How far the first and the last speed of all ranges are from a `crossing` (rad/s), in percent of it."""
    ends = (ranges[0].begin, ranges[-1].end) if ranges else ()
    return ", ".join(f"{_percent(crossing, '', end):+.1f}" for end in ends) or "-"


def _percent(crossing: float, _: str, speed: float) -> float:
    """A speed (rad/s) in percent from a `crossing` (rad/s)."""
    return 100.0 * (speed / crossing - 1.0)
