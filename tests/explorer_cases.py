"""What tests of the explorer show: a made-up sweep, and pages beside one that is open."""

from contextlib import contextmanager

import numpy as np
import xarray as xr
from browser import LONGEST

from r37core.explorer import PARTS, write_page
from r37core.results.events import Danger
from r37core.results.limits import Cause
from r37core.time_integration.status import RunStatus

SPEEDS = np.array([900.0, 1000.25, 1100.0, 1200.0, 1300.0])
BLADES, SCENES = ["Ref", "L<50>"], ["abradable", "direct"]


def sweep():
    """Two blades in two scenes: one run has diverged, one was not asked for; only Ref in the lining has a history."""
    generator = np.random.default_rng(2)
    axes = {"blade": BLADES, "scene": SCENES, "speed": SPEEDS}
    status = np.zeros((2, 2, 5), dtype="i1")
    status[0, 1, 3], status[1, 0, 0] = RunStatus.DIVERGED, RunStatus.NOT_RUN
    missing = status > 0

    def over(*more):
        values = generator.uniform(1e-4, 1e-3, (2, 2, 5, *more))
        values[missing] = np.nan
        return values

    dims = ("blade", "scene", "speed")
    tip = {"tip_point": ["leading_edge", "trailing_edge"]}
    names = ("rms_normal", "rms_tangential", "peak_normal")
    rms = {name: ((*dims, "tip_point"), over(2)) for name in names}
    left = np.where(missing, np.nan, np.where(SPEEDS > 1050.0, 3.0, np.nan))
    rms |= {"exit_revolution": (dims, left), "exit_cause": (dims, np.where(left > 0.0, Cause.HEAT, Cause.NONE).astype("i1"))}
    rms |= {"status": (dims, status), "share_of_time_in_contact": (dims, over()), "largest_penetration": (dims, over())}
    stressed = 1e12 * over()
    history = np.full((2, 2, 1, 4), np.nan)
    history[0, 0, 0] = 1e8 * np.arange(1, 5)
    stress = {
        "status": (dims, status),
        **{
            f"max_von_mises_{name}": (dims, factor * stressed)
            for name, factor in (("ever", 1.0), ("high", 0.8), ("median", 0.5), ("inside", 0.4))
        },
        "yield_danger": (dims, np.where(0.4 * stressed > 2e8, Danger.DANGEROUS, (left > 0.0) * Danger.UNKNOWN).astype("i1")),
        "first_yield_revolution": (dims, np.where(0.4 * stressed > 2e8, 2.0, np.nan)),
        "revolutions_above_yield": (dims, np.where(0.4 * stressed > 2e8, 70.0, 0.0)),
        "share_of_revolutions_above_yield": (dims, 0.4 * (stressed > 1.38e9)),
        "yield_stress": (dims[:2], np.full((2, 2), 1.38e9)),
        "stress_region": (dims[:2], np.array([["x < 0.197 m"] * 2, ["whole blade", ""]], dtype=object)),
        "max_von_mises_history": ((*dims[:2], "history_speed", "revolution"), history),
    }
    orders = np.arange(0.0, 4.001, 0.01)
    modes = {"blade": BLADES, "mode": ["1B", "1T"], "speed": np.linspace(0.0, 2000.0, 5), "engine_order": [1, 2, 3]}
    campbell = {
        "frequency": (("blade", "mode", "speed"), generator.uniform(500.0, 3000.0, (2, 2, 5))),
        "crossing_speed": (("blade", "mode", "engine_order"), np.array([[[np.nan, 1500.0, 800.0]] * 2] * 2)),
    }
    return {
        "rms": xr.Dataset(rms, axes | tip, {"fidelity": "draft"}),
        "campbell": xr.Dataset(campbell, modes),
        "stress": xr.Dataset(stress, axes | {"history_speed": [1000.25], "revolution": np.arange(1, 5)}),
        "spectrum": xr.Dataset({"amplitude": ((*dims, "engine_order"), over(len(orders)))}, axes | {"engine_order": orders}),
        # only one scene has a lining
        "wear": xr.Dataset(
            {
                "wear": ((*dims, "angle"), over(360)[:, :1]),
                "max_wear": (dims, over()[:, :1]),
                "worn_through_share": (dims, np.where(missing, np.nan, SPEEDS == 1200.0)[:, :1] / 8.0),
            },
            axes | {"scene": ["abradable"], "angle": np.radians(np.arange(360))},
        ),
    }


@contextmanager
def beside(page, contents, file, size=(1500, 1400), place="", parts=PARTS, color_scheme="light", **more):
    """Another page in the browser of a page, made of other `parts` where an extension has panels.

    Such pages follow each other in one tab and in the file of the first: there the browser has plotly compiled, most of what
    a page takes. One with `more` arguments has a tab of its own.
    """
    viewport = {"width": size[0], "height": size[1]}
    if more or not hasattr(page, "tab"):
        other = page.context.browser.new_page(viewport=viewport, **more)
        other.set_default_timeout(LONGEST)
        if not more:
            page.tab, page.tab_file = other, file
    if not more:
        other, file = page.tab, page.tab_file
        other.set_viewport_size(viewport)
    other.emulate_media(color_scheme=color_scheme)
    write_page(contents, "r37", file, parts)
    # from the page before it would only change the place
    other.goto("about:blank")
    other.goto(file.as_uri() + place)
    other.wait_for_selector("html[data-ready]")
    yield other
    if more:
        other.close()
