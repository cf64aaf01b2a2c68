"""Families of swept and leaned designs in both scenes."""

from typing import Any

import pandas as pd
from scipy.stats import spearmanr

from r37core.results.table_file import read_table

from .pages import write_table
from .which_blade import ON_PATCHES, SCENES

LEFT = {"clearance_loss_1t_m": "loss of clearance, 1T", "clearance_loss_1b_m": "loss of clearance, 1B",
        "frequency_1t_hz": "1T at rest", "frequency_1b_hz": "1B at rest"}  # fmt: skip


def families(input: Any, output: Any, params: Any) -> None:
    """Structure and lengths above yield of every design. Input: designs."""
    rows = []
    for blade, of in read_table(input.designs).groupby("blade", sort=False):
        first, family = of.iloc[0], str(blade).split("_")[0].lower()
        losses = (f"{1e3 * first[f'clearance_loss_{mode}_m']:.2f}" for mode in ("1b", "1t"))
        lengths = [_lengths(of[of["scene"] == scene].iloc[0]) for scene in ON_PATCHES.values()]
        rows.append([f"{family} {first[f'{family}_percent']:g}%", f"{first['frequency_1b_hz']:.0f}", *losses, *lengths])
    head = ["design", "1B (Hz)", "clearance lost along 1B (mm)", "along 1T (mm)"]
    write_table([*head, *(f"{words} (rad/s)" for words in SCENES.values())], rows, output.table)


def _lengths(design: pd.Series) -> str:
    return f"{design['length_most_revolutions_rad_s']:.0f} ({design['length_some_revolutions_rad_s']:.0f})"


def correlations(input: Any, output: Any, params: Any) -> None:
    """Rank correlation of what a design is with its lengths above yield. Input: designs."""
    designs, rows = read_table(input.designs), []
    for name, words in LEFT.items():
        scene_refinement = (designs[designs["scene"] == scene] for scene in ON_PATCHES.values())
        rows.append(
            [words, *(f"{spearmanr(of[name], of['length_most_revolutions_rad_s']).statistic:.2f}" for of in scene_refinement)]
        )
    write_table(["rank correlation with the length", *SCENES.values()], rows, output.table)
