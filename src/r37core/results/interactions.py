"""Interactions: peaks of the response over speed, matched with modes and engine orders."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from scipy.signal import find_peaks

from r37core.time_integration.status import RunStatus

COLUMNS = (
    "blade",
    "scene",
    "mode",
    "engine_order",
    "campbell_speed",
    "peak_speed",
    "shift",
    "peak_rms_normal",
    "peak_rms_tangential",
    "jump",
    "width_above_yield",
    "max_von_mises",
    "max_wear",
    "status",
)
"""Columns of summary.csv; speeds, shift and width in rad/s, `jump` the drop to the next speed as a share of the peak."""

NAMED_MODES = ("1B", "1T", "2B")
"""Modes whose crossings with engine orders peaks are matched with."""

SPECTRA = {"normal": "amplitude", "tangential": "amplitude_tangential"}
"""Directions whose peaks are looked for, and the name of their spectrum in spectrum.nc."""


@dataclass(frozen=True)
class InteractionChoice:
    """What counts as an interaction.

    A peak of the leading edge's normal or tangential rms must rise above its surroundings by `prominence` of the largest one
    in that direction. It is matched with a crossing of the engine order that is strongest in that direction's spectrum if it
    lies between `below` and `above` (shares of the Campbell speed) about it; without a spectrum, with the nearest crossing
    of any order.
    """

    prominence: float
    below: float
    above: float


def find_interactions(
    rms: xr.Dataset,
    campbell: xr.Dataset,
    spectrum: xr.Dataset | None,
    stress: xr.Dataset | None,
    wear: xr.Dataset | None,
    choice: InteractionChoice,
) -> list[dict[str, object]]:
    """Peaks of one blade and scene, by ascending speed; keys as in COLUMNS but for blade and scene.

    The datasets are those of the project with `blade` and `scene` already selected; `spectrum`, `stress` and `wear` None
    where a scene has none. Only the named modes 1B, 1T and 2B are matched; a peak that belongs to none of their crossings
    has an empty mode and no Campbell speed.
    """
    return _strongest_of_each(
        [row for direction in SPECTRA for row in _peaks(direction, rms, campbell, spectrum, choice, stress, wear)]
    )


def interactions_of_response(response: xr.Dataset, campbell: xr.Dataset, choice: InteractionChoice) -> list[dict[str, object]]:
    """The same of one response.nc, with the Campbell diagram of its blade."""

    def part(name: str) -> xr.Dataset | None:
        return response if name in response else None

    return find_interactions(response, campbell, part("amplitude"), part("max_von_mises"), part("max_wear"), choice)


def titles(interactions: Iterable[Mapping[str, Any]]) -> dict[float, str]:
    """Peak speed (rad/s) -> what meets there: 1B/4, or the engine order alone."""

    def what(mode: str, order: int | None) -> str:
        return f"{mode}/{order}" if mode else "a peak of its own" if order is None else f"engine order {order}"

    return {float(row["peak_speed"]): what(row["mode"], row["engine_order"]) for row in interactions}


def _peaks(
    direction: str,
    rms: xr.Dataset,
    campbell: xr.Dataset,
    spectrum: xr.Dataset | None,
    choice: InteractionChoice,
    stress: xr.Dataset | None,
    wear: xr.Dataset | None,
) -> list[dict[str, object]]:
    """Peaks of the leading edge's rms in one direction."""
    rms = rms.isel(speed=np.flatnonzero(rms["status"].values != RunStatus.NOT_RUN)).sel(tip_point="leading_edge")
    speed = rms["speed"].values
    rms_of_speed = rms[f"rms_{direction}"].fillna(0.0).values
    if rms_of_speed.size == 0 or not rms_of_speed.max() > 0.0:
        return []
    # a floor at both ends, so that a peak on the first or last speed counts
    peaks, _ = find_peaks(np.concatenate([[0.0], rms_of_speed, [0.0]]), prominence=choice.prominence * rms_of_speed.max())
    rows: list[dict[str, object]] = []
    for peak in peaks - 1:
        strongest = _strongest_order(spectrum, SPECTRA[direction], speed[peak])
        mode, order, crossing = _nearest_crossing(campbell, speed[peak], strongest, choice)
        after = rms_of_speed[peak + 1] if peak + 1 < len(rms_of_speed) else np.nan
        rows.append(
            {
                "mode": mode,
                "engine_order": order,
                "campbell_speed": crossing,
                "peak_speed": speed[peak],
                "shift": speed[peak] - crossing,
                "peak_rms_normal": float(rms["rms_normal"][peak]),
                "peak_rms_tangential": float(rms["rms_tangential"][peak]),
                "jump": 1.0 - after / rms_of_speed[peak],
                "width_above_yield": _width_above_yield(stress, speed[peak]),
                "max_von_mises": _at(stress, "max_von_mises", speed[peak]),
                "max_wear": _at(wear, "max_wear", speed[peak]),
                "status": RunStatus(int(rms["status"][peak])).text,
            }
        )
    return rows


def _strongest_order(spectrum: xr.Dataset | None, name: str, speed: float) -> int | None:
    """The whole engine order with the largest amplitude at `speed` in the spectrum's variable; None without a spectrum."""
    if spectrum is None:
        return None
    amplitude = spectrum[name].sel(speed=speed)
    vibration = amplitude.where(amplitude["engine_order"] >= 0.5, 0.0).fillna(0.0)
    return round(float(vibration["engine_order"][int(np.argmax(vibration.values))]))


def _nearest_crossing(
    campbell: xr.Dataset, speed: float, strongest: int | None, choice: InteractionChoice
) -> tuple[str, int | None, float]:
    """Mode, engine order and speed of the nearest Campbell crossing in the allowed window, of the strongest order if known."""
    candidates = []
    for mode in NAMED_MODES:
        for order, crossing in campbell["crossing_speed"].sel(mode=mode).to_series().dropna().items():
            fits = strongest is None or order == strongest
            if fits and -choice.below * crossing <= speed - crossing <= choice.above * crossing:
                candidates.append((abs(speed - crossing), mode, int(order), float(crossing)))
    return min(candidates)[1:] if candidates else ("", strongest, float("nan"))


def _at(dataset: xr.Dataset | None, name: str, speed: float) -> float:
    return float("nan") if dataset is None else float(dataset[name].sel(speed=speed))


def _width_above_yield(stress: xr.Dataset | None, speed: float) -> float:
    """Length (rad/s) of the range of speeds about `speed` over which the largest stress exceeds yield."""
    if stress is None:
        return float("nan")
    series = stress["max_von_mises"].dropna("speed")
    speeds, excess = series["speed"].values, series.values / float(stress["yield_stress"]) - 1.0
    at = np.flatnonzero(speeds == speed)
    if not len(at) or excess[at[0]] <= 0.0:
        return 0.0
    low = high = int(at[0])
    while low > 0 and excess[low - 1] > 0.0:
        low -= 1
    while high + 1 < len(excess) and excess[high + 1] > 0.0:
        high += 1
    # linear interpolation to the yield line on both sides
    start, end = speeds[low], speeds[high]
    if low > 0:
        start -= (speeds[low] - speeds[low - 1]) * excess[low] / (excess[low] - excess[low - 1])
    if high + 1 < len(excess):
        end += (speeds[high + 1] - speeds[high]) * excess[high] / (excess[high] - excess[high + 1])
    return float(end - start)


def _strongest_of_each(rows: list[dict[str, object]]) -> list[dict[str, object]]:
    """One row for each mode and engine order: the peak with the largest motion, in both directions together."""

    def motion(row: dict[str, object]) -> float:
        return float(np.hypot(row["peak_rms_normal"], row["peak_rms_tangential"]))  # type: ignore[call-overload]

    strongest: dict[tuple[object, object], dict[str, object]] = {}
    for row in rows:
        key = (row["mode"], row["engine_order"])
        if key not in strongest or motion(row) > motion(strongest[key]):
            strongest[key] = row
    return sorted(strongest.values(), key=lambda row: row["peak_speed"])  # type: ignore[arg-type, return-value]


def summarise(datasets: Mapping[str, xr.Dataset], choice: InteractionChoice) -> pd.DataFrame:
    """Table of all interactions, columns as in COLUMNS, from the datasets `campbell`, `rms` and, if there, others."""

    def part(kind: str, blade: str, scene: str) -> xr.Dataset | None:
        dataset = datasets.get(kind)
        if dataset is None or scene not in dataset["scene"].values or blade not in dataset["blade"].values:
            return None
        return dataset.sel(blade=blade, scene=scene)

    rows = []
    for blade in datasets["rms"]["blade"].values:
        campbell = datasets["campbell"].sel(blade=blade)
        for scene in datasets["rms"]["scene"].values:
            rms = datasets["rms"].sel(blade=blade, scene=scene)
            spectrum, stress, wear = (part(kind, blade, scene) for kind in ("spectrum", "stress", "wear"))
            found = find_interactions(rms, campbell, spectrum, stress, wear, choice)
            rows += [{"blade": blade, "scene": scene} | row for row in found]
    return pd.DataFrame(rows, columns=list(COLUMNS))
