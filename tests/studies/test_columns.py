"""Columns of the studies have units."""

import pytest

from r37core.base.units import SI_UNITS, unit_of
from r37core.product.targets import COLUMNS
from r37core.results.columns import OPERATING
from r37studies.designs.table import MEASURES


@pytest.mark.parametrize("column", ["power_w", "force_n", "energy_j", "time_s"])
def test_every_column_has_a_unit_that_is_known(column):
    units = {unit_of(column.name) for column in (*COLUMNS["summary"], *COLUMNS["ranking"], *MEASURES, *OPERATING)}
    assert units == {*SI_UNITS.values(), "1"} - {"percent"}
    with pytest.raises(ValueError, match=f"{column}: ends like a unit that no column has; known: _m, _pa"):
        unit_of(column)
