"""The cases of a preset: what is varied, one parameter at a time, in which blade and scenes, at which level and speeds."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, Literal

from r37core.base.speeds import exact_text
from r37core.base.varied_number import with_value
from r37core.config import ConfigError, Settings, checked_scene, plain
from r37core.config.fidelity import Level
from r37core.config.section import ExtensionSection, Unique, either
from r37core.config.settings import contact_nodes
from r37core.plans.extension import Extension
from r37studies.other_models import OWN_MESH, ModelChoice

from .case import Case

Varied = Mapping[str, Mapping[str, Any]]
"""Name of what is varied -> what it changes: first a key with the values of the cases, one each, then keys with one value.

Keys: SPEEDS, LEVEL; those of a scene in scenes.yaml, as `scene.lining.bars`; fields of a `case`, its `choice` and its `model`.
"""

SPEEDS, LEVEL = "base.speeds", "base.level"
"""Keys: speeds as shares of the crossing's, or the one that three lie about; fidelity level."""

CLEARANCE, LOBES = "casing.clearance_m", "casing.amplitude_clearances"
"""Keys of a scene: the clearance, which is the cold one in a scene that has that, and the height of its lobes."""


def some_of(varied: Collection[str]) -> Any:
    """Type of a key that names some of what is varied, or all."""

    return either(Literal["all"], rows=Unique[Literal[tuple(varied)]])  # type: ignore[misc]


@dataclass(frozen=True)
class BaseCase:
    """The case of a run's first blade in each of its scenes, at its level, about the fastest crossing of 1B."""

    settings: Settings

    def cases(
        self, varied: Varied, chosen: Collection[str], results: Sequence[str], common: Mapping[str, Any]
    ) -> dict[str, Case | str]:
        """A case for each value of what is chosen in each scene that has it, such as a lining, called `what/value__scene`.

        One that this run cannot have is the reason why. `results`: as far as a scene has them, and the energy; `common`:
        changes of all cases.
        """
        settings, planned = self.settings, {}
        blade = settings.blade_names[0]
        for what in varied if chosen == "all" else chosen:
            key, values = next(iter(varied[what].items()))
            for value, scene in product(values, settings.scene_names):
                entry, changes = plain(settings.scene_designs.entries[scene]), {**common, **varied[what], key: value}
                if key.count(".") == 1 or key.split(".")[1] in entry:
                    text = value if isinstance(value, str) else exact_text(value)
                    kinds = [kind for kind in results if kind == "energy" or kind in settings.results_of(blade, scene)]
                    planned[f"{what}/{text}__{scene}"] = self._case(blade, entry, kinds, changes)
        return planned

    def _case(self, blade: str, entry: dict[str, Any], results: Sequence[str], changes: Mapping[str, Any]) -> Case | str:
        """The case in the scene of an entry with changes, or the reason why this run cannot have it."""
        scene, case, choice, model = (
            {key.removeprefix(part): value for key, value in changes.items() if key.startswith(part)}
            for part in ("scene.", "case.", "choice.", "model.")
        )
        settings, chosen, speeds = self.settings, self.settings.blades[blade], changes[SPEEDS]
        level = settings.levels[changes.get(LEVEL, settings.fidelity_name)]
        # matrices have contact nodes, and no stress
        if chosen.is_matrices and (model or "snapshots_per_revolution" in choice):
            return f"{blade} is given by matrices"
        if "nodes" in model and not chosen.has_profiles:
            return f"{blade} is given by a mesh"
        try:
            made = checked_scene(_changed(entry, scene))
        except ConfigError as error:
            return str(error)
        integration = replace(level.time_integration.choice(made), **choice)
        if "stress" not in results:
            integration = replace(integration, snapshots_per_revolution=0)
        elif integration.samples_per_revolution % integration.snapshots_per_revolution:
            return "stress is at samples of the motion alone"
        return Case(
            blade=blade,
            model=self._model(blade, level, model),
            scene=made,
            choice=integration.recorded,
            speeds=speeds if isinstance(speeds, tuple) else tuple(speeds * near for near in (0.997, 1.0, 1.003)),
            results=tuple(results),
            material=chosen.material,
            kept=level.time_integration.kept,
            crossing="1B",
            **case,
        )

    def _model(self, blade: str, level: Level, changes: Mapping[str, Any]) -> ModelChoice | str:
        """The model of a level: on the mesh of the run where that is given, the run's own where matrices are."""
        if self.settings.blades[blade].is_matrices:
            return self.settings.structure.boundary.tip_line
        nodes = level.mesh.nodes if self.settings.blades[blade].has_profiles else OWN_MESH
        boundary_nodes = contact_nodes(self.settings, blade, level.mesh.tip_elements)
        return replace(ModelChoice(nodes, boundary_nodes, level.reduction.fixed_interface_modes), **changes)


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


def extension(section: ExtensionSection[Any], closing: str) -> Extension:
    """The extension of a preset, by its section: the table of its cases, and the function of the run's last line of it."""
    return Extension(
        name=section.name,
        section=section,
        targets=lambda _: {f"<results>/{section.name}.csv": [{}]},
        closing=closing,
        made_on_request=True,
    )
