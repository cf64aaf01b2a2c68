"""What an engineer decides: clearance and lining; fatigue."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.patches import Rectangle

from r37core.figures import style
from r37core.results.events import Danger
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .tables import write_table

CLEARANCE, THICKNESS = "scene.casing.clearance_m", "scene.lining.thickness_m"


def lengths(input: Any, output: Any, params: Any) -> None:
    """Dangerous and unknown lengths, and largest stress inside the model, over lining and clearance. Input: designs.

    Outputs: table, picture.
    """
    designs = read_table(input.designs).sort_values(CLEARANCE, kind="stable")
    clearances = [f"{1e3 * clearance:.2f} mm" for clearance in designs[CLEARANCE].unique()]
    rows = []
    for (blade, thickness), part in designs.groupby(["blade", THICKNESS], sort=False):
        numbers = part[["length_dangerous_rad_s", "length_unknown_rad_s", "largest_stress_over_yield"]].itertuples(index=False)
        rows.append([blade, f"{1e3 * thickness:g}", *("{:.0f} / {:.0f} ({:.2f})".format(*row) for row in numbers)])
    write_table(["blade", "lining (mm)", *clearances], rows, output.table)
    draw_stresses(designs, output.picture)


def draw_stresses(designs: pd.DataFrame, file: str) -> None:
    """A map of the largest stress for each blade: thickness of the lining over clearance; hatched where speeds are unknown."""
    blades = designs["blade"].unique()
    sizes: dict[Any, int] = dict.fromkeys(("font.size", *(f"{name}size" for name in ("axes.title", "axes.label"))), 9)
    with plt.rc_context(sizes | dict.fromkeys(("xtick.labelsize", "ytick.labelsize"), 9)):
        figure, panels = plt.subplots(len(blades), 1, figsize=(4.6, 1.75 * len(blades)), sharex=True)
        for axes, blade in zip(panels, blades, strict=True):
            part = designs[designs["blade"] == blade]
            table, unknown = (
                part.pivot(index=THICKNESS, columns=CLEARANCE, values=values)
                for values in ("largest_stress_over_yield", "length_unknown_rad_s")
            )
            image = axes.imshow(table, origin="lower", aspect="auto", cmap="RdBu_r", vmin=0.0, vmax=2.0)
            for (row, column), value in np.ndenumerate(table.to_numpy()):
                colour = "white" if abs(value - 1.0) > 0.6 else "black"
                axes.text(column, row, f"{value:.2f}", ha="center", va="center", color=colour)
                if unknown.iloc[row, column] > 0.0:
                    axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, fill=False, linewidth=0, hatch="///", alpha=0.4))
            axes.set_yticks(range(len(table.index)), [f"{1e3 * thickness:g}" for thickness in table.index])
            axes.set_xticks(range(len(table.columns)), [f"{1e3 * clearance:.2f}" for clearance in table.columns])
            axes.set_title(f"blade {blade}", loc="left")
            axes.grid(visible=False)
        panels[-1].set_xlabel("clearance (mm)")
        figure.supylabel("thickness of the lining (mm)")
        figure.colorbar(image, ax=panels, label="largest stress over yield inside the model", extend="max")
        style.save(figure, file)


def verdicts(input: Any, output: Any, params: Any) -> None:
    """Verdicts on lengths above yield, and the shortest and longest of all that was tried. Input: verdict. Output: table."""
    head = ["blade", "scene", "verdict", "shortest (rad/s)", "longest (rad/s)", "runs besides the sweep's", "note"]
    columns = ["blade", "scene", "verdict", "value_lowest", "value_highest", "further_runs", "note"]
    verdict = read_table(input.verdict)
    texts = {name: verdict[name].map("{:.0f}".format) for name in ("value_lowest", "value_highest")}
    # the first reason decides
    texts["note"] = verdict["note"].str.split(";").str[0]
    write_table(head, verdict.assign(**texts)[columns].fillna("").astype(str).values.tolist(), output.table)


def fatigue(input: Any, output: Any, params: Any) -> None:
    """Largest stress against yield and the Goodman line, inside the model. Inputs: stress, ranking. Output: table."""
    stress, row = read_judged(input.stress), read_table(input.ranking).iloc[0]
    share, danger = float(stress["goodman_share_inside"].max()), stress["goodman_danger"]
    speeds = (str(int((danger == each).sum())) for each in (Danger.DANGEROUS, Danger.UNKNOWN))
    cells = [row["blade"], f"{row['largest_stress_over_yield']:.2f}", f"{share:.2f}", *speeds]
    head = ["blade", "largest stress / yield", "largest Goodman share", "speeds above the line", "unknown speeds"]
    write_table(head, [cells], output.table)
