"""r37 from Python: what a blade does while it rubs against the casing, from its Campbell diagram to ranges of tolerances.

Blades, scenes and accuracy levels are those of the shipped configuration, or of one's own (`config="config.yaml"`). Datasets
have the variables, units and attributes of the workflow's files. Speeds are in rad/s unless a name says rpm, everything is SI.
What takes minutes, the structure of a blade, is kept in a cache folder (r37.structure_files).

Bad input raises ConfigError, an argument that a call does not have TypeError, a file that cannot be read InputFileError.
"""

from r37core import __version__
from r37core.config import ConfigError
from r37core.io import InputFileError

from .choices import BladeChoice, SceneChoice, blade, blades, scene, scenes
from .plots import plot_campbell, plot_designs, plot_response, plot_run_ups, plot_tolerances
from .run_results import RunResults, open_results
from .run_up_calls import run_up, run_ups
from .simulations import campbell, reduced_model, simulate, sweep
from .studies import compare, designs, tolerances
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
    "compare",
    "designs",
    "init",
    "open_results",
    "plot_campbell",
    "plot_designs",
    "plot_response",
    "plot_run_ups",
    "plot_tolerances",
    "reduced_model",
    "run_up",
    "run_ups",
    "scene",
    "scenes",
    "simulate",
    "sweep",
    "tolerances",
]
