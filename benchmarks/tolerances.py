"""Tables of docs/tolerances.md, from finished results of config/tolerances.yaml.

Run: make claims ONLY=tolerances. The sensitivity of one blade is that of a run named
`sensitivity`, the price of few members that of a run named `members`, of one blade with many members:

    snakemake tolerances --configfile config/config.yaml config/tolerances.yaml --config tolerances='{members: 16}'
    snakemake tolerances --configfile config/config.yaml config/tolerances.yaml \\
        --config run='{name: sensitivity}' blades='[Ref]' tolerances='{members: 16, sensitivity: true}'
    snakemake tolerances --configfile config/config.yaml config/tolerances.yaml \\
        --config run='{name: members}' blades='[Ref]' tolerances='{members: 64}'
"""

from pathlib import Path

import numpy as np
import pandas as pd

from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.studies.tables import markdown_table
from r37core.tolerances.dataset import INDEXED, QUANTILES
from r37core.tolerances.table import read_ranges

RESULTS = Path("results")
MODE, ORDER = "1B", 4
PRICED = {"peak_speed": "peak speed", "width_above_yield": "width above yield", "largest_stress": "largest stress"}


def spread(row, name, scale=1.0, digits=0):
    """Nominal value, median and range as text."""
    nominal, low, median, high = (scale * row[f"{name}{end}"] for end in ("", "_low", "_median", "_high"))
    return f"{nominal:.{digits}f}", f"{median:.{digits}f} ({low:.{digits}f} to {high:.{digits}f})"


def range_rows(table):
    """Of each blade the interaction, nominal and with its range."""
    chosen = table[(table["mode"] == MODE) & (table["engine_order"] == ORDER)]
    for _, row in chosen.iterrows():
        cells = {"blade": row["blade"]}
        for name, label, scale, digits in (
            ("peak_speed_rad_s", "peak (rad/s)", 1.0, 0),
            ("first_yield_speed_rad_s", "first yield (rad/s)", 1.0, 0),
            ("width_above_yield_rad_s", "width above yield (rad/s)", 1.0, 0),
            ("max_von_mises_pa", "largest stress (GPa)", 1e-9, 2),
        ):
            nominal, ranged = spread(row, name, scale, digits)
            cells |= {label: nominal, f"{label.split(' (')[0]}, median (range)": ranged}
        yield cells


def sensitivity_table(dataset):
    """Total and first-order index of each number for each measure."""
    of = dataset.isel(blade=0, scene=0)
    rows = []
    for number in of["number"].values:
        row = [f"`{number}`"]
        for measure in INDEXED:
            one = of.sel(number=number, measure=measure)
            low, high = float(one["sobol_total_low"]), float(one["sobol_total_high"])
            row.append(f"{float(one['sobol_total']):.2f} ({low:.2f} to {high:.2f}), {float(one['sobol_first']):.2f}")
        rows.append(row)
    return markdown_table(["number", *(f"{PRICED[name]}: total (range), alone" for name in INDEXED)], rows)


def price_table(dataset):
    """Largest error of the range's ends and of the median with fewer members, over independent parts of the sample."""
    of, rows = dataset.isel(blade=0, scene=0), []
    every = of.sizes["member"]
    for members in (number for number in (4, 8, 16, 32, 64) if 2 * number <= every):
        row = [str(members)]
        for name in PRICED:
            values = of[name].values.reshape(-1, members)
            whole = np.quantile(of[name].values, QUANTILES, method="inverted_cdf")
            found = np.quantile(values, QUANTILES, axis=1, method="inverted_cdf")
            error = np.sqrt(np.mean((found - whole[:, None]) ** 2, axis=1)) / (whole[-1] - whole[0])
            row.append(" / ".join(f"{100 * value:.0f}%" for value in error))
        rows.append(row)
    return markdown_table([f"members (of {every})", *PRICED.values()], rows)


if __name__ == "__main__":
    cells = list(range_rows(read_ranges(RESULTS / "tolerances.csv")))
    folder = RESULTS / "studies"
    write_text(markdown_table(list(cells[0]), pd.DataFrame(cells).values.tolist()), folder / "tolerance_ranges.md")
    for run, table in (("sensitivity", sensitivity_table), ("members", price_table)):
        found = read_dataset(RESULTS / "runs" / run / "tolerances.nc")
        write_text(table(found), folder / f"tolerance_{run}.md")
