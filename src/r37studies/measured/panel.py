"""Panel of the explorer and closing lines of measurements and of a calibration."""

from pathlib import Path

import pandas as pd

from r37core.base.dataset_file import read_dataset
from r37core.explorer.contents import packed
from r37core.results.closing import counted
from r37core.results.table_file import read_table
from r37studies.agreement import disagrees, groups, words

from .posterior import number_table


def contents(measured: pd.DataFrame) -> list[dict[str, object]]:
    """Each measurement: blade, scene, title and unit, its axis, measured and simulated values, their deviations, and words."""
    panels = []
    for (blade, scene, quantity, file), rows in groups(measured):
        axis = "angle_deg" if rows["angle_deg"].notna().all() else "speed_rad_s"
        numbers = {name: packed(rows[name].to_numpy(float)) for name in rows if rows[name].dtype.kind in "fi"}
        about = {"blade": blade, "scene": scene, "title": f"{quantity} ({Path(file).name})", "unit": rows["unit"].iloc[0]}
        panels.append(about | {"axis": axis, "words": words(rows)} | numbers)
    return panels


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
    elsewhere = [f"{speed:.5g}" for speed in dataset["speed"].values[dataset["elsewhere"].values > 0.5]]
    if elsewhere:
        lines.append(f"on another branch or wrong: {', '.join(elsewhere[:4])} rad/s")
    if dataset.attrs["disagrees"]:
        lines.append("no values in these ranges agree with the measurements: the model lacks something, and ranges mean little")
    return ", ".join(lines)
