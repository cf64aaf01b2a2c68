"""Settings of a run of the workflow: config.yaml, the files it names, and what it chooses of them."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from r37core.base.plain import to_plain
from r37core.base.speeds import SpeedError, SpeedPlan, plan_speeds
from r37core.base.yaml_file import KeyPath
from r37core.contact.scene import Scene
from r37core.results.operating_range import OperatingRange
from r37core.rom.reduction_choice import POINTS, BoundaryChoice, ReductionChoice
from r37core.rom.region_choice import RegionChoice
from r37core.time_integration.integration_choice import SECONDS_PER_STEP, IntegrationChoice

from .blade_sections import chosen_regions
from .blades import BladeSettings, blade_settings, chain_of_blades, link_with
from .config_file import UNITS, Config, SpeedRule, StructureSection, key_of_speeds
from .declaring import si, si_form
from .document import ConfigRefusals, Document
from .families import AnyEntry, Designs
from .fidelity import Level
from .scenes import SceneEntry
from .section import ExtensionSection, Section, plain

T = TypeVar("T")

_OF_MESHES = ("stress", "static_stress", "fatigue", "shapes")
"""Results that blades of matrices do not have."""

FARTHEST = 2.0
"""Largest ratio of a speed to structure.maximum_speed_rad_s: rpm taken for rad/s are above it, of speeds from 21% on."""


def results_folder(run: str | None) -> Path:
    """Folder of the results of a run with this name, or without one."""
    return Path("results", "runs", run) if run else Path("results")


@dataclass(frozen=True)
class SceneSettings:
    """One scene: what the blade meets, on which tip line, how long, and which results are wanted."""

    scene: Scene
    tip_line: str
    revolutions: int
    until_settled: bool
    results: tuple[str, ...]
    stress_history_speeds: tuple[float, ...]


@dataclass(frozen=True)
class Settings:
    """Everything the workflow needs to know; what concerns several files is checked by r37core.config.cross_checks.

    `root`: folder that file names start from; `config`: config.yaml, and `document`, where its values stand;
    `designs`, `levels` and `scene_designs`: all that their files have, of which `blades`, `fidelity` and `scenes` are those to
    run, in order.
    """

    root: Path
    document: Document
    config: Config
    designs: Designs[AnyEntry]
    levels: dict[str, Level]
    levels_document: Document
    scene_designs: Designs[SceneEntry]

    @property
    def structure(self) -> StructureSection:
        """Geometry and reduced model."""
        return self.config.structure

    def section(self, declared: ExtensionSection[T]) -> T:
        """The section of config.yaml that an extension has brought."""
        return getattr(self.config, declared.name)

    @cached_property
    def made(self) -> Callable[..., Any]:
        """Gives what a function makes of these settings and of more arguments, each made once: what takes long, or often."""
        return cache(lambda make, *arguments: make(self, *arguments))

    @cached_property
    def blade_names(self) -> list[str]:
        """Blades that config.yaml chooses, of a family all of its designs.

        Raises ConfigError for a name that is not in the file.
        """
        return _chosen(self, "blades", self.designs)

    @cached_property
    def blades(self) -> dict[str, BladeSettings]:
        """Blades to run, each with its tables and files read.

        Raises the ConfigErrors of all of them, but not of one whose base is refused before it. Of designs of one family the
        first refusal is enough: they have nearly all in common.
        """
        entries, family_of, refusals = self.designs.entries, self.designs.family_of, ConfigRefusals()
        blades: dict[str, BladeSettings | None] = {}
        refused_families: set[str] = set()
        for name in self.blade_names:
            base, family = getattr(entries[name], "base", None), family_of.get(name, "")
            known = (base not in blades or blades[base] is not None) and family not in refused_families
            blades[name] = refusals.of(blade_settings, name, entries, self.root, self.designs.document) if known else None
            if family and blades[name] is None:
                refused_families.add(family)
        refusals.tell()
        return {name: blade for name, blade in blades.items() if blade is not None}

    @cached_property
    def scene_names(self) -> list[str]:
        """Scenes that config.yaml chooses, of a family all of its designs.

        Raises ConfigError for a name that is not in the file.
        """
        return _chosen(self, "scenes", self.scene_designs)

    @cached_property
    def scenes(self) -> dict[str, SceneSettings]:
        """Scenes to run."""
        return {
            name: SceneSettings(
                scene=entry.scene(),
                tip_line=entry.tip_line or self.structure.boundary.tip_line,
                revolutions=entry.revolutions or self.fidelity.time_integration.revolutions,
                until_settled=(entry.until or self.fidelity.time_integration.until) == "settled",
                results=tuple(entry.results),
                stress_history_speeds=entry.stress_history_speeds(),
            )
            for name, entry in ((name, self.scene_designs.entries[name]) for name in self.scene_names)
        }

    @cached_property
    def fidelity_name(self) -> str:
        """The level to run. Raises ConfigError for a name that is not in the file."""
        self.document.known(("fidelity",), [self.config.fidelity], self.levels, self.levels_document)
        return self.config.fidelity

    @property
    def fidelity(self) -> Level:
        """The level to run."""
        return self.levels[self.fidelity_name]

    @cached_property
    def speed_plans(self) -> dict[tuple[str, str], SpeedPlan]:
        """Speeds of each blade and scene: of the first rule that fits. Raises ConfigError for speeds that clash."""
        sections = [(("speeds_for", number), rule) for number, rule in enumerate(self.config.speeds_for)]
        refusals = ConfigRefusals()
        general, *special = (refusals.of(_planned, self, *section) for section in [((), self.config), *sections])
        refusals.tell()
        assert general
        plans = {(blade, scene): general for blade in self.blade_names for scene in self.scene_names}
        # of the rules that fit the first one decides
        for rule, plan in zip(reversed(self.config.speeds_for), reversed(special), strict=True):
            assert plan
            blades, scenes = blades_named(self, rule.blades or "all"), scenes_named(self, rule.scenes or "all")
            plans |= {pair: plan for pair in product(blades, scenes) if pair in plans}
        return plans

    @property
    def results(self) -> Path:
        """Folder of the results."""
        return results_folder(self.config.run.name)

    def reduction_choice(self, blade: str) -> ReductionChoice:
        """Reduction of a blade: its basis is computed at rest, at half the maximum speed and at the maximum speed."""
        structure = self.structure
        speeds = (0.0, 0.5 * structure.maximum_speed_rad_s, structure.maximum_speed_rad_s)
        more = {"kinematics": self.kinematics_of(blade), **dict(self.fidelity.reduction)}
        return si_form(ReductionChoice, structure, speeds=speeds, **more)

    def boundary_choice(self, blade: str, tip_line: str | None = None) -> BoundaryChoice:
        """Contact nodes of a blade, on `tip_line` or on that of config.yaml."""
        section = self.structure.boundary
        return si_form(BoundaryChoice, section, tip_line=tip_line or section.tip_line, contact=self.contact_of(blade))

    def stress_regions(self, blade: str) -> dict[str, RegionChoice]:
        """Regions of a blade where stress is looked for."""
        shared, own = self.structure.stress_regions, self.blades[blade].stress_regions
        return chosen_regions(shared) | {name: region for name, region in own.items() if shared.get(name, region)}

    def contact_of(self, blade: str) -> str:
        """Contact nodes of a blade: as config.yaml says for all of them, else as its own entry does."""
        return self.structure.boundary.contact or self.blades[blade].contact

    def kinematics_of(self, blade: str) -> str:
        """Kinematics of a blade: as config.yaml says for all of them, else as its own entry does."""
        return self.structure.kinematics or self.blades[blade].kinematics

    def results_of(self, blade: str, scene: str) -> tuple[str, ...]:
        """Results requested for a scene, as far as the blade has them: matrices have no stress, nor shapes.

        An imported mesh with strengths has fatigue wherever stress is wanted.
        """
        wanted, chosen = self.scenes[scene].results, self.blades[blade]
        if chosen.is_matrices:
            return tuple(result for result in wanted if result not in _OF_MESHES)
        assumed = not chosen.has_profiles and chosen.strengths.are_known and "stress" in wanted and "fatigue" not in wanted
        return (*wanted, "fatigue") if assumed else wanted

    def integration_choice(self, blade: str, scene: str) -> IntegrationChoice:
        """Numbers of the time integration of a blade in a scene, with only what its results need."""
        chosen = self.scenes[scene]
        everything = self.fidelity.time_integration.choice(chosen.scene)
        stress = "stress" in self.results_of(blade, scene)
        choice = replace(everything, revolutions=chosen.revolutions, until_settled=chosen.until_settled)
        return replace(
            choice,
            snapshots_per_revolution=choice.snapshots_per_revolution if stress else 0,
            snapshot_revolutions=choice.revolutions if stress else 0,
        )


def _planned(settings: Settings, path: KeyPath, section: Config | SpeedRule) -> SpeedPlan:
    """The speeds of a section at `path`, whose ranges have the level's step where they give none. Raises ConfigError."""
    key, document = key_of_speeds(section), settings.document
    entries = [plain(entry) if isinstance(entry, Section) else entry for entry in getattr(section, key)]
    with document.blamed((*path, key), SpeedError):
        plan = plan_speeds(entries, settings.fidelity.time_integration.speed_step_rad_s, UNITS[key])
    fastest, highest = plan.every_speed()[-1], FARTHEST * settings.structure.maximum_speed_rad_s
    if fastest > highest:
        allowed = f"up to {highest:g} rad/s, {FARTHEST:g} times structure.maximum_speed_rad_s; rpm stand under speeds_rpm"
        raise document.refusal(f"{fastest:g} rad/s", allowed, *path, key)
    operating = operating_range(settings)
    return plan.including(operating.ends) if operating else plan


def _chosen(settings: Settings, key: str, designs: Designs[Any]) -> list[str]:
    """Names that a key of config.yaml chooses. Raises ConfigError for one that is not in the file."""
    chosen = getattr(settings.config, key)
    if chosen == "all":
        return list(designs.entries)
    settings.document.known((key,), chosen, designs.names, designs.document)
    return designs.named(chosen)


def varied_settings(settings: Settings, blades: Mapping[str, BladeSettings], scenes: Mapping[str, SceneSettings]) -> Settings:
    """The settings with other blades and scenes in the place of those to run that have the same names."""
    changed = replace(settings)
    # what is computed once stands in the object's dictionary
    vars(changed).update(
        blades={**settings.blades, **blades}, scenes={**settings.scenes, **scenes}, speed_plans=settings.speed_plans
    )
    return changed


def merged_settings(settings: Settings) -> dict[str, Any]:
    """Settings of a run, merged from all files and the command line, as plain values."""
    # the key of the unit that speeds are not given in has the default
    other_speeds = set(UNITS) - {key_of_speeds(settings.config)}
    return {
        "config": {key: value for key, value in plain(settings.config).items() if key not in other_speeds},
        "fidelity": {settings.fidelity_name: plain(settings.fidelity)},
        "scenes": {name: plain(settings.scene_designs.entries[name]) for name in settings.scenes},
        "blades": to_plain(settings.blades),
    }


def contact_nodes(settings: Settings, blade: str, tip_elements: int) -> int:
    """Number of a blade's contact nodes on a tip of so many elements; 0 where the mesh of another program decides it."""
    boundary = settings.boundary_choice(blade)
    if not settings.blades[blade].has_profiles:
        return boundary.nodes or 0
    return boundary.on(np.linspace(0.0, 1.0, 2 * tip_elements + 1)).most_nodes


def blades_named(settings: Settings, chosen: Sequence[str] | str) -> list[str]:
    """Blades and designs of families of these names; those that are run for `all`."""
    return settings.blade_names if chosen == "all" else settings.designs.named(chosen)


def scenes_named(settings: Settings, chosen: Sequence[str] | str) -> list[str]:
    """Scenes and designs of families of these names; those that are run for `all`."""
    return settings.scene_names if chosen == "all" else settings.scene_designs.named(chosen)


def operating_range(settings: Settings) -> OperatingRange | None:
    """Speeds in operation, where config.yaml has them."""
    section = settings.config.operating
    return None if section is None else si(section)


def direct_on_points(settings: Settings) -> tuple[list[str], list[str]]:
    """Scenes without lining and blades whose contact acts on points of a mesh; none of both where one is missing."""
    # by their entries: which level is run may depend on it
    scenes = [name for name in settings.scene_names if settings.scene_designs.entries[name].lining is None]
    blades = [name for name in blades_on_points(settings) if not settings.blades[name].is_matrices]
    return (scenes, blades) if scenes and blades else ([], [])


def contact_of_blades(settings: Settings) -> dict[str, str]:
    """Blade -> what its contact acts on, and its kinematics: 8 points, linear; patches, quadratic.

    Of points with their number, which the results depend on, unless matrices of another program decide it.
    """
    kinds = {}
    for name in settings.blades:
        contact, number = settings.contact_of(name), contact_nodes(settings, name, settings.fidelity.mesh.tip_elements)
        points = f"{number or ''} {contact}".strip() if contact == POINTS else contact
        kinds[name] = f"{points}, {settings.kinematics_of(name)}"
    return kinds


def blades_of_matrices(settings: Settings) -> list[str]:
    """Blades that are given by matrices, which have no mesh."""
    return [name for name, blade in settings.blades.items() if blade.is_matrices]


def blades_on_points(settings: Settings) -> list[str]:
    """Blades whose contact acts on points."""
    return [name for name in settings.blades if settings.contact_of(name) == POINTS]


def level_errors(settings: Settings, pairs: Sequence[tuple[str, str]]) -> list[float]:
    """Relative error of the level, by mesh and step, of each of some blades and scenes; NaN where it was not measured."""
    measured, points = settings.fidelity.measured, blades_on_points(settings)
    if measured is None:
        return [math.nan] * len(pairs)
    return [measured.error_of(blade in points and not settings.scenes[scene].scene.lined, blade) for blade, scene in pairs]


def location_of_contact(settings: Settings, blade: str) -> str:
    """Where stands what a blade's contact acts on, as `file:line: key`."""
    if settings.structure.boundary.contact is None:
        entries, document = settings.designs.entries, settings.designs.document
        link = link_with("contact", chain_of_blades(blade, entries, document), entries)
        return f"{document.location((link, 'contact'))}: {link}.contact"
    path = ("structure", "boundary", "contact")
    return f"{settings.document.location(path)}: {'.'.join(path)}"


def checked_scene(entry: Mapping[str, Any]) -> Scene:
    """The scene of one entry of scenes.yaml; ConfigError where the model of scenes forbids it."""
    return Document("scenes.yaml", dict(entry)).check(SceneEntry).scene()


@dataclass(frozen=True)
class RunLength:
    """A run at a `speed` (rad/s): of so many `revolutions` and `blades`, in steps of `time_step` (s)."""

    speed: float
    revolutions: float
    blades: int
    time_step: float

    @property
    def steps_per_revolution(self) -> float:
        """Steps in a revolution of one blade."""
        return 2.0 * math.pi / (self.speed * self.time_step)

    @property
    def steps(self) -> float:
        """Steps of all blades together."""
        return self.revolutions * self.blades * self.steps_per_revolution

    @property
    def cpu_time(self) -> float:
        """About how long it takes (s)."""
        return self.steps * SECONDS_PER_STEP

    @property
    def wording(self) -> str:
        """How many steps it has."""
        blade_text = f" of {self.blades} blades" if self.blades > 1 else ""
        return f"a run of {self.steps:.3g} steps ({self.revolutions:.6g} revolutions{blade_text})"


def length_of_run(settings: Settings, scene: str, speed: float, revolutions: float | None = None) -> RunLength:
    """Length of a run in a scene at a speed (rad/s), with the level's revolutions unless they are given."""
    steps, chosen = settings.fidelity.time_integration, settings.scenes[scene].scene
    blades = 1 if chosen.rotor is None else len(chosen.rotor.numbers)
    step = steps.largest_step(chosen)
    return RunLength(speed, steps.revolutions if revolutions is None else revolutions, blades, step)


def slowest_speeds(settings: Settings) -> dict[str, float]:
    """The lowest speed (rad/s) of each scene's simulations in the sweep."""
    slowest: dict[str, float] = {}
    for (_, scene), plan in settings.speed_plans.items():
        slowest[scene] = min(plan.certain[0], slowest.get(scene, plan.certain[0]))
    return slowest


def most_runs(settings: Settings, blade: str, scene: str) -> int:
    """Simulations of a blade and scene, at most where speeds are adaptive."""
    refinement = settings.config.refinement.scene_refinement(settings.scenes[scene].scene)
    return settings.speed_plans[blade, scene].speed_count(refinement.largest_share)


def fastest_of(settings: Settings, scene: str) -> float:
    """The highest speed (rad/s) of a scene's simulations in the sweep."""
    return max(settings.speed_plans[blade, scene].certain[-1] for blade in settings.blade_names)
