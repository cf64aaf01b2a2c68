"""Panel of the explorer: designs as maps over two numbers that vary."""

import numpy as np
import pandas as pd

from r37core.explorer.contents import packed

from .compared import BOTH, SCENE
from .maps import length_column
from .table import compared_in


def contents(table: pd.DataFrame) -> dict[str, object]:
    """The map of a table of designs of one family of two keys: values of `keys`, and cells with `blade` and `scene`.

    Without such a family the `cells` are none. `values`: length above yield in most revolutions (rad/s), by cell.
    """
    compared = compared_in(table)
    if len(compared.keys) != 2:
        return {"keys": list(compared.keys), "cells": [], "values": packed(np.empty(0)), "axis": ""}
    rows = table.dropna(subset=list(compared.keys))
    cells = rows[["blade", "scene", *compared.keys]].to_numpy().tolist()
    panel_axis = "" if compared.kind == BOTH else "blade" if compared.kind == SCENE else "scene"
    lengths = packed(rows[length_column(table)].to_numpy(float))
    return {"keys": list(compared.keys), "cells": cells, "values": lengths, "axis": panel_axis}
