"""The explorer's tables: interactions and ranking as rows, and their columns in the words of the glossary."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict

import pandas as pd

from r37core.results import glossary
from r37core.results.closing import interaction_title
from r37core.results.glossary import Word
from r37core.results.ranking import as_scatter_bears

WORDS = glossary.INTERACTIONS | {
    "interaction": Word(
        "interaction",
        "mode and engine order that meet there, 1B/4: first bending with order 4; without a crossing the strongest order",
    ),
}

COLUMNS = (
    "interaction",
    "blade",
    "scene",
    "direction",
    "campbell_speed_rad_s",
    "peak_speed_rad_s",
    "peak_speed_rad_s_low",
    "peak_speed_rad_s_median",
    "peak_speed_rad_s_high",
    "share_of_members",
    "shift_rad_s",
    "peak_rms_normal_m",
    "drop",
    "width_above_yield_rad_s",
    "possible_from_rad_s",
    "possible_to_rad_s",
    "certain_length_rad_s",
    "median_von_mises_pa",
    "max_von_mises_pa",
    "max_von_mises_speed_rad_s",
    "max_wear_m",
    "worn_through_share",
    "status",
)
"""Columns of the table of interactions, in this order; those that summary.csv does not have are left out."""


def interaction_table(interactions: pd.DataFrame) -> dict[str, object]:
    """`interactions`, rows as in summary.csv with their title, and `columns`."""
    table = interactions.astype(object).where(interactions.notna(), None)
    titles = [
        interaction_title(mode or "", None if order is None else int(order))
        for mode, order in zip(table["mode"], table["engine_order"], strict=True)
    ]
    table = table.assign(interaction=titles)
    return {"interactions": table.to_dict("records"), "columns": _columns([name for name in COLUMNS if name in table], WORDS)}


def ranking_rows(ranking: pd.DataFrame | None) -> dict[str, object]:
    """`ranking`, its rows or None, and `ranking_columns`, those of them that the glossary knows."""
    if ranking is None or ranking.empty:
        return {"ranking": None, "ranking_columns": []}
    ranking = as_scatter_bears(ranking)
    rows = ranking.astype(object).where(ranking.notna(), None).to_dict("records")
    return {"ranking": rows, "ranking_columns": _columns(ranking.columns, glossary.RANKING)}


def _columns(names: Iterable[str], words: dict[str, Word]) -> list[dict[str, object]]:
    known = {name: glossary.word(name, words) for name in names}
    return [{"name": name, **asdict(word), "meaning": word.meaning.replace("`", "")} for name, word in known.items() if word]
