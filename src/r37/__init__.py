"""r37 from Python: the Campbell diagram of a blade, and its response while it rubs against the casing.

Blades, scenes and accuracy levels are those of the shipped configuration, or of one's own (`config="config.yaml"`). Datasets
have the variables, units and attributes of the workflow's files. Speeds are in rad/s, everything is SI. What takes minutes,
the structure of a blade, is kept in a cache folder (r37.structure_files).

Bad input raises ConfigError, a file that cannot be read InputFileError.
"""

from r37core import __version__
from r37core.config import ConfigError
from r37core.io import InputFileError

from .choices import BladeChoice, SceneChoice, blade, blades, scene
from .plots import plot_campbell, plot_response
from .run_results import RunResults, open_results
from .simulations import campbell, reduced_model, simulate, sweep
from .study_folder import SNAKEFILE, init

__all__ = [
    "SNAKEFILE",
    "BladeChoice",
    "ConfigError",
    "InputFileError",
    "RunResults",
    "SceneChoice",
    "__version__",
    "blade",
    "blades",
    "campbell",
    "init",
    "open_results",
    "plot_campbell",
    "plot_response",
    "reduced_model",
    "scene",
    "simulate",
    "sweep",
]
