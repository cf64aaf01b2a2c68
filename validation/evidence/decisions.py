"""What an engineer decides: clearance and lining, and fatigue of a blade that stays below yield."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from r37core.figures import style
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .pages import write_table

CLEARANCE, THICKNESS = "scene.casing.clearance_m", "scene.lining.thickness_m"


def lengths(input: Any, output: Any, params: Any) -> None:
    """Lengths above yield over lining and clearance. Input: designs. Outputs: table, picture."""
    designs = read_table(input.designs)
    column = "length_most_revolutions_rad_s"
    rows = []
    for (blade, thickness), part in designs.groupby(["blade", THICKNESS], sort=False):
        by_clearance = part.sort_values(CLEARANCE)
        clearances = [f"{1e3 * clearance:.2f} mm" for clearance in by_clearance[CLEARANCE]]
        rows.append([blade, f"{1e3 * thickness:g}", *(f"{length:.0f}" for length in by_clearance[column])])
    write_table(["blade", "lining (mm)", *clearances], rows, output.table)
    draw_lengths(pd.DataFrame(rows, columns=["blade", "lining", *clearances]), output.picture)


def draw_lengths(table: pd.DataFrame, file: str) -> None:
    """A map of lengths for each blade: thickness of the lining over clearance."""
    blades = {str(blade): part for blade, part in table.groupby("blade", sort=False)}
    letters: dict[Any, Any] = {f"{name}size": 9 for name in ("font.", "axes.title", "axes.label", "xtick.label", "ytick.label")}
    largest = table.iloc[:, 2:].astype(float).to_numpy().max()
    with plt.rc_context(letters):
        figure, panels = plt.subplots(len(blades), 1, figsize=(4.6, 1.75 * len(blades)), sharex=True)
        for axes, (blade, part) in zip(panels, blades.items(), strict=True):
            values = part.iloc[:, 2:].astype(float).to_numpy()
            image = axes.imshow(values, origin="lower", aspect="auto", cmap="YlOrRd", vmin=0.0, vmax=largest)
            for (row, column), value in np.ndenumerate(values):
                colour = "white" if value > 0.66 * largest else "black"
                axes.text(column, row, f"{value:.0f}", ha="center", va="center", color=colour)
            axes.set_yticks(range(len(part)), part["lining"])
            axes.set_title(f"blade {blade}", loc="left")
            axes.grid(visible=False)
        panels[-1].set_xticks(range(table.shape[1] - 2), [name.removesuffix(" mm") for name in table.columns[2:]])
        panels[-1].set_xlabel("clearance (mm)")
        figure.supylabel("thickness of the lining (mm)")
        figure.colorbar(image, ax=panels, label="speeds above yield (rad/s)")
        style.save(figure, file)


def verdicts(input: Any, output: Any, params: Any) -> None:
    """Verdicts on lengths above yield, and the shortest and longest of all that was tried. Input: verdict. Output: table."""
    head = ["blade", "scene", "verdict", "shortest (rad/s)", "longest (rad/s)", "runs besides the sweep's", "note"]
    columns = ["blade", "scene", "verdict", "value_lowest", "value_highest", "further_runs", "note"]
    verdict = read_table(input.verdict)
    lengths = {name: verdict[name].map("{:.0f}".format) for name in ("value_lowest", "value_highest")}
    write_table(head, verdict.assign(**lengths)[columns].fillna("").astype(str).values.tolist(), output.table)


def fatigue(input: Any, output: Any, params: Any) -> None:
    """Largest stress against yield and the Goodman line. Inputs: stress, ranking. Output: table."""
    stress, row = read_judged(input.stress), read_table(input.ranking).iloc[0]
    largest = float((stress["max_von_mises_ever"] / stress["yield_stress"]).max())
    cells = [row["blade"], f"{largest:.2f}", f"{row['largest_goodman_share']:.2f}", f"{row['length_goodman_rad_s']:.0f}"]
    head = ["blade", "largest stress / yield", "largest Goodman share", "length above the line (rad/s)"]
    write_table(head, [cells], output.table)
