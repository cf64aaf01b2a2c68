"""Panel of the explorer: designs as maps over two numbers that vary."""

import pandas as pd

from r37core.explorer.contents import packed

from .compared import axis_of_key
from .maps import measured, some_above_yield
from .table import compared_in


def contents(designs: pd.DataFrame, verdict: pd.DataFrame | None = None) -> list[dict[str, object]]:
    """A map of each family of two keys: its `family`, `axes`, `other` (blade or scene, of which each has a map), and cells.

    `axes`: label and factor of each key; `cells`: blade, scene and values of the keys; `values`, `label` and `digits`: those
    of the figure (maps.measured), `some`: maps.some_above_yield, by cell.
    """
    maps: list[dict[str, object]] = []
    for name, compared in compared_in(designs).items():
        if len(compared.keys) == 2:
            rows, column, label, digits = measured(designs[designs["family"] == name], verdict)
            cells = rows[["blade", "scene", *compared.keys]].to_numpy().tolist()
            values, some = packed(rows[column].to_numpy(float)), packed(some_above_yield(rows).to_numpy())
            about = {"family": name, "axes": [axis_of_key(key) for key in compared.keys], "other": compared.other}
            maps.append(about | {"cells": cells, "values": values, "some": some, "label": label, "digits": digits})
    return maps
