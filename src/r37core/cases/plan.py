"""The plan of the cases of an extension: keys of its section, files for its rules, and what they take from the settings."""

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import Annotated, Any

from pydantic import Field

from r37core.base.plain import to_plain
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import engine_order_is_known
from r37core.config.document import ConfigRefusals
from r37core.config.fidelity import Level
from r37core.config.section import AllOrNames, LeftOut, Name, Section, left_out
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.integrators import EXACT_MODAL

from .case import OWN_MESH, Case, ModelChoice, model_of_name

MODEL_FILE = "<results>/cases/{blade}/{model}/{file}"


class CasesSection(Section):
    """Which blade, scenes, level and speeds the cases are of."""

    blade: Name | LeftOut = left_out("Blade; by default the first one of the run")
    scenes: AllOrNames = Field(default="all", description="Scenes of the run")
    base: Name | LeftOut = left_out("Fidelity level of all that is not varied; by default that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "Crossing of 1B that the speeds lie about; by default the fastest one"
    )

    def blade_of(self, settings: Settings) -> str | None:
        """The blade whose cases are run, by default the first of the run; None where this run leaves it out."""
        name = self.blade or settings.blade_names[0]
        return name if name in settings.blade_names else None

    def scenes_of(self, settings: Settings) -> list[str]:
        """Scenes of the cases, as far as they are run."""
        return [name for name in settings.scene_names if name in scenes_named(settings, self.scenes)]

    def base_of(self, settings: Settings) -> str:
        """Level of the cases."""
        return self.base or settings.fidelity_name


class Cases:
    """Inputs and parameters of the rules for the cases of an extension, which `make` plans from the settings when asked."""

    def __init__(self, settings: Settings, extension: str, make: Callable[[Settings], Mapping[str, Case]]):
        self.file = f"<results>/{extension}/{{case}}.nc"
        self.log = f"<logs>/{extension}/{{case}}.log"
        self._made = cache(lambda: make(settings))

    def files(self, wildcards: Any) -> list[str]:
        """Responses of all cases."""
        return [paths.fill(self.file, case=name) for name in self._made()]

    def names(self, wildcards: Any) -> list[str]:
        """Names of the cases, in the order of their files."""
        return list(self._made())

    def case(self, wildcards: Any) -> dict[str, Any]:
        """A case as plain values."""
        return to_plain(self._made()[wildcards.case])

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that a case is run from; none of one that is refused."""
        case = self._made()[wildcards.case]
        if case.scene is None:
            return {}
        if isinstance(case.model, str):
            where = {"blade": case.blade, "tip_line": case.model}
            files = {"rom": paths.fill(paths.REDUCED_MODEL, **where), "contact": paths.fill(paths.CONTACT_MODEL, **where)}
        else:
            where = {"blade": case.blade, "model": case.model.name}
            names = {"rom": "rom.nc", "contact": "contact.npz", "cost": "cost.json"}
            files = {kind: paths.fill(MODEL_FILE, **where, file=name) for kind, name in names.items()}
        if "stress" not in case.results:
            del files["rom"]
        if case.crossing:
            files["campbell"] = paths.fill(paths.CAMPBELL, blade=case.blade)
        return files


def shape_of_model(wildcards: Any) -> dict[str, str]:
    """What a model is made of: the mesh of the run, or the geometry that is meshed with so many nodes."""
    own = model_of_name(wildcards.model).nodes == OWN_MESH
    return {"mesh" if own else "geometry": paths.fill(paths.MESH if own else paths.GEOMETRY, blade=wildcards.blade)}


def choice_of_model(wildcards: Any) -> dict[str, Any]:
    """The choice that a model's name stands for."""
    return to_plain(model_of_name(wildcards.model))


def carries_coriolis(settings: Settings, choice: IntegrationChoice) -> bool:
    """Whether this run has no Coriolis force, or the time integration carries it."""
    return not settings.structure.coriolis or choice.integrator == EXACT_MODAL


def model_of_level(settings: Settings, blade: str, level: str) -> ModelChoice | str:
    """The model of a fidelity level: on the mesh of the run where that is given, the run's own where matrices are."""
    entry, boundary = settings.levels[level], settings.structure.boundary
    if settings.blades[blade].is_matrices:
        return boundary.tip_line
    return ModelChoice(
        nodes=entry.mesh.nodes if settings.blades[blade].has_profiles else OWN_MESH,
        boundary_nodes=settings.contact_nodes(blade, entry.mesh.tip_elements),
        fixed_interface_modes=entry.reduction.fixed_interface_modes,
        whole_blade_stress=False,
        tip_line=boundary.tip_line,
        corners=boundary.corners,
    )


def integration_of_level(settings: Settings, level: str, scene: Scene | None) -> IntegrationChoice:
    """The time integration of a fidelity level in a scene."""
    return settings.levels[level].time_integration.choice(scene is not None and scene.lining is not None)


def kept_of(level: Level) -> dict[str, int]:
    """How much of a run a level's files keep."""
    section = level.time_integration
    return {"spectrum_highest_order": section.spectrum_highest_order, "wear_angles": section.wear_angles}


def names_are_known(settings: Settings, extension: str, section: CasesSection, levels: Iterable[str] = ()) -> None:
    """ConfigError unless blade, scenes, base and `levels` are in their files, and the engine order in the Campbell diagram."""
    documents, refusals = settings.documents, ConfigRefusals()
    if section.blade:
        refusals.of(documents.known, (extension, "blade"), [section.blade], settings.designs.entries, documents.blades)
    if section.scenes != "all":
        refusals.of(documents.known, (extension, "scenes"), section.scenes, settings.scene_designs.names, documents.scenes)
    if section.base:
        refusals.of(documents.known, (extension, "base"), [section.base], settings.levels, documents.levels)
    refusals.of(documents.known, (extension, "parameters", "level"), list(levels), settings.levels, documents.levels)
    if section.engine_order:
        refusals.of(engine_order_is_known, settings, (extension, "engine_order"), section.engine_order)
    refusals.tell()
