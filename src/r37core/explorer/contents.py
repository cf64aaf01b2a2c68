"""Contents of the explorer: the datasets of a sweep, thinned to what a screen shows, as one mapping that JSON can carry."""

import base64
import gzip
from collections.abc import Mapping

import numpy as np
from numpy import ndarray
from xarray import DataArray, Dataset

from r37core.base.units import shown_unit
from r37core.figures.danger_rows import causes_text, kinds_of
from r37core.figures.style import ABOVE_YIELD, OUTSIDE, is_linear
from r37core.results.datasets import response_of
from r37core.results.exceedance import length_of
from r37core.results.limits import Cause
from r37core.results.operating_range import OperatingRange
from r37core.results.variables import VARIABLES

CURVES = (
    ("stress", "max_von_mises_inside"),
    ("stress", "max_von_mises_ever"),
    ("stress", "first_yield_revolution"),
    ("stress", "revolutions_above_yield"),
    ("rms", "exit_revolution"),
    ("stress", "max_von_mises_high"),
    ("stress", "max_von_mises_median"),
    ("stress", "share_of_revolutions_above_yield"),
    ("fatigue", "goodman_share"),
    ("rms", "rms_normal"),
    ("rms", "rms_tangential"),
    ("rms", "peak_normal"),
    ("wear", "max_wear"),
    ("wear", "worn_through_share"),
    ("rms", "largest_penetration"),
    ("rms", "share_of_time_in_contact"),
)
"""Dataset and variable, the one first that the page opens with; of the leading edge where a variable has tip points."""

MOST_SPEEDS = 400
"""Speeds of a map; beyond it neighbours are joined by their maximum. Curves keep every speed."""

MOST_ANGLES = 180
ORDERS_PER_STEP = 0.1
"""Width of a spectrum's bins in engine orders; a bin has the largest amplitude in it."""


def explorer_contents(datasets: Mapping[str, Dataset], operating: OperatingRange | None = None) -> dict[str, object]:
    """All that the page needs. `datasets`: campbell, rms and, where computed, spectrum, stress and wear.

    `operating`: speeds that are shaded.
    Curves have every speed; maps are thinned, each cell the largest value of what it stands for.
    """
    rms, campbell = datasets["rms"], datasets["campbell"]
    blades, scenes = [str(name) for name in rms["blade"].values], [str(name) for name in rms["scene"].values]
    return {
        "about": {name: str(rms.attrs[name]) for name in ("r37core_version", "fidelity") if name in rms.attrs},
        "outside": OUTSIDE if is_linear(rms) else ABOVE_YIELD,
        "blades": blades,
        "scenes": scenes,
        "speeds": packed(rms["speed"].values, 64),
        "status": packed(rms["status"].values),
        "campbell": _campbell(campbell.sel(blade=blades)),
        "exit_cause": packed(rms["exit_cause"].transpose("blade", "scene", "speed").values),
        "causes": [cause.text for cause in Cause],
        "danger": [[_danger(datasets, blade, scene) for scene in scenes] for blade in blades],
        "curves": [_curve(_like(datasets[kind], rms)[name]) for kind, name in CURVES if kind in datasets],
        **_stress(datasets.get("stress"), rms),
        "spectrum": _spectrum(datasets["spectrum"], rms) if "spectrum" in datasets else None,
        "wear": _wear(datasets["wear"], rms) if "wear" in datasets else None,
        "operating": [operating.first, operating.last] if operating else None,
    }


def _like(dataset: Dataset, rms: Dataset) -> Dataset:
    """The dataset with all blades, scenes and speeds of the rms; NaN where it has none."""
    if "tip_point" in dataset.dims:
        dataset = dataset.sel(tip_point="leading_edge")
    return dataset.reindex({name: rms[name] for name in ("blade", "scene", "speed")})


def _campbell(campbell: Dataset) -> dict[str, object]:
    return {
        "modes": [str(name) for name in campbell["mode"].values],
        "orders": [int(order) for order in campbell["engine_order"].values],
        "speeds": packed(campbell["speed"].values),
        "frequency": packed(campbell["frequency"].transpose("blade", "mode", "speed").values),
        "crossing": packed(campbell["crossing_speed"].transpose("blade", "mode", "engine_order").values),
    }


def _described(values: DataArray) -> tuple[dict[str, object], float]:
    """Name, label and shown unit of a variable, from its attributes, and the factor from SI to that unit."""
    attributes = VARIABLES[str(values.name)].attributes | values.attrs
    unit, factor = shown_unit(attributes["units"])
    return {"name": values.name, "label": attributes["long_name"], "unit": unit or "1"}, factor


def _curve(variable: DataArray) -> dict[str, object]:
    about, factor = _described(variable)
    return about | {"values": packed(factor * variable.transpose("blade", "scene", "speed").values)}


def _danger(datasets: Mapping[str, Dataset], blade: str, scene: str) -> dict[str, object]:
    """Ranges of speeds (rad/s) of each kind of a blade and scene, their lengths together, and limits that are left first."""
    # those that a verdict's further runs may have joined
    response = response_of({kind: datasets[kind] for kind in ("rms", "stress") if kind in datasets}, blade, scene)
    ranges = kinds_of(response)
    return {
        "ranges": {kind: [[part.begin, part.end] for part in parts] for kind, parts in ranges.items()},
        "lengths": {kind: length_of(parts) for kind, parts in ranges.items()},
        "causes": causes_text(response),
    }


def _stress(stress: Dataset | None, rms: Dataset) -> dict[str, object]:
    """Yield stress and, for the speeds that have it, largest stress of every revolution (MPa); each blade's region in words."""
    if stress is None:
        return {"yield_stress": None, "stress_region": {}, "history": None}

    def megapascals(name: str, *dims: str) -> dict[str, object]:
        values = stress[name].reindex(blade=rms["blade"], scene=rms["scene"])
        return packed(1e-6 * values.transpose("blade", "scene", *dims).values)

    history = None
    if "max_von_mises_history" in stress:
        values = megapascals("max_von_mises_history", "history_speed", "revolution")
        history = {"speeds": packed(stress["history_speed"].values, 64), "values": values}
    known = [blade for blade in map(str, rms["blade"].values) if blade in stress["blade"].values]
    return {
        "yield_stress": megapascals("yield_stress"),
        "stress_region": {blade: max(map(str, stress["stress_region"].sel(blade=blade).values)) for blade in known},
        "history": history,
    }


def _map(variable: DataArray, over: str, across: ndarray, other: ndarray) -> dict[str, object]:
    """A map of a variable over speed and another axis, that one joined at `across`, the speeds if they are many."""
    about, factor = _described(variable)
    values = factor * variable.transpose("blade", "scene", "speed", over).values
    speeds = variable["speed"].values
    along = bin_starts(len(speeds), MOST_SPEEDS)
    return about | {
        "speeds": packed(speeds[along], 64),
        "other": packed(other),
        "values": packed(rounded(joined(joined(values, 3, across), 2, along))),
    }


def _spectrum(spectrum: Dataset, rms: Dataset) -> dict[str, object]:
    """Amplitude of the leading edge's normal motion (mm) over engine order."""
    starts = order_bins(spectrum["engine_order"].values)
    return _map(_like(spectrum, rms)["amplitude"], "engine_order", starts, ORDERS_PER_STEP * np.arange(len(starts)))


def _wear(wear: Dataset, rms: Dataset) -> dict[str, object]:
    """Wear (mm) over the angle (degrees) round the casing."""
    starts = bin_starts(wear.sizes["angle"], MOST_ANGLES)
    return _map(_like(wear, rms)["wear"], "angle", starts, np.degrees(wear["angle"].values[starts]))


def packed(values: ndarray, bits: int = 32) -> dict[str, object]:
    """Numbers as little-endian floats, compressed, in base64, with their shape; speeds take 64 bits, to stay what they are."""
    data = np.ascontiguousarray(values, dtype=f"<f{bits // 8}")
    compressed = gzip.compress(data.tobytes(), mtime=0)
    return {"shape": list(data.shape), "bits": bits, "base64": base64.b64encode(compressed).decode("ascii")}


def rounded(values: ndarray) -> ndarray:
    """Values with 14 binary digits, a relative error of at most 6e-5: enough for a map, and half as much to carry."""
    whole = np.ascontiguousarray(values, dtype=np.float32).view(np.uint32)
    near = ((whole + np.uint32(1 << 9)) & np.uint32(~((1 << 10) - 1) & 0xFFFFFFFF)).view(np.float32)
    return np.where(np.isfinite(values), near, np.float32(np.nan))


def joined(values: ndarray, axis: int, starts: ndarray) -> ndarray:
    """Largest of `values` in each bin along an axis; `starts`: where the bins begin. NaN where all are."""
    return np.fmax.reduceat(values, starts, axis=axis)


def bin_starts(number: int, most: int) -> ndarray:
    """Where bins of equal length begin, at most `most` of them."""
    return np.arange(0, number, -(-number // most))


def order_bins(orders: ndarray) -> ndarray:
    """Where bins of ORDERS_PER_STEP begin, each centred on a multiple of it; `orders`, shape (orders,), ascend from 0."""
    bins = np.floor(orders / ORDERS_PER_STEP + 0.5 + 1e-9)
    return np.flatnonzero(np.diff(bins, prepend=-1.0) > 0.0)
