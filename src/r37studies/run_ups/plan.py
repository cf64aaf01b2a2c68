"""The plan of the run-ups: of which blades and scenes, from what, and which files are made of them."""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

from r37core.base.plain import to_plain
from r37core.base.yaml_file import KeyPath
from r37core.config import Settings, blades_named, scenes_named
from r37core.config.cross_checks import engine_order_is_known, names_are_there, slow_run_can_be_done
from r37core.config.document import ConfigRefusals
from r37core.config.elastic_casings import elastic_casings, remarks_on_overtaken_waves, waves_are_simulated
from r37core.config.settings import fastest_of, length_of_run
from r37core.plans import paths
from r37core.plans.extension import Extension, Figure
from r37core.plans.extent import Pair, Runs
from r37core.plans.stages import Stage
from r37core.plans.sweep_plan import Sweep
from r37core.time_integration.integration_choice import IntegrationChoice

from .choice import RunUpChoice, RunUpError, check_highest
from .section import SECTION, RunUpEntry

RUN_UP = "<results>/{blade}/{scene}/run_up_{run_up}.npz"
DATASET, TABLE, RATES = "<results>/run_ups.nc", "<results>/run_ups.csv", "<results>/run_up_rates.csv"


@dataclass(frozen=True)
class RunUps:
    """Plan of the run-ups that the configuration asks for. Methods with `wildcards` are inputs and parameters of rules."""

    sweep: Sweep

    @property
    def files(self) -> paths.Wildcards:
        """Wildcards of the files of all run-ups: blade, scene and name."""
        return [{"blade": blade, "scene": scene, "run_up": name} for blade, scene, name in self.runs]

    @property
    def runs(self) -> list[tuple[str, str, str]]:
        """Blade, scene and name of each, in the order of the dataset."""
        return [(*pair, name) for pair, named in self.choices.items() for name in named]

    @cached_property
    def choices(self) -> dict[tuple[str, str], dict[str, RunUpChoice]]:
        """Run-ups of each blade and scene, by name."""
        settings = self.sweep.settings
        choices: dict[tuple[str, str], dict[str, RunUpChoice]] = {pair: {} for pair in settings.speed_plans}
        for name, entry in settings.section(SECTION).items():
            blades, scenes = blades_named(settings, entry.blades), scenes_named(settings, entry.scenes)
            for blade, scene in set(product(blades, scenes)) & set(choices):
                choices[blade, scene][name] = entry.choice(settings.scenes[scene].revolutions)
        return choices

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that a run-up starts from, with the stress operator where its stress is wanted."""
        files = self.sweep.run_inputs(wildcards)
        if self._choice(wildcards).crossing:
            files["campbell"] = paths.CAMPBELL.format(blade=wildcards.blade)
        return files

    def stage(self) -> Stage:
        """Stage of a run-up."""
        return Stage(
            "r37studies.run_ups.steps.record",
            {
                "name": lambda wildcards: wildcards.run_up,
                "scene": self.sweep.plain_scene,
                "choice": lambda run: to_plain(self.integration_choice(run.blade, run.scene, run.run_up)),
                "run_up": lambda wildcards: to_plain(self._choice(wildcards)),
                "results": lambda wildcards: list(self.sweep.results(wildcards)),
                "highest_order": self.sweep.settings.fidelity.time_integration.spectrum_highest_order,
                "yield_stress": self.sweep.yield_stress,
                "strengths": self.sweep.strengths,
                "provenance": self.sweep.provenance,
            },
        )

    def _choice(self, wildcards: Any) -> RunUpChoice:
        return self.choices[wildcards.blade, wildcards.scene][wildcards.run_up]

    def integration_choice(self, blade: str, scene: str, name: str) -> IntegrationChoice:
        """Numbers of the time integration of a run-up: those of the sweep, with stress in every revolution."""
        choice = self.sweep.settings.integration_choice(blade, scene)
        before = self.choices[blade, scene][name].before
        snapshot_revolutions = before if choice.snapshots_per_revolution else 0
        return replace(choice, revolutions=before, until_settled=False, snapshot_revolutions=snapshot_revolutions)


def _pairs(sweep: Sweep) -> paths.Wildcards:
    return paths.run_keys(pair for pair, named in RunUps(sweep).choices.items() if named)


def further_runs(settings: Settings) -> dict[Pair, Runs]:
    """Run-ups of each blade and scene; about a crossing they are at most so long, as it lies below the highest speed."""
    samples, highest = settings.fidelity.time_integration.samples_per_revolution, settings.structure.maximum_speed_rad_s
    runs = {}
    for pair, named in RunUps(Sweep(settings)).choices.items():
        ups = [choice.run_up(samples, highest if choice.crossing else None) for choice in named.values()]
        revolutions = sum((1 + up.worn) * (up.before + up.revolutions + up.after) for up in ups)
        if ups:
            runs[pair] = Runs(len(ups), length=revolutions / settings.scenes[pair[1]].revolutions)
    return runs


def remarks(settings: Settings) -> list[str]:
    """Remarks on elastic casings that only a run-up overtakes, as far as no crossing decides its speeds."""
    lines: list[str] = []
    choices = RunUps(Sweep(settings)).choices
    for name, casing in elastic_casings(settings).items():
        scene_choices = [choice for (_, scene), named in choices.items() if scene == name for choice in named.values()]
        fastest = max((max(choice.start, choice.stop) for choice in scene_choices if choice.crossing is None), default=0.0)
        if fastest > fastest_of(settings, name):
            lines += remarks_on_overtaken_waves(name, casing, fastest)
    return lines


def run_ups_can_be_done(settings: Settings) -> None:
    """Run-ups name blades, scenes and orders that are there, and can be done in them at these speeds."""
    refusals = ConfigRefusals()
    for name, entry in settings.section(SECTION).items():
        refusals.of(_can_be_done, settings, name, entry)
    refusals.tell()


def _can_be_done(settings: Settings, name: str, entry: RunUpEntry) -> None:
    path: KeyPath = ("run_ups", name)
    names_are_there(settings, path, entry)
    time, document = settings.fidelity.time_integration, settings.document
    choice, highest = entry.choice(time.revolutions), settings.structure.maximum_speed_rad_s
    with document.blamed((*path, entry.key_of_length), RunUpError):
        # of a crossing what holds wherever it lies: the higher, the more revolutions
        run_up = choice.run_up(time.samples_per_revolution, highest if entry.crossing else None)
        if entry.crossing is None:
            check_highest(max(choice.start, choice.stop), highest)
    if entry.crossing:
        engine_order_is_known(settings, (*path, "crossing", "engine_order"), entry.crossing.engine_order)
    for scene in scenes_named(settings, entry.scenes):
        if entry.lining == "worn" and settings.scene_designs.entries[scene].lining is None:
            lining = f"worn in the scene '{scene}', which has no lining"
            raise document.refusal(lining, "new, or scenes with a lining", *path, "lining")
        if scene in settings.scenes and settings.scenes[scene].scene.rotor is not None:
            allowed = "scenes of a single blade; the speed of a rotor does not change while it runs"
            raise document.refusal(f"'{scene}', which has a rotor", allowed, *path, "scenes")
    # neither the run-up nor a revolution at its slowest speed, whose steps all have, may have too many steps
    for scene in settings.scenes if entry.crossing is None else ():
        revolutions = choice.before + run_up.revolutions + choice.after
        run = length_of_run(settings, scene, min(choice.start, choice.stop), revolutions)
        slow_run_can_be_done(run, settings, path)
        waves_are_simulated(settings, scene, max(choice.start, choice.stop))


EXTENSION = Extension(
    name="run_ups",
    section=SECTION,
    checks=(run_ups_can_be_done,),
    runs=further_runs,
    targets=lambda sweep: {
        RUN_UP: RunUps(sweep).files,
        **dict.fromkeys((DATASET, TABLE, RATES), [{}] if _pairs(sweep) else []),
    },
    offers={"run_ups": DATASET},
    remarks=remarks,
    figures=(
        Figure(
            rule="run_up_figure",
            name="run_ups_{blade}__{scene}",
            runs=_pairs,
            draw="r37studies.run_ups.figures.draw_run_ups",
            files={"run_ups": DATASET},
            label="run-ups",
            caption="Blade {blade} in scene {scene}, run up (solid) and down (dashed) at several rates, the slowest dark. "
            "Crosses: the lining was worn before. Of every revolution over its mean speed: rms of the leading edge's motion "
            "normal to the casing and tangential, largest von Mises stress, and largest wear so far. Dashed line: yield "
            "stress; above it (tinted) the blade is outside the linear model.",
        ),
        Figure(
            rule="run_up_rates_figure",
            name="run_up_rates_{scene}",
            runs=lambda sweep: paths.of("scene", dict.fromkeys(run["scene"] for run in _pairs(sweep))),
            draw="r37studies.run_ups.figures.draw_rates",
            files={"runs": TABLE},
            label="rates",
            caption="Largest von Mises stress of every run-up (left) and run-down (right) in scene {scene} against its rate, "
            "for every blade. Tinted: above yield.",
        ),
    ),
    closing="r37studies.run_ups.tables.closing",
)
