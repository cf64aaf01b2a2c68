"""The plan of the second motions: of which blades and scenes, from what, and which files are made of them."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from r37core.base.plain import to_plain
from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, scenes_named
from r37core.config.cross_checks import names_are_there, slow_run_can_be_done
from r37core.config.speed_choice import length_of_run
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.provenance import Provenance
from r37core.plans.stages import Stage
from r37core.plans.sweep_plan import Simulations, Sweep

from .choice import MOTIONS
from .section import SECTION, SecondMotionSection, pairs_of

RESPONSE = "<results>/{blade}/{scene}/second_motions_{motion}.nc"
STATES = "<results>/{blade}/{scene}/second_motions_{motion}.npz"
DWELLS = "<results>/{blade}/{scene}/second_motions_dwells.nc"
DATASET, TABLE = "<results>/second_motions.nc", "<results>/second_motions.csv"
ALL_DWELLS, DWELL_TABLE = "<results>/second_motions_dwells.nc", "<results>/second_motions_dwells.csv"

KEPT = ("stress", "static_stress", "wear", "energy", "casing", "motion_kind")
"""Results of a scene that its sweeps keep, too."""


@dataclass(frozen=True)
class SecondMotions:
    """Plan of the second motions that a run asks for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @cached_property
    def pairs(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene."""
        return pairs_of(self.sweep.settings)

    @property
    def runs(self) -> paths.Wildcards:
        """Wildcards of all sweeps."""
        return [{**key, "motion": motion} for key in paths.run_keys(self.pairs) for motion in MOTIONS]

    def swept_files(self, wildcards: Any) -> dict[str, Any]:
        """Files that dwells start from."""
        states = [paths.fill(STATES, blade=wildcards.blade, scene=wildcards.scene, motion=motion) for motion in MOTIONS]
        return {"model": self.sweep.contact_model(wildcards), "states": states}

    def stages(self, made: Provenance) -> dict[str, Stage]:
        """Stage of each rule of a blade and scene."""
        section = self._section
        common = {
            "scene": Simulations(self.sweep).plain_scene,
            # of a run from rest: those of the pipeline
            "choice": lambda of: to_plain(self.sweep.settings.integration_choice(of.blade, of.scene, 0.0)),
            # without any speed where there are none, as the rules are there all the same
            "sweep": to_plain(section.sweep()) if section.asked else None,
            "provenance": made.sweep,
        }
        carried = {
            "motion": lambda wildcards: wildcards.motion,
            "results": lambda wildcards: [each for each in self.sweep.results(wildcards) if each in KEPT],
            "kept": self.sweep.kept,
            "yield_stress": self.sweep.yield_stress,
        }
        return {
            "second_motion_sweep": Stage("second_motions.steps.carry", common | carried),
            "second_motion_dwells": Stage("second_motions.steps.dwell", common | {"dwell": to_plain(section.dwells())}),
        }

    @property
    def _section(self) -> SecondMotionSection:
        return self.sweep.settings.section(SECTION)


def simulated(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The sweeps and dwells themselves."""
    plan = SecondMotions(sweep)
    runs, pairs = plan.runs, paths.run_keys(plan.pairs)
    return {RESPONSE: runs, STATES: runs, DWELLS: pairs}


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """Datasets and tables."""
    plan = SecondMotions(sweep)
    once: paths.Wildcards = [{}] if plan.pairs else []
    return dict.fromkeys((DATASET, TABLE, ALL_DWELLS, DWELL_TABLE), once)


MOST_SPEEDS = 20_000
"""Speeds of a sweep: one job runs all of them."""


def can_be_swept(settings: Settings) -> None:
    """Blades and scenes are there, without rotor or Coriolis force, and the speeds within the model's and not too many."""
    section, document = settings.section(SECTION), settings.documents.config
    if not section.asked:
        return
    names_are_there(settings, ("second_motions",), section)
    sweep, path = section.sweep(), ("second_motions",)
    if settings.structure.coriolis:
        raise document.refusal(path, "sweeps with structure.coriolis: true", "none; they do not carry the Coriolis force yet")
    for scene in [] if section.scenes == "all" else scenes_named(settings, section.scenes):
        entry = settings.scene_designs.entries[scene]
        if entry.rotor is not None:
            raise document.refusal((*path, "scenes"), f"'{scene}', which has a rotor", "scenes of a single blade")
    count = (sweep.last - sweep.first) / sweep.step + 1.0
    if count > MOST_SPEEDS:
        raise document.refusal(path, f"{count:.8g} speeds", f"at most {MOST_SPEEDS}; a larger step has fewer")
    highest = settings.structure.maximum_speed_rad_s
    first_key: KeyPath = (*path, "from_rad_s" if section.from_rpm is None else "from_rpm")
    last_key: KeyPath = (*path, "to_rad_s" if section.to_rpm is None else "to_rpm")
    if sweep.first < sweep.step:
        allowed = f"from the step on, {sweep.step:g}: the motion is carried on to the next speed"
        raise document.refusal(first_key, f"{sweep.first:g} rad/s", allowed)
    if sweep.speeds[-1] > highest:
        raise document.refusal(last_key, f"{sweep.speeds[-1]:g} rad/s", f"up to structure.maximum_speed_rad_s, {highest:g}")
    for number, speed in enumerate(section.dwell.speeds_rad_s):
        if not sweep.first <= speed <= sweep.last:
            between = f"speeds of the sweeps, {sweep.first:g} to {sweep.last:g}"
            raise document.refusal((*path, "dwell", "speeds_rad_s", number), f"{speed:g} rad/s", between)
    runs = []
    for _, scene in pairs_of(settings):
        if sweep.worn and section.scenes != "all" and settings.scenes[scene].scene.lining is None:
            raise document.refusal((*path, "lining"), f"worn in the scene '{scene}', which has no lining", "new")
        longest = max(sweep.revolutions, section.dwell.revolutions, settings.scenes[scene].revolutions)
        runs.append(length_of_run(settings, scene, sweep.first, longest))
    if runs:
        slow_run_can_be_done(max(runs, key=lambda run: run.steps), settings, first_key)


EXTENSION = Extension(
    name="second_motions",
    section=SECTION,
    checks=(can_be_swept,),
    simulated=simulated,
    targets=targets,
    offers={"motions": DATASET},
    figures=(
        Figure(
            rule="second_motions_figure",
            name="second_motions_{blade}__{scene}",
            runs=lambda sweep: paths.run_keys(pairs_of(sweep.settings)),
            draw="second_motions.figures.draw_second_motions",
            files={"motions": DATASET, "dwells": DWELL_TABLE},
            label="second motions",
            caption="Blade {blade} in scene {scene}, carried up and down the speeds, and from rest. Motion of the leading "
            "edge, normal and tangential together, with its scatter over the revolutions. Shaded: the motions differ by more "
            "than they scatter. Then the median stress, the largest motion's share of a long time, and Lyapunov exponents.",
        ),
        Figure(
            rule="second_motions_overview",
            name="second_motions_{scene}",
            runs=lambda sweep: paths.of("scene", dict.fromkeys(scene for _, scene in pairs_of(sweep.settings))),
            draw="second_motions.figures.draw_overview",
            files={"motions": DATASET},
            label="second motions of all",
            caption="All blades in scene {scene}, carried up and down through the speeds, and from rest. Shaded: the motions "
            "differ by more than they scatter.",
        ),
    ),
    closing="second_motions.tables.closing",
    look_at=TABLE,
)
