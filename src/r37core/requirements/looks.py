"""Further runs that a verdict waits for: those that could overturn what the sweep's own runs say.

From rest until the motion has settled, also between the sweep's speeds; with damping at the ends of its range, and lobes that
rise sooner; carried up and down; with a little more and less friction; with half the step. Of a requirement that the sweep's
runs fail clearly only other damping and rise are tried, which may keep it.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from r37core.base.dataset_file import dataset_of
from r37core.contact.scene import Scene
from r37core.results.datasets import overlaid
from r37core.results.response import run_row
from r37core.results.variables import AXES, OF_ALL_SPEEDS, VARIABLES
from r37core.rom.contact_model import ContactModel
from r37core.stress.operator import StressOperators
from r37core.stress.statistic import Strengths
from r37core.sweep.parts import Parts
from r37core.time_integration.carrying import CarriedMotion, resolved_problem
from r37core.time_integration.finished_run import FinishedRun
from r37core.time_integration.integration_choice import PUBLISHED_REVOLUTIONS, IntegrationChoice
from r37core.time_integration.simulate import TIP_POINTS, Simulation
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.speed_run import numbers_of_run

from .choice import CARRIED_STEP, LONGEST, MOST_NEAR, STEP, Requirements
from .evidence import OF_ALL, Evidence
from .judging import DOWN, HALF_STEP, LARGE_CHANGES, LESS_FRICTION, MORE_FRICTION, REST, UP, closeness, fails_clearly, nearness

_NEAR = 0.7
"""Share of a limit from which a peak counts as near to it."""

_PEAK_STEP = 0.7
"""Step (rad/s) between runs about a peak that comes near to the limit."""

_FRICTION = 0.01
"""Relative change of the friction."""

_SOONER = 0.1
"""Revolutions in which lobes rise sooner, over those of the sweep."""


@dataclass(frozen=True, eq=False)
class JudgedBlade:
    """A blade's `model` in a `scene`: time integration, `results` and `kept` as run_speed takes them, and its material.

    `yield_stress` (Pa); `stress`: operator of the region that decides, by its name, where stress is among the results.
    `parts`: files of the runs.
    """

    model: ContactModel
    scene: Scene
    choice: IntegrationChoice
    results: Sequence[str]
    kept: Mapping[str, Any]
    yield_stress: float
    strengths: Strengths
    parts: Parts
    stress: StressOperators | None = None

    @cached_property
    def long_choice(self) -> IntegrationChoice:
        """Time integration of a run that ends as it has settled, and keeps the stress of all its revolutions."""
        longest = max(self.choice.revolutions, LONGEST)
        kept = longest if self.choice.snapshots_per_revolution else 0
        return replace(self.choice, revolutions=longest, snapshot_revolutions=kept, until_settled=True)

    @cached_property
    def rising_scene(self) -> Scene:
        """The scene with lobes that grow as in the sweep's runs, however long a run is."""
        return self.scene.rising_over(self.choice.length_of_rise_fraction)

    def runs_from_rest(self, speeds: Iterable[float], scene: Scene | None = None, step: float = 1.0) -> xr.Dataset:
        """Runs from rest at speeds (rad/s), in another scene if it is given, with a share of the time `step`."""
        choice = replace(self.long_choice, time_step=step * self.long_choice.time_step)
        of = scene or self.rising_scene
        runs = {speed: partial(self._run, of, choice, speed) for speed in speeds}
        return self._dataset({speed: self.parts.file(speed, (of, choice), run) for speed, run in runs.items()})

    def carried(self, speeds: Sequence[float]) -> xr.Dataset:
        """The motion carried on from each speed (rad/s) to the next in an unworn lining, from rest at the first one."""
        step = resolved_problem(self.model, max(speeds), self.scene, self.choice).choice.time_step
        scene, choice = self.scene.grown, replace(self.long_choice, time_step=step)
        files = self.parts.carried(speeds, (scene, choice), partial(self._carry, scene, choice))
        return self._dataset(dict(zip(speeds, files, strict=True)))

    def _carry(
        self, scene: Scene, choice: IntegrationChoice, speed: float, motion: CarriedMotion | None
    ) -> dict[str, np.ndarray]:
        """Numbers of a run that begins in a motion, and the motion at its end."""
        run = Simulation(self.model, speed, scene, choice).run(motion)
        return self._numbers(run) | CarriedMotion.ended(run.problem, run.states[0]).arrays

    def _run(self, scene: Scene, choice: IntegrationChoice, speed: float) -> dict[str, np.ndarray]:
        return self._numbers(Simulation(self.model, speed, scene, choice).run())

    def _numbers(self, run: FinishedRun) -> dict[str, np.ndarray]:
        return numbers_of_run(run, self.results, stress=self.stress, **self.kept)

    def _row(self, numbers: Mapping[str, np.ndarray]) -> dict[str, Any]:
        row = run_row(numbers, self.yield_stress, self.strengths)
        if "revolution_von_mises" in numbers:
            # NaN after the end of a run that settled
            row["max_von_mises_of_run"] = np.nan_to_num(numbers["revolution_von_mises"]).max(axis=1)
        return row

    def _dataset(self, files: Mapping[float, Path]) -> xr.Dataset:
        """Response by ascending speed (rad/s), without what nodes and angles have."""
        speeds = sorted(files)
        rows = {speed: self._row(read_speed(files[speed])) for speed in speeds}
        first = rows[speeds[0]]
        # the stress is that of one region
        described = {
            name: replace(variable, dims=tuple(dim for dim in variable.dims if dim != "region"))
            for name, variable in VARIABLES.items()
            if name in first and set(variable.dims) <= {"region", "tip_point", "engine_order"}
        }
        values = first | {name: [np.squeeze(rows[speed][name]) for speed in speeds] for name in described} | {"speed": speeds}
        axes = {name: AXES[name] for name in ("speed", "engine_order")}
        response = dataset_of(described, values, axes, {"tip_point": list(TIP_POINTS)}, ("speed",))
        same = {name: ((), first[name], OF_ALL_SPEEDS[name].attributes) for name in OF_ALL if name in first}
        return response.assign(same).drop_vars("speed_rpm")


def looks_of(blade: JudgedBlade, requirements: Requirements, evidence: Evidence) -> Iterator[tuple[str, xr.Dataset]]:
    """Further runs, one look (LOOKS) after another, as long as no requirement fails clearly; none where nothing touches.

    A run shorter than the published ones shows a beginning alone, and fails nothing clearly.
    """
    if not evidence.touches:
        return
    if blade.choice.revolutions >= PUBLISHED_REVOLUTIONS and fails_clearly(requirements, evidence):
        yield from _large_changes(blade, requirements, evidence)
        return
    first, last = evidence.operating.first, evidence.operating.last
    inside = [float(speed) for speed in evidence.speeds if first < speed < last]
    runs = blade.runs_from_rest(_closer([first, *inside, last], STEP))
    while len(new := _speeds_about_peaks(runs["speed"].values, nearness(requirements, evidence.replaced(runs)))):
        runs = overlaid(runs, blade.runs_from_rest(new))
    yield REST, runs
    rest = evidence.replaced(runs)
    yield from _large_changes(blade, requirements, rest)
    if fails_clearly(requirements, rest):
        return
    carried = _closer([first, last], CARRIED_STEP)
    yield UP, blade.carried(carried)
    yield DOWN, blade.carried(carried[::-1])
    near = np.sort(runs["speed"].values[np.argsort(-closeness(requirements, rest), kind="stable")[:MOST_NEAR]]).tolist()
    friction = blade.scene.friction
    if friction is not None:
        for look, factor in ((MORE_FRICTION, 1.0 + _FRICTION), (LESS_FRICTION, 1.0 - _FRICTION)):
            changed = replace(friction, coefficient=factor * friction.coefficient)
            yield look, blade.runs_from_rest(near, replace(blade.rising_scene, friction=changed))
    yield HALF_STEP, blade.runs_from_rest(near, step=0.5)


def _large_changes(blade: JudgedBlade, requirements: Requirements, runs: Evidence) -> Iterator[tuple[str, xr.Dataset]]:
    """LARGE_CHANGES, at the speeds in operation where `runs` fail and up to MOST_NEAR in all, those nearest to a limit."""
    near, scene = nearness(requirements, runs)[runs.operates], blade.rising_scene
    nearest = np.argsort(-near, kind="stable")[: max(MOST_NEAR, int(np.count_nonzero(near >= 1.0)))]
    speeds = np.sort(runs.response["speed"].values[runs.operates][nearest]).tolist()
    sooner = replace(scene.casing, rise_revolutions=_SOONER * (scene.casing.rise_revolutions or 0.0))
    changes = (scene.damped("lowest"), scene.damped("highest"), replace(scene, casing=sooner))
    for look, changed in zip(LARGE_CHANGES, changes, strict=True):
        if changed != scene and speeds:
            yield look, blade.runs_from_rest(speeds, changed)


def joined_looks(looks: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """All looks in one dataset over (look, speed); what is not run is NaN."""
    if not looks:
        return xr.Dataset(coords={"look": np.empty(0, dtype=object)})
    parts = [runs.drop_vars(OF_ALL, errors="ignore").expand_dims(look=[name]) for name, runs in looks.items()]
    first = next(iter(looks.values()))
    return xr.concat(parts, "look", join="outer").assign({name: first[name] for name in OF_ALL if name in first})


def looks_in(joined: xr.Dataset) -> dict[str, xr.Dataset]:
    """The looks of a joined dataset, each at the speeds that it was run at."""
    looks = {str(name): joined.sel(look=name, drop=True) for name in joined["look"].values}
    return {name: runs.isel(speed=np.flatnonzero(runs["status"].notnull().values)) for name, runs in looks.items()}


def _closer(speeds: Sequence[float], step: float) -> list[float]:
    """The speeds, ascending, with others evenly between them, none farther than a `step` from the next."""
    filled = [np.linspace(low, high, int(np.ceil((high - low) / step - 1e-9)) + 1)[:-1] for low, high in pairwise(speeds)]
    return [*np.concatenate(filled).tolist(), speeds[-1]]


def _speeds_about_peaks(speeds: np.ndarray, near: np.ndarray) -> list[float]:
    """Middles of the intervals beside peaks that come near to the limit, where these are longer than _PEAK_STEP."""
    higher = np.maximum(np.append(near[1:], 0.0), np.append(0.0, near[:-1]))
    peaks = (near >= _NEAR) & (near < 1.0) & (near >= higher)
    beside = (peaks[1:] | peaks[:-1]) & (np.diff(speeds) > _PEAK_STEP)
    return (0.5 * (speeds[1:] + speeds[:-1]))[beside].tolist()
