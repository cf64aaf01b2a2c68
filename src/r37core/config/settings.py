"""What a run of the workflow is made with: config.yaml, the files it names, and what it chooses of them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.scene import Scene
from r37core.exchange.importing.source import MatricesSource
from r37core.plain import to_plain
from r37core.rom.reduction_choice import POINTS, ReductionChoice
from r37core.run_ups.choice import RunUpChoice
from r37core.speeds import SpeedError, SpeedPlan
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.tolerances.fewest import remarks_on_rankings
from r37core.yaml_file import KeyPath

from . import casing_remarks
from .blades import BladeSettings, blade_settings
from .config_file import CampbellSection, Config, Interactions, RefinementSection, StructureSection
from .document import Document
from .families import Designs, Family
from .fidelity import Level, Measured, recommended_level
from .members import Members
from .scenes import SceneEntry
from .speed_section import UNITS, SpeedRule, key_of_speeds, planned
from .study_sections import StudiesSection

RESULTS = Path("results")
"""Folder of the results of a run without a name."""


@dataclass(frozen=True)
class SceneSettings:
    """One scene: what the blade meets, on which tip line, how long, and which results are wanted."""

    scene: Scene
    tip_line: str
    revolutions: int
    results: tuple[str, ...]
    stress_history_speeds: tuple[float, ...]


@dataclass(frozen=True)
class Documents:
    """The files that a message may have to point into; that of the blades has designs in place of families."""

    config: Document
    blades: Document
    levels: Document
    scenes: Document


@dataclass(frozen=True)
class Settings:
    """Everything the workflow needs to know; what concerns several files is checked by r37core.config.cross_checks.

    `root`: folder that file names start from; `config`: config.yaml; `designs`, `levels` and `scene_entries`: all that their
    files have, of which `blades`, `fidelity` and `scenes` are those to run, in order.
    """

    root: Path
    documents: Documents
    config: Config
    designs: Designs
    levels: dict[str, Level]
    scene_entries: dict[str, SceneEntry]

    @property
    def structure(self) -> StructureSection:
        """Geometry and reduced model."""
        return self.config.structure

    @property
    def campbell(self) -> CampbellSection:
        """The Campbell diagram."""
        return self.config.campbell

    @property
    def interactions(self) -> Interactions:
        """What counts as an interaction."""
        return self.config.interactions

    def refinement(self, scene: str) -> RefinementSection:
        """Where ranges with `refine_to` get more speeds; in a scene without lining with windows and share of its own."""
        given = self.config.refinement
        return given if self.scenes[scene].scene.lining else given.model_copy(update=dict(given.direct))

    def most_runs(self, blade: str, scene: str) -> int:
        """Simulations of a blade and scene, at most where speeds are adaptive."""
        return self.speed_plans[blade, scene].at_most(self.refinement(scene).largest_share)

    @property
    def studies(self) -> StudiesSection:
        """Studies of the model itself."""
        return self.config.studies

    @cached_property
    def chosen_blades(self) -> list[str]:
        """Names of the blades that config.yaml chooses; that of a family is all of its designs."""
        if self.config.blades == "all":
            return list(self.designs.entries)
        return self.designs_of(self.config.blades)

    def designs_of(self, names: Sequence[str]) -> list[str]:
        """Each of the blades, and of the families' designs, once."""
        families = self.designs.families
        several = [list(families[name].designs) if name in families else [name] for name in names]
        return list(dict.fromkeys(name for names in several for name in names))

    @cached_property
    def blade_names(self) -> list[str]:
        """Those of them that are in this run's part."""
        return self.config.run.of_part(self.chosen_blades)

    @cached_property
    def blades(self) -> dict[str, BladeSettings]:
        """Blades to run. Raises ConfigError for tables or files that cannot be read, and shapes that are impossible."""
        document = self.documents.blades
        return {name: blade_settings(name, self.designs.entries, self.root, document) for name in self.blade_names}

    @cached_property
    def families(self) -> dict[str, Family]:
        """Families of which some designs are run."""
        return {name: one for name, one in self.designs.families.items() if set(one.designs) & set(self.blade_names)}

    @cached_property
    def places(self) -> dict[str, dict[str, str]]:
        """Blade -> key -> `file:line: blade.key`, for what is found out later."""
        return {name: self._places(name) for name in self.blade_names}

    def _places(self, blade: str) -> dict[str, str]:
        """Where each key of a blade's entry, or of the entry that its base has it from, stands."""
        entry = self.designs.entries[blade]
        if base := getattr(entry, "base", None):
            return self._places(base)
        return {key: f"{self.documents.blades.place((blade, key))}: {blade}.{key}" for key in type(entry).model_fields}

    @cached_property
    def scene_names(self) -> list[str]:
        """Names of the scenes to run."""
        return list(self.scene_entries) if self.config.scenes == "all" else list(self.config.scenes)

    @cached_property
    def scenes(self) -> dict[str, SceneSettings]:
        """Scenes to run."""
        return {name: self._scene(self.scene_entries[name]) for name in self.scene_names}

    def _scene(self, entry: SceneEntry) -> SceneSettings:
        return SceneSettings(
            scene=entry.scene(),
            tip_line=entry.tip_line or self.structure.boundary.tip_line,
            revolutions=entry.revolutions or self.fidelity.time_integration.revolutions,
            results=tuple(entry.results),
            stress_history_speeds=entry.stress_history_speeds(),
        )

    @cached_property
    def fidelity_name(self) -> str:
        """The level that is named, or for `auto` the cheapest one whose measured error is within the tolerance."""
        if self.config.fidelity != "auto":
            return self.config.fidelity
        measured = {name: level.measured for name, level in self.levels.items() if level.measured}
        errors = {name: error for name, one in measured.items() if (error := self._error(one)) is not None}
        chosen = recommended_level(errors, {name: one.cpu_s_per_run for name, one in measured.items()}, self.config.tolerance)
        if chosen is None:
            known = ", ".join(f"{name} {error:g}" for name, error in errors.items()) or "none"
            raise self.documents.config.error(
                ("tolerance",),
                f"found {self.config.tolerance:g}; measured errors of the levels in {self.documents.levels.name}: {known}; "
                "accept more, or name a level under fidelity"
                + (", or take structure.boundary.contact: patches" if self._direct_on_points[0] else ""),
            )
        return chosen

    def _error(self, measured: Measured) -> float | None:
        """What a level was found to be off by in what this run has; None where that was not measured."""
        of_points = measured.error_on_points if self._direct_on_points[0] else None
        return measured.error if of_points is None else of_points

    @property
    def _direct_on_points(self) -> tuple[list[str], list[str]]:
        """Scenes without lining and blades whose contact acts on points of a mesh; none of both where one is missing."""
        scenes = [name for name in self.scene_names if self.scene_entries[name].lining is None]
        meshed = [name for name, blade in self.blades.items() if not isinstance(blade.definition, MatricesSource)]
        blades = [name for name in meshed if self.contact_of(name) == POINTS]
        return (scenes, blades) if scenes and blades else ([], [])

    @property
    def fidelity(self) -> Level:
        """The level to run."""
        return self.levels[self.fidelity_name]

    @cached_property
    def speed_plans(self) -> dict[tuple[str, str], SpeedPlan]:
        """Speeds of each blade and scene: of the first rule that fits. Raises ConfigError for speeds that clash."""
        general = self._speed_plan(self.config, ())
        special = [(rule, self._speed_plan(rule, ("speeds_for", n))) for n, rule in enumerate(self.config.speeds_for)]
        return {
            (blade, scene): next((plan for rule, plan in special if rule.fits(blade, scene)), general)
            for blade in self.blade_names
            for scene in self.scene_names
        }

    def _speed_plan(self, section: Config | SpeedRule, path: tuple[str | int, ...]) -> SpeedPlan:
        try:
            return planned(section, self.fidelity.time_integration.speed_step_rad_s)
        except SpeedError as error:
            raise self.documents.config.error((*path, key_of_speeds(section)), str(error)) from None

    @property
    def results(self) -> Path:
        """Folder of the results."""
        return RESULTS / "runs" / self.config.run.name if self.config.run.name else RESULTS

    @property
    def logs(self) -> Path:
        """Folder of the logs."""
        return Path("logs", "runs", self.config.run.name) if self.config.run.name else Path("logs")

    def merged(self) -> dict[str, Any]:
        """What this run is made with, merged from all files and the command line, as plain values."""
        # the key of the unit that speeds are not given in has the default
        other_speeds = set(UNITS) - {key_of_speeds(self.config)}
        return {
            "config": {key: value for key, value in plain(self.config).items() if key not in other_speeds},
            "fidelity": {self.fidelity_name: plain(self.fidelity)},
            "scenes": {name: plain(self.scene_entries[name]) for name in self.scenes},
            "blades": to_plain(self.blades),
        }

    @property
    def remarks(self) -> list[str]:
        """What a run should say before it starts."""
        said = []
        measured = self.fidelity.measured
        if self.config.fidelity == "auto" and measured is not None and (share := self._error(measured)) is not None:
            error, cost = 100 * share, measured.cpu_s_per_run
            said.append(f"fidelity auto: level {self.fidelity_name}, measured error {error:g}%, {cost:g} CPU s per run")
        fastest, highest = max(plan.every_speed()[-1] for plan in self.speed_plans.values()), self.structure.maximum_speed_rad_s
        if fastest > highest:
            said.append(
                f"speeds: up to {fastest:g} rad/s, and structure.maximum_speed_rad_s is {highest:g}: reduced models and "
                "Campbell diagrams are made for speeds up to that; raise it to what is run"
            )
        said += self.remarks_on_casings
        said += casing_remarks.of_left_out_modes(self.elastic_casings)
        refining = {place: plan for place, plan in self.speed_plans.items() if plan.refined}
        if refining:
            certain = sum(len(plan.certain) for plan in refining.values())
            most = sum(self.most_runs(*place) for place in refining)
            said.append(
                f"adaptive speed sampling: {certain} simulations and those of the windows first, about {most} at most; "
                "they are planned round by round, so a dry run shows none of those to come"
            )
        if self.members.pairs:
            members, drawn = self.most_of_members, self.config.tolerances.members
            said.append(f"tolerances: {drawn} members, {members} simulations of theirs at most, beside those of the sweep")
            said += remarks_on_rankings(drawn, len(self.members.numbers), self.config.tolerances.sensitivity)
        return said

    @property
    def elastic_casings(self) -> dict[str, ElasticCasing]:
        """Of each scene to run whose casing gives way."""
        entries = {name: self.scene_entries[name].casing for name in self.scene_names}
        return {name: casing.elastic_casing() for name, casing in entries.items() if casing.elastic}

    @property
    def remarks_on_casings(self) -> list[str]:
        """What a run should say of casings that the rotor overtakes."""
        said = (casing_remarks.of_speeds(name, one, self._fastest_of(name)) for name, one in self.elastic_casings.items())
        return [one for one in said if one]

    @property
    def remarks_on_points(self) -> list[str]:
        """What a run should say at its end of direct contact on points, which has no limit in the mesh."""
        scenes, blades = self._direct_on_points
        if not scenes:
            return []
        of = f"{len(blades)} blades" if len(blades) > 1 else blades[0]
        return [
            f"{', '.join(scenes)}: contact of {of} acts on points, as published, and changes with every finer mesh; for "
            "numbers to decide from: structure.boundary.contact: patches (docs/accuracy.md#points-and-patches)"
        ]

    def _fastest_of(self, scene: str) -> float:
        """The highest speed (rad/s) of a scene's simulations, and of its run-ups as far as no crossing decides it."""
        swept = [plan.every_speed()[-1] for (_, one), plan in self.speed_plans.items() if one == scene]
        climbs = [climb for (_, one), found in self.run_ups.items() if one == scene for climb in found.values()]
        return max(*swept, *(max(climb.start, climb.stop) for climb in climbs if climb.crossing is None), 0.0)

    def shape_hash(self, blade: str) -> str:
        """Short hash of all that a blade's geometry depends on."""
        return _short_hash(self.blades[blade].definition, self.structure.edges)

    def structure_hash(self, blade: str) -> str:
        """Short hash of all that a blade's structural results depend on."""
        material = self.blades[blade].material
        elastic = material and replace(material, yield_stress=0.0)
        choice = self.reduction_choice(blade)
        return _short_hash(self.shape_hash(blade), elastic, plain(self.fidelity.mesh), choice)

    def reduction_choice(self, blade: str, tip_line: str | None = None) -> ReductionChoice:
        """What a blade's reduced model is made of, with contact nodes on `tip_line` or on that of config.yaml."""
        submesh = self.blades[blade].stress_submesh
        return self.structure.reduction(self.fidelity.reduction, self.contact_of(blade), tip_line, submesh)

    def contact_of(self, blade: str) -> str:
        """What a blade's contact acts on: as config.yaml says for all of them, else as its own entry does."""
        return self.structure.boundary.contact or self.blades[blade].contact

    def place_of_contact(self, blade: str) -> str:
        """Where stands what a blade's contact acts on, as `file:line: key`."""
        path: KeyPath = ("structure", "boundary", "contact")
        if self.structure.boundary.contact is not None:
            return f"{self.documents.config.place(path)}: {'.'.join(map(str, path))}"
        return f"{self.documents.blades.place((blade, 'contact'))}: {blade}.contact"

    def results_of(self, blade: str, scene: str) -> tuple[str, ...]:
        """What is wanted of a scene, as far as the blade can give it: matrices have no stress, nor shapes."""
        wanted = self.scenes[scene].results
        matrices = isinstance(self.blades[blade].definition, MatricesSource)
        return tuple(result for result in wanted if not (matrices and result in ("stress", "static_stress", "shapes")))

    @cached_property
    def members(self) -> Members:
        """Blades and scenes with other values of what is never known exactly."""
        return Members(self)

    @property
    def most_of_members(self) -> int:
        """Simulations of all members, at most where speeds are adaptive."""
        share, plans = self.config.tolerances.largest_share, self.speed_plans
        return sum(len(members) * plans[pair].at_most(share) for pair, members in self.members.all.items())

    @cached_property
    def run_ups(self) -> dict[tuple[str, str], dict[str, RunUpChoice]]:
        """Run-ups of each blade and scene, by name."""
        found: dict[tuple[str, str], dict[str, RunUpChoice]] = {
            (blade, scene): {} for blade in self.blade_names for scene in self.scene_names
        }
        for name, entry in self.config.run_ups.items():
            blades = self.blade_names if entry.blades == "all" else self.designs_of(entry.blades)
            scenes = self.scene_names if entry.scenes == "all" else entry.scenes
            choices = {scene: entry.choice(self.scenes[scene].revolutions) for scene in scenes if scene in self.scenes}
            for blade, (scene, choice) in product(blades, choices.items()):
                if (blade, scene) in found:
                    found[blade, scene][name] = choice
        return found

    def run_up_choice(self, blade: str, scene: str, name: str) -> IntegrationChoice:
        """Numbers of the time integration of a run-up: those of the sweep, with stress in every revolution."""
        choice = self.integration_choice(blade, scene, 0.0)
        before = self.run_ups[blade, scene][name].before
        return replace(choice, revolutions=before, snapshot_revolutions=before if choice.snapshots_per_revolution else 0)

    def integration_choice(self, blade: str, scene: str, speed: float) -> IntegrationChoice:
        """Numbers of the time integration at one speed of a blade and scene, with only what its results need."""
        chosen = self.scenes[scene]
        everything = self.fidelity.time_integration.choice(chosen.scene.lining is not None)
        stress = "stress" in self.results_of(blade, scene)
        history = speed in chosen.stress_history_speeds
        choice = replace(everything, revolutions=chosen.revolutions)
        return replace(
            choice,
            snapshots_per_revolution=choice.snapshots_per_revolution if stress else 0,
            snapshot_revolutions=(choice.revolutions if history else choice.revolutions_in_statistic) if stress else 0,
        )


def plain(section: BaseModel) -> dict[str, Any]:
    """A section as a dictionary of plain values, which Snakemake can compare and a job can read without the models."""
    return section.model_dump(exclude_none=True)


def checked_scene(entry: Mapping[str, Any]) -> Scene:
    """The scene of one entry of scenes.yaml; ConfigError where the model of scenes forbids it."""
    return Document("scenes.yaml", dict(entry)).check(SceneEntry).scene()


def _short_hash(*parts: object) -> str:
    """Hash of plain numbers, texts and frozen dataclasses."""
    return hashlib.sha256(json.dumps(to_plain(parts)).encode()).hexdigest()[:16]
