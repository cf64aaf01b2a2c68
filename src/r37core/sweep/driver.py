"""Driver of runs: sweeps at the speeds that they share, adaptive rounds included, which leave parts to go on from."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from r37core.adaptive.rounds import first_round, measure_members, round_after
from r37core.base.dataset_file import read_dataset
from r37core.machine_code.kept import content_digest
from r37core.results.response import write_response
from r37core.time_integration.initial_motion import InitialMotion

from .blade_sweep import BladeSweep, SharedSpeeds
from .parts import simulated
from .recipe import code_of

Call = Callable[[], Any]
RunAll = Callable[[Sequence[Call], str], Sequence[Any]]
"""Gives the results of calls, in their order, on whatever processes; raises what one raises. The text says what they make."""

SIMULATIONS = "simulations"
"""Text of the calls that simulate."""


def one_by_one(calls: Sequence[Call], what: str = "") -> list[Any]:
    """Results of the calls, in this process."""
    return [call() for call in calls]


@dataclass(frozen=True)
class Driver:
    """Driver of sweeps whose files lie in a `folder`, one folder each, and those of structures in `structures`.

    A broken run goes on from the files that lie there: each has a name that follows from all that its content does.
    `attributes`: as of `structure_attributes`; `run_all`: on which processes; `motion`: that simulations start in.
    """

    folder: Path
    structures: Path
    attributes: Mapping[str, Any]
    run_all: RunAll = one_by_one
    motion: InitialMotion | None = None

    def run(
        self, sweeps: Mapping[str, BladeSweep], speeds: SharedSpeeds, campbell: Path | None, about: Mapping[str, str]
    ) -> dict[str, Path]:
        """Run all sweeps, by the names of their folders; gives the responses. Raises what a simulation raises.

        `campbell`: the diagram that adaptive speeds begin with; `about`: attributes of the files of each sweep, as JSON.
        """
        self.structures.mkdir(parents=True, exist_ok=True)
        code = code_of("r37core.time_integration.speed_job.run_job")
        models = self.run_all([partial(self._models, sweep) for sweep in sweeps.values()], "models")
        runs = [
            _Runs(self.folder / name, sweep, tuple(files), about[name], code, self.motion)
            for (name, sweep), files in zip(sweeps.items(), models, strict=True)
        ]
        files = self._simulated(runs, speeds, campbell)
        every_speed = sorted(files)
        of_runs = zip(*(files[speed] for speed in every_speed), strict=True)
        responses = self.run_all(
            [partial(run.response, every_speed, own) for run, own in zip(runs, of_runs, strict=True)], "responses"
        )
        return dict(zip(sweeps, responses, strict=True))

    def _models(self, sweep: BladeSweep) -> list[tuple[str, str]]:
        """Files of the models of a sweep, each with the digest of its content."""
        files = [str(sweep.file(stage, self.structures, self.attributes)) for stage in sweep.models]
        return [(file, content_digest(file)) for file in files]

    def _simulated(self, runs: Sequence[_Runs], speeds: SharedSpeeds, campbell: Path | None) -> dict[float, Sequence[Path]]:
        """Simulate at all speeds (rad/s); gives the file of each run at each of them."""

        def simulate(asked: Sequence[float]) -> Sequence[Path]:
            new = self.run_all([run.simulation(speed) for run in runs for speed in asked], SIMULATIONS)
            files.update({speed: new[place :: len(asked)] for place, speed in enumerate(asked)})
            return new

        plan, choice, files = speeds.plan, speeds.choice, dict[float, Sequence[Path]]()
        if not plan.refined:
            simulate(plan.certain)
            return files
        assert campbell is not None
        asked = first_round(plan, read_dataset(campbell), choice)
        while asked.new:
            measured = measure_members([run.sweep.yield_stress for run in runs], asked.new, simulate(asked.new))
            asked = round_after(asked, measured, plan, choice)
        return files


@dataclass(frozen=True)
class _Runs:
    """Simulations of a `sweep` in a folder, from `models` with their digests."""

    folder: Path
    sweep: BladeSweep
    models: tuple[tuple[str, str], ...]
    about: str
    code: Sequence[str]
    motion: InitialMotion | None = field(default=None, compare=False)

    def simulation(self, speed: float) -> Callable[[], Path]:
        """Call that gives the file of the simulation at a speed (rad/s); a process of its own imports no more for it."""
        return partial(
            simulated, self.folder, speed, self.sweep.task_at(speed), self.models, self.about, self.code, self.motion
        )

    def response(self, speeds: Sequence[float], simulations: Sequence[Path]) -> Path:
        """File of the response over the speeds (rad/s), of the files of its `simulations` there."""
        file = self.folder / "response.nc"
        write_response(
            simulations,
            speeds,
            file,
            stress_history_speeds=self.sweep.history_speeds,
            yield_stress=self.sweep.yield_stress,
            strengths=self.sweep.strengths,
            provenance=json.loads(self.about),
        )
        return file
