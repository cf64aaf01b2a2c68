"""What an engineer decides: limits of clearance over linings, and fatigue of a blade that stays below yield."""

import shutil
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from r37core.figures import style
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from .pages import write_table

CLEARANCE, THICKNESS = "scene.casing.clearance_m", "scene.lining.thickness_m"
FINE_THICKNESS = 0.003
"""Thickness of the lining (m) of the finer grid."""


def limits(input: Any, output: Any, params: Any) -> None:
    """Clearances from which a blade meets all requirements, by lining. Inputs: coarse, fine (designs and verdict)."""
    coarse, fine = (_judged(*map(read_table, files)) for files in (input.coarse, input.fine))
    rows = []
    for (blade, thickness), part in coarse.groupby(["blade", THICKNESS], sort=False):
        finer = fine[fine["blade"] == blade] if thickness == FINE_THICKNESS else fine[:0]
        rows.append([blade, f"{1e3 * thickness:g}", limit_text(part), limit_text(finer) if len(finer) else ""])
    head = ["blade", "lining (mm)", "meets from, steps of 0.1 mm", "meets from, steps of 0.01 mm"]
    write_table(head, rows, output.table)


def lengths(input: Any, output: Any, params: Any) -> None:
    """Lengths above yield in operation over lining and clearance. Input: designs. Outputs: table, picture."""
    designs = read_table(input.designs)
    column = "length_most_revolutions_operating_rad_s"
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
    with plt.rc_context(letters):
        figure, panels = plt.subplots(len(blades), 1, figsize=(4.6, 1.75 * len(blades)), sharex=True)
        for axes, (blade, part) in zip(panels, blades.items(), strict=True):
            values = part.iloc[:, 2:].astype(float).to_numpy()
            image = axes.imshow(values, origin="lower", aspect="auto", cmap="YlOrRd", vmin=0.0, vmax=120.0)
            for (row, column), value in np.ndenumerate(values):
                axes.text(column, row, f"{value:.0f}", ha="center", va="center", color="white" if value > 80.0 else "black")
            axes.set_yticks(range(len(part)), part["lining"])
            axes.set_title(f"blade {blade}", loc="left")
            axes.grid(visible=False)
        panels[-1].set_xticks(range(table.shape[1] - 2), [name.removesuffix(" mm") for name in table.columns[2:]])
        panels[-1].set_xlabel("clearance (mm)")
        figure.supylabel("thickness of the lining (mm)")
        figure.colorbar(image, ax=panels, label="speeds above yield in operation (rad/s)")
        style.save(figure, file)


def verdicts(input: Any, output: Any, params: Any) -> None:
    """Verdicts on lengths above yield, and the shortest and longest of all that was tried. Input: verdict. Output: table."""
    head = ["blade", "scene", "verdict", "shortest (rad/s)", "longest (rad/s)", "runs besides the sweep's", "note"]
    columns = ["blade", "scene", "verdict", "value_lowest", "value_highest", "further_runs", "note"]
    verdict = read_table(input.verdict)
    lengths = {name: verdict[name].map("{:.0f}".format) for name in ("value_lowest", "value_highest")}
    write_table(head, verdict.assign(**lengths)[columns].fillna("").astype(str).values.tolist(), output.table)


def _judged(designs: pd.DataFrame, verdict: pd.DataFrame) -> pd.DataFrame:
    """Designs by ascending clearance, and whether they meet all requirements."""
    kept = verdict.assign(meets=verdict["verdict"].isin(["meets", "does not apply"]))
    meets = kept.groupby(["blade", "scene"], sort=False)["meets"].all()
    return designs.merge(meets.reset_index(), on=["blade", "scene"]).sort_values(CLEARANCE, kind="stable")


def limit_text(part: pd.DataFrame) -> str:
    """Smallest clearance (mm) from which on every one meets the requirements; none where the largest does not."""
    meets = part["meets"].tolist()
    if not meets[-1]:
        return "none"
    first = len(meets) - next((number for number, kept in enumerate(reversed(meets)) if not kept), len(meets))
    return f"{1e3 * part[CLEARANCE].iloc[first]:.2f}"


def fatigue(input: Any, output: Any, params: Any) -> None:
    """Largest stress against yield and the Goodman line. Inputs: stress, ranking, picture. Outputs: table, picture."""
    stress, row = read_judged(input.stress), read_table(input.ranking).iloc[0]
    largest = float((stress["max_von_mises_ever"] / stress["yield_stress"]).max())
    cells = ["Ref", f"{largest:.2f}", f"{row['largest_goodman_share']:.2f}", f"{row['length_goodman_rad_s']:.0f}"]
    write_table(
        ["blade", "largest stress / yield", "largest Goodman share", "length above the line (rad/s)"], [cells], output.table
    )
    shutil.copyfile(input.picture, output.picture)
