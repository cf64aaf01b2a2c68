"""The Python interpreter as Snakemake hands it to a shell."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path

PYTHON = Path(sys.executable)


def through(start: Path) -> None:
    """Let Snakemake start the Python scripts of its rules by way of `start`, a script that hands them to the job server."""
    sys.executable = shlex.join([str(PYTHON), "-S", "-E", str(start)])


def quote() -> None:
    """Quote `sys.executable`, which Snakemake 9.27 puts into the commands of its scripts as it stands.

    A virtual environment in a folder with a blank could not run them otherwise, and `$()` in a folder's name would be run.
    """
    sys.executable = shlex.quote(str(PYTHON))
