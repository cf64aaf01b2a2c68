"""A blade in a scene, calculated in this process: in a folder laid out as the workflow's results, by its stages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.provenance import Provenance
from r37core.plans.stages import Stage
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.blade_sweep import CAMPBELL, BladeSweep, blade_sweep, shared_speeds
from r37core.sweep.driver import SIMULATIONS, Driver
from r37core.sweep.recipe import LOGGER, run_step, structure_attributes
from r37core.time_integration.initial_motion import InitialMotion

from .jobs import parallel_results
from .stages import simulations_in_words
from .structure_files import cache_folder


@dataclass(frozen=True)
class Calculation:
    """The one blade and the one scene of `settings`, in `folder`, on so many `cores`; the structure comes from the cache."""

    settings: Settings
    folder: Path
    cores: int

    @cached_property
    def sweep(self) -> Sweep:
        """Plan of the sweep of the one blade and scene."""
        return Sweep(self.settings)

    @property
    def run(self) -> Named:
        """Wildcards of its files."""
        ((blade, scene),) = self.settings.speed_plans
        return Named(blade=blade, scene=scene)

    @cached_property
    def made(self) -> Provenance:
        """Provenance of its files."""
        return Provenance(self.settings)

    @cached_property
    def blade_sweep(self) -> BladeSweep:
        """Simulations of the blade in the scene."""
        return blade_sweep(self.settings, **vars(self.run))

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
        # without the second one where no stress is wanted
        for name, stage in zip(self.sweep.models(self.run), self.blade_sweep.models, strict=True):
            link = Path(self.path(name))
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(self._kept(stage))

    def campbell(self) -> Path:
        """The Campbell diagram, that adaptive speeds and crossings begin with. Raises what making it raises."""
        output = Path(self.path(paths.fill(paths.CAMPBELL, blade=self.run.blade)))
        write_dataset(read_dataset(self._kept(CAMPBELL)), output, self.made.structure(self.run))
        return output

    def _kept(self, stage: str) -> Path:
        attributes = structure_attributes(self.settings, self.run.blade)
        (file,) = parallel_results([partial(self.blade_sweep.file, stage, cache_folder(), attributes)], 1)
        return file

    def response(self, motion: InitialMotion | None = None) -> Path:
        """All simulations and the file of their response. Raises what they raise. `motion`: that the blade starts in."""
        run, speeds = vars(self.run), shared_speeds(self.settings, **vars(self.run))
        attributes = structure_attributes(self.settings, self.run.blade)
        driver = Driver(self.folder, cache_folder(), attributes, self._run_all, motion)
        campbell = self.campbell() if speeds.plan.refined else None
        name = "/".join(run.values())
        return driver.run({name: self.blade_sweep}, speeds, campbell, {name: str(self.made.sweep(self.run))})[name]

    def _run_all(self, calls: Sequence[Callable[[], Any]], what: str) -> list[Any]:
        if what != SIMULATIONS:
            return parallel_results(calls, self.cores)
        LOGGER.info("%s", simulations_in_words(self.settings, self.run.blade, self.run.scene, str(len(calls))))
        return parallel_results(calls, self.cores, what, "run")
