"""Clearance over speed, where it changes with the speed."""

from __future__ import annotations

import matplotlib.pyplot as plt
import xarray as xr
from matplotlib.figure import Figure

from . import style


def draw_clearance(rms: xr.Dataset, title: str) -> Figure:
    """Clearance of the round casing at both ends of the tip of all blades in one scene."""
    figure, axes = plt.subplots(figsize=(style.PAGE, 3.4))
    styles = style.blade_styles(rms["blade"].values)
    for blade in rms["blade"].values:
        # blades may have been run at other speeds, and with fewer contact nodes
        room = 1e6 * rms["clearance"].sel(blade=blade).dropna("speed", how="all").dropna("contact_node", how="all")
        for name, node, line in (("leading edge", 0, "-"), ("trailing edge", -1, "--")):
            curve = room.isel(contact_node=node)
            axes.plot(curve["speed"], curve, label=f"{blade}, {name}", color=styles[str(blade)]["color"], linestyle=line)
    axes.set(xlabel="speed (rad/s)", ylabel="clearance before vibration (µm)", title=f"clearance in scene {title}")
    style.rpm_axis(axes)
    figure.legend(loc="outside right center")
    return figure
