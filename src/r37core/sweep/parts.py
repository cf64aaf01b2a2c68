"""Parts of a job of many simulations, which a broken one goes on from."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from numpy import ndarray

from r37core.base.speeds import exact_text
from r37core.base.variable import Variable
from r37core.machine_code.kept import kept_file
from r37core.time_integration.carrying import CarriedMotion
from r37core.time_integration.speed_arrays import ARRAYS
from r37core.time_integration.speed_file import read_speed, read_status, write_speed
from r37core.time_integration.speed_job import run_job

from .counts import count_simulation

Numbers = Mapping[str, ndarray]
"""Numbers of a simulation, its status among them."""


def part(folder: Path, speed: float, made_of: object, write: Callable[[Path], None]) -> Path:
    """File of a simulation at a speed (rad/s), written now where it is missing or damaged, and counted then."""
    folder.mkdir(parents=True, exist_ok=True)

    def write_and_count(file: Path) -> None:
        write(file)
        count_simulation(read_status(file))

    return kept_file(f"speed_{exact_text(speed)}.npz", made_of, write_and_count, folder)


def simulated(
    folder: Path, speed: float, task: str, models: Sequence[tuple[str, str]], about: str, code: Sequence[str]
) -> Path:
    """File of a simulation at a speed (rad/s), run now where it is missing: as run_job; `models` with their digests."""
    files, digests = zip(*models, strict=True)

    def run(file: Path) -> None:
        run_job(exact_text(speed), str(file), task, about, *files)

    return part(folder, speed, [task, list(digests), code], run)


@dataclass(frozen=True)
class Parts:
    """Numbers of simulations in files of a `folder`.

    `made_of`: what all of them follow from, told apart by its repr. `arrays`: those that the files may have.
    """

    folder: Path
    made_of: object
    arrays: Mapping[str, Variable] = field(default_factory=lambda: ARRAYS)

    def file(self, speed: float, made_of: object, run: Callable[[], Numbers]) -> Path:
        """File of a simulation at a speed (rad/s), with the numbers that `run` gives where it is missing or damaged.

        `made_of`: what this one follows from. Raises what `run` raises.
        """
        return part(self.folder, speed, (self.made_of, made_of), lambda file: write_speed(run(), file, {}, self.arrays))

    def carried(
        self, speeds: Sequence[float], made_of: object, run: Callable[[float, CarriedMotion | None], Numbers]
    ) -> list[Path]:
        """Files of simulations at speeds (rad/s), in their order, of which each goes on from the motion at the end of the last.

        `run` gives the numbers, with the motion at the end; it is given none at the first speed and after a divergence.
        """
        files: list[Path] = []
        for place, speed in enumerate(speeds):
            before = CarriedMotion.at_end(read_speed(files[-1])) if files else None
            files.append(self.file(speed, (made_of, speeds[:place]), partial(run, speed, before)))
        return files
