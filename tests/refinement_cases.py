"""Made-up responses over speed, and the rounds that adaptive speed sampling asks for of them."""

import numpy as np
import xarray as xr

from r37core.adaptive.criterion import RefinementChoice, Window
from r37core.adaptive.rounds import first_round, round_after
from r37core.base.speeds import plan_speeds
from r37core.results.events import Danger
from r37core.time_integration.status import RunStatus

WINDOWS = (Window("1B", 8, 0.0, 0.05, 5.0),)
STEEP = {"steep_change": 0.8, "steep_prominence": 0.01}
CHOICE = RefinementChoice(windows=WINDOWS, change=0.25, peak=0.1, largest_share=0.25, prominence=0.1, **STEEP)
PLAN = plan_speeds([{"start": 750, "stop": 2000, "step": 20, "refine_to": 1}], 8.0)
GRID = PLAN.refined[0]


STRESS = "max_von_mises_inside"


def campbell(crossings):
    """A diagram whose mode 1B crosses order 4, 5, ... at the given speeds, and 1T nowhere."""
    speeds = np.full((2, 8), np.nan)
    speeds[0, 3 : 3 + len(crossings)] = crossings
    return xr.Dataset(
        {"crossing_speed": (("mode", "engine_order"), speeds)}, coords={"mode": ["1B", "1T"], "engine_order": np.arange(1, 9)}
    ).reindex(mode=["1B", "1T", "2B"])


def spiked(*spikes, yield_stress=1e9, diverged=(), left=()):
    """A response on the whole grid: from each (first, peak, height) a branch rises to the peak, and drops after it."""
    speeds = np.array(GRID.every_speed())
    rms = 2e-5 + 1e-6 * np.sin(speeds)
    for first, peak, height in spikes:
        branch = (speeds >= first) & (speeds <= peak)
        rms[branch] += height * (speeds[branch] - first + 1.0) / (peak - first + 1.0)
    status = np.where(np.isin(speeds, diverged), int(RunStatus.DIVERGED), int(RunStatus.COMPLETED))
    tips, stress = np.stack([rms, 0.5 * rms], axis=1), np.where(status == 0, 2e12 * rms, np.nan)
    return xr.Dataset(
        {
            "status": ("speed", status),
            "rms_normal": (("speed", "tip_point"), tips),
            "rms_tangential": (("speed", "tip_point"), 3.0 * tips),
            **{name: ("speed", stress) for name in (STRESS, *(f"max_von_mises_{kind}" for kind in ("median", "high", "ever")))},
            "share_of_revolutions_above_yield": ("speed", np.where(status == 0, stress > yield_stress, np.nan)),
            "yield_stress": ((), yield_stress),
            "left": ("speed", np.isin(speeds, left)),
        },
        coords={"speed": speeds, "tip_point": ["leading_edge", "trailing_edge"]},
    )


def asked(response, crossings=(), choice=CHOICE, plan=PLAN):
    """New speeds of each round as the sweep asks for them, with the runs looked up in the whole grid, and all of them."""
    edge, rounds = response.sel(tip_point="leading_edge"), []
    ratio = edge[STRESS] / edge["yield_stress"]
    passed = (ratio > 1.0) | (edge["status"] == RunStatus.DIVERGED)
    danger = xr.where(passed, Danger.DANGEROUS, xr.where(edge["left"], Danger.UNKNOWN, Danger.BELOW))
    columns = [danger, edge["rms_normal"], edge["rms_tangential"], ratio]
    rows = dict(zip(edge["speed"].values.tolist(), np.transpose(columns).tolist(), strict=True))
    current = first_round(plan, campbell(crossings), choice)
    while current.new:
        rounds.append(list(current.new))
        current = round_after(current, {speed: rows[speed] for speed in current.new}, plan, choice)
    return rounds, sorted(speed for new in rounds for speed in new)
