"""Panel of the explorer: designs as maps over two numbers that vary."""

import pandas as pd

from r37core.explorer.contents import packed

from .table import compared_in, length_column


def contents(table: pd.DataFrame) -> list[dict[str, object]]:
    """A map of each family of two keys: its `family`, `keys`, `other` (blade or scene, of which each has a map), and cells.

    `cells`: blade, scene and values of the keys; `values`: length above yield in most revolutions (rad/s), by cell.
    """
    maps: list[dict[str, object]] = []
    for name, compared in compared_in(table).items():
        if len(compared.keys) == 2:
            rows = table[table["family"] == name]
            cells = rows[["blade", "scene", *compared.keys]].to_numpy().tolist()
            values = packed(rows[length_column(table)].to_numpy(float))
            about = {"family": name, "keys": list(compared.keys), "other": compared.other}
            maps.append(about | {"cells": cells, "values": values})
    return maps
