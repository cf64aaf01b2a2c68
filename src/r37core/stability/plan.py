"""The study `stability`: extremes of the configuration, each with its own step and with half of it. `snakemake stability`"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from r37core.config import ConfigError, Settings, checked_scene, plain
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from ..case import Case, changed
from ..plan import blade_name_of, integration_of_level, kept_of, level_of, material_of, model_of_level, scene_entry_of

HALF = "__half_step"
"""End of the name of an extreme's second case."""

_CLEARANCE = "casing.clearance_m"

_NEIGHBOURS = (0.997, 1.0, 1.003)
"""Speeds that are run, as shares of an extreme's."""


@dataclass(frozen=True)
class Extreme:
    """One case. `changes`: dotted path in the scene's entry of scenes.yaml -> value; the rest: of integration and model.

    `share_of_limit`: time step as a share of the blade's stability limit under central differences, and `integrator`, in place
    of the level's; `model`: fields of ModelChoice.
    """

    what: str
    value: str
    scene: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    speed: float = 1344.0
    revolutions: int = 60
    share_of_limit: float | None = None
    integrator: str | None = None
    model: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name in file names."""
        return f"{self.what}_{self.value}_{self.scene}".replace(" ", "_")


def extremes(lined: str, direct: str) -> list[Extreme]:
    """All cases; `lined` and `direct`: names of a scene with a lining and of one without."""

    def several(what: str, values: Sequence[float], fields: Callable[[Any], dict[str, Any]], *scenes: str) -> list[Extreme]:
        """One of each value in each scene, by default in both; `fields` of Extreme from the value."""
        return [Extreme(what, f"{value:g}", scene, **fields(value)) for value in values for scene in scenes or (lined, direct)]

    def step(integrator: str) -> Callable[[float], dict[str, Any]]:
        return lambda share: {"share_of_limit": share, "integrator": integrator, "revolutions": 20}

    def friction(direction: str) -> Callable[[float], dict[str, Any]]:
        return lambda value: {"changes": {"friction.coefficient": value, "friction.direction": direction}}

    def entry(path: str) -> Callable[[float], dict[str, Any]]:
        return lambda value: {"changes": {path: value}}

    def model(key: str) -> Callable[[int], dict[str, Any]]:
        return lambda value: {"model": {key: value}, "share_of_limit": 0.4, "integrator": CENTRAL_DIFFERENCE}

    return [
        *several(f"{CENTRAL_DIFFERENCE} step over limit", (0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05), step(CENTRAL_DIFFERENCE)),
        *several(f"{EXACT_MODAL} step over limit", (0.1, 1.0, 3.0, 10.0, 100.0), step(EXACT_MODAL)),
        *several("speed", (2.0, 10.0), lambda speed: {"speed": speed, "revolutions": 2}),
        *several("speed", (100.0, 3000.0, 5000.0), lambda speed: {"speed": speed}),
        *several("clearance", (0.0, 1e-9, 1e-2), entry(_CLEARANCE)),
        *several("lobes", (1, 5, 20), entry("casing.lobes")),
        *several("ovalisation in clearances", (0.0, 10.0), entry("casing.amplitude_clearances")),
        *several("damping ratio", (0.0, 0.1, 0.999, 1.0), entry("damping_ratio")),
        *several("friction against_rotation", (0.0, 0.5, 1.0), friction("against_rotation")),
        *several("friction along_rotation", (0.0, 0.5, 1.0), friction("along_rotation")),
        *several("lining thickness", (1e-6, 1e-4, 5e-2), entry("lining.thickness_m"), lined),
        *several("elastic modulus", (1e4, 1e6, 1e8, 1e10, 1e12), entry("lining.elastic_modulus_pa"), lined),
        *several("plastic modulus", (0.0, 1e4, 1e12), entry("lining.plastic_modulus_pa"), lined),
        *several("yield stress", (0.0, 1e6, 1e9), entry("lining.yield_stress_pa"), lined),
        *several("bars", (10, 100, 100000, 1000000), entry("lining.bars"), lined),
        *several("boundary nodes", (1, 2, 20, 40), model("boundary_nodes")),
        *several("fixed-interface modes", (0, 60, 200), model("fixed_interface_modes")),
        *several("mesh nodes", (500, 1000, 60000), model("nodes")),
        *several("revolutions", (1, 2, 5000), lambda number: {"revolutions": number}),
    ]


def cases(settings: Settings) -> dict[str, Case]:
    """Each extreme at three neighbouring speeds, and the same with half the step that it takes."""
    planned: dict[str, Case] = {}
    for extreme in _extremes(settings):
        case = _case(settings, extreme)
        planned |= {extreme.name: case, f"{extreme.name}{HALF}": replace(case, half_step=True)}
    return planned


def _extremes(settings: Settings) -> list[Extreme]:
    section = settings.studies.stability
    return extremes(section.lined_scene, section.direct_scene)


def _case(settings: Settings, extreme: Extreme) -> Case:
    section, entry = settings.studies.stability, plain(scene_entry_of(settings, extreme.scene))
    blade = blade_name_of(settings, section)
    scene, refused = None, ""
    try:
        scene = checked_scene(changed(entry, _of_scene(entry, extreme.changes)))
    except ConfigError as error:
        refused = str(error)
    choice = replace(integration_of_level(settings, section.base, scene), revolutions=extreme.revolutions)
    return Case(
        blade,
        replace(model_of_level(settings, section.base), **extreme.model),
        scene,
        choice if extreme.integrator is None else replace(choice, integrator=extreme.integrator),
        speeds=tuple(extreme.speed * share for share in _NEIGHBOURS),
        results=("energy",),
        material=material_of(settings, blade),
        kept=kept_of(level_of(settings, section.base)),
        share_of_limit=extreme.share_of_limit,
        refused=refused,
    )


def _of_scene(entry: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The changes, of the cold clearance in a scene that has one."""
    cold = "casing.clearance.cold_m" if "clearance" in entry["casing"] else _CLEARANCE
    return {cold if path == _CLEARANCE else path: value for path, value in changes.items()}


def values(settings: Settings) -> dict[str, Any]:
    """What each extreme is."""
    return {case.name: {"what": case.what, "value": case.value, "scene": case.scene} for case in _extremes(settings)}
