"""Table of the limit of the lining by its material, from made-up runs."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
from evidence import lining
from evidence.pages import read_table


def test_a_case_is_compared_with_the_finest_over_its_range(tmp_path):
    wear = np.full((6, 10), 1e-3)
    # the last speed of the range does not count
    rms = np.array([9e-3, 2e-3, 2e-3, 2e-3, 1e-3, 9e-3])
    finest = lining.Range(1700.0, 1720.0, rms, wear, 1, 4)
    found = lining.Range(1700.0, 1724.0, rms * [2.0, 1.05, 0.95, 1.3, 3.0, 2.0], 1.1 * wear, 1, 5)
    row = lining._row("Ref", "4 patches", found, finest)
    assert (round(row["rms"], 9), row["other_branch"], row["speeds"], round(row["wear"], 9)) == (5.0, 1, 3, 10.0)
    pd.DataFrame([row]).to_csv(tmp_path / "Ref.csv", index=False)
    table = tmp_path / "table.csv"
    lining.limits(SimpleNamespace(files=[tmp_path / "Ref.csv"]), SimpleNamespace(table=table), None)
    assert read_table(table)[1] == ["4 patches", "1700 to 1724; 5.0%; 1/3; 10.0%"]
