"""stability of config.yaml, and the plan of the extremes: each with its own step and with half of it, at three speeds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from pydantic import Field

from r37core.base.varied_number import with_value
from r37core.cases.case import Case, Crossing
from r37core.cases.plan import CasesSection, carries_coriolis, integration_of_level, kept_of, model_of_level, names_are_known
from r37core.config import ConfigError, Settings, checked_scene, plain
from r37core.config.section import AllOrNames, ExtensionSection
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

HALF = "__half_step"
"""End of the name of an extreme's second case."""


class StabilitySection(CasesSection):
    """Runs at extremes of the parameters (snakemake stability)."""

    extremes: AllOrNames = Field(default="all", description="Extremes, such as lobes, bars or mesh_nodes")


SECTION = ExtensionSection("stability", StabilitySection, StabilitySection())


@dataclass(frozen=True)
class Extreme:
    """One case. `changes`: dotted path in the scene's entry of scenes.yaml -> value; the rest: of integration and model.

    `speed`: share of the Campbell speed, above 1 as contact stiffens the blade; `share_of_limit`: time step over the blade's
    stability limit under central differences, and `integrator`, in place of the level's; `model`: fields of ModelChoice.
    """

    what: str
    value: str
    scene: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    speed: float = 1.02
    revolutions: int = 60
    share_of_limit: float | None = None
    integrator: str | None = None
    model: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name in file names."""
        return f"{self.what}_{self.value}__{self.scene}"


Fields = Callable[[Any], dict[str, Any]]
"""Fields of an Extreme from its value."""


def _step(integrator: str) -> Fields:
    return lambda share: {"share_of_limit": share, "integrator": integrator, "revolutions": 20}


def _entry(path: str) -> Fields:
    return lambda value: {"changes": {path: value}}


def _model(key: str) -> Fields:
    return lambda value: {"model": {key: value}, "share_of_limit": 0.4, "integrator": CENTRAL_DIFFERENCE}


_CLEARANCE, _LOBES = "casing.clearance_m", "casing.amplitude_clearances"

EXTREMES: Mapping[str, tuple[Sequence[float], Fields]] = {
    "central_difference_step_over_limit": ((0.01, 0.1, 0.5, 0.9, 0.99, 1.0, 1.05), _step(CENTRAL_DIFFERENCE)),
    "exact_modal_step_over_limit": ((0.1, 1.0, 3.0, 10.0, 100.0), _step(EXACT_MODAL)),
    "low_speed_over_crossing": ((0.001, 0.005), lambda share: {"speed": share, "revolutions": 2}),
    "speed_over_crossing": ((0.05, 2.0, 3.0), lambda share: {"speed": share}),
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
    "revolutions": ((1, 2, 5000), lambda number: {"revolutions": number}),
}
"""Name -> its values, and what they change."""


def extremes(settings: Settings) -> list[Extreme]:
    """All extremes of this run, in each of its scenes that has what they change (a lining, friction); none without a blade."""
    section = settings.section(SECTION)
    if section.blade_of(settings) is None:
        return []
    chosen = EXTREMES if section.extremes == "all" else section.extremes
    several = (
        Extreme(what, f"{value:g}", scene, **EXTREMES[what][1](value))
        for what in chosen
        for value in EXTREMES[what][0]
        for scene in section.scenes_of(settings)
    )
    entries = {name: plain(entry) for name, entry in settings.scene_designs.entries.items()}
    return [
        extreme
        for extreme in several
        if all("." not in path or path.split(".")[0] in entries[extreme.scene] for path in extreme.changes)
    ]


def cases(settings: Settings) -> dict[str, Case]:
    """Each extreme at three neighbouring speeds, and the same with half the step that it takes."""
    planned: dict[str, Case] = {}
    for extreme in extremes(settings):
        case = _case(settings, extreme)
        planned |= {extreme.name: case, f"{extreme.name}{HALF}": replace(case, half_step=True)}
    return planned


def _case(settings: Settings, extreme: Extreme) -> Case:
    section, entry = settings.section(SECTION), plain(settings.scene_designs.entries[extreme.scene])
    blade, base = section.blade_of(settings), section.base_of(settings)
    assert blade is not None
    scene, refused = None, _refusal(settings, blade, extreme)
    try:
        scene = None if refused else checked_scene(_changed(entry, extreme.changes))
    except ConfigError as error:
        refused = str(error)
    choice = replace(integration_of_level(settings, base, scene), revolutions=extreme.revolutions)
    model = model_of_level(settings, blade, base)
    return Case(
        blade,
        model if isinstance(model, str) else replace(model, **extreme.model),
        scene,
        choice if extreme.integrator is None else replace(choice, integrator=extreme.integrator),
        speeds=tuple(extreme.speed * share for share in (0.997, 1.0, 1.003)),
        results=("energy",),
        material=settings.blades[blade].material,
        kept=kept_of(settings.levels[base]),
        crossing=Crossing("1B", section.engine_order),
        share_of_limit=extreme.share_of_limit,
        refused=refused,
    )


def _refusal(settings: Settings, blade: str, extreme: Extreme) -> str:
    """Why a blade cannot have an extreme, empty where it can."""
    if extreme.model and settings.blades[blade].is_matrices:
        return f"{blade} is given by matrices"
    if "nodes" in extreme.model and not settings.blades[blade].has_profiles:
        return f"{blade} is given by a mesh"
    choice = integration_of_level(settings, settings.section(SECTION).base_of(settings), None)
    if not carries_coriolis(settings, replace(choice, integrator=extreme.integrator or choice.integrator)):
        return f"{CENTRAL_DIFFERENCE} does not carry the Coriolis force"
    return ""


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


def values(settings: Settings) -> list[dict[str, str]]:
    """What each extreme is, with the names of its case and of that with half the step."""
    return [
        {"what": each.what, "value": each.value, "scene": each.scene, "case": each.name, "half": f"{each.name}{HALF}"}
        for each in extremes(settings)
    ]


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The table and the figure."""
    section, settings = sweep.settings.section(SECTION), sweep.settings
    made: paths.Wildcards = [{}] if section.blade_of(settings) and section.scenes_of(settings) else []
    return {"<results>/stability.csv": made, **paths.pictures("stability", made)}


def can_be_run(settings: Settings) -> None:
    """Blade, scenes, level and extremes are there."""
    section = settings.section(SECTION)
    names_are_known(settings, "stability", section)
    for number, name in enumerate([] if section.extremes == "all" else section.extremes):
        if name not in EXTREMES:
            path = ("stability", "extremes", number)
            raise settings.documents.config.refusal(path, f"'{name}'", f"all, or some of {', '.join(EXTREMES)}")
