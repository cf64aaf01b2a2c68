"""Published numbers of the benchmark beside ours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from .reading_list import LINED, RIGID
from .readings import HISTORIES, OUTSIDE, WINDOWS

AREAS_CM2 = {0: 1.8427, 30: 1.4094, 50: 1.1842, 70: 0.9806, 100: 0.7059}
VOLUME_CM3 = 8.08
CROSSINGS = {7: 806.0, 6: 965.0, 5: 1213.0, 4: 1672.0}
PEAKS = {7: 838.0, 6: 996.0, 5: 1264.0, 4: 1717.0}
DIRECT_PEAK = 1344.0
LINED_YIELD, RIGID_YIELD = 40.0, 90.0
LINING_THICKNESS_MM = 5.0
QUIET = 1800.0
"""Speed (rad/s) at which no stress passes yield, in both scenes."""

CONVERGENCE = ("double_step", "half_step", "mesh_10000", "mesh_40000")
"""Readings that differ from the shipped one in a numerical choice only."""


@dataclass(frozen=True)
class Check:
    """One published number beside ours, or a yes or no; `within`: relative error up to which it counts as met."""

    name: str
    published: float | str
    ours: float | str
    unit: str = ""
    within: float = 0.01

    @property
    def error(self) -> float:
        """Relative error; infinite where a yes or no is missed or there is no number of ours."""
        if isinstance(self.published, str) or isinstance(self.ours, str):
            return 0.0 if self.published == self.ours else np.inf
        return abs(self.ours / self.published - 1.0) if np.isfinite(self.ours) else np.inf

    @property
    def met(self) -> bool:
        """Whether the error is within what is asked."""
        return self.error <= self.within


def peak_of(run: xr.Dataset, window: tuple[float, float]) -> xr.Dataset:
    """The speed of a window (rad/s) with the largest radial rms."""
    inside = run.sel(speed=slice(*window))
    return inside.isel(speed=int(np.argmax(inside["rms_radial"].fillna(0.0).values)))


def drop_after(run: xr.Dataset, window: tuple[float, float], within: float = 24.0) -> float:
    """Share of the peak's rms that is lost within so many rad/s above it."""
    peak = peak_of(run, window)
    speed = float(peak["speed"])
    after = run["rms_radial"].sel(speed=slice(speed + 1e-6, speed + within)).fillna(0.0)
    return 1.0 - float(after.min() / peak["rms_radial"]) if after.size else np.nan


def lined_checks(run: xr.Dataset, rigid: xr.Dataset | None, yield_stress: float) -> list[Check]:
    """Checks of the abradable scene; `rigid`: direct contact of the shipped reading, to compare with outside."""
    checks = []
    for order, published in PEAKS.items():
        peak = peak_of(run, WINDOWS[order])
        checks.append(Check(f"abradable: peak of 1B/{order}", published, float(peak["speed"]), "rad/s"))
        checks.append(
            Check(f"abradable: lobes of the wear at the peak of 1B/{order}", float(order), float(peak["lobes"]), "", 0.0)
        )
        drop = drop_after(run, WINDOWS[order])
        checks.append(Check(f"abradable: sharp drop after the peak of 1B/{order}", "yes", _yes(drop > 0.5)))
    history = run.sel(speed=HISTORIES["lined"])
    first = float(history["first_yield_revolution"])
    checks.append(Check(f"abradable: first yield at {HISTORIES['lined']:g}", LINED_YIELD, first, "revolutions", 0.25))
    worn = max(1e3 * float(peak_of(run, window)["max_wear"]) for window in WINDOWS.values())
    checks.append(Check("abradable: lining worn through at the peaks, deepest wear", LINING_THICKNESS_MM, worn, "mm", 0.01))
    checks.append(_quiet("abradable", run, yield_stress))
    if rigid is not None:
        ours = float(run["rms_radial"].sel(speed=list(OUTSIDE)).mean() / rigid["rms_radial"].sel(speed=list(OUTSIDE)).mean())
        checks.append(Check("abradable: response outside interactions below half of direct contact's", "yes", _yes(ours < 0.5)))
    return checks


def rigid_checks(run: xr.Dataset, yield_stress: float) -> list[Check]:
    """Checks of direct contact."""
    rms = run["rms_radial"].fillna(0.0)
    peak = float(run["speed"][int(np.argmax(rms.values))])
    above = float(rms.sel(speed=slice(1400.0, 2000.0)).max() / rms.max())
    first = float(run["first_yield_revolution"].sel(speed=HISTORIES["rigid"]))
    window = (DIRECT_PEAK - 20.0, DIRECT_PEAK + 20.0)
    return [
        Check("direct: largest rms", DIRECT_PEAK, peak, "rad/s"),
        Check("direct: jump down after 1344", "yes", _yes(drop_after(run, window, 4.0) > 0.3)),
        Check("direct: response above 1400 below half of the largest", "yes", _yes(above < 0.5)),
        Check(f"direct: first yield at {HISTORIES['rigid']:g}", RIGID_YIELD, first, "revolutions", 0.25),
        _quiet("direct", run, yield_stress),
    ]


def structure_checks(geometry: xr.Dataset, campbell: xr.Dataset) -> list[Check]:
    """Checks of the blade's shape and its Campbell diagram."""
    span = np.round(100.0 * geometry["span"].values).astype(int)
    areas = dict(zip(span, 1e4 * geometry["section_area"].values, strict=True))
    checks = [
        Check(f"area of the profile at {percent}%", value, float(areas[percent]), "cm2") for percent, value in AREAS_CM2.items()
    ]
    checks.append(Check("volume of the blade", VOLUME_CM3, 1e6 * float(geometry["volume"]), "cm3"))
    for order, value in CROSSINGS.items():
        ours = float(campbell["crossing_speed"].sel(mode="1B", engine_order=order))
        checks.append(Check(f"Campbell: 1B meets order {order}", value, ours, "rad/s", 0.003))
    return checks


def _quiet(scene: str, run: xr.Dataset, yield_stress: float) -> Check:
    stress = float(run["max_von_mises"].sel(speed=QUIET))
    return Check(f"{scene}: stress below yield at {QUIET:g} rad/s", "yes", _yes(stress < yield_stress))


def _yes(truth: bool) -> str:
    return "yes" if truth else "no"


def score_table(lined: Mapping[str, xr.Dataset], rigid: Mapping[str, xr.Dataset], yield_stress: float) -> str:
    """All readings: peak speeds, what else is met, how many checks."""
    lines = ["| reading of the abradable scene | " + " | ".join(f"1B/{order}: {value:g}" for order, value in PEAKS.items())]
    lines[0] += " | rms of peak errors | drops | lobes | first yield at 1717: 40 | deepest wear: 5 mm | checks met |"
    lines.append("|---" * 10 + "|")
    for name, run in lined.items():
        checks = lined_checks(run, rigid.get("benchmark"), yield_stress)
        peaks = [check for check in checks if check.name.startswith("abradable: peak")]
        spread = np.sqrt(np.mean([(float(check.ours) - float(check.published)) ** 2 for check in peaks]))
        drops = sum(check.met for check in checks if "drop" in check.name)
        lobes = sum(check.met for check in checks if "lobes" in check.name)
        first = next(check for check in checks if "first yield" in check.name).ours
        worn = next(check for check in checks if "worn" in check.name).ours
        cells = [LINED[name].what, *[f"{check.ours:.0f}" for check in peaks], f"{spread:.0f}", f"{drops} of 4", f"{lobes} of 4"]
        lines.append("| " + " | ".join([*cells, _number(first), _number(worn), _met(checks)]) + " |")
    lines += [
        "",
        "| reading of direct contact | largest rms: 1344 | jump | quiet above | first yield at 1344: 90 | checks met |",
    ]
    lines.append("|---" * 6 + "|")
    for name, run in rigid.items():
        checks = rigid_checks(run, yield_stress)
        cells = [RIGID[name].what, *[_number(check.ours) for check in checks[:4]], _met(checks)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def validation_table(checks: Sequence[Check], variants: Mapping[str, Mapping[str, float | str]]) -> str:
    """All checks, the missed ones first and by falling error; `variants`: ours of each numerical variant by name."""
    head = ["what", "published", "ours", "error", *(name.replace("_", " ") for name in variants)]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    for check in sorted(checks, key=lambda check: (check.met, -check.error)):
        error = "missed" if np.isinf(check.error) else f"{100 * check.error:.2g}%"
        mark = error if check.met else f"**{error}**"
        others = [_number(values.get(check.name, "")) for values in variants.values()]
        unit = f" {check.unit}" if check.unit else ""
        lines.append(
            "| " + " | ".join([check.name, f"{_number(check.published)}{unit}", _number(check.ours), mark, *others]) + " |"
        )
    return "\n".join(lines) + "\n"


def _number(value: float | str) -> str:
    if isinstance(value, str):
        return value
    return f"{value:.5g}" if np.isfinite(value) else "none"


def _met(checks: Sequence[Check]) -> str:
    return f"{sum(check.met for check in checks)} of {len(checks)}"
