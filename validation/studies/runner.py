"""Runs of the studies that choose some of their speeds as they go."""

from __future__ import annotations

from dataclasses import replace

import xarray as xr

from r37core.cases.runner import Runs
from r37core.results.measures import peak_of
from r37core.time_integration.speed_file import read_speed
from validation.studies.measures import motion_of_run

from .plan import StudyCase, SweptPeak

_MOST_EXTRA = 40
"""Speeds added on each side of a range that ends above yield."""


def with_swept_peak(case: StudyCase, peak: SweptPeak, response: xr.Dataset) -> StudyCase:
    """The case with the speed of the sweep's peak among its speeds."""
    near = response.sel(speed=slice(peak.first, peak.last))
    return replace(case, speeds=tuple(sorted({*case.speeds, float(peak_of(near)["speed"])})))


def follow(runs: Runs) -> None:
    """Add speeds beyond both ends until the stress is below yield there; then keep the history of the peak."""
    material, speeds = runs.case.material, sorted(runs.files)
    assert material is not None
    step = speeds[1] - speeds[0] if len(speeds) > 1 else 1.0
    for end, towards in ((speeds[0], -step), (speeds[-1], step)):
        for number in range(_MOST_EXTRA):
            last = read_speed(runs.files[end + number * towards])
            if not last["max_von_mises"] > material.yield_stress:
                break
            runs.run(end + (number + 1) * towards)
    peak = max(runs.files, key=lambda speed: motion_of_run(read_speed(runs.files[speed])))
    if peak not in runs.histories:
        runs.histories.add(peak)
        runs.run(peak)
