"""Run-ups through 1B with engine order 4: the rate that each blade needs, and what moves it."""

from typing import Any

import numpy as np
import pandas as pd

from r37studies.run_ups.tables import safe_rates

from .tables import write_table

SHOWN = (100, 3000)
"""Rates (rad/s2) at which the stress is shown."""


def rates(input: Any, output: Any, params: Any) -> None:
    """Table of the blades in the order of the rate that they need upwards. Input: run_ups, a table of the product."""
    rows = []
    for blade, runs in pd.read_csv(input.run_ups).groupby("blade", sort=False):
        upwards, downwards = (runs[runs.direction == direction] for direction in ("up", "down"))
        share = upwards.largest_stress_pa / upwards.yield_stress_pa
        # whole samples make rates that are nearly those asked for
        stress = [f"{share[np.isclose(upwards.rate_rad_s2, rate, rtol=1e-3)].max():.2f}" for rate in SHOWN]
        speeds = f"{runs.low_speed_rad_s.iloc[0]:.0f} to {runs.high_speed_rad_s.iloc[0]:.0f}"
        needed = safe_rates(upwards)["lowest_safe_rate_rad_s2"]
        rows.append(
            (
                -np.nan_to_num(needed, nan=np.inf),
                -share.max(),
                [blade, speeds, *stress, needed_rate(upwards), needed_rate(downwards)],
            )
        )
    head = ["blade", "speeds (rad/s)", *(f"stress / yield at {rate}" for rate in SHOWN)]
    head += ["up: below yield from (rad/s²)", "down: below yield from (rad/s²)"]
    write_table(head, [cells for *_, cells in sorted(rows)], output.table)


def variants(input: Any, output: Any, params: Any) -> None:
    """Table of the largest stress of run-ups of which one thing is varied. Input: run_ups, tables of the product.

    Params: blades, and names of the run-ups by the name of a row.
    """
    runs = pd.concat([pd.read_csv(file) for file in input.run_ups]).set_index(["run_up", "blade"])
    share = runs.largest_stress_pa / runs.yield_stress_pa
    rows = [[row, *(f"{share[name, blade]:.2f}" for blade in params.blades)] for row, name in params.names.items()]
    write_table(["stress / yield at 3000 rad/s²", *params.blades], rows, output.table)


def needed_rate(runs: pd.DataFrame) -> str:
    """Rate (rad/s2) from which on run-ups stay below yield, of two digits; a bound where it is outside of those tried."""
    safe = safe_rates(runs)
    names = ("rate_at_yield_rad_s2", "slowest_rate_rad_s2", "fastest_rate_rad_s2")
    needed, slowest, fastest = (f"{float(f'{safe[name]:.2g}'):g}" for name in names)
    if np.isfinite(safe[names[0]]):
        return needed
    return f"{slowest} or less" if np.isfinite(safe["lowest_safe_rate_rad_s2"]) else f"more than {fastest}"
