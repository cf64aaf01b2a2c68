"""Closing lines of measurements and of a calibration."""

from pathlib import Path

import numpy as np

from r37core.base.dataset_file import read_dataset
from r37core.results.closing import counted
from r37core.results.table_file import read_table
from r37studies.agreement import disagrees, groups, words

from .model_check import FAR
from .posterior import number_table


def closing(results: Path) -> str:
    """Closing line: how many points of each measurement agree, and where others lie."""
    table = read_table(results / "measured.csv")
    lines = [f"{blade} in {scene}, {quantity}: {words(rows)}" for (blade, scene, quantity, _), rows in groups(table)]
    far = [lines[place] for place, (_, rows) in enumerate(groups(table)) if disagrees(rows)]
    # of many measurements those that disagree
    return " | ".join(lines if len(lines) < 5 else [f"{counted(len(lines), 'measurement')}, {len(far)} disagree", *far[:4]])


def closing_of_calibration(results: Path) -> str:
    """Closing line: best value and 95% range of each number, and whether simulation and measurements then agree."""
    dataset = read_dataset(results / "calibration.nc")
    lines = [
        f"{row.number} {row.best:.3g} ({row.low_95:.3g} to {row.high_95:.3g}{'; ' + row.note if row.note else ''})"
        for row in number_table(dataset).itertuples()
    ]
    far, elsewhere = np.abs(dataset["misfit"].values) > FAR, dataset["elsewhere"].values > 0
    for text, places in (("on another branch", elsewhere), ("far from the model", far & ~elsewhere)):
        if speeds := [f"{speed:.5g}" for speed in dataset["speed"].values[places]]:
            lines.append(f"{text}: {', '.join(speeds[:4])} rad/s")
    if doubts := dataset.attrs["doubts"]:
        lines.append(f"the model lacks something, and ranges mean little: {doubts}")
    return ", ".join(lines)
