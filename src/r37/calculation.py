"""A blade in a scene, calculated in this process: its structure comes from the user's cache."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from r37core.base.io import Named
from r37core.config import ConfigError, Settings
from r37core.machine_code.kept import named_folder, writable_folder
from r37core.plans.sweep_plan import Sweep
from r37core.sweep.blade_sweep import CAMPBELL, blade_sweep, shared_speeds
from r37core.sweep.driver import SIMULATIONS, Driver
from r37core.sweep.recipe import LOGGER, recipes, structure_attributes

from .jobs import parallel_results
from .stages import simulations_in_words


def response_file(settings: Settings, folder: Path, cores: int) -> Path:
    """File of the response of the one blade in the one scene of `settings`, in `folder`. Raises what the simulations raise."""
    ((blade, scene),) = settings.speed_plans
    run, attributes = Named(blade=blade, scene=scene), structure_attributes(settings, blade)
    sweep, speeds = blade_sweep(settings, blade, scene), shared_speeds(settings, blade, scene)

    def run_all(calls: Sequence[Callable[[], Any]], what: str) -> list[Any]:
        if what != SIMULATIONS:
            return parallel_results(calls, cores)
        LOGGER.info("%s", simulations_in_words(settings, blade, scene, str(len(calls))))
        return parallel_results(calls, cores, what, "run")

    campbell = None
    if speeds.plan.refined:
        (campbell,) = parallel_results([partial(sweep.file, CAMPBELL, cache_folder(), attributes)], 1)
    name = f"{blade}/{scene}"
    driver = Driver(folder, cache_folder(), attributes, run_all)
    return driver.run({name: sweep}, speeds, campbell, {name: str(Sweep(settings).provenance(run))})[name]


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
