"""speed_*.npz: the file of one blade, scene and speed. Small, and quick to read and write: there are thousands."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from r37core.base.io import atomic_write, readable

from .status import RunStatus

RUN, STATUS, PARAMETERS = "run", "status", "parameters"
"""Members of the file: a record whose fields are the other arrays of the run, its status alone, and a text. Forty members take
five times as long, and Snakemake looks at the status of every run."""


def write_speed(result: Mapping[str, np.ndarray], file: Path | str, parameters: Mapping[str, object]) -> None:
    """Write the arrays of one run, `status` among them, and, as JSON text under `parameters`, what made them."""
    arrays = {name: np.asarray(array) for name, array in result.items()}
    status = arrays.pop(STATUS)
    run = np.zeros((), [(name, array.dtype, array.shape) for name, array in arrays.items()])
    for name, array in arrays.items():
        run[name] = array
    with atomic_write(file) as partial:
        text = np.array(json.dumps(dict(parameters), sort_keys=True, default=str))
        np.savez(partial, allow_pickle=False, **{PARAMETERS: text, STATUS: status, RUN: run})


def read_speed(file: Path | str) -> dict[str, np.ndarray]:
    """The arrays of a run; InputFileError when the file cannot be read."""
    with readable(file), np.load(file) as stored:
        run = stored[RUN]
        # aligned, as computing with a field of a record is slower
        return {STATUS: stored[STATUS], **{name: run[name].copy() for name in run.dtype.names}}


def read_status(file: Path | str) -> RunStatus:
    """Status of a run; InputFileError when the file cannot be read."""
    with readable(file), np.load(file) as stored:
        return RunStatus(int(stored[STATUS]))
