"""A flexible casing: the rings' waves, and what rings on stiff and soft flanges change."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.contact.elastic_casing import ENOUGH, ElasticCasing, nodal_diameters_for, slowest_wave
from r37core.results.events import Danger
from r37core.results.regions import read_judged
from r37core.time_integration.status import RunStatus

from .configuration import settings_of
from .tables import write_table

SHIPPED, FASTEST = "elastic_abradable", 2000.0
THICKNESSES, FLANGES = (2e-3, 1e-3), {"stiff": 1e9, "soft": 1e7}
"""Of rings (m), and the stiffness of their flanges, radial and tangential, per length of circumference (N/m2)."""


def rings(input: Any, output: Any, params: Any) -> None:
    """Table of the waves of the rings that the rotor overtakes, and of the nodal diameters that a ring needs."""
    shipped = settings_of(Path.cwd(), scenes="all").scene_designs.entries[SHIPPED].casing.elastic_casing().ring
    assert shipped is not None
    rows = []
    for name, stiffness in FLANGES.items():
        for thickness in THICKNESSES:
            ring = replace(shipped, thickness=thickness, radial_foundation=stiffness, tangential_foundation=stiffness)
            elastic = ElasticCasing(ring.modes(), ring)
            second = next(mode.frequency for mode in elastic.modes if mode.radial and mode.nodal_diameter == 2)
            number, critical = slowest_wave(ring)
            overtaken = [mode.nodal_diameter for mode in elastic.overtaken(FASTEST)]
            cells = [f"{critical:.0f}", str(number), f"{overtaken[0]} to {overtaken[-1]}"]
            needed = [str(nodal_diameters_for(ring, speed)) for speed in (0.0, FASTEST)]
            rows.append([f"{1e3 * thickness:g} mm, {name}", f"{second / 2.0 / np.pi:.0f}", *cells, *needed])
    heads = ["n = 2 (Hz)", "lowest critical speed (rad/s)", "its n", f"n overtaken at {FASTEST:g} rad/s"]
    write_table(["ring, flanges", *heads, f"n for {ENOUGH:.0%} of the flexibility", "n that are needed"], rows, output.table)


def effect(input: Any, output: Any, params: Any) -> None:
    """Table of dangerous and unknown speeds, and of runs that diverge, by blade, contact and casing. Input: responses."""
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for response in map(read_judged, input.responses):
        contact, casing = response.attrs["scene"].split("_")
        cells.setdefault((response.attrs["blade"], contact), {})[casing] = _cell(response, params.speeds)
    casings = list(next(iter(cells.values())))
    rows = [[*case, *(by_casing[casing] for casing in casings)] for case, by_casing in sorted(cells.items())]
    write_table(["blade", "contact", *casings], rows, output.table)


def _cell(response: xr.Dataset, speeds: list[float]) -> str:
    """Numbers of dangerous and of unknown speeds, and how many runs diverge."""
    at_speeds = response.sel(speed=speeds)
    dangerous, unknown = (int((at_speeds["yield_danger"] == each).sum()) for each in (Danger.DANGEROUS, Danger.UNKNOWN))
    diverged = int((at_speeds["status"] == RunStatus.DIVERGED).sum())
    return f"{dangerous} / {unknown} of {len(speeds)}" + (f" ({diverged} diverge)" if diverged else "")
