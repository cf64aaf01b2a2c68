"""One style for all figures."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from r37core.io import atomic_write
from r37core.units import RPM

plt.rcParams.update(
    {
        "figure.dpi": 110,
        "savefig.dpi": 150,
        "figure.constrained_layout.use": True,
        "font.size": 9,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "lines.linewidth": 1.4,
        "legend.frameon": False,
        # no creation date, so that the same data give the same bytes
        "svg.hashsalt": "r37",
    }
)


def rpm_axis(axes: Axes) -> None:
    """A second axis above one of speeds in rad/s, in revolutions per minute."""
    functions = (lambda speed: np.multiply(speed, RPM), lambda turns: np.divide(turns, RPM))
    axes.secondary_xaxis("top", functions=functions).set_xlabel("rpm", fontsize=8)


def save(figure: Figure, file: Path | str, caption: str | None = None) -> None:
    """Write the figure with its caption as a description, atomically, and close it; the same data give the same bytes."""
    with atomic_write(file) as partial:
        figure.savefig(partial, metadata={"Software": None, "Description": caption})
    plt.close(figure)
