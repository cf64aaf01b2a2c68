"""Lengths above yield over the contact length, on made-up data."""

from types import SimpleNamespace

import pandas as pd
from evidence import lining
from evidence.tables import read_table


def test_lengths_of_all_blades_stand_together(tmp_path):
    files = []
    for blade, lengths in {"Ref": (30.0, 5.0), "S100": (10.0, 20.0)}.items():
        files.append(tmp_path / f"{blade}.csv")
        pd.DataFrame([{"blade": blade, "0.05": lengths[0], "1": lengths[1]}]).to_csv(files[-1], index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lining.contact_lengths(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head == ["blade", "0.05 mm", "1 mm"]
    assert rows == [["Ref", "30", "5"], ["S100", "10", "20"]]
    assert output.picture.stat().st_size > 10_000
