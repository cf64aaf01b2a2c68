"""ranking.csv: how robust each blade is in each scene, and the chance that one is better than another."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
from pandas import DataFrame
from xarray import Dataset

from r37core.base.io import readable
from r37core.base.units import si_name
from r37core.time_integration.status import RunStatus

from .columns import CHANCE, ENDS, LENGTHS, MOST_REVOLUTIONS, OPERATING, OVER_SCENES, ROBUSTNESS, names
from .danger import danger_of, danger_ranges, grid_scatter, moved_by_error, ranges_of
from .datasets import response_in_operation, response_of
from .exceedance import DEVIATIONS, Exceedance, SpeedRange, exceedance_of
from .measures import drop_after, has_strengths, lasts, motion, peak_of, ran
from .operating_range import OperatingRange
from .table_file import read_table

MeasuresOfMembers = dict[tuple[str, str], dict[str, dict[str, float]]]
"""(blade, scene) -> member -> column of RANKED_BY -> value."""

RANKED_BY = (*names(LENGTHS), "largest_stress_inside_pa")
"""Columns that blades stand in the order of: less of the first first, of the next where that is the same."""

_BRACKET = RANKED_BY[:2]
"""Columns of the bracket that blades are ranked by: from the first to the sum of both."""

_RANKS = ("rank", "rank_lowest", "rank_highest")
_WITHIN = "length_dangerous_within_rad_s"


def operating_measures(response: Dataset, operating: OperatingRange, *, chance_scatter: bool = True) -> dict[str, float]:
    """OPERATING of one blade in one scene; NaN without stress, and where the runs do not reach over the judged range.

    `chance_scatter`: whether chance is drawn.
    """
    measures = dict.fromkeys(names(OPERATING), np.nan)
    if "share_of_revolutions_above_yield" not in response:
        return measures
    exceedance = exceedance_of(response)
    if not operating.is_covered(exceedance.speeds):
        return measures
    for name, ranges in ranges_of(response).items():
        measures[name.replace("_rad_s", "_operating_rad_s")] = operating.length(ranges)
    measures["exceedance_integral_operating_rad_s"] = operating.integral(exceedance.speeds, exceedance.shares)
    if exceedance.chance and chance_scatter:
        measures["exceedance_integral_operating_scatter_rad_s"] = exceedance.scatter_of_integral(
            lambda shares: operating.integral(exceedance.speeds, shares)
        )
    if has_strengths(response):
        fatigue = exceedance_of(response, "share_of_revolutions_above_goodman")
        measures["goodman_integral_operating_rad_s"] = operating.integral(fatigue.speeds, fatigue.shares)
    return measures


def robustness(
    response: Dataset, *, chance_scatter: bool = True, operating: OperatingRange | None = None, error: float = 0.0
) -> dict[str, float]:
    """ROBUSTNESS of one blade in one scene; NaN for what is not computed, and for a first speed that there is not.

    `chance_scatter`: whether chance is drawn, which takes longer than all else and which members have no use for. `operating`:
    range whose operating_measures are among them; `error`: relative one of the stress, by mesh and step of the level.
    """
    response = ran(response)
    inside = operating_measures(response, operating, chance_scatter=chance_scatter) if operating else {}
    measures = dict.fromkeys(names(ROBUSTNESS), np.nan) | inside
    if not response.sizes["speed"]:
        return measures
    ended = response["status"].values == RunStatus.COMPLETED
    if ended.any():
        measures["largest_rms_m"] = float(motion(response).max())
        measures["largest_rms_speed_rad_s"] = float(peak_of(response)["speed"])
        measures["drop"] = drop_after(response)
    measures["diverged_runs"] = float(np.count_nonzero(~ended))
    measures["largest_gap_rad_s"] = float(np.diff(response["speed"].values).max(initial=0.0))
    if "share_of_revolutions_above_yield" in response:
        measures |= danger_of(response)
        exceedance = exceedance_of(response)
        dangerous, sustained = danger_ranges(response)[0], exceedance.ranges(MOST_REVOLUTIONS)
        measures["length_most_revolutions_scatter_rad_s"] = exceedance.scatter_of_length(
            MOST_REVOLUTIONS, chance=chance_scatter
        )
        measures[_WITHIN] = _known_within(exceedance, grid_scatter(response), moved_by_error(response, error))
        for name, ranges in (("dangerous", dangerous), ("most_revolutions", sustained)):
            measures[f"first_{name}_rad_s"] = ranges[0].begin if ranges else np.nan
        measures["exceedance_integral_rad_s"] = exceedance.integral
        if chance_scatter:
            measures["exceedance_integral_scatter_rad_s"] = exceedance.scatter_of_integral()
        if "motion_at_end" in response:
            shares = response["share_of_revolutions_above_yield"].where(lasts(response), 0.0)
            lasting = exceedance_of(response.assign(share_of_revolutions_above_yield=shares))
            measures["length_lasting_rad_s"] = lasting.length(MOST_REVOLUTIONS)
        widest = max(dangerous, key=lambda above: above.length, default=SpeedRange(np.nan, np.nan, False))
        measures["widest_range_rad_s"], measures["widest_range_from_rad_s"] = np.nan_to_num(widest.length), widest.begin
        measures["ranges_dangerous"] = len(dangerous)
    if has_strengths(response):
        exceedance = exceedance_of(response, "share_of_revolutions_above_goodman")
        measures["length_goodman_rad_s"] = exceedance.length(MOST_REVOLUTIONS)
        measures["goodman_integral_rad_s"] = exceedance.integral
    return measures


def _known_within(exceedance: Exceedance, scatter: float, moved: float) -> float:
    """Two standard deviations (rad/s) of a length; a peak may be hidden between the two speeds that are farthest apart."""
    return float(np.hypot(max(DEVIATIONS * scatter, np.diff(exceedance.speeds).max(initial=0.0)), moved))


def measures_of(
    datasets: Mapping[str, Dataset], blade: str, scene: str, operating: OperatingRange | None, error: float
) -> dict[str, float]:
    """ROBUSTNESS of a blade in a scene of the datasets of a sweep and, with a range, OPERATING of what a verdict judges there.

    `error`: as of `robustness`.
    """
    measures = robustness(response_of(datasets, blade, scene), error=error)
    if operating:
        measures |= operating_measures(response_in_operation(datasets, blade, scene), operating)
    return measures


def length_sustained(response: Dataset) -> float:
    """Length (rad/s) of the speeds above yield in most revolutions; NaN of a response without stress."""
    if "share_of_revolutions_above_yield" not in response:
        return np.nan
    exceedance = exceedance_of(response)
    return exceedance.length(MOST_REVOLUTIONS) if len(exceedance.speeds) else np.nan


def measures_of_members(members: Dataset) -> MeasuresOfMembers:
    """Columns of RANKED_BY of each blade and scene, member by member; `members`: a dataset of them."""
    pair_measures: MeasuresOfMembers = {}
    measures = [si_name(column)[0] for column in RANKED_BY]
    for blade in members["blade"].values.tolist():
        for scene in members["scene"].values.tolist():
            part = members[measures].sel(blade=blade, scene=scene).dropna("member", how="all")
            rows = part.to_dataframe()[measures].set_axis(list(RANKED_BY), axis=1)
            if len(rows):
                pair_measures[blade, scene] = {str(member): values for member, values in rows.to_dict("index").items()}
    return pair_measures


def ranking_table(
    measures: Mapping[tuple[str, str], Mapping[str, float]],
    members: MeasuresOfMembers | None = None,
    contacts: Mapping[str, str] | None = None,
) -> DataFrame:
    """One row for each blade and scene, scene by scene with the best blade first; equal ones have the same rank.

    Ranks and chances are among blades of the same contact. `contacts`: what that of each blade acts on; None: all on the same.
    `measures`: blade and scene -> its `robustness`, whose measures in operation have a rank of their own; `members`: the same
    of each member of a sample, by name, for their ranges (`_low`, `_high`: ranges.ENDS) and the chance to be better than each
    other blade: the share of the members that both blades have, which have the same values of the scene's numbers, in which it
    is; equal ones count half.
    """
    contacts = contacts or {}
    table = DataFrame([{"blade": blade, "scene": scene, **values} for (blade, scene), values in measures.items()])
    table.insert(2, "contact", [contacts.get(blade, "") for blade in table["blade"]])
    alike = ["scene", "contact"]
    # blades without stress have nothing to be ranked by
    known = table[table[RANKED_BY[0]].notna()]
    ranks = pd.concat([ranks_of(rows) for _, rows in known.groupby(alike)] or [DataFrame(columns=_RANKS)])
    for place, name in enumerate(_RANKS, 2):
        table.insert(place, name, ranks[name].reindex(table.index).astype("Int64"))
    if "exceedance_integral_operating_rad_s" in table:
        inside = table.groupby(alike)["exceedance_integral_operating_rad_s"].rank(method="min")
        table["rank_operating"] = inside.astype("Int64")
    if members:
        table = pd.concat([table, DataFrame([_member_columns(pair, members, contacts) for pair in measures])], axis=1)
    if table.loc[table["rank"].notna(), "scene"].nunique() > 1:
        table = pd.concat([table, _overall(table)], axis=1)
    order = ["scene", "contact", "rank", *RANKED_BY]
    return table.sort_values(order, key=lambda keys: pd.Series(pd.factorize(keys)[0]) if keys.name in order[:2] else keys)


def ranks_of(rows: DataFrame) -> DataFrame:
    """`rank`, `rank_lowest` and `rank_highest` of rows of one scene, by their brackets and what these are known within.

    One is surely better where its bracket ends below the other's. In the order of `rank_lowest`, then RANKED_BY, those than
    which no other of a group is surely better share its rank.
    """
    ends, within = np.cumsum(rows[list(_BRACKET)].to_numpy(float), axis=1), rows[_WITHIN].fillna(np.inf).to_numpy()
    better = ends[None, :, 0] - ends[:, None, 1] > np.hypot(within[:, None], within)
    lowest, highest = 1 + better.sum(axis=0), len(rows) - better.sum(axis=1)
    order = np.lexsort([*rows[list(RANKED_BY)].fillna(np.inf).to_numpy().T[::-1], lowest])
    shared, group = np.empty(len(rows), int), order[:0]
    for place, row in enumerate(order):
        begins = not len(group) or better[group, row].any()
        group = order[place : place + 1] if begins else np.append(group, row)
        shared[row] = place + 1 if begins else shared[group[0]]
    # what is sure need not be in one order: of three each may be surely better than the next
    columns = {"rank": shared.clip(lowest, highest), "rank_lowest": lowest, "rank_highest": highest}
    return DataFrame(columns, rows.index, dtype="Int64")


def _overall(table: DataFrame) -> DataFrame:
    """OVER_SCENES of the rows of a ranking; NaN for a blade without a rank in some of the scenes."""
    ranked = table[table["rank"].notna()]
    ranked = ranked.assign(bracket_end=ranked[list(_BRACKET)].sum(axis=1))
    blades = ranked.groupby("blade")
    worst = ranked.loc[blades["bracket_end"].idxmax()].set_index("blade")[blades.size() == ranked["scene"].nunique()]
    ranks = pd.concat([ranks_of(rows)["rank"] for _, rows in worst.groupby("contact")]).reindex(worst.index)
    columns = [ranks, blades["rank"].max(), blades[RANKED_BY[0]].sum()]
    overall = pd.concat(dict(zip(names(OVER_SCENES), columns, strict=True)), axis=1).reindex(worst.index)
    return overall.reindex(table["blade"]).set_axis(table.index)


def read_ranking(file: Path | str) -> DataFrame:
    """ranking.csv. Raises InputFileError where it cannot be read, or a column is missing or has no numbers."""
    table = read_table(file)
    with readable(file):
        missing = [name for name in ("blade", "scene", *_RANKS, *names(ROBUSTNESS)) if name not in table]
        if missing:
            raise ValueError(f"without the columns {', '.join(missing)}")
        numbers = dict.fromkeys(table.columns.drop(["blade", "scene", "contact"], errors="ignore"), float)
        return table.astype(numbers).astype(dict.fromkeys(_RANKS, "Int64"))


def _member_columns(pair: tuple[str, str], members: MeasuresOfMembers, contacts: Mapping[str, str]) -> dict[str, float]:
    blade, scene = pair
    own = members.get(pair, {})
    row: dict[str, float] = {"members": len(own)}
    for name in RANKED_BY:
        values = [measures[name] for measures in own.values()]
        for end in ("low", "high"):
            row[f"{name}_{end}"] = float(np.quantile(values, ENDS[end], method="inverted_cdf")) if values else np.nan
    for other in dict.fromkeys(name for name, of in members if of == scene):
        if other != blade and contacts.get(other) == contacts.get(blade):
            row[f"{CHANCE}{other}"] = chance_to_be_better(own, members[other, scene])
    return row


def chance_to_be_better(own: Mapping[str, Mapping[str, float]], others: Mapping[str, Mapping[str, float]]) -> float:
    """Share of the common members, by name, in which the bracket of `own` ends below that of the other.

    Brackets that overlap count half; NaN without any.
    """
    pairs = [[np.cumsum([each[name][of] for of in _BRACKET]) for each in (own, others)] for name in own if name in others]
    wins = [0.5 * (1.0 + (ours[1] < theirs[0]) - (theirs[1] < ours[0])) for ours, theirs in pairs]
    return float(np.mean(wins)) if wins else np.nan
