"""Parts of a job of many simulations, which a broken one goes on from."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from r37core.base.speeds import exact_text
from r37core.machine_code.kept import kept_file
from r37core.time_integration.speed_file import read_speed, write_speed

from .counts import count_simulation


@dataclass(frozen=True)
class Parts:
    """Numbers of simulations in files of a `folder`. `made_of`: what all of them follow from, told apart by its repr."""

    folder: Path
    made_of: object

    def numbers(self, speed: float, made_of: object, run: Callable[[], Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
        """Numbers of a simulation at a speed (rad/s), which `run` gives where they are missing or damaged.

        `made_of`: what this one follows from. Raises what `run` raises.
        """
        self.folder.mkdir(parents=True, exist_ok=True)

        def write(file: Path) -> None:
            numbers = run()
            write_speed(numbers, file, {})
            count_simulation(int(numbers["status"]))

        return read_speed(kept_file(f"speed_{exact_text(speed)}.npz", (self.made_of, made_of), write, self.folder))
