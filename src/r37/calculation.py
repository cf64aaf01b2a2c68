"""A blade in a scene, calculated in this process: its structure comes from the user's cache."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from r37core.base.io import Named
from r37core.config import ConfigError, Settings
from r37core.machine_code.kept import named_folder, writable_folder
from r37core.plans.provenance import Attributes, Provenance
from r37core.sweep.blade_sweep import CAMPBELL, BladeSweep, blade_sweep, shared_speeds
from r37core.sweep.driver import SIMULATIONS, Driver
from r37core.sweep.recipe import LOGGER, recipes, structure_attributes
from r37core.time_integration.initial_motion import InitialMotion

from .jobs import parallel_results
from .stages import simulations_in_words


@dataclass(frozen=True)
class Calculation:
    """The one blade and the one scene of `settings`, on so many `cores`, with files of simulations in `folder`."""

    settings: Settings
    folder: Path
    cores: int

    @property
    def run(self) -> Named:
        """Wildcards of its files."""
        ((blade, scene),) = self.settings.speed_plans
        return Named(blade=blade, scene=scene)

    @cached_property
    def blade_sweep(self) -> BladeSweep:
        """Simulations of the blade in the scene."""
        return blade_sweep(self.settings, **vars(self.run))

    @property
    def attributes(self) -> Attributes:
        """Parameters of the stages of the structure that are for messages."""
        return structure_attributes(self.settings, self.run.blade)

    def structure_file(self, stage: str) -> Path:
        """File of a stage of the structure that the simulations start from. Raises what making it raises."""
        (file,) = parallel_results([partial(self.blade_sweep.file, stage, cache_folder(), self.attributes)], 1)
        return file

    def response(self, motion: InitialMotion | None = None) -> Path:
        """All simulations and the file of their response. Raises what they raise. `motion`: that the blade starts in."""
        run, speeds = vars(self.run), shared_speeds(self.settings, **vars(self.run))
        driver = Driver(self.folder, cache_folder(), self.attributes, self._run_all, motion)
        campbell = self.structure_file(CAMPBELL) if speeds.plan.refined else None
        name, about = "/".join(run.values()), str(Provenance(self.settings).sweep(self.run))
        return driver.run({name: self.blade_sweep}, speeds, campbell, {name: about})[name]

    def _run_all(self, calls: Sequence[Callable[[], Any]], what: str) -> list[Any]:
        if what != SIMULATIONS:
            return parallel_results(calls, self.cores)
        LOGGER.info("%s", simulations_in_words(self.settings, self.run.blade, self.run.scene, str(len(calls))))
        return parallel_results(calls, self.cores, what, "run")


def structure_file(settings: Settings, blade: str, stage: str, tip_line: str | None = None) -> Path:
    """The file of a stage, with the numbers that one thread of linear algebra gives. Raises what making it raises."""
    made = recipes(settings, blade, {stage: tip_line})[stage]
    (file,) = parallel_results([partial(made.file, cache_folder(), structure_attributes(settings, blade))], 1)
    return file


def cache_folder() -> Path:
    """The user's cache folder. ConfigError if it cannot be written."""
    try:
        return writable_folder()
    except OSError as error:
        refusal = f"R37_CACHE: found the cache folder {named_folder()}, which cannot be written ({error.strerror})"
        raise ConfigError(f"{refusal}; allowed: a folder that can") from None
