"""Table of lengths above yield over the clearance, from made-up ones."""

from types import SimpleNamespace

import pandas as pd
from evidence import lobes
from evidence.pages import read_table


def test_a_length_beyond_the_speeds_is_marked(tmp_path):
    files = []
    for contact in ("points", "patches"):
        rows = [
            [contact, scene, "Ref", kind, clearance, 100.0 * clearance + 0.25 * place, clearance == 0.6]
            for place, scene in enumerate(lobes.SCENES)
            for kind in (lobes.HELD, lobes.SCALED)
            for clearance in lobes.CLEARANCES
        ]
        files.append(tmp_path / f"{contact}.csv")
        columns = ["contact", "scene", "blade", "lobes", "clearance_mm", "length_rad_s", "beyond"]
        pd.DataFrame(rows, columns=columns).to_csv(files[-1], index=False)
    output = SimpleNamespace(table=tmp_path / "table.csv")
    lobes.lengths(SimpleNamespace(files=files), output, None)
    head, *rows = read_table(output.table)
    assert head[:5] == ["scene", "blade", "contact", "lobes", "0.2 mm"] and len(rows) == 8
    assert ["lining", "Ref", "points", "0.712 mm", "20", "30", "36", "40", "50", "> 60"] in rows
    assert ["bare casing", "Ref", "patches", "2 clearances", "20", "30", "36", "40", "50", "> 60"] in rows
