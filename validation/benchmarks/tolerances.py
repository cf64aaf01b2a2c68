"""Ranges of docs/tolerances.md, from finished results of config/tolerances.yaml.

Run: make claims ONLY=tolerances. The page's other tables are those of tolerance_rankings.py, its picture is of the second run.

    snakemake tolerances --configfile config/config.yaml config/tolerances.yaml --config tolerances='{members: 16}'
    snakemake tolerances --configfile config/config.yaml config/tolerances.yaml --config run='{name: members}' blades='[Ref]'
"""

from pathlib import Path

import pandas as pd

from r37core.io import write_text
from r37core.results.ranges import ENDS, read_ranges
from r37core.rounding import rounded_to
from validation.studies.tables import markdown_table

RESULTS = Path("results")
MODE, ORDER = "1B", 4


def spread(row, name, scale=1.0):
    """Nominal value, median and range as text, with as many digits as the range bears."""
    low, high = (scale * row[f"{name}_{end}"] for end in (ENDS[0], ENDS[-1]))
    values = (scale * row[column] for column in (name, *(f"{name}_{end}" for end in ENDS)))
    nominal, low, median, high = (rounded_to(value, high - low) for value in values)
    return nominal, f"{median} ({low} to {high})"


def range_rows(table):
    """Of each blade the interaction, nominal and with its range."""
    chosen = table[(table["mode"] == MODE) & (table["engine_order"] == ORDER)]
    for _, row in chosen.iterrows():
        cells = {"blade": row["blade"]}
        for name, label, scale in (
            ("peak_speed_rad_s", "peak (rad/s)", 1.0),
            ("first_yield_speed_rad_s", "first yield (rad/s)", 1.0),
            ("width_above_yield_rad_s", "width above yield (rad/s)", 1.0),
            ("max_von_mises_pa", "largest stress (GPa)", 1e-9),
        ):
            nominal, ranged = spread(row, name, scale)
            cells |= {label: nominal, f"{label.split(' (')[0]}, median (range)": ranged}
        yield cells


if __name__ == "__main__":
    cells = list(range_rows(read_ranges(RESULTS / "tolerances.csv")))
    table = markdown_table(list(cells[0]), pd.DataFrame(cells).values.tolist())
    write_text(table, RESULTS / "studies/tolerance_ranges.md")
