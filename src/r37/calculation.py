"""Steps of the workflow done for some settings, in a folder that is laid out as the workflow's results."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import count
from pathlib import Path
from typing import Any

from r37core.config import Settings
from r37core.dataset_file import read_dataset, write_dataset
from r37core.io import Named
from r37core.plans import paths
from r37core.plans.provenance import Provenance
from r37core.plans.rounds_plan import Rounds
from r37core.plans.samples import NOMINAL, Pair, Sample, path_part
from r37core.plans.simulation_plan import Simulations
from r37core.plans.sweep_plan import Sweep
from r37core.product.sampling import beside
from r37core.speeds import exact_text
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.speed_job import run_job

from .jobs import in_parallel, run_step
from .stages import LOGGER
from .structure_files import Recipe, StructureFiles


@dataclass(frozen=True)
class Calculation:
    """What the workflow makes of `settings`, made in `folder` on so many `cores`; structures come from the cache.

    `only`: folders of samples, such as `search/d0003`, that are made in place of the nominal sweep and those beside it.
    """

    settings: Settings
    folder: Path
    cores: int
    only: tuple[str, ...] | None = None

    @cached_property
    def samples(self) -> Mapping[str, Mapping[Pair, Sample]]:
        """Members of samples, by the folder that they lie in."""
        return beside(self.settings, self.folder)

    @cached_property
    def sweep(self) -> Sweep:
        """Its plan."""

        def round_file(**wildcards: Any) -> str:
            return self.path(paths.fill(paths.ROUND, **wildcards))

        return Sweep(self.settings, round_file, self.samples)

    @property
    def simulations(self) -> Simulations:
        """Parameters of its simulations."""
        return Simulations(self.sweep)

    @cached_property
    def made(self) -> Provenance:
        """What its files say about their making."""
        return Provenance(self.settings, self.samples)

    @property
    def groups(self) -> Iterator[Named]:
        """Wildcards of all samples: the nominal ones first, then those of members."""
        every = {NOMINAL: self.settings.speed_plans, **self.samples}
        for folder, pairs in every.items() if self.only is None else ((name, self.samples[name]) for name in self.only):
            for blade, scene in pairs:
                yield Named(member=path_part(folder), blade=blade, scene=scene)

    @property
    def runs(self) -> Iterator[Named]:
        """Wildcards of all members of the samples."""
        for group in self.groups:
            for name in self.sweep.samples.sample(group).members:
                yield _with(group, member=group.member + path_part(name))

    def path(self, file: str) -> str:
        """A file of the workflow's results, in the folder."""
        return file.replace("<results>", str(self.folder))

    def task(self, step: str, input: Mapping[str, Any], output: Mapping[str, str], **params: Any) -> Callable[[], None]:
        """A step with files of the results, to be called."""
        inputs = {key: self.path(of) if isinstance(of, str) else [*map(self.path, of)] for key, of in input.items()}
        outputs = {key: self.path(file) for key, file in output.items()}
        return partial(run_step, step, inputs, outputs, params)

    def step(self, step: str, input: Mapping[str, Any], output: Mapping[str, str], **params: Any) -> None:
        """Do a step with files of the results. Raises what it raises."""
        in_parallel([self.task(step, input, output, **params)], 1)

    def models(self) -> None:
        """What simulations start from, of all blades and members. Raises what making it raises."""
        wanted: dict[str, Recipe] = {}
        for run in self.runs:
            files, tip_line = self._structure(run), self.settings.scenes[run.scene].tip_line
            wanted[self.sweep.contact_model(run)] = files.contact_model(tip_line)
            wanted |= {file: files.stress_operator(tip_line) for file in self.sweep.stress_operator(run)}
        self.linked(wanted)

    def linked(self, wanted: Mapping[str, Recipe]) -> None:
        """Give files of the cache their names in the folder. Raises what making them raises."""
        for name, file in self._kept(wanted).items():
            link = Path(self.path(name))
            if not link.exists():
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(file)

    def campbells(self) -> None:
        """Campbell diagrams of all blades and members; of samples `only`, theirs alone. Raises what making them raises."""
        runs = self.runs if self.only is None else self.groups
        models = {(run.blade, self.sweep.samples.model(run)): run for run in runs}
        wanted = {
            paths.fill(paths.CAMPBELL, blade=blade, member=model): self._structure(run).campbell()
            for (blade, model), run in models.items()
        }
        for (name, file), (blade, model) in zip(self._kept(wanted).items(), models, strict=True):
            provenance = self.made.structure(Named(blade=blade, member=model))
            write_dataset(read_dataset(file), self.path(name), provenance)

    def _structure(self, run: Named) -> StructureFiles:
        return StructureFiles(self.settings, run.blade, self.samples, self.sweep.samples.model(run))

    def _kept(self, wanted: Mapping[str, Recipe]) -> dict[str, Path]:
        """Files of the cache, under the names that they have in the results: those of each blade one after another."""
        of_blades: dict[Path, list[str]] = {}
        for name in wanted:
            of_blades.setdefault(Path(name).parent, []).append(name)
        calls = [partial(_files, {name: wanted[name] for name in names}) for names in of_blades.values()]
        files = {name: file for made in in_parallel(calls, self.cores) for name, file in made.items()}
        return {name: files[name] for name in wanted}

    def responses(self, motion: InitialMotion | None = None) -> None:
        """All simulations and the response of each run. Raises what they raise.

        Adaptive speeds go from round to round, those of all samples at once. `motion`: that the blade starts in.
        """
        self.models()
        adaptive = [group for group in self.groups if self.sweep.speed_plan(group).refined]
        certain = [run for run in self.runs if not self.sweep.speed_plan(run).refined]
        if adaptive:
            self.campbells()
        self._simulate([(run, speed) for run in certain for speed in self.sweep.speed_plan(run).certain], motion)
        for number in count():
            adaptive = [group for group in adaptive if self._round(group, number)]
            if not adaptive:
                break
            self._simulate([(run, speed) for group in adaptive for run, speed in self._new(group, number)], motion)
        in_parallel([self._response(run) for run in self.runs], self.cores)

    def _round(self, group: Named, number: int) -> bool:
        """Whether a round of a sample asks for speeds."""
        at, rounds = _with(group, round=str(number)), Rounds(self.sweep)
        self.step(
            "adaptive.steps.refine",
            rounds.round_inputs(at),
            {"round": paths.fill(paths.ROUND, **vars(at))},
            plan=rounds.refined_plan(at),
            choice=rounds.refinement_choice(at),
            yields=rounds.yields_of_round(at),
        )
        return bool(self.sweep.new_speeds(group, number))

    def _new(self, group: Named, number: int) -> Iterator[tuple[Named, float]]:
        """Simulations that a round of a sample asks for."""
        for name in self.sweep.samples.sample(group).members:
            for speed in self.sweep.new_speeds(group, number):
                yield _with(group, member=group.member + path_part(name)), speed

    def _simulate(self, simulations: Sequence[tuple[Named, float]], motion: InitialMotion | None) -> None:
        if min(self.cores, len(simulations)) > 1:
            # compiled once, before several processes ask for it
            for run in {(run.blade, run.scene): run for run, _ in simulations}.values():
                self._prepare(run)
        runs = Counter((run.blade, run.scene) for run, _ in simulations)
        for (blade, scene), number in runs.items():
            level = self.settings.fidelity_name
            LOGGER.info("%s in %s: %d simulation%s, level %s", blade, scene, number, "s" if number > 1 else "", level)
        calls = [self._simulation(run, speed, motion) for run, speed in simulations]
        in_parallel(calls, self.cores, "simulations", "run")

    def _prepare(self, run: Named) -> None:
        self.step(
            "time_integration.speed_job.prepare",
            {"models": self.sweep.models(run)},
            {},
            scene=self.simulations.plain_scene(run),
            speed=self.settings.structure.maximum_speed_rad_s,
            choice=self.simulations.choice_of_scene(run),
        )

    def _simulation(self, run: Named, speed: float, motion: InitialMotion | None) -> Callable[[], None]:
        text = exact_text(speed)
        task = self.simulations.task(_with(run, speed=text))
        (output,) = map(self.path, paths.speed_files(run.member, run, [speed]))
        about, models = str(self.made.sweep(run)), [self.path(file) for file in self.sweep.models(run)]
        return partial(run_job, text, output, task, about, *models, motion=motion)

    def _response(self, run: Named) -> Callable[[], None]:
        files = self.sweep.speed_files(run)
        return self.task(
            "results.steps.response",
            {"speeds": files},
            {"response": paths.fill(paths.RESPONSE, **vars(run))},
            speeds=self.sweep.speeds(run, Named(speeds=files)),
            stress_history_speeds=self.sweep.stress_history_speeds(run),
            yield_stress=self.sweep.yield_stress(run),
            provenance=self.made.sweep(run),
        )


def _files(recipes: Mapping[str, Recipe]) -> dict[str, Path]:
    return {name: recipe.file() for name, recipe in recipes.items()}


def _with(wildcards: Named, **more: str) -> Named:
    return Named(**(vars(wildcards) | more))
