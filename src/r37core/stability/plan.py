"""stability of config.yaml, and the plan of the extremes: each with its own step and with half of it, at three speeds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

from pydantic import Field

from r37core.base.varied_number import with_value
from r37core.cases.case import HALF_STEP, Case
from r37core.cases.plan import BaseCase, CasesSection
from r37core.config import ConfigError, Settings, checked_scene, plain
from r37core.config.section import AllOrNames, ExtensionSection
from r37core.plans.extension import Extension, Figure
from r37core.plans.paths import Wildcards
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL


class StabilitySection(CasesSection):
    """Runs at extremes of the parameters (snakemake stability)."""

    extremes: AllOrNames = Field(default="all", description="Extremes, such as lobes, bars or mesh_nodes")


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())

TABLE = "<results>/stability.csv"

Changes = Callable[[Any], tuple[dict[str, Any], dict[str, Any]]]
"""Changes to the scene's entry and to the case, from an extreme's value."""


def _step(integrator: str) -> Changes:
    return lambda share: ({}, {"share_of_limit": share, "choice.integrator": integrator, "choice.revolutions": 20})


def _entry(key: str) -> Changes:
    return lambda value: ({key: value}, {})


def _model(field: str) -> Changes:
    return lambda number: ({}, {f"model.{field}": number, "share_of_limit": 0.4, "choice.integrator": CENTRAL_DIFFERENCE})


def _near(share: float) -> tuple[float, ...]:
    """Three neighbouring speeds, as shares of the crossing's."""
    return tuple(share * near for near in (0.997, 1.0, 1.003))


_CLEARANCE, _LOBES = "casing.clearance_m", "casing.amplitude_clearances"

EXTREMES: Mapping[str, tuple[Sequence[float], Changes]] = {
    "central_difference_step_over_limit": ((0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05), _step(CENTRAL_DIFFERENCE)),
    "exact_modal_step_over_limit": ((0.1, 1.0, 3.0, 10.0, 100.0), _step(EXACT_MODAL)),
    "low_speed_over_crossing": ((0.001, 0.005), lambda share: ({}, {"speeds": _near(share), "choice.revolutions": 2})),
    "speed_over_crossing": ((0.05, 2.0, 3.0), lambda share: ({}, {"speeds": _near(share)})),
    "clearance": ((0.0, 1e-9, 1e-2), _entry(_CLEARANCE)),
    "lobes": ((1, 5, 20), _entry("casing.lobes")),
    "ovalisation_in_clearances": ((0.0, 10.0), _entry(_LOBES)),
    "damping_ratio": ((0.0, 0.1, 0.999, 1.0), _entry("damping_ratio")),
    "friction": ((0.0, 0.5, 1.0), _entry("friction.coefficient")),
    "lining_thickness": ((1e-6, 1e-4, 5e-2), _entry("lining.thickness_m")),
    "elastic_modulus": ((1e4, 1e6, 1e8, 1e10, 1e12), _entry("lining.elastic_modulus_pa")),
    "plastic_modulus": ((0.0, 1e4, 1e12), _entry("lining.plastic_modulus_pa")),
    "yield_stress": ((0.0, 1e6, 1e9), _entry("lining.yield_stress_pa")),
    "bars": ((10, 100, 100000, 1000000), _entry("lining.bars")),
    "boundary_nodes": ((1, 2, 20, 40), _model("boundary_nodes")),
    "fixed_interface_modes": ((0, 60, 200), _model("fixed_interface_modes")),
    "mesh_nodes": ((500, 1000, 60000), _model("nodes")),
    "revolutions": ((1, 2, 5000), lambda number: ({}, {"choice.revolutions": number})),
}
"""Name -> its values, and what they change."""


def cases(settings: Settings) -> dict[str, Case]:
    """Each extreme of this run at three neighbouring speeds, and the same with half the step that it takes.

    In each scene that has what it changes (a lining, friction); none without a blade.
    """
    base, chosen = BaseCase(settings, SECTION), settings.section(SECTION).extremes
    entries = {scene: plain(settings.scene_designs.entries[scene]) for scene in base.scenes}
    planned: dict[str, Case] = {}
    for what in EXTREMES if chosen == "all" else chosen:
        values, changes = EXTREMES[what]
        for value, (scene, entry) in product(values, entries.items()):
            scene_changes, case_changes = changes(value)
            if all("." not in key or key.split(".")[0] in entry for key in scene_changes):
                case, name = _case(base, _changed(entry, scene_changes), case_changes), f"{what}_{value:g}__{scene}"
                planned |= {name: case, f"{name}{HALF_STEP}": replace(case, half_step=True)}
    return planned


def _case(base: BaseCase, entry: Mapping[str, Any], changes: Mapping[str, Any]) -> Case:
    scene, refused = None, ""
    try:
        scene = checked_scene(entry)
    except ConfigError as error:
        refused = str(error)
    # above the crossing, as contact stiffens the blade
    case = base.case(scene, _near(1.02), ["energy"]).changed({"choice.revolutions": 60, **changes})
    refused = base.refusal(case, changes) or refused
    return replace(case, scene=None if refused else scene, refused=refused)


def _changed(entry: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a scene's entry with the changes; that of the clearance is of the cold one in a scene that has one.

    Lobes scale with a changed clearance: otherwise, nothing would touch at the largest.
    """
    casing = dict(entry["casing"])
    cold = "casing.clearance.cold_m" if "clearance" in casing else "casing.clearance_m"
    if "amplitude_m" in casing and {_CLEARANCE, _LOBES} & set(changes):
        clearance = casing["clearance"]["cold_m"] if "clearance" in casing else casing["clearance_m"]
        casing["amplitude_clearances"] = casing.pop("amplitude_m") / clearance
        entry = {**entry, "casing": casing}
    for path, value in changes.items():
        entry = with_value(entry, cold if path == _CLEARANCE else path, value)
    return entry


def _once(sweep: Sweep) -> Wildcards:
    return [{}] if BaseCase(sweep.settings, SECTION).scenes else []


def can_be_run(settings: Settings) -> None:
    """Blade, scenes, level and extremes are there."""
    BaseCase(settings, SECTION).check_names()
    chosen = settings.section(SECTION).extremes
    for number, name in enumerate([] if chosen == "all" else chosen):
        if name not in EXTREMES:
            path = ("stability", "extremes", number)
            raise settings.documents.config.refusal(path, f"'{name}'", f"all, or some of {', '.join(EXTREMES)}")


EXTENSION = Extension(
    name="stability",
    section=SECTION,
    checks=(can_be_run,),
    cases=cases,
    targets=lambda sweep: {TABLE: _once(sweep)},
    figures=(
        Figure(
            rule="stability_figure",
            name="stability",
            runs=_once,
            draw="stability.figures.draw_stability",
            files={"table": TABLE},
            label="extremes",
            caption="Extremes of the configuration, each run with its own time step and with half of it. Accurate: both have "
            "the same mean rms within 5%. Degraded: they have not. Diverged: the status of the run reports it. Refused: not "
            "run. Unsound: a wrong number that no status reports.",
        ),
    ),
    closing="stability.steps.closing",
    made_on_request=True,
)
