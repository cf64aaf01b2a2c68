"""The case that those of a preset differ from, in which blade and scenes, and how one parameter of it is changed."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

from pydantic import Field

from r37core.base.varied_number import with_value
from r37core.base.yaml_file import KeyPath
from r37core.config import ConfigError, Settings, checked_scene, plain, scenes_named
from r37core.config.cross_checks import engine_order_is_known
from r37core.config.document import ConfigRefusals, Document
from r37core.config.fidelity import Level
from r37core.config.section import AllOrNames, ExtensionSection, LeftOut, Name, Section, left_out
from r37core.config.settings import contact_nodes
from r37studies.other_models import OWN_MESH, ModelChoice

from .case import Case

Changes = Callable[[Any], dict[str, dict[str, Any]]]
"""Changes by a value of a parameter: of fields of the `case`, its `choice` and `model`, and of keys of the `scene`'s entry."""

CLEARANCE, LOBES = "casing.clearance_m", "casing.amplitude_clearances"
"""Keys of a scene: the clearance, which is the cold one in a scene that has that, and the height of its lobes."""


def put(part: str, name: str, also: Mapping[str, dict[str, Any]] | None = None) -> Changes:
    """Changes that put a value at a name of a part, and others that do not depend on it."""
    return lambda value: {part: {name: value}, **(also or {})}


class TrialsSection(Section):
    """Blade, scenes, level and speeds of the cases."""

    blade: Name | LeftOut = left_out("Blade; by default the first one of the run")
    scenes: AllOrNames = Field(default="all", description="Scenes of the run")
    base: Name | LeftOut = left_out("Fidelity level of all that is not varied; by default that of the run")
    engine_order: Annotated[int, Field(ge=1, le=100)] | LeftOut = left_out(
        "Crossing of 1B that the speeds lie about; by default the fastest one"
    )


@dataclass(frozen=True)
class BaseCase:
    """The case of a section's blade and level in its scenes, about a crossing of 1B."""

    settings: Settings
    declared: ExtensionSection[Any]

    @property
    def _section(self) -> TrialsSection:
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

    def has(self, scene: str, changes: Mapping[str, dict[str, Any]]) -> bool:
        """True where a scene has what is changed, such as a lining."""
        entry = plain(self.settings.scene_designs.entries[scene])
        return all(key.split(".")[0] in entry for key in changes.get("scene", {}) if "." in key)

    def lacking(self, changes: Mapping[str, dict[str, Any]]) -> str:
        """Reason why the blade, as its program gives it, cannot be changed so; empty where it can."""
        assert self.blade is not None
        blade, model = self.settings.blades[self.blade], changes.get("model", {})
        # matrices have contact nodes, and no stress
        if blade.is_matrices and (model or "snapshots_per_revolution" in changes.get("choice", {})):
            return f"{self.blade} is given by matrices"
        return f"{self.blade} is given by a mesh" if "nodes" in model and not blade.has_profiles else ""

    def case(
        self,
        scene: str,
        shares: Sequence[float],
        results: Sequence[str],
        changes: Mapping[str, dict[str, Any]],
        level: str | None = None,
    ) -> Case | str:
        """The case in a scene with `changes`, at `shares` of the crossing's speed; or the reason why this run cannot have it.

        `level`: in place of its own.
        """
        settings, blade, entry = self.settings, self.blade, self.settings.levels[level or self.level]
        if lacking := self.lacking(changes):
            return lacking
        try:
            made = checked_scene(_changed(plain(settings.scene_designs.entries[scene]), changes.get("scene", {})))
        except ConfigError as error:
            return str(error)
        choice = replace(entry.time_integration.choice(made), **changes.get("choice", {}))
        if "stress" not in results:
            choice = replace(choice, snapshots_per_revolution=0)
        elif choice.samples_per_revolution % choice.snapshots_per_revolution:
            return "stress is at samples of the motion alone"
        assert blade is not None
        case = Case(
            blade,
            self._model(blade, entry, changes.get("model", {})),
            made,
            choice.recorded,
            tuple(shares),
            tuple(results),
            settings.blades[blade].material,
            entry.time_integration.kept,
            ("1B", self._section.engine_order),
        )
        return replace(case, **changes.get("case", {}))

    def _model(self, blade: str, level: Level, changes: dict[str, Any]) -> ModelChoice | str:
        """The model of a level: on the mesh of the run where that is given, the run's own where matrices are."""
        if self.settings.blades[blade].is_matrices:
            return self.settings.structure.boundary.tip_line
        nodes = level.mesh.nodes if self.settings.blades[blade].has_profiles else OWN_MESH
        boundary_nodes = contact_nodes(self.settings, blade, level.mesh.tip_elements)
        return replace(ModelChoice(nodes, boundary_nodes, level.reduction.fixed_interface_modes, "submesh"), **changes)

    def check_names(self, levels: Iterable[str] = ()) -> None:
        """ConfigError unless blade, scenes, base and `levels` are in their files, and the order in the Campbell diagram."""
        settings, section, refusals = self.settings, self._section, ConfigRefusals()
        documents, name = settings.documents, self.declared.name
        named: list[tuple[KeyPath, Iterable[str | None], Iterable[str], Document]] = [
            (("blade",), [section.blade], settings.designs.entries, documents.blades),
            (("scenes",), [] if section.scenes == "all" else section.scenes, settings.scene_designs.names, documents.scenes),
            (("base",), [section.base], settings.levels, documents.levels),
            (("parameters", "level"), levels, settings.levels, documents.levels),
        ]
        for key, names, known, file in named:
            refusals.of(documents.known, (name, *key), filter(None, names), known, file)
        if section.engine_order:
            refusals.of(engine_order_is_known, settings, (name, "engine_order"), section.engine_order)
        refusals.tell()


def _changed(entry: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A copy of a scene's entry with the changes.

    Lobes scale with a changed clearance: otherwise, nothing would touch at the largest.
    """
    casing = dict(entry["casing"])
    cold = "casing.clearance.cold_m" if "clearance" in casing else CLEARANCE
    if "amplitude_m" in casing and {CLEARANCE, LOBES} & set(changes):
        clearance = casing["clearance"]["cold_m"] if "clearance" in casing else casing["clearance_m"]
        casing["amplitude_clearances"] = casing.pop("amplitude_m") / clearance
        entry = {**entry, "casing": casing}
    for path, value in changes.items():
        entry = with_value(entry, cold if path == CLEARANCE else path, value)
    return entry
