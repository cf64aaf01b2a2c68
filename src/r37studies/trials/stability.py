"""The preset stability: extremes, each at three speeds with its own step and with half of it."""

from dataclasses import replace
from typing import Any

from r37core.config import Settings
from r37core.config.section import ExtensionSection, Section, option
from r37core.plans.extent import Extent
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .base_case import CLEARANCE, LOBES, SPEEDS, BaseCase, Varied, extension, some_of
from .case import HALF_STEP, Case

_CENTRAL_DIFFERENCE = {"choice.integrator": CENTRAL_DIFFERENCE}
_OF_MODEL = {"case.share_of_limit": 0.4, **_CENTRAL_DIFFERENCE}

EXTREMES: Varied = {
    "central_difference_step_over_limit": {
        "case.share_of_limit": (0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05),
        "choice.revolutions": 20,
        **_CENTRAL_DIFFERENCE,
    },
    "exact_modal_step_over_limit": {
        "case.share_of_limit": (0.1, 1.0, 3.0, 10.0, 100.0),
        "choice.revolutions": 20,
        "choice.integrator": EXACT_MODAL,
    },
    "low_speed_over_crossing": {SPEEDS: (0.001, 0.005), "choice.revolutions": 2},
    "speed_over_crossing": {SPEEDS: (0.05, 2.0, 3.0)},
    "clearance": {f"scene.{CLEARANCE}": (0.0, 1e-9, 1e-2)},
    "lobes": {"scene.casing.lobes": (1, 5, 20)},
    "ovalisation_in_clearances": {f"scene.{LOBES}": (0.0, 10.0)},
    "damping_ratio": {"scene.damping_ratio": (0.0, 0.1, 0.999, 1.0)},
    "friction": {"scene.friction.coefficient": (0.0, 0.5, 1.0)},
    "lining_thickness": {"scene.lining.thickness_m": (1e-6, 1e-4, 5e-2)},
    "elastic_modulus": {"scene.lining.elastic_modulus_pa": (1e4, 1e6, 1e8, 1e10, 1e12)},
    "plastic_modulus": {"scene.lining.plastic_modulus_pa": (0.0, 1e4, 1e12)},
    "yield_stress": {"scene.lining.yield_stress_pa": (0.0, 1e6, 1e9)},
    "bars": {"scene.lining.bars": (10, 100, 100000, 1000000)},
    "boundary_nodes": {"model.boundary_nodes": (1, 2, 20, 40), **_OF_MODEL},
    "fixed_interface_modes": {"model.fixed_interface_modes": (0, 60, 200), **_OF_MODEL},
    "mesh_nodes": {"model.nodes": (500, 1000, 60000), **_OF_MODEL},
    "revolutions": {"choice.revolutions": (1, 2, 5000)},
}
"""Name -> its values."""


class StabilitySection(Section):
    """Runs at extremes of the parameters (snakemake stability)."""

    extremes: some_of(EXTREMES) = option(  # type: ignore[valid-type]
        "Extremes, such as lobes, bars or mesh_nodes", "all"
    )


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())


TABLE = "r37studies.trials.case_table.table"


def cases(settings: Settings) -> dict[str, Case | str]:
    """Each extreme of this run, and the same with half the step that it takes, in each scene that has what it changes."""
    # above the crossing, as contact stiffens the blade
    common = {SPEEDS: 1.02, "choice.revolutions": 60}
    planned = BaseCase(settings).cases(EXTREMES, settings.section(SECTION).extremes, ["energy"], common)
    return planned | {
        f"{name}{HALF_STEP}": case if isinstance(case, str) else replace(case, half_step=True) for name, case in planned.items()
    }


def values(settings: Settings, extent: Extent) -> dict[str, Any]:
    """The case with half the step, which each extreme is compared with."""
    names = settings.made(cases)
    return {"compared": {name: [f"{name}{HALF_STEP}"] for name in names if not name.endswith(HALF_STEP)}}


EXTENSION = extension(SECTION, "r37studies.trials.case_table.closing_of_stability")
