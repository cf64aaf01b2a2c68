"""Speeds about what the paper publishes, and the runs of the product that have them. Light: rules import it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, floor
from typing import Any

from published import BLADES, DIRECT_PEAK, INTERACTIONS, QUIET, REFERENCE, PublishedInteraction

LINED, DIRECT = "abradable", "direct"
"""The benchmark's scenes."""

BARE = "Ref_direct"
"""Name of the window of direct contact. Those with lining have the names of the interactions, as `Ref_4`."""

FINE = 0.05
"""How far the fine windows reach above the published Campbell speed, as a share of it."""

ELSEWHERE = (850.0, 1000.0, 1100.0, 1200.0, 1300.0, 1400.0, 1500.0, 1600.0, 1717.0, 1800.0, 1900.0)
"""Speeds (rad/s) of direct contact outside its window."""

CHOICES = {
    "perturbed": "friction 0.1% larger",
    "radial": "radial normal: a cylindrical casing",
    "form": "the other form of friction: vector on the lining, constant on the bare casing",
    "bars_0_8mm": "bars 0.8 mm wide",
    "bars_1_25mm": "bars 1.25 mm wide",
    "bars_2mm": "bars 2 mm wide",
    "camber": "nodes on the camber line",
    "suction": "nodes on the suction edge",
    "exact": "exact gap",
    "yield_mpa": "yield stress of the lining in MPa",
}
"""Choices that validation/scenes.yaml varies, by the end of the scenes' names, in words."""

INSIDE = {"inside": "corners not among the nodes"}
"""The choice that is a run of its own."""

TIP_LINES = {"camber": "camber", "suction": "suction_edge"}
"""Lines of the tip that choices have their nodes on."""

OF_LINING = ("bars_0_8mm", "bars_1_25mm", "bars_2mm", "yield_mpa")
"""Choices that say nothing about direct contact."""

MEMBERS = 8
"""Of the tolerances."""

TOLERANCES = {
    "friction.coefficient": {"uniform_percent": 5},
    "lining.elastic_modulus_pa": {"uniform_percent": 5},
    "lining.plastic_modulus_pa": {"uniform_percent": 5},
    "lining.bar_width_m": {"between": [8.0e-4, 1.25e-3]},
    "casing.clearance_m": {"uniform_percent": 2},
}
"""Tolerances of the scenes' numbers. They are ours and were set before any run; the paper gives none."""


def grid(centre: float, below: float, above: float, step: float) -> list[float]:
    """Multiples of `step` (rad/s) about `centre`, from `below` to `above` it."""
    first, last = ceil(below / step - 1e-9), floor(above / step + 1e-9)
    return [centre + number * step for number in range(first, last + 1)]


def fine(row: PublishedInteraction) -> list[float]:
    """Every 2 rad/s from the published Campbell speed to 5% above it."""
    return grid(row.campbell, 0.0, FINE * row.campbell, 2.0)


def every(row: PublishedInteraction) -> list[float]:
    """Every 1 rad/s from 1% below the published Campbell speed to 6% above it."""
    return grid(row.campbell, -0.01 * row.campbell, 0.06 * row.campbell, 1.0)


def wide(row: PublishedInteraction) -> list[float]:
    """Every 6 rad/s from the published Campbell speed to 6% above it: a peak moves by 2% under tolerances."""
    return grid(row.campbell, 0.0, 0.06 * row.campbell, 6.0)


def narrow(row: PublishedInteraction) -> list[float]:
    """Every 4 rad/s about the published peak."""
    return grid(row.peak, -0.012 * row.peak, 0.016 * row.peak, 4.0)


def direct_speeds(step: float) -> list[float]:
    """About direct contact's published peak, and some elsewhere."""
    more = {DIRECT_PEAK + 1.0} if step < 4.0 else set()
    return sorted({*ELSEWHERE, *more, *grid(DIRECT_PEAK, -20.0, 28.0, step)})


def speeds(of: Callable[[PublishedInteraction], list[float]], direct: list[str], step: float) -> dict[str, Any]:
    """Keys of a run: speeds about the interactions of each blade; `step` (rad/s) of the scenes `direct` about their peak."""
    by_blade = {blade: sorted({speed for row in INTERACTIONS if row.blade == blade for speed in of(row)}) for blade in BLADES}
    return {
        "speeds": sorted({*by_blade.pop(REFERENCE), QUIET}),
        "speeds_for": [
            {"scenes": direct, "speeds": direct_speeds(step)},
            *({"blades": [blade], "speeds": several} for blade, several in by_blade.items()),
        ],
    }


def responses(folder: str, lined: str = LINED, direct: str | None = DIRECT, file: str = "response.nc") -> list[str]:
    """Files of all blades with lining and, with `direct`, of the reference blade without, in the folder of a run."""
    files = [f"{folder}/{blade}/{lined}/{file}" for blade in BLADES]
    return files + ([f"{folder}/{REFERENCE}/{direct}/{file}"] if direct else [])


@dataclass(frozen=True)
class Source:
    """Runs that checks are made of: files of responses and of the models behind them, the windows, the step about 1344 rad/s.

    `level`: of fidelity.yaml. `peaks`: whether the stress of every revolution is wanted at each blade's own peak, too.
    `group`: of the responses in their files.
    """

    responses: list[str]
    models: list[str]
    windows: Callable[[PublishedInteraction], list[float]]
    step: float
    level: str = "standard"
    peaks: bool = False
    group: str | None = None

    @property
    def files(self) -> list[str]:
        """All of its files."""
        return [*self.responses, *self.models]


def source(name: str) -> Source:
    """The runs with this name: `paper`, `standard`, `choice_NAME` of CHOICES or `inside`, `member_NUMBER`."""
    kind, _, of = name.partition("_")
    if kind in ("paper", "standard"):
        folder = f"results/runs/{'paper' if kind == 'paper' else 'campaign'}"
        window, step = (fine, 2.0) if kind == "paper" else (every, 1.0)
        return Source(responses(folder), [_model(folder, blade) for blade in BLADES], window, step, kind, True)
    if kind == "member":
        folder = "results/runs/ranges"
        members = responses(f"{folder}/tolerances", file="members.nc")
        return Source(members, [_model(folder, REFERENCE)], wide, 4.0, group=f"{of}/response")
    if of == "inside":
        folder = "results/runs/inside"
        return Source(responses(folder), [_model(folder, REFERENCE)], narrow, 4.0)
    folder = "results/runs/choices"
    files = responses(folder, f"{LINED}_{of}", None if of in OF_LINING else f"{DIRECT}_{of}")
    return Source(files, [_model(folder, REFERENCE, TIP_LINES.get(of, "pressure_edge"))], narrow, 4.0)


def _model(folder: str, blade: str, tip_line: str = "pressure_edge") -> str:
    return f"{folder}/{blade}/rom_{tip_line}.nc"


def histories_of(name: str) -> str:
    """File with the stress of every revolution of a source."""
    return f"results/validation/histories_{name}.npz"


ALL_CHOICES = [f"choice_{name}" for name in (*CHOICES, *INSIDE)]
ALL_MEMBERS = [f"member_{number}" for number in range(MEMBERS)]
"""Names of sources."""

CHARTS = (
    "campbell",
    "reference",
    "spectrum_lined",
    "spectrum_direct",
    "revolution",
    "histories",
    "stress",
    "wear_content",
    "widths",
)
"""Pictures of docs/gallery.md that are drawn, not rendered."""
