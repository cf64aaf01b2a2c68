"""tolerances.nc: what the members of all samples gave, their quantiles, and where their spread comes from."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
import xarray as xr

from r37core.base.dataset_file import SPEED_RPM
from r37core.base.io import readable
from r37core.base.units import RPM, si_name
from r37core.base.variable import Variable, about
from r37core.results.columns import ENDS
from r37core.results.danger import ratio_inside
from r37core.results.events import OF_EXIT, OF_YIELD
from r37core.results.measures import leading_edge, peak_of
from r37core.results.ranking import RANKED_BY, robustness
from r37core.results.regions import read_judged
from r37core.results.variables import VARIABLES
from r37core.time_integration.status import RunStatus

from .number_ranks import CONFIDENCE, ranking, share_ends

QUANTILES = tuple(ENDS.values())
"""Ends and middle of the range that nine tenths of the members lie in."""

_CURVES = ("rms_normal", "rms_tangential", "max_von_mises_ever")
_JUDGED = ("share_of_revolutions_above_yield", *OF_YIELD, *OF_EXIT, "goodman_share", "goodman_share_inside")
_OF_ALL = ("yield_stress", "static_stress", "fatigue_strength", "lined")

MEASURES = {
    "peak_speed": Variable((), "rad s-1", "speed of the leading edge's largest motion"),
    "largest_stress": Variable((), "Pa", "largest von Mises stress over all speeds"),
    "length_dangerous": Variable((), "rad s-1", "length of the dangerous speeds"),
    "length_unknown": Variable((), "rad s-1", "length of the unknown speeds"),
    "length_most_revolutions": Variable((), "rad s-1", "length of the speeds above yield in most of the later revolutions"),
    "diverged_runs": Variable((), "1", "runs that diverged"),
    "largest_stress_inside": Variable((), "Pa", "largest von Mises stress over all speeds before the model's limits are left"),
    "largest_goodman_share": Variable((), "1", "largest share of the Goodman line over all speeds"),
}
"""Measures of each member over all its speeds; all but the first need the stress."""

_MORE = ("diverged_runs", "largest_stress_pa", "largest_goodman_share")
"""Columns of a ranking that are MEASURES beside RANKED_BY."""

INDEXED = ("peak_speed", "length_dangerous", "largest_stress")
"""Measures for which the numbers are ranked."""


RESPONSE, CAMPBELL_GROUP = "{}/response", "{}/campbell"
"""Groups of a member in the file of its blade and scene."""

Sample = tuple[str, str, Mapping[str, Sequence[float | None]]]
"""Blade, scene, and member -> its value of each of the numbers, None for one that it does not have."""


def tolerances_dataset(samples: Iterable[tuple[Sample, Path | str]], numbers: Sequence[str]) -> xr.Dataset:
    """Dataset of all members by their files, over (blade, scene, member, speed, number); one response is in memory at a time.

    Where nothing was run numbers are NaN. Raises InputFileError for a response that cannot be read.
    """
    parts, pairs = [], []
    for (blade, scene, members), file in samples:
        pairs.append((blade, scene))
        kept = [_kept(file, name, dict(zip(numbers, values, strict=True))) for name, values in members.items()]
        parts.append(_pair_dataset(pairs[-1], kept))
    joined = xr.merge(parts, join="outer", compat="no_conflicts", combine_attrs="override")
    joined["status"] = joined["status"].fillna(RunStatus.NOT_RUN).astype("i1")
    joined = joined.assign_coords(speed_rpm=("speed", RPM * joined["speed"].values, SPEED_RPM.attributes))
    blades, scenes = (list(dict.fromkeys(names)) for names in zip(*pairs, strict=True))
    return joined.sel(blade=blades, scene=scenes)


def _kept(file: Path | str, name: str, numbers: Mapping[str, float | None]) -> xr.Dataset:
    """Curves and measures of one member by its `numbers`, and what requirements are judged by."""
    response = read_judged(file, RESPONSE.format(name))
    with readable(file):
        values = {**dict.fromkeys(MEASURES, np.nan), "peak_speed": float(peak_of(response)["speed"])}
        if "max_von_mises_ever" in response:
            ranked = robustness(response, chance_scatter=False)
            values |= {si_name(column)[0]: ranked[column] for column in (*RANKED_BY, *_MORE)}
    edge = leading_edge(response)
    member = edge[[each for each in ("status", *_CURVES, *_JUDGED, *_OF_ALL) if each in edge]].drop_vars(
        "speed_rpm", errors="ignore"
    )
    member = member.assign({each: ((), value, MEASURES[each].attributes) for each, value in values.items()})
    known = np.array([*numbers.values()], dtype=float)
    member["value"] = ("number", known, {"long_name": "value of the number, in the unit of its key"})
    return member.assign_coords(number=list(numbers)).expand_dims(member=[int(name)])


def _pair_dataset(pair: tuple[str, str], members: Sequence[xr.Dataset]) -> xr.Dataset:
    """One blade in one scene."""
    sample = xr.concat(members, "member", join="exact", combine_attrs="override").drop_attrs(deep=False)
    diverged = sample["status"] == RunStatus.DIVERGED
    for name in _CURVES:
        if name not in sample:
            continue
        kind = VARIABLES[name]
        units, meaning = kind.units, kind.long_name + (", leading edge" if "tip_point" in kind.dims else "")
        sample[name].attrs = about(units, meaning)
        # a run that diverged is above all others; a value of some member, for between infinite ones there is none
        spread = sample[name].where(~diverged, np.inf)
        quantiles = spread.quantile(QUANTILES, "member", method="inverted_cdf").where(~diverged.all("member"))
        sample[f"{name}_quantile"] = quantiles.assign_attrs(about(units, f"quantiles over the members: {meaning}"))
    if "max_von_mises_ever" in sample:
        above = ratio_inside(sample) > 1.0
        count = above.sum("member")
        low, high = share_ends(count.values, above.sizes["member"])
        ends = f"end of what that share says of all that could be drawn, {CONFIDENCE:.0%} sure"
        for end, share, text in (
            ("", above.mean("member"), "share of the members above yield, diverged ones among them"),
            ("_low", count.copy(data=low), f"lower {ends}"),
            ("_high", count.copy(data=high), f"upper {ends}"),
        ):
            sample[f"probability_above_yield{end}"] = share.assign_attrs(about("1", text))
    values = sample["value"].transpose("member", "number").values
    rankings = [ranking(values, sample[name].values) for name in INDEXED]
    sample = sample.assign(xr.concat(rankings, xr.Variable("measure", list(INDEXED)), combine_attrs="override"))
    return sample.expand_dims(blade=[pair[0]], scene=[pair[1]])
