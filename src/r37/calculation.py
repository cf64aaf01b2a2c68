"""A blade in a scene, calculated in this process: in a folder laid out as the workflow's results, by its stages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import count
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named
from r37core.base.speeds import exact_text
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.provenance import Provenance
from r37core.plans.samples import NOMINAL
from r37core.plans.stages import Stage, sweep_stages
from r37core.plans.sweep_plan import Rounds, Simulations, Sweep
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.speed_job import run_job

from .jobs import parallel_results, run_step
from .stages import LOGGER, simulations_in_words
from .structure_files import structure_file


@dataclass(frozen=True)
class Calculation:
    """The one blade and the one scene of `settings`, in `folder`, on so many `cores`; the structure comes from the cache."""

    settings: Settings
    folder: Path
    cores: int

    @cached_property
    def sweep(self) -> Sweep:
        """Plan of the sweep of the one blade and scene."""
        return Sweep(self.settings, lambda **wildcards: self.path(paths.fill(paths.ROUND, **wildcards)))

    @property
    def run(self) -> Named:
        """Wildcards of its files."""
        ((blade, scene),) = self.settings.speed_plans
        return Named(member=NOMINAL, blade=blade, scene=scene)

    @cached_property
    def made(self) -> Provenance:
        """Provenance of its files."""
        return Provenance(self.settings)

    def path(self, file: str) -> str:
        """A file of the workflow's results, in the folder."""
        return file.replace("<results>", str(self.folder))

    def do(self, stage: Stage, input: Mapping[str, Any], output: Mapping[str, str], **wildcards: str) -> None:
        """Do a stage with files of the results. Raises what its step raises."""
        files = {key: self.path(of) if isinstance(of, str) else [*map(self.path, of)] for key, of in input.items()}
        outputs = {key: self.path(file) for key, file in output.items()}
        params = stage.values(Named(**vars(self.run), **wildcards), Named(**files))
        parallel_results([partial(run_step, stage.step, files, outputs, params)], 1)

    def models(self) -> None:
        """The reduced model and the contact model of this call. Raises what making them raises."""
        tip_line = self.settings.scenes[self.run.scene].tip_line
        # without the second one where no stress is wanted
        for name, stage in zip(self.sweep.models(self.run), ("contact_model", "stress_operator"), strict=False):
            link = Path(self.path(name))
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(self._kept(stage, tip_line))

    def campbell(self) -> None:
        """The Campbell diagram, that adaptive speeds and crossings begin with. Raises what making it raises."""
        output = self.path(paths.fill(paths.CAMPBELL, blade=self.run.blade))
        write_dataset(read_dataset(self._kept("campbell_of_blade")), output, self.made.structure(self.run))

    def _kept(self, stage: str, tip_line: str | None = None) -> Path:
        return structure_file(self.settings, self.run.blade, stage, tip_line)

    def response(self, motion: InitialMotion | None = None) -> str:
        """All simulations and the file of their response. Raises what they raise. `motion`: that the blade starts in."""
        self.models()
        plan, stages = self.sweep.speed_plan(self.run), sweep_stages(self.sweep, self.made)
        if plan.refined:
            self.campbell()
            for number in count():
                at = {"round": str(number)}
                inputs = Rounds(self.sweep).round_inputs(Named(**vars(self.run), **at))
                self.do(stages["refine"], inputs, {"round": paths.fill(paths.ROUND, **vars(self.run), **at)}, **at)
                if not (new := self.sweep.new_speeds(self.run, number)):
                    break
                self._simulate(new, motion)
        else:
            self._simulate(plan.certain, motion)
        response = paths.fill(paths.RESPONSE, **vars(self.run))
        self.do(stages["response"], {"speeds": self.sweep.speed_files(self.run)}, {"response": response})
        return self.path(response)

    def _simulate(self, speeds: Sequence[float], motion: InitialMotion | None) -> None:
        if min(self.cores, len(speeds)) > 1:
            # compiled once, before several processes ask for it
            prepare = sweep_stages(self.sweep, self.made)["prepare_time_integration"]
            self.do(prepare, {"models": self.sweep.models(self.run)}, {})
        LOGGER.info("%s", simulations_in_words(self.settings, self.run.blade, self.run.scene, str(len(speeds))))
        parallel_results([self._simulation(speed, motion) for speed in speeds], self.cores, "simulations", "run")

    def _simulation(self, speed: float, motion: InitialMotion | None) -> Callable[[], None]:
        text = exact_text(speed)
        task = Simulations(self.sweep).task(Named(**vars(self.run), speed=text))
        (output,) = map(self.path, paths.speed_files(NOMINAL, self.run, [speed]))
        about, models = str(self.made.sweep(self.run)), [self.path(file) for file in self.sweep.models(self.run)]
        return partial(run_job, text, output, task, about, *models, motion=motion)
