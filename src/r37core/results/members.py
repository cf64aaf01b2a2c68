"""What members of samples gave, member by member, as far as blades are ranked by it."""

from __future__ import annotations

import xarray as xr

from .ranking import RANKED_BY

MEASURES_RANKED_BY = dict(
    zip(RANKED_BY, ("length_certain", "length_possible", "diverged_runs", "largest_median_stress"), strict=True)
)
"""What blades are ranked by -> measure that it is."""


def measures_of_members(members: xr.Dataset) -> dict[tuple[str, str], dict[str, dict[str, float]]]:
    """What blades are ranked by of each blade and scene, member by member; `members`: a dataset of them."""
    by_pair: dict[tuple[str, str], dict[str, dict[str, float]]] = {}
    for blade in members["blade"].values.tolist():
        for scene in members["scene"].values.tolist():
            part = members[list(MEASURES_RANKED_BY.values())].sel(blade=blade, scene=scene).dropna("member", how="all")
            rows = part.to_dataframe()[list(MEASURES_RANKED_BY.values())].set_axis(list(MEASURES_RANKED_BY), axis=1)
            by_pair[blade, scene] = {str(member): values for member, values in rows.to_dict("index").items()}
    return {pair: measures for pair, measures in by_pair.items() if measures}
