"""Driver of runs: sweeps at the speeds that they share, adaptive rounds included, which leave parts to go on from."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from r37core.adaptive.rounds import first_round, measure_members, round_after
from r37core.base.dataset_file import read_dataset
from r37core.machine_code.kept import content_digest
from r37core.results.response import write_response

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
    `attributes`: as of `structure_attributes`; `run_all`: on which processes.
    """

    folder: Path
    structures: Path
    attributes: Mapping[str, Any]
    run_all: RunAll = one_by_one

    def run(
        self, sweeps: Mapping[str, BladeSweep], speeds: SharedSpeeds, campbell: Path | None, about: Mapping[str, str]
    ) -> dict[str, Path]:
        """Run all sweeps, by the names of their folders; gives the responses. Raises what a simulation raises.

        `campbell`: the diagram that adaptive speeds begin with; `about`: attributes of the files of each sweep, as JSON.
        """
        self.structures.mkdir(parents=True, exist_ok=True)
        code = code_of("r37core.time_integration.speed_job.run_job")
        models = self.run_all([partial(self._models, sweep) for sweep in sweeps.values()], "models")
        plan, choice, files = speeds.plan, speeds.choice, dict[float, Sequence[Path]]()

        def simulate(asked: Sequence[float]) -> Sequence[Path]:
            """Files at some speeds (rad/s), those of one sweep after those of another; a process imports no more for one."""
            new = self.run_all(
                [
                    partial(simulated, self.folder / name, speed, sweep.task, started, about[name], code)
                    for (name, sweep), started in zip(sweeps.items(), models, strict=True)
                    for speed in asked
                ],
                SIMULATIONS,
            )
            files.update({speed: new[place :: len(asked)] for place, speed in enumerate(asked)})
            return new

        if plan.refined:
            assert campbell is not None
            asked = first_round(plan, read_dataset(campbell), choice)
            while asked.new:
                yields = [sweep.yield_stress for sweep in sweeps.values()]
                asked = round_after(asked, measure_members(yields, asked.new, simulate(asked.new)), plan, choice)
        else:
            simulate(plan.certain)
        every_speed = sorted(files)
        own_files = zip(*(files[speed] for speed in every_speed), strict=True)
        calls = [
            partial(
                write_response,
                own,
                every_speed,
                self.folder / name / "response.nc",
                stress_history_speeds=sweep.history_speeds,
                yield_stress=sweep.yield_stress,
                strengths=sweep.strengths,
                provenance=json.loads(about[name]),
            )
            for (name, sweep), own in zip(sweeps.items(), own_files, strict=True)
        ]
        return dict(zip(sweeps, self.run_all(calls, "responses"), strict=True))

    def _models(self, sweep: BladeSweep) -> list[tuple[str, str]]:
        """Files of the models of a sweep, each with the digest of its content."""
        files = [str(sweep.file(stage, self.structures, self.attributes)) for stage in sweep.models]
        return [(file, content_digest(file)) for file in files]
