"""Blade-tip rubbing: blade shape, finite elements, reduced model and post-processing, usable without Snakemake."""

import sys

__version__ = "0.4.0"

if sys.platform == "win32":
    raise ImportError("r37 runs on Linux and macOS; on Windows use WSL, the Windows Subsystem for Linux")
