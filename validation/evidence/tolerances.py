"""Ranges of interactions under tolerances, what they come from, and how many members it takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import read_dataset
from r37core.base.rounding import rounded_to
from r37core.results.ranges import read_ranges
from r37core.tolerances.dataset import INDEXED, QUANTILES
from r37core.tolerances.number_ranks import Ranking, ranking

from .pages import write_table

MODE, ORDER = "1B", 4
COLUMNS = {
    "peak (rad/s)": "peak_speed_rad_s",
    "above yield in most revolutions (rad/s)": "length_most_revolutions_rad_s",
    "ever above yield (rad/s)": "length_ever_rad_s",
}
COUNTS = (8, 16, 32, 64, 128)
UNKNOWN = "-"


def ranges(input: Any, output: Any, params: Any) -> None:
    """Nominal value and range of the interaction of 1B with engine order 4, of every blade. Input: table."""
    table = read_ranges(input.table)
    chosen = table[(table["mode"] == MODE) & (table["engine_order"] == ORDER)]
    rows = [[row["blade"], *(ranged(row, column) for column in COLUMNS.values())] for _, row in chosen.iterrows()]
    write_table(["blade", *COLUMNS], rows, output.table)


def ranged(row: pd.Series, name: str) -> str:
    """Nominal value and, in brackets, both ends of its range, with as many digits as the range bears."""
    low, high = (row[f"{name}_{end}"] for end in ("low", "high"))
    nominal, low_text, high_text = (rounded_to(value, high - low) for value in (row[name], low, high))
    return f"{nominal} ({low_text} to {high_text})"


@dataclass(frozen=True)
class Sample:
    """Values of the numbers, shape (members, numbers), and one measure, shape (members,), of members of one sample."""

    values: np.ndarray
    measure: np.ndarray

    def parts(self, members: int) -> list[Sample]:
        """Samples of so many members that follow each other: each as evenly spread as the whole."""
        rows = np.arange(len(self.measure)).reshape(-1, members)
        return [Sample(self.values[of], self.measure[of]) for of in rows]

    @property
    def ranking(self) -> Ranking:
        """Rank coefficients of the numbers."""
        return ranking(self.values, self.measure)


def samples(dataset: xr.Dataset) -> dict[str, Sample]:
    """Measure -> all members of the only blade and scene of tolerances.nc."""
    members = dataset.squeeze(["blade", "scene"]).sortby("member").transpose("member", "number", ...)
    return {measure: Sample(members["value"].values, members[measure].values) for measure in INDEXED}


def numbers(input: Any, output: Any, params: Any) -> None:
    """Place and rank coefficient of each number for each measure. Input: members."""
    dataset = read_dataset(input.members)
    rankings = {measure: sample.ranking for measure, sample in samples(dataset).items()}
    rows = [
        [f"`{number}`", *(_coefficient(of, place) for of in rankings.values())]
        for place, number in enumerate(dataset["number"].values)
    ]
    rows.append(["explained by all together", *(f"{100.0 * of.explained:.0f}%" for of in rankings.values())])
    write_table(["number", *(measure.replace("_", " ") for measure in INDEXED)], rows, output.table)


def _coefficient(of: Ranking, number: int) -> str:
    """A number's place, its coefficient and, in brackets, the interval of that."""
    if not of.known[number]:
        return UNKNOWN
    first, last = (round(float(places[number])) for places in of.places)
    low, high = float(of.low[number]), float(of.high[number])
    value, low_text, high_text = (rounded_to(each, high - low) for each in (float(of.coefficient[number]), low, high))
    place = f"{first}" if first == last else f"{first} to {last}"
    return f"place {place}: {value} ({low_text} to {high_text})"


def members(input: Any, output: Any, params: Any) -> None:
    """Error of ranges and rankings from parts of a sample, against the whole. Input: members."""
    of_measures = samples(read_dataset(input.members))
    whole = {measure: np.abs(sample.ranking.coefficient) for measure, sample in of_measures.items()}
    total, rows = len(next(iter(of_measures.values())).measure), []
    for count in (each for each in COUNTS if each <= total):
        parts = {measure: sample.parts(count) for measure, sample in of_measures.items()}
        errors = [range_error(parts[measure], of_measures[measure]) for measure in INDEXED]
        cells = [f"{100.0 * error:.0f}%" for error in errors] if count < total else [UNKNOWN] * len(errors)
        rows.append([str(count), str(total // count), *cells, *_of_rankings(parts, whole)])
    measures = (f"range of the {measure.replace('_', ' ')}" for measure in INDEXED)
    write_table(["members", "samples", *measures, "the first is right", "pairs distinguished (of 15)"], rows, output.table)


def _of_rankings(parts: dict[str, list[Sample]], whole: dict[str, np.ndarray]) -> list[str]:
    found = {measure: [sample.ranking for sample in several] for measure, several in parts.items()}
    if any(np.isnan(of.coefficient).all() for several in found.values() for of in several):
        # too few members for so many numbers
        return [UNKNOWN, UNKNOWN]
    right = [np.abs(of.coefficient).argmax() == whole[measure].argmax() for measure in found for of in found[measure]]
    apart = [of.above.sum() for several in found.values() for of in several]
    return [f"{100.0 * np.mean(right):.0f}%", f"{np.mean(apart):.1f}"]


def range_error(parts: list[Sample], whole: Sample) -> float:
    """Root mean square error of the worse end of the range from parts, as a share of the range of the whole."""
    found = np.quantile([part.measure for part in parts], QUANTILES, axis=1, method="inverted_cdf")
    known = np.quantile(whole.measure, QUANTILES, method="inverted_cdf")
    errors = np.sqrt(np.mean((found - known[:, None]) ** 2, axis=1))
    return float(max(errors[0], errors[-1]) / (known[-1] - known[0]))
