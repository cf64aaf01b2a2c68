"""The preset stability: extremes, each at three speeds with its own step and with half of it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Annotated, Any

from pydantic import AfterValidator, Field

from r37core.config import Settings
from r37core.config.section import AllOrNames, ExtensionSection, refused
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair
from r37core.plans.paths import Wildcards
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .base_case import CLEARANCE, LOBES, BaseCase, Changes, TrialsSection, put
from .case import HALF_STEP, Case


def _near(share: float) -> tuple[float, ...]:
    """Three neighbouring speeds, as shares of the crossing's."""
    return tuple(share * near for near in (0.997, 1.0, 1.003))


def _step(integrator: str) -> Changes:
    return put("case", "share_of_limit", {"choice": {"integrator": integrator, "revolutions": 20}})


def _model(field: str) -> Changes:
    return put("model", field, {"case": {"share_of_limit": 0.4}, "choice": {"integrator": CENTRAL_DIFFERENCE}})


EXTREMES: Mapping[str, tuple[Sequence[float], Changes]] = {
    "central_difference_step_over_limit": ((0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05), _step(CENTRAL_DIFFERENCE)),
    "exact_modal_step_over_limit": ((0.1, 1.0, 3.0, 10.0, 100.0), _step(EXACT_MODAL)),
    "low_speed_over_crossing": ((0.001, 0.005), lambda share: {"case": {"speeds": _near(share)}, "choice": {"revolutions": 2}}),
    "speed_over_crossing": ((0.05, 2.0, 3.0), lambda share: {"case": {"speeds": _near(share)}}),
    "clearance": ((0.0, 1e-9, 1e-2), put("scene", CLEARANCE)),
    "lobes": ((1, 5, 20), put("scene", "casing.lobes")),
    "ovalisation_in_clearances": ((0.0, 10.0), put("scene", LOBES)),
    "damping_ratio": ((0.0, 0.1, 0.999, 1.0), put("scene", "damping_ratio")),
    "friction": ((0.0, 0.5, 1.0), put("scene", "friction.coefficient")),
    "lining_thickness": ((1e-6, 1e-4, 5e-2), put("scene", "lining.thickness_m")),
    "elastic_modulus": ((1e4, 1e6, 1e8, 1e10, 1e12), put("scene", "lining.elastic_modulus_pa")),
    "plastic_modulus": ((0.0, 1e4, 1e12), put("scene", "lining.plastic_modulus_pa")),
    "yield_stress": ((0.0, 1e6, 1e9), put("scene", "lining.yield_stress_pa")),
    "bars": ((10, 100, 100000, 1000000), put("scene", "lining.bars")),
    "boundary_nodes": ((1, 2, 20, 40), _model("boundary_nodes")),
    "fixed_interface_modes": ((0, 60, 200), _model("fixed_interface_modes")),
    "mesh_nodes": ((500, 1000, 60000), _model("nodes")),
    "revolutions": ((1, 2, 5000), put("choice", "revolutions")),
}
"""Name -> its values, and what they change."""


def _known(names: list[str] | str) -> list[str] | str:
    for number, name in enumerate([] if names == "all" else names):
        if name not in EXTREMES:
            raise refused((number,), f"'{name}'", f"all, or some of {', '.join(EXTREMES)}")
    return names


class StabilitySection(TrialsSection):
    """Runs at extremes of the parameters (snakemake stability)."""

    extremes: Annotated[AllOrNames, AfterValidator(_known)] = Field(
        default="all", description="Extremes, such as lobes, bars or mesh_nodes"
    )


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())


def cases(settings: Settings) -> dict[str, Case | str]:
    """Each extreme of this run, and the same with half the step that it takes, in each scene that has what it changes."""
    base, chosen = BaseCase(settings, SECTION), settings.section(SECTION).extremes
    planned: dict[str, Case | str] = {}
    for what in EXTREMES if chosen == "all" else chosen:
        values, changes_by = EXTREMES[what]
        for value, scene in product(values, base.scenes):
            changes = changes_by(value)
            if base.has(scene, changes):
                changes["choice"] = {"revolutions": 60, **changes.get("choice", {})}
                # above the crossing, as contact stiffens the blade
                case = base.case(scene, _near(1.02), ["energy"], changes)
                planned[name := f"{what}_{value:g}__{scene}"] = case
                if isinstance(case, Case):
                    planned[f"{name}{HALF_STEP}"] = replace(case, half_step=True)
    return planned


def values(settings: Settings, members: Mapping[Pair, int]) -> dict[str, Any]:
    """Nothing but the responses."""
    return {}


TABLES = {"table": "<results>/stability.csv"}


def _once(sweep: Sweep) -> Wildcards:
    return [{}] if BaseCase(sweep.settings, SECTION).scenes else []


EXTENSION = Extension(
    name="stability",
    section=SECTION,
    checks=(lambda settings: BaseCase(settings, SECTION).check_names(),),
    targets=lambda sweep: {TABLES["table"]: _once(sweep)},
    figures=(
        Figure(
            rule="stability_figure",
            name="stability",
            runs=_once,
            draw="r37studies.trials.figures.draw_stability",
            files=TABLES,
            label="extremes",
            caption="Extremes of the configuration, each run with its own time step and with half of it. Accurate: both have "
            "the same mean rms within 5%. Degraded: they have not. Diverged: the status of the run reports it. Refused: not "
            "run. Unsound: a wrong number that no status reports.",
        ),
    ),
    closing="r37studies.trials.stability_tables.closing",
    made_on_request=True,
)
