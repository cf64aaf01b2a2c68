"""The figure of the estimate."""

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from r37core.figures import style


def draw_estimate(table: pd.DataFrame) -> Figure:
    """A bar for each part of the cost, and one for all."""
    figure, axes = plt.subplots(figsize=(style.COLUMN, 1.8))
    bars = axes.barh(table["part"], table["core_hours"])
    axes.bar_label(bars, fmt="%.3g", fontsize=6, padding=2)
    axes.margins(x=0.2)
    axes.invert_yaxis()
    axes.set(xlabel="core hours", title=f"{table['simulations'].iloc[0]} simulations")
    return figure
