"""Interference diagram (ZZENF) of a blade on a disc: frequencies over nodal diameter."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from xarray import Dataset

from r37core.fem.sector import aliased
from r37core.rom.naming import NAMED_MODES, mode_label

from . import style


def draw_interference(campbell: Dataset, title: str) -> Figure:
    """Frequencies of all nodal diameters at rest and at the highest speed, and the engine orders that excite them there.

    Source: M. P. Singh et al., SAFE diagram, Proc. 17th Turbomachinery Symposium (1988) 93-101.
    """
    figure, ((axes,),) = style.panels(1, 1, 3.6)
    diameters, sectors = campbell["nodal_diameter"].values, int(campbell["sectors"])
    highest = 1.3 * float(campbell["nodal_frequency"].sel(mode="2B").max())
    axes.set(xlabel="nodal diameter", ylabel="frequency (Hz)", ylim=(0.0, highest), xlim=(-0.5, diameters[-1] + 0.5))
    speed = float(campbell["speed"].max())
    orders = np.arange(0, 2 * sectors + 1)
    excited = [aliased(int(order), sectors) for order in orders]
    axes.plot(excited, orders * speed / (2.0 * np.pi), color="0.6", linewidth=0.8, label=f"engine orders, {speed:g} rad/s")
    for place, filled in ((0, False), (-1, True)):
        every = campbell["disc_frequency"].isel(speed=place)
        axes.plot(diameters, every.T, "o", color="0.6", markersize=2.5, markerfacecolor="0.6" if filled else "white", zorder=2)
        for name in NAMED_MODES:
            colour, family = style.mode_colour(campbell, name), campbell["nodal_frequency"].sel(mode=name).isel(speed=place)
            label = f"{mode_label(name)}" if filled else "_"
            look = {"markersize": 4.0, "markerfacecolor": colour if filled else "white", "zorder": 3}
            axes.plot(diameters, family, "o-", color=colour, linewidth=0.6, label=label, **look)
    axes.set_title(f"interference diagram, blade {title}, {sectors} sectors")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), title="filled: spinning, open: at rest")
    return figure
