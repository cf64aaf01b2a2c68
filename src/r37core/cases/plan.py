"""The plan of the cases of an extension: keys of its section, files for its rules, and the case that the others differ from."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any

from pydantic import Field

from r37core.base.plain import to_plain
from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import engine_order_is_known
from r37core.config.document import ConfigRefusals, Document
from r37core.config.fidelity import Level
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Section, left_out
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL

from .case import OWN_MESH, Case, ModelChoice, model_of_name

MODEL_FILES = {
    "rom": "<results>/cases/{blade}/{model}/rom.nc",
    "contact": "<results>/cases/{blade}/{model}/contact.npz",
    "cost": "<results>/cases/{blade}/{model}/cost.json",
}

_OF_A_MESH = ("model.", "choice.snapshots_per_revolution")
"""Fields of a case, by the first part of their paths, that matrices decide: they have contact nodes and no stress."""


class CasesSection(Section):
    """Blade, scenes, level and speeds of the cases."""

    blade: Name | LeftOut = left_out("Blade; by default the first one of the run")
    scenes: AllOrNames = Field(default="all", description="Scenes of the run")
    base: Name | LeftOut = left_out("Fidelity level of all that is not varied; by default that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "Crossing of 1B that the speeds lie about; by default the fastest one"
    )


@dataclass(frozen=True)
class BaseCase:
    """The case that the cases of an extension differ from: its blade and level in a scene, about a crossing of 1B."""

    settings: Settings
    declared: ExtensionSection[Any]

    @property
    def _section(self) -> CasesSection:
        return self.settings.section(self.declared)

    @property
    def blade(self) -> str | None:
        """Blade of the cases, by default the first of the run; None where this run leaves it out."""
        name = self._section.blade or self.settings.blade_names[0]
        return name if name in self.settings.blade_names else None

    @property
    def scenes(self) -> list[str]:
        """Scenes of the cases, as far as they are run; none without the blade."""
        chosen = scenes_named(self.settings, self._section.scenes) if self.blade else []
        return [name for name in self.settings.scene_names if name in chosen]

    @property
    def level(self) -> str:
        """Fidelity level of the cases."""
        return self._section.base or self.settings.fidelity_name

    def case(self, scene: Scene | None, shares: Sequence[float], results: Sequence[str], level: str | None = None) -> Case:
        """The case in a scene, at `shares` of the crossing's speed, of its own or another `level`."""
        blade, entry = self.blade, self.settings.levels[level or self.level]
        assert blade is not None
        return Case(
            blade,
            self._model(blade, entry),
            scene,
            entry.time_integration.choice(scene is not None and scene.lining is not None),
            tuple(shares),
            tuple(results),
            self.settings.blades[blade].material,
            entry.time_integration.kept,
            ("1B", self._section.engine_order),
        )

    def _model(self, blade: str, level: Level) -> ModelChoice | str:
        """The model of a level: on the mesh of the run where that is given, the run's own where matrices are."""
        settings, boundary = self.settings, self.settings.structure.boundary
        if settings.blades[blade].is_matrices:
            return boundary.tip_line
        return ModelChoice(
            nodes=level.mesh.nodes if settings.blades[blade].has_profiles else OWN_MESH,
            boundary_nodes=settings.contact_nodes(blade, level.mesh.tip_elements),
            fixed_interface_modes=level.reduction.fixed_interface_modes,
            stress_region="submesh",
            tip_line=boundary.tip_line,
            tip_ends="corners" if boundary.corners else "inside",
        )

    def lacking(self, changes: Iterable[str]) -> str:
        """Reason why the blade, as its program gives it, cannot have changes at these paths; empty where it can."""
        assert self.blade is not None
        blade = self.settings.blades[self.blade]
        if blade.is_matrices and any(path.startswith(_OF_A_MESH) for path in changes):
            return f"{self.blade} is given by matrices"
        return f"{self.blade} is given by a mesh" if "model.nodes" in changes and not blade.has_profiles else ""

    def refusal(self, case: Case, changes: Iterable[str]) -> str:
        """Reason why this run cannot have a `case` with changes at these paths; empty where it can."""
        carried = not self.settings.structure.coriolis or case.choice.integrator == EXACT_MODAL
        return self.lacking(changes) or ("" if carried else f"{CENTRAL_DIFFERENCE} does not carry the Coriolis force")

    def check_names(self, levels: Iterable[str] = ()) -> None:
        """ConfigError unless blade, scenes, base and `levels` are in their files, and the order in the Campbell diagram."""
        settings, section, refusals = self.settings, self._section, ConfigRefusals()
        documents, scenes = settings.documents, [] if section.scenes == "all" else section.scenes
        named: list[tuple[KeyPath, Iterable[str | None], Iterable[str], Document]] = [
            (("blade",), [section.blade], settings.designs.entries, documents.blades),
            (("scenes",), scenes, settings.scene_designs.names, documents.scenes),
            (("base",), [section.base], settings.levels, documents.levels),
            (("parameters", "level"), levels, settings.levels, documents.levels),
        ]
        for key, names, known, file in named:
            refusals.of(documents.known, (self.declared.name, *key), filter(None, names), known, file)
        if section.engine_order:
            refusals.of(engine_order_is_known, settings, (self.declared.name, "engine_order"), section.engine_order)
        refusals.tell()


class Cases:
    """Inputs and parameters of the rules for the cases of an extension, which `make` plans from the settings when asked."""

    def __init__(self, settings: Settings, extension: str, make: Callable[[Settings], Mapping[str, Case]]):
        self.file = f"<results>/{extension}/{{case}}.nc"
        self.log = f"<logs>/{extension}/{{case}}.log"
        self._made = partial(settings.made, make)

    def files(self, wildcards: Any) -> list[str]:
        """Responses of all cases."""
        return [paths.fill(self.file, case=name) for name in self._made()]

    def case(self, wildcards: Any) -> dict[str, Any]:
        """A case as plain values."""
        return to_plain(self._made()[wildcards.case])

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that a case is run from; none of one that is refused."""
        case = self._made()[wildcards.case]
        if case.scene is None:
            return {}
        if isinstance(case.model, str):
            patterns = {"rom": paths.REDUCED_MODEL, "contact": paths.CONTACT_MODEL}
            where = {"blade": case.blade, "tip_line": case.model}
        else:
            patterns, where = dict(MODEL_FILES), {"blade": case.blade, "model": case.model.name}
        if "stress" not in case.results:
            del patterns["rom"]
        if case.crossing:
            patterns["campbell"] = paths.CAMPBELL
        return {kind: paths.fill(pattern, **where) for kind, pattern in patterns.items()}


def shape_of_model(wildcards: Any) -> dict[str, str]:
    """Files of a model's shape: the mesh of the run, or the geometry that is meshed with so many nodes."""
    own = model_of_name(wildcards.model).nodes == OWN_MESH
    return {"mesh" if own else "geometry": paths.fill(paths.MESH if own else paths.GEOMETRY, blade=wildcards.blade)}


def choice_of_model(wildcards: Any) -> dict[str, Any]:
    """The choice that a model's name stands for."""
    return to_plain(model_of_name(wildcards.model))
