"""Panel of the explorer: the verdict of each blade and scene."""

import pandas as pd

from .judging import VERDICTS
from .table import certainty, overall


def contents(verdict: pd.DataFrame) -> dict[str, object]:
    """`pairs`: blade, scene, verdict and reason of each, those that meet all first; `requirements`: rows of verdict.csv."""
    shown = verdict.astype(object).where(verdict.notna(), None)
    rows = [
        {
            **{key: row[key] for key in ("blade", "scene", "requirement", "verdict", "limit", "unit", "note")},
            **_numbers(row, full),
        }
        for (_, row), (_, full) in zip(shown.iterrows(), verdict.iterrows(), strict=True)
    ]
    pairs = sorted(overall(verdict).to_dict("records"), key=lambda pair: VERDICTS.index(pair["verdict"]))
    return {"pairs": pairs, "requirements": rows}


def _numbers(row: pd.Series, full: pd.Series) -> dict[str, object]:
    """Value, margin and speeds as JSON can have them, and how certain they are."""
    numbers = {key: row[key] for key in ("value", "margin", "from_rad_s", "to_rad_s")}
    finite = {key: value if value is not None and abs(value) < float("inf") else None for key, value in numbers.items()}
    return {**finite, "certainty": certainty(full)}
