"""From config.yaml and the files it names to the settings that the workflow needs, or to one clear refusal."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from r37core.blade.definition import BladeDefinition
from r37core.config.fidelity import recommended_level
from r37core.contact.scene import Scene
from r37core.exchange.importing.source import MatricesSource
from r37core.rom.reduction_choice import ReductionChoice
from r37core.speeds import SpeedError, SpeedPlan
from r37core.time_integration.integration_choice import LARGEST_TABLE, IntegrationChoice

from .blades import Blades, BladeSettings, blade_settings
from .document import Document, command_line_document, read_document
from .families import Designs, Family, with_designs
from .fidelity import Level, Levels
from .scenes import SceneEntry, Scenes
from .settings import CampbellSection, Config, Interactions, RefinementSection, Run, StructureSection
from .speed_section import UNITS, SpeedRule, key_of_speeds, planned
from .studies import Studies

CONFIG_FILE = "config/config.yaml"

LARGEST_NUMBER_OF_SIMULATIONS = 200_000
"""Jobs that Snakemake can still plan: about 25 kB of memory and 1 ms for each."""


@dataclass(frozen=True)
class SceneSettings:
    """One scene: what the blade meets, on which tip line, how long, and which results are wanted."""

    scene: Scene
    tip_line: str
    revolutions: int
    results: tuple[str, ...]
    stress_history_speeds: tuple[float, ...]


@dataclass(frozen=True)
class Settings:
    """Everything the workflow needs to know, checked.

    `blades` and `scenes` are those to run, in order; `families` those of which some are run; `speed_plans` of each
    (blade, scene); `fidelity` the chosen level;
    `fidelity_is_chosen`: by its measured error;
    `places`: blade -> key -> `file:line: blade.key`, for what is found out later;
    `levels` and `scene_entries` all that their files have, for the studies; the rest as in config.yaml.
    """

    blades: dict[str, BladeSettings]
    scenes: dict[str, SceneSettings]
    families: dict[str, Family]
    speed_plans: dict[tuple[str, str], SpeedPlan]
    fidelity_name: str
    fidelity: Level
    structure: StructureSection
    campbell: CampbellSection
    interactions: Interactions
    refinement: RefinementSection
    studies: Studies
    levels: dict[str, Level]
    scene_entries: dict[str, SceneEntry]
    tolerance: float
    fidelity_is_chosen: bool
    run_name: str | None
    config: Config
    places: dict[str, dict[str, str]]

    @property
    def results(self) -> Path:
        """Folder of the results."""
        return Path("results", "runs", self.run_name) if self.run_name else Path("results")

    @property
    def logs(self) -> Path:
        """Folder of the logs."""
        return Path("logs", "runs", self.run_name) if self.run_name else Path("logs")

    def merged(self) -> dict[str, Any]:
        """What this run is made with, merged from all files and the command line, as plain values."""
        return {
            "config": {key: value for key, value in plain(self.config).items() if key not in self._other_speeds},
            "fidelity": {self.fidelity_name: plain(self.fidelity)},
            "scenes": {name: plain(self.scene_entries[name]) for name in self.scenes},
            "blades": {name: asdict(blade) for name, blade in self.blades.items()},
        }

    @property
    def _other_speeds(self) -> set[str]:
        """The key of the unit that speeds are not given in, which has the default."""
        return set(UNITS) - {key_of_speeds(self.config)}

    @property
    def remarks(self) -> list[str]:
        """What a run should say before it starts."""
        said = []
        measured = self.fidelity.measured
        if self.fidelity_is_chosen and measured is not None:
            error, cost = 100 * measured.error, measured.cpu_s_per_run
            said.append(f"fidelity auto: level {self.fidelity_name}, measured error {error:g}%, {cost:g} CPU s per run")
        refining = [plan for plan in self.speed_plans.values() if plan.refined]
        if refining:
            certain = sum(len(plan.certain) for plan in refining)
            most = sum(plan.at_most(self.refinement.largest_share) for plan in refining)
            said.append(
                f"speeds refine themselves: {certain} simulations and those of the windows first, about {most} at most; "
                "they are planned round by round, so a dry run shows none of those to come"
            )
        return said

    def shape_hash(self, blade: str) -> str:
        """Short hash of all that a blade's geometry depends on."""
        return _short_hash(self.blades[blade].definition, self.structure.edges)

    def structure_hash(self, blade: str) -> str:
        """Short hash of all that a blade's structural results depend on."""
        material = self.blades[blade].material
        elastic = material and replace(material, yield_stress=0.0)
        choice = self.reduction_choice(blade=blade)
        return _short_hash(self.shape_hash(blade), elastic, plain(self.fidelity.mesh), choice)

    def reduction_choice(self, tip_line: str | None = None, blade: str | None = None) -> ReductionChoice:
        """What the reduced model is made of, with contact nodes on `tip_line` or on that of config.yaml.

        `blade`: whose region of stress counts, where it has one of its own.
        """
        submesh = self.blades[blade].stress_submesh if blade else None
        return self.structure.reduction(self.fidelity.reduction, tip_line, submesh)

    def results_of(self, blade: str, scene: str) -> tuple[str, ...]:
        """What is wanted of a scene, as far as the blade can give it: matrices have neither stress nor shapes."""
        wanted = self.scenes[scene].results
        matrices = isinstance(self.blades[blade].definition, MatricesSource)
        return tuple(result for result in wanted if not (matrices and result in ("stress", "shapes")))

    def integration_choice(self, blade: str, scene: str, speed: float) -> IntegrationChoice:
        """Numbers of the time integration at one speed of a blade and scene, with only what its results need."""
        chosen = self.scenes[scene]
        everything = self.fidelity.time_integration.choice()
        stress = "stress" in self.results_of(blade, scene)
        history = speed in chosen.stress_history_speeds
        return replace(
            everything,
            revolutions=chosen.revolutions,
            snapshots_per_revolution=everything.snapshots_per_revolution if stress else 0,
            snapshot_revolutions=(chosen.revolutions if history else 1) if stress else 0,
            energy="energy" in chosen.results,
        )


def plain(section: BaseModel) -> dict[str, Any]:
    """A section as a dictionary of plain values, which Snakemake can compare and a job can read without the models."""
    return section.model_dump(exclude_none=True)


def _short_hash(*parts: object) -> str:
    """Hash of plain numbers, texts and frozen dataclasses, whose repr is exact."""
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:16]


def read_settings(root: Path, *changes: Document) -> Settings:
    """Settings of config/config.yaml in the folder `root`, with `changes` on top. Raises ConfigError."""
    return load_settings(_together(read_document(root, CONFIG_FILE), changes), root)


def settings_of_run(root: Path, files: Sequence[Path], values: Mapping[str, Any], only_given: bool = False) -> Settings:
    """Settings of a run of the workflow in the current folder: the configuration, `files` on top, then `values`.

    The configuration is config/config.yaml of the current folder or, where that has none, of `root`; it is left out if
    `only_given`. Raises ConfigError.
    """
    here = Path.cwd()
    folder = here if (here / CONFIG_FILE).exists() else root
    first = [] if only_given and files else [read_document(folder, CONFIG_FILE)]
    named = [Path(file).relative_to(here) if Path(file).is_relative_to(here) else Path(file) for file in files]
    changes = [*first, *(read_document(here, str(file)) for file in named), command_line_document(values)]
    return load_settings(_together(changes[0], changes[1:]), root)


def _together(below: Document, changes: Iterable[Document]) -> Document:
    for change in changes:
        if not isinstance(change.content, Mapping):
            raise change.refusal((), repr(change.content)[:60], "keys and values, as in config/config.yaml")
        below = _with_one_unit(below, change).overlaid(change)
    return below


def _with_one_unit(below: Document, change: Document) -> Document:
    """The document without speeds in the unit that a change on top does not give its own in."""
    given = [key for key in UNITS if key in change.content]
    if len(given) != 1:
        return below
    return replace(below, content={key: value for key, value in below.content.items() if key not in UNITS or key in given})


def load_settings(config: Document | Mapping[str, Any], root: Path) -> Settings:
    """Check a configuration (the content of config.yaml) and the files it names, relative to the folder `root`.

    Raises ConfigError for anything wrong, before any work is done.
    """
    document = config if isinstance(config, Document) else Document(CONFIG_FILE, dict(config))
    checked = document.check(Config)
    files = _Files(
        document, *(read_document(root, name) for name in (checked.blades_file, checked.fidelity_file, checked.scenes_file))
    )
    levels, scenes = files.levels.check(Levels).root, files.scenes.check(Scenes).root
    designs = with_designs(files.blades.check(Blades).root, root, files.blades)
    blades, files = designs.entries, replace(files, blades=designs.document)
    fidelity_name = _level_name(checked, levels, files)
    level = levels[fidelity_name]
    names = _part_of(_chosen_blades(checked, designs, files), checked.run, files.config)
    scene_names = files.known(("scenes",), list(scenes) if checked.scenes == "all" else checked.scenes, scenes, files.scenes)
    _check_studies(checked.studies, blades, levels, scenes, files)
    chosen_scenes = {name: _scene(scenes[name], level, checked.structure.boundary.tip_line) for name in scene_names}
    plans = _speed_plans(checked, names, scene_names, level.time_integration.speed_step_rad_s, blades, scenes, files)
    _check_windows(checked, plans, files.config)
    _check_history_speeds(chosen_scenes, scenes, plans, files.scenes)
    _check_exports(checked, plans, files.config)
    slowest = min(plan.certain[0] for plan in plans.values())
    _check_slowest(level, checked.structure.boundary.nodes, slowest, ("speeds",), files.config)
    _check_signals(checked, level, blades, chosen_scenes, files)
    chosen_blades = {name: blade_settings(name, blades, root, files.blades) for name in names}
    _check_matrices(chosen_blades, checked, files.config)
    _check_families(chosen_blades, designs, files.blades)
    return Settings(
        blades=chosen_blades,
        scenes=chosen_scenes,
        families={name: family for name, family in designs.families.items() if set(family.designs) & set(names)},
        speed_plans=plans,
        fidelity_name=fidelity_name,
        fidelity=level,
        structure=checked.structure,
        campbell=checked.campbell,
        interactions=checked.interactions,
        refinement=checked.refinement,
        studies=checked.studies,
        levels=levels,
        scene_entries=scenes,
        tolerance=checked.tolerance,
        fidelity_is_chosen=checked.fidelity == "auto",
        run_name=checked.run.name,
        config=checked,
        places={name: _places(name, blades, files.blades) for name in names},
    )


def _chosen_blades(checked: Config, designs: Designs, files: _Files) -> list[str]:
    """Names of the blades to run; that of a family is all of its designs."""
    if checked.blades == "all":
        return list(designs.entries)
    files.known(("blades",), checked.blades, [*designs.entries, *designs.families], files.blades)
    several = [list(designs.families[name].designs) if name in designs.families else [name] for name in checked.blades]
    return list(dict.fromkeys(name for names in several for name in names))


def _part_of(names: list[str], run: Run, document: Document) -> list[str]:
    """The blades of the run's part; ConfigError where that has none."""
    chosen = run.of_part(names)
    if not chosen:
        raise document.refusal(("run", "part"), f"{run.part} of {len(names)} blades", f"at most {len(names)} parts")
    return chosen


@dataclass(frozen=True)
class _Files:
    """The documents that a message may have to point into."""

    config: Document
    blades: Document
    levels: Document
    scenes: Document

    def known(self, path: tuple[str | int, ...], names: Sequence[str], entries: Iterable[str], file: Document) -> list[str]:
        """`names`, which stand at `path` of config.yaml; ConfigError for one that `file` lacks."""
        for name in names:
            if name not in (known := list(entries)):
                raise self.config.refusal(path, f"'{name}'", f"{', '.join(known)} ({file.name})")
        return list(names)


def _level_name(checked: Config, levels: Mapping[str, Level], files: _Files) -> str:
    """The level that is named, or for `auto` the cheapest one whose measured error is within the tolerance."""
    if checked.fidelity != "auto":
        return files.known(("fidelity",), [checked.fidelity], levels, files.levels)[0]
    errors = {name: level.measured.error for name, level in levels.items() if level.measured}
    costs = {name: level.measured.cpu_s_per_run for name, level in levels.items() if level.measured}
    chosen = recommended_level(errors, costs, checked.tolerance)
    if chosen is None:
        known = ", ".join(f"{name} {error:g}" for name, error in errors.items()) or "none"
        raise files.config.error(
            ("tolerance",),
            f"found {checked.tolerance:g}; measured errors of the levels in {files.levels.name}: {known}; "
            "accept more, or name a level under fidelity",
        )
    return chosen


def _check_studies(
    studies: Studies,
    blades: Mapping[str, Any],
    levels: Mapping[str, Level],
    scenes: Mapping[str, SceneEntry],
    files: _Files,
) -> None:
    """ConfigError for a name in the section `studies` that its file lacks, and for a scene without what its role needs."""
    for name in ("tradeoff", "readings", "stability"):
        study = getattr(studies, name)
        if study is None or name not in studies.model_fields_set:
            continue
        if name != "readings":
            files.known(("studies", name, "blade"), [study.blade], blades, files.blades)
        files.known(("studies", name, "base"), [study.base], levels, files.levels)
    if "readings" in studies.model_fields_set:
        files.known(("studies", "readings", "quick"), [studies.readings.quick], levels, files.levels)
    if studies.tradeoff:
        given = studies.tradeoff
        files.known(("studies", "tradeoff", "parameters", "level"), given.parameters.level.values, levels, files.levels)
        if given.scenes != "all":
            files.known(("studies", "tradeoff", "scenes"), given.scenes, scenes, files.scenes)
    for name in ("readings", "stability"):
        if name in studies.model_fields_set:
            study = getattr(studies, name)
            files.known(("studies", name, "lined_scene"), [study.lined_scene], scenes, files.scenes)
            files.known(("studies", name, "direct_scene"), [study.direct_scene], scenes, files.scenes)


def _scene(entry: SceneEntry, level: Level, tip_line: str) -> SceneSettings:
    return SceneSettings(
        scene=entry.scene(),
        tip_line=entry.tip_line or tip_line,
        revolutions=entry.revolutions or level.time_integration.revolutions,
        results=tuple(entry.results),
        stress_history_speeds=tuple(map(float, entry.stress_history_speeds())),
    )


def _speed_plans(
    checked: Config,
    blades: Sequence[str],
    scenes: Sequence[str],
    default_step: float,
    all_blades: Iterable[str],
    all_scenes: Iterable[str],
    files: _Files,
) -> dict[tuple[str, str], SpeedPlan]:
    def plan(section: Config | SpeedRule, path: tuple[str | int, ...]) -> SpeedPlan:
        try:
            return planned(section, default_step)
        except SpeedError as error:
            raise files.config.error((*path, key_of_speeds(section)), str(error)) from None

    general = plan(checked, ())
    special = []
    for number, rule in enumerate(checked.speeds_for):
        files.known(("speeds_for", number, "blades"), rule.blades or [], all_blades, files.blades)
        files.known(("speeds_for", number, "scenes"), rule.scenes or [], all_scenes, files.scenes)
        special.append((rule, plan(rule, ("speeds_for", number))))

    def of(blade: str, scene: str) -> SpeedPlan:
        return next((plan for rule, plan in special if rule.fits(blade, scene)), general)

    together = {(blade, scene): of(blade, scene) for blade in blades for scene in scenes}
    number_of_all = sum(len(plan.certain) for plan in together.values())
    if number_of_all > LARGEST_NUMBER_OF_SIMULATIONS:
        raise files.config.refusal(
            ("speeds",),
            f"{number_of_all} simulations of {len(blades)} blades in {len(scenes)} scenes",
            f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run; more in parts (run.part, docs/cluster.md)",
        )
    return together


def _check_windows(checked: Config, plans: Mapping[tuple[str, str], SpeedPlan], document: Document) -> None:
    """ConfigError for a window above crossings that the Campbell diagram does not have."""
    highest = checked.campbell.highest_engine_order
    for number, window in enumerate(checked.refinement.windows):
        if window.highest_engine_order > highest and any(plan.refined for plan in plans.values()):
            raise document.refusal(
                ("refinement", "windows", number, "highest_engine_order"),
                f"{window.highest_engine_order}",
                f"at most campbell.highest_engine_order ({highest})",
            )


def _check_history_speeds(
    scenes: Mapping[str, SceneSettings],
    entries: Mapping[str, SceneEntry],
    plans: Mapping[tuple[str, str], SpeedPlan],
    document: Document,
) -> None:
    for name, chosen in scenes.items():
        run = {speed for (_, scene), plan in plans.items() if scene == name for speed in plan.certain}
        key = "stress_history_speeds_rpm" if entries[name].stress_history_speeds_rpm else "stress_history_speeds_rad_s"
        for given, speed in zip(getattr(entries[name], key), chosen.stress_history_speeds, strict=True):
            if speed not in run:
                raise document.refusal(
                    (name, key),
                    f"{given:g}",
                    "speeds that are simulated (add it to speeds or speeds_for in config.yaml)",
                )


def _check_families(blades: Mapping[str, BladeSettings], designs: Designs, document: Document) -> None:
    """ConfigError for a family of an imported blade: what is compared of designs needs their shape."""
    for name, family in designs.families.items():
        if any(not isinstance(blades[design].definition, BladeDefinition) for design in family.designs if design in blades):
            raise document.refusal((name,), "a family of an imported blade", "families of blades with profiles")


def _check_exports(checked: Config, plans: Mapping[Any, SpeedPlan], document: Document) -> None:
    """ConfigError for a speed of `exports` that is not simulated whatever is found, or beyond the reduced model's basis."""
    given, highest = checked.exports, checked.structure.maximum_speed_rad_s
    run = {speed for plan in plans.values() for speed in plan.certain}
    key = "stress_speeds_rad_s" if given.stress_speeds_rpm is None else "stress_speeds_rpm"
    allowed = "speeds that are simulated whatever a range refines to; name it under speeds, too"
    for number, speed in enumerate(given.stress_speeds() or []):
        if speed not in run:
            raise document.refusal(("exports", key, number), f"{getattr(given, key)[number]:g}", allowed)
    for number, speed in enumerate(given.mode_speeds_rad_s or []):
        if speed > highest:
            allowed = f"up to structure.maximum_speed_rad_s, {highest:g}"
            raise document.refusal(("exports", "mode_speeds_rad_s", number), f"{speed:g}", allowed)


def _check_signals(
    checked: Config, level: Level, blades: Iterable[str], scenes: Mapping[str, SceneSettings], files: _Files
) -> None:
    """ConfigError for signals of a blade that is not there, of no scene, or longer than a scene's runs."""
    given = checked.signals
    if given.blades != "all":
        files.known(("signals", "blades"), given.blades, blades, files.blades)
    speeds, path = given.speeds(), ("signals", given.key_of_speeds)
    if speeds is None:
        return
    if isinstance(speeds, list):
        _check_slowest(level, checked.structure.boundary.nodes, speeds[0], path, files.config)
    with_signal = {name: scene for name, scene in scenes.items() if "signal" in scene.results}
    if not with_signal:
        raise files.config.refusal(
            path,
            "speeds, though no scene that is run has signal among its results",
            f"such a scene ({', '.join(scenes)} of {files.scenes.name} are run), or no speeds",
        )
    for name, scene in with_signal.items():
        if given.revolutions is not None and given.revolutions > scene.revolutions:
            raise files.config.refusal(
                ("signals", "revolutions"), f"{given.revolutions}", f"at most those of a run, {scene.revolutions} in '{name}'"
            )


def _check_slowest(level: Level, nodes: int, slowest: float, path: tuple[str, ...], document: Document) -> None:
    """ConfigError for a slowest speed, given at `path`, whose revolution has too many steps."""
    size = 8 * nodes * 2.0 * math.pi / slowest / level.time_integration.time_step_s
    if size > LARGEST_TABLE:
        raise document.refusal(
            path,
            f"{slowest:g} rad/s, a revolution of {size / 8 / nodes:.3g} steps of {level.time_integration.time_step_s:g} s",
            f"speeds from {slowest * size / LARGEST_TABLE:.3g} rad/s with this step (the casing's shape at every step has to "
            "fit in memory)",
        )


def _places(blade: str, entries: Mapping[str, Any], document: Document) -> dict[str, str]:
    """Where each key of a blade's entry, or of the entry that its base has it from, stands."""
    entry = entries[blade]
    if base := getattr(entry, "base", None):
        return _places(base, entries, document)
    return {key: f"{document.place((blade, key))}: {blade}.{key}" for key in type(entry).model_fields}


def _check_matrices(blades: Mapping[str, BladeSettings], checked: Config, document: Document) -> None:
    """ConfigError for a term of rotation that cannot be added to matrices of another program."""
    given = [name for name, blade in blades.items() if isinstance(blade.definition, MatricesSource)]
    for key in ("spin_softening", "coriolis"):
        if given and getattr(checked.structure, key):
            raise document.refusal(
                ("structure", key),
                f"true with the blade '{given[0]}', given by matrices",
                "false; put the term into its K_<speed>",
            )


def checked_scene(entry: Mapping[str, Any]) -> Scene:
    """The scene of one entry of scenes.yaml; ConfigError where the model of scenes forbids it."""
    return Document("scenes.yaml", dict(entry)).check(SceneEntry).scene()
