"""speed_*.npz: the file of one blade, scene and speed. Small, and quick to read and write: there are thousands."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from r37core.io import atomic_write, readable


def write_speed(result: Mapping[str, np.ndarray], file: Path | str, parameters: Mapping[str, object]) -> None:
    """Write the arrays of one run and, as JSON text under `parameters`, what made them."""
    with atomic_write(file) as partial:
        text = np.array(json.dumps(dict(parameters), sort_keys=True, default=str))
        np.savez(partial, allow_pickle=False, parameters=text, **result)


def read_speed(file: Path | str) -> dict[str, np.ndarray]:
    """The arrays of a run; InputFileError when the file cannot be read."""
    with readable(file), np.load(file) as stored:
        return {name: stored[name] for name in stored.files}
