"""verdict.csv: what each blade keeps in operation."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from r37core.results.closing import counted
from r37core.results.datasets import response_of
from r37core.results.operating_range import OperatingRange
from r37core.results.table_file import read_table

from .choice import Requirements
from .evidence import Evidence
from .judging import (
    AT_LEAST,
    COLUMNS,
    FAILS,
    MEETS,
    NOT_APPLICABLE,
    REST,
    UNKNOWN,
    VERDICTS,
    fails_clearly,
    judge,
    members_that_meet,
)


def verdict_table(
    known: Mapping[tuple[str, str], Mapping[str, Any]],
    requirements: Requirements,
    operating: OperatingRange,
    datasets: Mapping[str, xr.Dataset],
) -> pd.DataFrame:
    """A row for each requirement of each blade and scene: COLUMNS.

    `known`: by blade and scene, fields of Evidence that are not made of the `datasets`: campbell, rms and, if there, stress,
    wear, members and motions by blade and scene, and run_ups.
    """
    rows = []
    for (blade, scene), fields in known.items():
        made: dict[str, Any] = {name: _part(datasets.get(name), blade, scene) for name in ("members", "motions")}
        made["miner_sum"] = _miner_sum(datasets.get("run_ups"), blade, scene)
        response, campbell = response_of(datasets, blade, scene), datasets["campbell"].sel(blade=blade)
        evidence = Evidence(response, campbell=campbell, operating=operating, **made, **fields)
        if failed := fails_clearly(requirements, evidence.replaced(evidence.looks.get(REST, response))):
            evidence = replace(evidence, not_looked=f"few further runs, as {failed[0]} fails", fails_elsewhere=True)
        rows += [{"blade": blade, "scene": scene, **row} for row in judge(requirements, evidence)]
    return pd.DataFrame(rows, columns=["blade", "scene", *COLUMNS])


def _miner_sum(run_ups: xr.Dataset | None, blade: str, scene: str) -> float:
    """Miner's sum of the worst run-up of a blade and scene; NaN where there is none, or one of its run-ups has none."""
    if run_ups is None or "miner_sum" not in run_ups:
        return np.nan
    own = (run_ups["blade"] == blade) & (run_ups["scene"] == scene)
    return float(run_ups["miner_sum"].where(own, drop=True).max(skipna=False)) if own.any() else np.nan


def _part(dataset: xr.Dataset | None, blade: str, scene: str) -> xr.Dataset | None:
    """One blade in one scene; None where the dataset does not have it."""
    if dataset is None or blade not in dataset["blade"].values or scene not in dataset["scene"].values:
        return None
    return dataset.sel(blade=blade, scene=scene)


def overall(verdict: pd.DataFrame) -> pd.DataFrame:
    """One row for each blade and scene: `verdict`, the worst of its requirements, and `reason`, what fails or is not sure."""
    rows = []
    for (blade, scene), part in verdict.groupby(["blade", "scene"], sort=False):
        worst = min(part["verdict"], key=(FAILS, UNKNOWN, MEETS, NOT_APPLICABLE).index)
        reasons = [reason(row) for _, row in part.iterrows() if row["verdict"] == worst in (FAILS, UNKNOWN)]
        rows.append((blade, scene, worst, "; ".join(reasons)))
    return pd.DataFrame(rows, columns=["blade", "scene", "verdict", "reason"])


def reason(row: pd.Series) -> str:
    """Why a requirement fails or cannot be told: what, by how much, where, and how certain that is."""
    if row["verdict"] == UNKNOWN:
        return f"{row['requirement']}: {row['note']}"
    excess = f"by {-row['margin']:.3g}{_unit(row)}" if np.isfinite(row["margin"]) else str(row["note"])
    begin, end = row["from_rad_s"], row["to_rad_s"]
    where = "" if pd.isna(begin) else f", at {begin:.5g} rad/s" if begin == end else f", {begin:.5g} to {end:.5g} rad/s"
    if begin < end and end - begin < 0.99 * row["value"]:
        where = f", the widest range{where[1:]}"
    return f"{row['requirement']} {excess}{where}{certainty(row)}"


def certainty(row: pd.Series) -> str:
    """Certainty of a verdict by all that was tried and by tolerances, and what its number leaves out; or an empty text."""
    texts = [str(row["note"])] if pd.notna(row["note"]) and row["note"] and np.isfinite(row["margin"]) else []
    if row["value_lowest"] < row["value_highest"]:
        bound = "at least " if AT_LEAST in str(row["note"]) else ""
        texts.append(f"{row['value_lowest']:.3g} to {bound}{row['value_highest']:.3g}{_unit(row)} in all that was tried")
    if row["scatter"] > 0.0:
        texts.append(f"scatter {row['scatter']:.2g}{_unit(row)}")
    # the note has it where it is why nobody can tell
    if pd.notna(row["share_of_members"]) and members_that_meet(row) not in str(row["note"]):
        texts.append(members_that_meet(row))
    return f" ({', '.join(texts)})" if texts else ""


def _unit(row: pd.Series) -> str:
    """The unit after a number; of a share none."""
    return "" if row["unit"] == "1" else f" {row['unit']}"


_SHOWN = ("blade", "scene", "requirement", "verdict", "limit", "unit", "note", "value", "margin", "from_rad_s", "to_rad_s")
"""Columns of verdict.csv that the explorer shows; what is not known or not finite is null."""


def contents(verdict: pd.DataFrame) -> dict[str, object]:
    """`pairs`: blade, scene, verdict and reason of each, those that meet all first; `requirements`: rows of verdict.csv."""
    rows = [
        {name: None if isinstance(row[name], float) and not np.isfinite(row[name]) else row[name] for name in _SHOWN}
        | {"certainty": certainty(row)}
        for _, row in verdict.iterrows()
    ]
    pairs = sorted(overall(verdict).to_dict("records"), key=lambda pair: VERDICTS.index(pair["verdict"]))
    return {"pairs": pairs, "requirements": rows}


_MOST_LINES = 8
"""Blades and scenes of which each has a line when a run ends."""


def closing(results: Path) -> str:
    """The verdict of each blade and scene; of many how many meet all, and which."""
    table = read_table(results / "verdict.csv")
    judged = overall(table)
    if len(judged) <= _MOST_LINES:
        lines = []
        for row, (_, own) in zip(judged.itertuples(), table.groupby(["blade", "scene"], sort=False), strict=True):
            sure = (f"{line['requirement']}{how}" for _, line in own.iterrows() if (how := certainty(line)))
            text = row.reason or ", ".join(sure)
            lines.append(f"{row.blade} in {row.scene} {row.verdict}{f': {text}' if text else ''}")
        return "\n  ".join(["verdict", *lines])
    good = [f"{row.blade} in {row.scene}" for row in judged.itertuples() if row.verdict == MEETS]
    more = f" and {len(good) - _MOST_LINES} more" if len(good) > _MOST_LINES else ""
    named = f": {', '.join(good[:_MOST_LINES])}{more}" if good else ""
    unknown = int((judged["verdict"] == UNKNOWN).sum())
    text = f"{len(good)} of {counted(len(judged), 'pair')} of blade and scene meet all requirements{named}"
    return f"{text}; of {unknown} one cannot tell" if unknown else text
