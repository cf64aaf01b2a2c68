"""Peak speeds of every reading beside the published ones."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from r37core.figures import style  # noqa: F401  (sets the style)
from r37core.published import INTERACTIONS

from .measures import peak_speed
from .reading_list import READINGS
from .validation import PEAK_WITHIN, Runs


def draw_readings(readings: Mapping[str, Runs]) -> Figure:
    """One row for each reading: error of every peak speed in percent, and how many there are; grey: what counts as met."""
    figure, axes = plt.subplots(figsize=(9.0, 0.32 * len(readings) + 1.6))
    axes.axvspan(-100 * PEAK_WITHIN, 100 * PEAK_WITHIN, color="0.92", zorder=0)
    rows = np.arange(len(readings))
    for number, one in enumerate(INTERACTIONS):
        speeds = [peak_speed(runs[one.name]) if one.name in runs else np.nan for runs in readings.values()]
        errors = 100.0 * (np.array(speeds) / one.peak - 1.0)
        marker = "o" if one.engine_order == 4 else "^sD"[one.engine_order - 5]
        color = f"C{number}" if one.engine_order == 4 else "C0"
        label = f"{one.blade} 1B/{one.engine_order}"
        axes.plot(errors, rows, marker, color=color, alpha=0.8, markersize=5, linestyle="none", label=label)
    for row, runs in enumerate(readings.values()):
        found = sum(np.isfinite(peak_speed(runs[one.name])) for one in INTERACTIONS if one.name in runs)
        axes.annotate(
            f"{found} of {len(INTERACTIONS)}", (1.01, row), xycoords=("axes fraction", "data"), va="center", fontsize=8
        )
    axes.set_yticks(rows, [READINGS[name].what for name in readings])
    axes.invert_yaxis()
    axes.set(xlabel="peak speed less the published one (%)")
    axes.annotate("peaks found", (1.01, 1.0), xycoords="axes fraction", va="bottom", fontsize=8)
    figure.legend(loc="outside lower center", ncols=5, fontsize=8)
    return figure
