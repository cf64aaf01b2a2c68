"""speed_*.npz: the file of one blade, scene and speed. Small, and quick to read and write: there are thousands.

Its arrays are declared in speed_arrays.
"""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy import ndarray

from r37core.base.io import atomic_write, readable
from r37core.base.variable import Variable

from .speed_arrays import ARRAYS
from .status import RunStatus

RUN, STATUS, PARAMETERS = "run", "status", "parameters"
"""Members of the file: a record whose fields are the other arrays of the run, its status alone, and a text. Forty members take
five times as long, and Snakemake looks at the status of every run."""


def sizes_of(run: Mapping[str, ndarray], arrays: Mapping[str, Variable] = ARRAYS) -> dict[str, int]:
    """Size of each dimension of a run's arrays.

    Raises ValueError for one that is not declared among `arrays`, and for one whose shape is not that of its dimensions.
    """
    sizes: dict[str, int] = {}
    for name, array in run.items():
        if name not in arrays:
            raise ValueError(f"{name}: found an array that is not declared; declare it in {__package__}.speed_arrays")
        shape, dims = array.shape, arrays[name].dims
        if len(shape) != len(dims) or shape != tuple(map(sizes.setdefault, dims, shape)):
            known = ", ".join(f"{dim} ({sizes.get(dim, 'any')})" for dim in dims)
            raise ValueError(f"{name}: found an array of shape {shape}; allowed: {known or 'a number'}")
    return sizes


def write_speed(
    result: Mapping[str, ndarray], file: Path | str, parameters: Mapping[str, object], arrays: Mapping[str, Variable] = ARRAYS
) -> None:
    """Write the arrays of one run, `status` among them, and, as JSON text under `parameters`, what made them.

    `arrays`: those that there may be. Raises what sizes_of raises.
    """
    numbers = {name: np.asarray(array) for name, array in result.items()}
    sizes_of(numbers, arrays)
    status = numbers.pop(STATUS)
    run = np.zeros((), [(name, array.dtype, array.shape) for name, array in numbers.items()])
    for name, array in numbers.items():
        run[name] = array
    with atomic_write(file) as partial:
        text = np.array(json.dumps(dict(parameters), sort_keys=True, default=str))
        np.savez(partial, allow_pickle=False, **{PARAMETERS: text, STATUS: status, RUN: run})


def read_speed(file: Path | str, arrays: Mapping[str, Variable] = ARRAYS) -> dict[str, ndarray]:
    """Status of a run, and all of `arrays` that its file has; InputFileError when it cannot be read, or for a wrong shape."""
    with readable(file), np.load(file) as stored:
        run = stored[RUN]
        # aligned, as computing with a field of a record is slower
        numbers = {name: run[name].copy() for name in run.dtype.names if name in arrays}
        sizes_of(numbers, arrays)
        return {STATUS: stored[STATUS], **numbers}


def read_status(file: Path | str) -> RunStatus:
    """Status of a run; InputFileError when the file cannot be read."""
    with readable(file), np.load(file) as stored:
        return RunStatus(int(stored[STATUS]))
