"""Tables of docs/better_blade.md: a search from Ref, plain sampling, the best designs looked at again, and errors of draft.

Run: make claims ONLY=search, or step by step (its commands). Without an argument it writes the tables; `designs` writes the
blades of which draft and standard are compared.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import scipy
import xarray as xr

from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.results.ranking import read_ranking
from r37core.search.dataset import entries_of, write_entries
from r37core.yaml_file import load_yaml
from validation.studies.tables import markdown_table

RUNS = Path("results/runs")
TABLES = Path("results/studies")
SEEDS = {"surrogate": (0, 1), "quasi_random": (0, 1, 2)}
METHODS = {"surrogate": "search", "quasi_random": "plain sampling"}
PAGE = ("surrogate", 1)
"""The search of the page."""

COMPARED = 30
"""Designs whose ranks at draft and at standard are compared."""

MEMBERS = ("length_certain_rad_s_low", "length_certain_rad_s", "length_certain_rad_s_high")


def run_of(method: str, seed: int) -> Path:
    """Folder of one of the searches; that of the page has no other name."""
    return RUNS / ("search" if (method, seed) == PAGE else f"search_{method}_{seed}")


def search_of(method: str, seed: int) -> xr.Dataset:
    """All designs of one of them."""
    return read_dataset(run_of(method, seed) / "search.nc")


def lengths(search: xr.Dataset) -> np.ndarray:
    """Both objectives (rad/s) of the feasible designs, without the start, shape (designs, 2)."""
    tried = search.where(search["feasible"].astype(bool) & (search["round"] >= 0), drop=True)
    return tried["objective_value"].values


def start_of(search: xr.Dataset) -> np.ndarray:
    """Both objectives (rad/s) of the start."""
    return search["objective_value"].sel(design="start").values


def dominated_share(values: np.ndarray, corner: np.ndarray) -> float:
    """Share of the rectangle from 0 to the `corner` whose points are worse than some design in both objectives."""
    covered, reach = 0.0, corner[1]
    for first, second in sorted(map(tuple, np.minimum(values, corner))):
        if second < reach:
            covered += (corner[0] - first) * (reach - second)
            reach = second
    return covered / float(np.prod(corner))


def compare() -> pd.DataFrame:
    """The searches and plain sampling, a row for each seed."""
    start = start_of(search_of(*PAGE))
    rows = []
    for method, words in METHODS.items():
        for seed in SEEDS[method]:
            values = lengths(search_of(method, seed))
            rows.append(
                {
                    "designs by": words,
                    "seed": seed,
                    "keep the constraints": len(values),
                    "no worse than the start in both": int(np.sum((values <= start).all(axis=1))),
                    "share of 0 to 500 rad/s in both (%)": round(100.0 * dominated_share(values, np.full(2, 500.0))),
                    "shortest with lining, at most 300 rad/s without": round(float(values[values[:, 1] <= 300.0, 0].min())),
                    "shortest without, at most 100 rad/s with lining": round(float(values[values[:, 0] <= 100.0, 1].min())),
                    "smallest sum": round(float(values.sum(axis=1).min())),
                }
            )
    return pd.DataFrame(rows)


def best_designs() -> pd.DataFrame:
    """The start and the best designs of the page's search, as it knows them."""
    search = search_of(*PAGE)
    order = search["order"].values
    places = range(1, int(order.max(initial=0)) + 1)
    names = ["start", *(str(search["design"].values[np.flatnonzero(order == place)[0]]) for place in places[:6])]
    rows = []
    for place, name in enumerate(names):
        of = search.sel(design=name)
        rows.append(
            {
                "blade": f"Free_best{place}" if place else "Free",
                "lining (rad/s)": round(float(of["objective_value"][0])),
                "without (rad/s)": f"{float(of['objective_value'][1]):.0f} ± {float(of['objective_scatter'][1]):.0f}",
                "1B (Hz)": round(float(of["constraint_value"][0])),
                "static stress (MPa)": round(1e-6 * float(of["constraint_value"][1])),
                **{str(key): f"{float(of['value'].sel(variable=key)):g}" for key in search["variable"].values},
            }
        )
    return pd.DataFrame(rows)


def confirmed() -> pd.DataFrame:
    """The same at level standard: nominal, under tolerances, and with 36 mistuned blades."""
    ranking = read_ranking(RUNS / "search_best/ranking.csv").set_index(["blade", "scene"])
    rotors = pd.read_csv(RUNS / "search_best/rotors.csv").set_index("blade")
    rows = []
    for blade in rotors.index:
        row: dict[str, object] = {"blade": blade}
        for scene, words in (("abradable", "lining"), ("direct", "without")):
            low, value, high = (float(ranking.loc[(blade, scene)].get(name, np.nan)) for name in MEMBERS)
            possible = float(ranking.loc[(blade, scene), "length_possible_rad_s"])
            scatter = float(ranking.loc[(blade, scene), "length_certain_scatter_rad_s"])
            certain = f"{value:.0f}" if np.isnan(scatter) else f"{value:.0f} ± {scatter:.0f}"
            row |= {f"{words} (rad/s)": certain, f"{words}, possible": round(possible)}
            row[f"{words}, four members"] = f"{low:.0f} to {high:.0f}" if np.isfinite(low) else "not run"
        row["36 blades, lining (rad/s)"] = round(float(rotors.loc[blade, "length_with_any_blade_above_yield_rad_s"]))
        rows.append(row)
    return pd.DataFrame(rows)


def ranks() -> pd.DataFrame:
    """What screening at draft decides wrongly: rank correlation with standard, and whether the best stay the best."""
    search = search_of("quasi_random", 0)
    ranking = read_ranking(RUNS / "search_ranks/ranking.csv").set_index(["scene", "blade"])
    names = compared_designs(search)
    rows = []
    for objective, scene in (("lined", "abradable"), ("direct", "direct")):
        draft = search["objective_value"].sel(objective=objective, design=names).values
        standard = ranking.loc[scene].loc[[f"Free_best{place}" for place in range(1, len(names) + 1)]]
        standard = standard["length_certain_rad_s"].values
        pairs = [(i, j) for i in range(len(names)) for j in range(i) if draft[i] != draft[j] and standard[i] != standard[j]]
        wrong = sum((draft[i] < draft[j]) != (standard[i] < standard[j]) for i, j in pairs)
        best = set(np.argsort(draft, kind="stable")[:5]) & set(np.argsort(standard, kind="stable")[:5])
        rows.append(
            {
                "scene": scene,
                "designs": len(names),
                "rank correlation": f"{scipy.stats.spearmanr(draft, standard).statistic:.3f}",
                "pairs told wrongly (%)": f"{100.0 * wrong / len(pairs):.1f}",
                "of the best five": f"{len(best)} are the same",
                "median difference (rad/s)": f"{np.median(np.abs(draft - standard)):.0f}",
                "largest (rad/s)": f"{np.abs(draft - standard).max():.0f}",
            }
        )
    return pd.DataFrame(rows)


def compared_designs(search: xr.Dataset) -> list[str]:
    """The first designs of plain sampling that could be built."""
    built = search.where((search["refused"] == "") & (search["round"] >= 0), drop=True)
    return [str(name) for name in built["design"].values[:COMPARED]]


def depends_on() -> pd.DataFrame:
    """Total indices of both objectives' surrogates."""
    search = search_of(*PAGE)
    rows = []
    for objective in search["objective"].values:
        of = search.sel(objective=objective)
        indices = {str(key): f"{float(of['sensitivity_total'].sel(variable=key)):.2f}" for key in search["variable"].values}
        rows.append({"objective": str(objective), **indices, "predicted share": f"{float(of['surrogate_q2']):.2f}"})
    return pd.DataFrame(rows)


def write_designs() -> None:
    """Entries of the designs whose ranks are compared."""
    search, folder = search_of("quasi_random", 0), TABLES / "search"
    entries = load_yaml(Path("config/search_blades.yaml"))
    names = compared_designs(search)
    folder.mkdir(parents=True, exist_ok=True)
    made = entries_of(search, names, "Free", entries)
    write_entries(search, made, names, entries, folder / "designs.yaml")


if __name__ == "__main__":
    if sys.argv[1:] == ["designs"]:
        write_designs()
    else:
        TABLES.mkdir(parents=True, exist_ok=True)
        tables = {"compared": compare, "best": best_designs, "confirmed": confirmed, "ranks": ranks, "depends": depends_on}
        for name, table in tables.items():
            frame = table()
            rows = [[str(cell) for cell in row] for row in frame.itertuples(index=False)]
            write_text(markdown_table(list(frame.columns), rows), TABLES / f"search_{name}.md")
