"""measured.csv: each measured point beside its simulated value."""

from collections.abc import Mapping
from math import inf
from typing import Any

import numpy as np
import pandas as pd

from .points import VALUES, Measurement


def compared(
    measurements: Mapping[str, Measurement], simulated: Mapping[str, Mapping[str, Any]], errors: Mapping[tuple[str, str], float]
) -> pd.DataFrame:
    """A row for each point of all measurements.

    `simulated`: of each measurement `values` at its points, None where a run diverged, `scatter` of these by a small change of
    friction, and a `remark`. `errors`: relative error by mesh and step of each blade and scene, NaN where it is not known.
    """
    rows = [_rows(each, simulated[name], errors[each.blade, each.scene]) for name, each in measurements.items()]
    return pd.concat(rows, ignore_index=True)


def _rows(measurement: Measurement, simulated: Mapping[str, Any], error: float) -> pd.DataFrame:
    points, known = measurement.points, np.array([value is not None for value in simulated["values"]])
    values, scatter = (np.nan_to_num(np.array(simulated[name], float)) for name in ("values", "scatter"))
    # the level's error is one of amplitudes, not of speeds
    share = np.nan_to_num(error) if measurement.speed_of == VALUES else 0.0
    uncertainty = np.where(known, np.hypot(share * values, scatter), 0.0)
    values = np.where(known, values, inf)
    both = np.hypot(points.deviations, uncertainty)
    return pd.DataFrame(
        {
            "blade": measurement.blade,
            "scene": measurement.scene,
            "quantity": measurement.title,
            "file": measurement.file,
            "speed_rad_s": points.speeds,
            "angle_deg": np.degrees(points.angles) if points.angles else np.nan,
            "engine_order": [order or None for order in points.orders],
            "measured": points.values,
            "measured_uncertainty": points.deviations,
            "simulated": values,
            "simulated_uncertainty": uncertainty,
            "unit": measurement.unit,
            "difference_over_uncertainty": (values - np.array(points.values)) / both,
            "remark": simulated["remark"],
        }
    )
