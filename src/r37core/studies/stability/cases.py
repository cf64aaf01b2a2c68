"""The study `stability`: extremes of the configuration, each with its own step and with half of it. `snakemake stability`"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from r37core.config import ConfigError, Settings, checked_scene
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from ..case import Case, changed
from ..plan import blade_name_of, integration_of_level, kept_of, level_of, material_of, model_of_level, plain_scene

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
    both = (lined, direct)
    cases = [
        Extreme(
            f"{integrator} step over limit", f"{share:g}", scene, share_of_limit=share, integrator=integrator, revolutions=20
        )
        for integrator, shares in (
            (CENTRAL_DIFFERENCE, (0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05)),
            (EXACT_MODAL, (0.1, 1.0, 3.0, 10.0, 100.0)),
        )
        for share in shares
        for scene in both
    ]
    cases += [
        Extreme("speed", f"{speed:g}", scene, speed=float(speed), revolutions=2 if speed <= 10 else 60)
        for speed in (2, 10, 100, 3000, 5000)
        for scene in both
    ]
    cases += [
        Extreme(what, f"{value:g}", scene, {path: value})
        for what, path, values in (
            ("clearance", _CLEARANCE, (0.0, 1e-9, 1e-2)),
            ("lobes", "casing.lobes", (1, 5, 20)),
            ("ovalisation in clearances", "casing.amplitude_clearances", (0.0, 10.0)),
            ("damping ratio", "damping_ratio", (0.0, 0.1, 0.999, 1.0)),
        )
        for value in values
        for scene in both
    ]
    cases += [
        Extreme("friction " + direction, f"{value:g}", scene, {"friction.coefficient": value, "friction.direction": direction})
        for direction in ("against_rotation", "along_rotation")
        for value in (0.0, 0.5, 1.0)
        for scene in both
    ]
    cases += [
        Extreme(what, f"{value:g}", lined, {path: value})
        for what, path, values in (
            ("lining thickness", "lining.thickness_m", (1e-6, 1e-4, 5e-2)),
            ("elastic modulus", "lining.elastic_modulus_pa", (1e4, 1e6, 1e8, 1e10, 1e12)),
            ("plastic modulus", "lining.plastic_modulus_pa", (0.0, 1e4, 1e12)),
            ("yield stress", "lining.yield_stress_pa", (0.0, 1e6, 1e9)),
            ("bars", "lining.bars", (10, 100, 100000, 1000000)),
        )
        for value in values
    ]
    cases += [
        Extreme(what, f"{value:g}", scene, model={key: value}, share_of_limit=0.4, integrator=CENTRAL_DIFFERENCE)
        for what, key, values in (
            ("boundary nodes", "boundary_nodes", (1, 2, 20, 40)),
            ("fixed-interface modes", "fixed_interface_modes", (0, 60, 200)),
            ("mesh nodes", "nodes", (500, 1000, 60000)),
        )
        for value in values
        for scene in both
    ]
    cases += [Extreme("revolutions", str(number), scene, revolutions=number) for number in (1, 2, 5000) for scene in both]
    return cases


def cases(settings: Settings) -> dict[str, Case]:
    """Each extreme at three neighbouring speeds, and the same with half the step that it takes."""
    by_name: dict[str, Case] = {}
    for extreme in _extremes(settings):
        case = _case(settings, extreme)
        by_name |= {extreme.name: case, f"{extreme.name}{HALF}": replace(case, half_step=True)}
    return by_name


def _extremes(settings: Settings) -> list[Extreme]:
    section = settings.studies.stability
    return extremes(section.lined_scene, section.direct_scene)


def _case(settings: Settings, extreme: Extreme) -> Case:
    section, entry = settings.studies.stability, plain_scene(settings, extreme.scene)
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


def inputs(settings: Settings) -> dict[str, Any]:
    """Nothing else."""
    return {}


def outputs(settings: Settings) -> dict[str, str]:
    """The table."""
    return {"table": "<results>/studies/stability.md"}


def values(settings: Settings) -> dict[str, Any]:
    """What each extreme is."""
    return {case.name: {"what": case.what, "value": case.value, "scene": case.scene} for case in _extremes(settings)}
