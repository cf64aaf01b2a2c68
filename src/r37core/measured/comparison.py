"""measured.csv: each measured point beside its simulated value."""

from collections.abc import Mapping
from math import inf
from typing import Any

import numpy as np
import pandas as pd

from .points import Measurement


def compared(
    measurements: Mapping[str, Measurement], simulated: Mapping[str, Mapping[str, Any]], errors: Mapping[tuple[str, str], float]
) -> pd.DataFrame:
    """A row for each point of all measurements.

    `simulated`: of each measurement `values` at its points, None where a run diverged, `scatter` of these by a small change of
    friction, and a `remark`. `errors`: relative error by mesh and step of each blade and scene, NaN where it is not known.
    """
    return pd.concat([_rows(each, simulated[name], errors) for name, each in measurements.items()], ignore_index=True)


def _rows(measurement: Measurement, simulated: Mapping[str, Any], errors: Mapping[tuple[str, str], float]) -> pd.DataFrame:
    points = measurement.points
    values = np.array([inf if value is None else value for value in simulated["values"]])
    error = np.nan_to_num(errors[measurement.blade, measurement.scene])
    scatter = np.array([0.0 if value is None else value for value in simulated["scatter"]])
    is_finite = np.isfinite(values)
    uncertainty = np.where(is_finite, np.hypot(error * np.where(is_finite, values, 0.0), scatter), 0.0)
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
