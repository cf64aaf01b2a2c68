"""How long an interaction lasts: runs of several lengths about it."""

from typing import Any

import numpy as np

from r37core.figures.style import PAGE, plt, save
from r37core.results.measures import motion
from r37core.results.regions import read_judged
from r37core.time_integration.settling import MotionAtEnd

from .tables import danger_cell, write_table

STATES = (MotionAtEnd.LASTING, MotionAtEnd.GROWING, MotionAtEnd.CUT_FREE, MotionAtEnd.QUIET)


def lasting(input: Any, output: Any, params: Any) -> None:
    """Table by length of a run, and curves of rms. Input: runs (responses). Params: revolutions. Outputs: table, picture."""
    rows, (figure, axes) = [], plt.subplots(figsize=(PAGE, 2.8))
    for file, revolutions, marker in zip(input.runs, params.revolutions, "oxv", strict=True):
        response = read_judged(file)
        counts = [np.count_nonzero(response["motion_at_end"] == state) for state in STATES]
        rows.append([revolutions, danger_cell(response), *map(str, counts)])
        axes.plot(response["speed"], 1e3 * motion(response), f"{marker}-", markersize=3, label=revolutions)
    states = [state.text.replace("_", " ") for state in STATES]
    write_table(
        ["revolutions", "dangerous / unknown / sustained (rad/s)", *(f"{state}: runs" for state in states)], rows, output.table
    )
    axes.set_xlabel("speed (rad/s)")
    axes.set_ylabel("rms of the leading edge (mm)")
    axes.legend(title="revolutions")
    save(figure, output.picture)
