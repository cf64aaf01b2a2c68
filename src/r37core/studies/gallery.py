"""Our counterpart of every result figure of the paper, from the datasets of a sweep, and what agrees under each."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr

from r37core.dataset_file import about
from r37core.published import BLADES, DIRECT_PEAK, INTERACTIONS, MESH_NODES, QUIET, REFERENCE, Interaction
from r37core.results.measures import first_contact, strongest_lobes, strongest_order
from r37core.time_integration.status import RunStatus

from . import measures as read
from .check import Check, number
from .reading_places import DIRECT
from .readings import Bench
from .validation import Runs, reading_checks, structure_checks, survey_checks

FINE, COARSE = 248, 62
"""Instants of a revolution at which the paper recovers stress: for a picture of it, and for its largest value."""

_WINDOW = (0.99, 1.06)
_ABOVE_THE_CASING = 2.5
_LISTED = 4


@dataclass(frozen=True)
class Item:
    """One figure of the gallery: its `name` in captions and file names, its title, and the checks that belong to it."""

    name: str
    title: str
    checks: tuple[str, ...]


ITEMS = (
    Item("campbell", "Campbell diagram", (r"^Ref 1B/\d: Campbell$",)),
    Item("modes", "First three mode shapes", (r"^Ref: 1B at rest",)),
    Item("mesh", "Mesh and submesh of stress", (r"^mesh", r"^area of the profile", r"^volume")),
    Item(
        "reference",
        "Response of the reference blade",
        (r"^Ref 1B/\d: (peak|drop)", r"^direct: ", r"^Ref (lined|direct), 750", r"^Ref lined: response of the torsion"),
    ),
    Item("spectrum_lined", "Spectral map with lining", (r"^Ref 1B/\d: engine order",)),
    Item("spectrum_direct", "Spectral map in direct contact", (r"^direct, engine order",)),
    Item("revolution", "Stress within a revolution, at 248 and 62 instants", (r"^largest stress of the last revolution",)),
    Item(
        "histories",
        "Stress of every revolution",
        (r"^Ref lined at .*first yield", r"^direct at .*first yield", r"below yield", r"^at \d+: ", r"first contact$"),
    ),
    Item("stress", "Stress over speed", (r"^Ref 1B/4: width above yield", r"^direct: largest rms")),
    Item(
        "wear_content",
        "Wear and its spatial content",
        (r"^Ref 1B/\d: lobes", r"^Ref lined: worn through", r"^Ref lined: deepest wear"),
    ),
    Item("variants", "Shapes of the variants", (r"^(?!Ref)\w+ 1B/4: Campbell$",)),
    Item("variants_spectra", "Spectral maps of the variants, with lining", (r"^(?!Ref)\w+ 1B/4: (engine order|lobes)",)),
    Item(
        "variants_response",
        "Response of the variants",
        (r"^(?!Ref)\w+ 1B/4: (peak|drop)", r"at its peak: ", r"^CS100 has more", r"^stress at the peak"),
    ),
    Item("clearances", "Dynamic clearances", (r"dynamic clearance",)),
    Item(
        "peak_histories",
        "Stress of every revolution at the peaks",
        (r"earliest first yield", r"latest first yield", r"first yield at our"),
    ),
    Item("widths", "Widths above yield", (r"width above yield", r"^CS100 has a wider")),
)


def run_of(datasets: Mapping[str, xr.Dataset], blade: str, scene: str) -> xr.Dataset:
    """One blade and scene of a sweep's datasets as a run of the studies, over the speeds that were run.

    `datasets` has rms and, as far as they are wanted, stress and wear.
    """
    rms = datasets["rms"].sel(blade=blade, scene=scene)
    rms = rms.isel(speed=np.flatnonzero(rms["status"].values != RunStatus.NOT_RUN))
    run = xr.Dataset(coords={"speed": rms["speed"]})
    for direction in ("normal", "radial", "tangential"):
        run[f"rms_{direction}"] = rms[f"rms_{direction}"].sel(tip_point="leading_edge", drop=True)
    run["casing_hits"], run["status"] = rms["casing_hits"], rms["status"]
    run["first_contact"] = "speed", first_contact(rms)
    if "stress" in datasets:
        run["max_von_mises"] = datasets["stress"]["max_von_mises"].sel(blade=blade, scene=scene, speed=rms["speed"])
    if "wear" in datasets and scene in datasets["wear"]["scene"].values:
        wear = datasets["wear"].sel(blade=blade, scene=scene, speed=rms["speed"])
        run["max_wear"] = wear["max_wear"]
        run["lobes"] = "speed", strongest_lobes(wear)
    return run.drop_vars([name for name in run.coords if name != "speed"])


def interaction_run(run: xr.Dataset, one: Interaction) -> xr.Dataset:
    """The speeds of a run about an interaction."""
    return run.sel(speed=slice(_WINDOW[0] * one.campbell, _WINDOW[1] * one.campbell))


def history_speeds(run: xr.Dataset, blade: str, lined: bool) -> list[float]:
    """Speeds (rad/s), ascending, whose stress is wanted for every revolution: the published ones and the blade's own peak."""
    wanted = {INTERACTIONS[0].peak, DIRECT_PEAK, QUIET} if blade == REFERENCE else set()
    if lined:
        one = next(one for one in INTERACTIONS if one.blade == blade and one.engine_order == 4)
        wanted.add(float(read.peak_of(interaction_run(run, one))["speed"]))
    return sorted(wanted)


def histories(bench: Bench, datasets: Mapping[str, xr.Dataset], blade: str, scene: str, lined: bool) -> xr.Dataset:
    """Stress (Pa) of every revolution at a few speeds of a blade; of the reference with lining also one in detail."""
    speeds = history_speeds(run_of(datasets, blade, scene), blade, lined)
    coords = {"history_speed": speeds, "revolution": 1 + np.arange(bench.choice.revolutions)}
    found = xr.Dataset(coords=coords)
    stress = np.array([bench.history(speed) for speed in speeds])
    found["history"] = (("history_speed", "revolution"), stress, about("Pa", "largest stress of each revolution"))
    if lined and blade == REFERENCE:
        detail = bench.revolution(INTERACTIONS[0].peak, FINE)
        found["last_revolution"] = ("instant", detail, about("Pa", "largest stress at each instant of the last revolution"))
    return found


@dataclass(frozen=True)
class GalleryData:
    """What the gallery shows: a sweep's `datasets`, its runs about the interactions and over all speeds, the `scenes` by kind.

    `revolution`: stress (Pa) of the reference blade at FINE instants of the last revolution, shape (FINE,).
    """

    datasets: Mapping[str, xr.Dataset]
    shipped: Runs
    survey: Runs
    revolution: np.ndarray
    scenes: Mapping[str, str]
    yield_stress: float

    @classmethod
    def of(
        cls,
        datasets: Mapping[str, xr.Dataset],
        histories: Mapping[tuple[str, str], xr.Dataset],
        scenes: Mapping[str, str],
        yield_stress: float,
    ) -> GalleryData:
        """From the datasets of a sweep and the histories by blade and kind of scene."""
        shipped, survey = gallery_runs(datasets, histories, scenes)
        detail = histories[REFERENCE, "lined"]["last_revolution"].values
        return cls(datasets, shipped, survey, detail, scenes, yield_stress)


def gallery_runs(
    datasets: Mapping[str, xr.Dataset], histories: Mapping[tuple[str, str], xr.Dataset], scenes: Mapping[str, str]
) -> tuple[Runs, Runs]:
    """Runs of the sweep by the names of the studies' places: about the interactions, and over the whole range.

    `scenes`: the scene's name of `lined` and `direct`; `histories` by blade and kind of scene.
    """
    whole = {blade: run_of(datasets, blade, scenes["lined"]) for blade in BLADES}
    direct = run_of(datasets, REFERENCE, scenes["direct"])
    shipped = {one.name: interaction_run(whole[one.blade], one) for one in INTERACTIONS}
    for blade in BLADES:
        shipped[f"{blade}_4"] = shipped[f"{blade}_4"].assign(history=histories[blade, "lined"]["history"])
    shipped[DIRECT] = direct.assign(history=histories[REFERENCE, "direct"]["history"])
    return shipped, {"Ref_lined": whole[REFERENCE], "Ref_direct": direct, "CS100_lined": whole["CS100"]}


def gallery_checks(data: GalleryData, geometry: xr.Dataset, nodes: int) -> list[Check]:
    """All checks: those of the study `readings`, and a few that only pictures need. `nodes` of the reference blade's mesh."""
    datasets, shipped, scenes = data.datasets, data.shipped, data.scenes
    campbells = {blade: datasets["campbell"].sel(blade=blade) for blade in BLADES}
    checks = structure_checks(geometry, campbells) + reading_checks(shipped, data.yield_stress)
    checks += survey_checks(data.survey, shipped, data.yield_stress)
    rest = float(campbells[REFERENCE]["frequency"].sel(mode="1B", speed=0.0))
    checks.append(Check("Ref: 1B at rest, through the published crossings", _at_rest(), rest, "Hz"))
    checks.append(Check("mesh: nodes", float(MESH_NODES), float(nodes), "", 0.05))
    loss = 1.0 - data.revolution[:: FINE // COARSE].max() / data.revolution.max()
    text = f"{100 * loss:.2g}% below that of {FINE}"
    checks.append(Check(f"largest stress of the last revolution from {COARSE} instants", None, text))
    for one in INTERACTIONS:
        order = _strongest_order(datasets["spectrum"], one.blade, scenes["lined"], shipped[one.name])
        name = f"{one.blade} 1B/{one.engine_order}: engine order of the largest amplitude at the peak"
        checks.append(Check(name, float(one.engine_order), order, "", 0.01))
    order = _strongest_order(datasets["spectrum"], REFERENCE, scenes["direct"], shipped[DIRECT])
    checks.append(Check("direct, engine order of the largest amplitude at the largest rms", None, order))
    return checks


def _at_rest() -> float:
    """Frequency (Hz) of the reference blade's 1B at rest: f^2 = f0^2 + s speed^2 through its published Campbell speeds."""
    crossings = [one for one in INTERACTIONS if one.blade == REFERENCE]
    speed = np.array([one.campbell for one in crossings])
    frequency = np.array([one.engine_order for one in crossings]) * speed / (2.0 * np.pi)
    _, square = np.polyfit(speed**2, frequency**2, 1)
    return float(np.sqrt(square))


def _strongest_order(spectrum: xr.Dataset, blade: str, scene: str, run: xr.Dataset) -> float:
    """Engine order of the largest normal amplitude at the peak, of all above the casing's own: it has two lobes."""
    speed = float(read.peak_of(run)["speed"])
    return strongest_order(spectrum["amplitude"].sel(blade=blade, scene=scene, speed=speed), above=_ABOVE_THE_CASING)


def of_item(item: Item, checks: Iterable[Check]) -> list[Check]:
    """The checks that belong to a figure."""
    return [check for check in checks if any(re.search(pattern, check.name) for pattern in item.checks)]


def verdict(checks: Sequence[Check]) -> str:
    """One line: what agrees with the published values, what does not, and what is ours alone."""
    scored = [check for check in checks if check.published is not None]
    met, missed = [check for check in scored if check.met], [check for check in scored if not check.met]
    parts = []
    if met:
        parts.append(f"**Agrees** ({len(met)} of {len(scored)}): " + (_listed(met) if len(met) <= _LISTED else _summed(met)))
    if missed:
        parts.append("**Does not agree**: " + _listed(missed))
    alone = [f"{check.name} {check.shown}{_unit(check)}" for check in checks if check.published is None]
    if alone:
        parts.append("Ours alone: " + "; ".join(alone))
    return ". ".join(parts) + "."


def _listed(checks: Sequence[Check]) -> str:
    return "; ".join(_one(check) for check in checks)


def _one(check: Check) -> str:
    if isinstance(check.published, str):
        return check.name + (f" ({check.detail})" if check.detail else "")
    return f"{check.name} {check.shown}{_unit(check)} (published {number(check.published)})"


def _summed(checks: Sequence[Check]) -> str:
    """Many that are met: the one with the largest error, and how many statements."""
    numbers = [check for check in checks if not isinstance(check.published, str)]
    told = len(checks) - len(numbers)
    parts = []
    if numbers:
        worst = max(numbers, key=lambda check: check.error)
        parts.append(f"{len(numbers)} numbers, the largest difference {100 * worst.error:.2g}%, {_one(worst)}")
    if told:
        parts.append(f"{told} statement{'s' if told > 1 else ''}")
    return " and ".join(parts)


def _unit(check: Check) -> str:
    return f" {check.unit}" if check.unit else ""
