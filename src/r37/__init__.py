"""r37 from Python: simulations of blade-tip rubbing, from the Campbell diagram of a blade to the effect of tolerances.

Blades, scenes and accuracy levels are those of the shipped configuration, or of your own (`config="config.yaml"`). Datasets
have the variables, units and attributes of the workflow's files. All units are SI, and speeds are in rad/s unless a name ends
in rpm. The structure of a blade takes up to a minute; it is kept in a cache folder (r37.calculation). The logger `r37` reports
the progress of a call (r37.stages).

Bad input raises ConfigError, an unknown argument TypeError, a file that cannot be read InputFileError, and a blade that its
load buckles at a speed BucklingError.
"""

import gc
from importlib import import_module
from typing import TYPE_CHECKING, Any

from r37core import __version__

if TYPE_CHECKING:
    from r37core.base.dataset_file import NETCDF_LOCK
    from r37core.base.io import InputFileError
    from r37core.config import ConfigError
    from r37core.rom.rotation import BucklingError

    from .choices import BladeChoice, SceneChoice, blade, blades, scene, scenes
    from .plots import plot_campbell, plot_designs, plot_response, plot_rotor, plot_run_ups, plot_tolerances
    from .rub_tests import lining_from_rub_test
    from .run_results import RunResults, open_results
    from .runs import run
    from .simulations import campbell, reduced_model, simulate, sweep
    from .study_folder import SNAKEFILE, init

__all__ = [
    "NETCDF_LOCK",
    "SNAKEFILE",
    "BladeChoice",
    "BucklingError",
    "ConfigError",
    "InputFileError",
    "RunResults",
    "SceneChoice",
    "__version__",
    "blade",
    "blades",
    "campbell",
    "init",
    "lining_from_rub_test",
    "open_results",
    "plot_campbell",
    "plot_designs",
    "plot_response",
    "plot_rotor",
    "plot_run_ups",
    "plot_tolerances",
    "reduced_model",
    "run",
    "scene",
    "scenes",
    "simulate",
    "sweep",
]

_NAMES_OF = {
    "r37core.config": ("ConfigError",),
    "r37core.base.dataset_file": ("NETCDF_LOCK",),
    "r37core.base.io": ("InputFileError",),
    "r37core.rom.rotation": ("BucklingError",),
    ".choices": ("BladeChoice", "SceneChoice", "blade", "blades", "scene", "scenes"),
    ".plots": ("plot_campbell", "plot_designs", "plot_response", "plot_rotor", "plot_run_ups", "plot_tolerances"),
    ".rub_tests": ("lining_from_rub_test",),
    ".run_results": ("RunResults", "open_results"),
    ".runs": ("run",),
    ".simulations": ("campbell", "reduced_model", "simulate", "sweep"),
    ".study_folder": ("SNAKEFILE", "init"),
}
"""Modules that are imported when one of their names is first used: the command starts in a tenth of a second."""


def __getattr__(name: str) -> Any:
    module = next((module for module, names in _NAMES_OF.items() if name in names), None)
    if module is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    collecting = gc.isenabled()
    # what is imported stays: looking through it for unused cycles again and again took a sixth of the time
    gc.disable()
    try:
        globals()[name] = value = getattr(import_module(module, __name__), name)
    finally:
        if collecting:
            gc.enable()
    return value


def __dir__() -> list[str]:
    return __all__
