"""Lengths over the contact length, on made-up data."""

from types import SimpleNamespace

import pandas as pd
from evidence import lining
from evidence.tables import read_table


def test_lengths_of_all_blades_stand_together(tmp_path):
    files = []
    for blade, lengths in {"Ref": (30.0, 5.0), "S100": (10.0, 20.0)}.items():
        files.append(tmp_path / f"{blade}.csv")
        rows = [
            {"blade": blade, "mm": 10.0**place, "dangerous": length, "unknown": 25.0} for place, length in enumerate(lengths)
        ]
        pd.DataFrame(rows).to_csv(files[-1], index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv", picture=tmp_path / "picture.png")
    lining.contact_lengths(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head == ["blade", "1 mm", "10 mm"]
    assert rows == [["Ref", "30 / 25", "5 / 25"], ["S100", "10 / 25", "20 / 25"]]
    assert output.picture.stat().st_size > 10_000
