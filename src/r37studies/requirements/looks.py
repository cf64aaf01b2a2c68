"""Further runs that a verdict waits for: those that could overturn what the sweep's own runs say.

From rest until the motion has settled, also between the sweep's speeds; with damping at the ends of its range, and lobes that
rise faster and slower; carried up and down; in run-ups and run-downs; with other friction; with half the step and on a coarser
mesh. Of a requirement that the sweep's runs fail clearly only other damping and rise are tried, which may keep it.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Any, Self

import numpy as np
import pandas as pd
import xarray as xr

from r37core.base.dataset_file import dataset_of
from r37core.contact.scene import Scene
from r37core.results.datasets import overlaid
from r37core.results.events import exit_of
from r37core.results.limits import OF_LIMITS
from r37core.results.response import run_row
from r37core.results.variables import AXES, OF_ALL_SPEEDS, VARIABLES
from r37core.rom.quadratic_terms import PATH_ERROR
from r37core.stress.operator import judged_operator
from r37core.stress.statistic import Strengths
from r37core.sweep.parts import Parts
from r37core.time_integration.integration_choice import PUBLISHED_REVOLUTIONS, IntegrationChoice
from r37core.time_integration.kept_numbers import melting_power, numbers_so_far, wear_numbers
from r37core.time_integration.settling import remaining_drift, window_of
from r37core.time_integration.simulate import DIRECTIONS, TIP_POINTS
from r37core.time_integration.speed_file import read_speed
from r37core.time_integration.status import RunStatus
from r37studies.blade_runs import BladeRuns
from r37studies.run_up_integration import RunUpIntegration
from r37studies.run_up_revolutions import record_run_up
from r37studies.run_up_schedule import RunUp

from . import judging
from .choice import BRIEF, CARRIED_STEP, FOLLOWED, LEAST_STEP, LONGEST, MOST_NEAR, NEAR, STEP, Requirements, run_up_lengths
from .evidence import HALF_FRICTION, OF_ALL, Evidence, peak_reach, soonest_divergence

_MOST_PEAKS = 12
"""Peaks, the highest, about which speeds refine."""

_LEAST_NEAR = 6
"""Speeds that are run with other friction and half the step where few come near to the limit."""

_FRICTION = {judging.MORE_FRICTION: 1.01, judging.LESS_FRICTION: 0.99, judging.SLIGHTLY_MORE_FRICTION: 1.001}
"""Factors of the coefficient of friction."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JudgedBlade(BladeRuns):
    """A blade in a scene; of the operators of the stress it has the one of the region that decides.

    `yield_stress` (Pa) and `strengths` of its material; `parts`: files of the runs. `coarser`: the blade on a coarser mesh,
    where there is one. `follows`: whether runs last up to FOLLOWED revolutions, not LONGEST.
    """

    yield_stress: float
    strengths: Strengths
    parts: Parts
    coarser: Self | None = None
    follows: bool = False

    @cached_property
    def long_choice(self) -> IntegrationChoice:
        """Time integration of a run that ends as it has settled, and keeps the stress of all its revolutions."""
        longest = max(self.choice.revolutions, FOLLOWED if self.follows else LONGEST)
        kept = longest if self.choice.snapshots_per_revolution else 0
        return replace(self.choice, revolutions=longest, snapshot_revolutions=kept, until_settled=True)

    @cached_property
    def rising_scene(self) -> Scene:
        """The scene with lobes that grow as in the sweep's runs, however long a run is."""
        return self.scene.rising_over(self.choice.length_of_rise_fraction)

    def runs_from_rest(self, speeds: Iterable[float], scene: Scene | None = None, **changes: Any) -> xr.Dataset:
        """Runs from rest at speeds (rad/s), in another scene if it is given, with changes of the long choice."""
        of, choice = scene or self.rising_scene, replace(self.long_choice, **changes)
        runs = {speed: partial(self.numbers_at, of, choice, speed) for speed in speeds}
        return self._dataset({speed: self.parts.file(speed, (of, choice), run) for speed, run in runs.items()})

    def carried(self, speeds: Sequence[float]) -> xr.Dataset:
        """The motion carried on from each speed (rad/s) to the next in an unworn lining, from rest at the first one."""
        scene, choice = self.scene.grown, self.stepped_up_to(max(speeds), self.long_choice)
        files = self.parts.carried(speeds, (scene, choice), partial(self.numbers_at, scene, choice))
        return self._dataset(dict(zip(speeds, files, strict=True)))

    def run_up(self, start: float, stop: float, revolutions: float, speeds: Sequence[float]) -> xr.Dataset:
        """Largest stress about each of the `speeds` (rad/s) in a run-up within so many revolutions, and all its wear.

        It begins with the revolutions of the sweep's runs, in which the lobes grow. Speeds before it leaves the model's limits
        are dangerous or below yield, those after that unknown. One that diverges first does so at all speeds.
        """
        before, scene = self.choice.revolutions, self.rising_scene
        kept = before if self.choice.snapshots_per_revolution else 0
        choice = replace(self.choice, until_settled=False, snapshot_revolutions=kept)
        integration = RunUpIntegration(self.model, scene, choice, RunUp(start, stop, revolutions, before, 0, False))
        numbers = record_run_up(
            integration,
            [each for each in self.results if each != "spectrum"],
            highest_order=0,
            stress=judged_operator(self.stress) if self.stress else None,
            yield_stress=self.yield_stress,
            strengths=self.strengths,
        )
        limited = self._limited(integration, numbers)
        exit_revolution = exit_of(limited)["exit_revolution"]
        distance = np.abs(np.subtract.outer(speeds, numbers["speed"]))
        is_near = distance <= np.maximum(distance.min(axis=1, keepdims=True), 0.5 * CARRIED_STEP)
        is_inside = ~(np.arange(len(numbers["speed"])) + 1 >= exit_revolution)
        values = {
            f"{name}_inside": np.max(np.where(is_near & is_inside, numbers[name], 0.0 if is_inside.any() else np.nan), axis=1)
            for name in ("max_von_mises", "goodman_share")
            if name in numbers
        }
        values["exit_revolution"] = np.where((is_near & ~is_inside).any(axis=1), exit_revolution, np.nan)
        # a divergence beyond the model says nothing of the speeds before
        status = numbers["status"] if np.isnan(exit_revolution) else RunStatus.COMPLETED
        same = {"status": status} | {name: limited[name] for name in OF_LIMITS if name in limited}
        if scene.lining:
            worn = wear_numbers(integration.state.wear, 1, scene.lining, np.zeros(1))
            same |= {name: worn[name] for name in ("used_thickness", "worn_through_share")}
        values |= {name: np.full(len(speeds), value) for name, value in same.items()}
        return xr.Dataset({name: ("speed", each) for name, each in values.items()}, {"speed": speeds})

    def _limited(self, integration: RunUpIntegration, numbers: Mapping[str, np.ndarray]) -> dict[str, Any]:
        """Arrays of a run-up that the model's limits are of.

        The heat of its friction is the most within as many revolutions as a run of the sweep has, which stands in for the
        power: over many seconds heat flows off.
        """
        state, quadratic, count = integration.state, self.model.quadratic, len(numbers["speed"])
        totals, so_far = state.totals, numbers_so_far(state, self.choice.samples_per_revolution, count)
        heat = np.concatenate([np.zeros(self.choice.revolutions), so_far["heat_so_far"]])
        # the most until the end of each revolution
        so_far["heat_so_far"] = np.maximum.accumulate(heat[-count:] - heat[:count])
        run = {
            "largest_normal_force": totals["largest_force"],
            "bounded_share_of_time": totals["steps_bounded"] / max(totals["steps"], 1.0),
            "friction_heat": so_far["heat_so_far"][-1],
            "melting_power": melting_power(self.model, self.scene.friction),
            **so_far,
        }
        if quadratic is not None:
            reached = (
                np.max([numbers[f"maximum_{direction}"].max(axis=1) for direction in DIRECTIONS], axis=0) / quadratic.height
            )
            run |= {"revolution_share_of_height": reached, "peak_share_of_height": reached.max(initial=0.0)}
            run["share_of_height_limit"] = quadratic.share_within(PATH_ERROR * self.scene.casing.clearance)
        return run

    def _row(self, numbers: Mapping[str, np.ndarray]) -> dict[str, Any]:
        row = run_row(numbers, self.yield_stress, self.strengths)
        if "revolution_von_mises" in numbers:
            # NaN after the end of a run that settled
            history = np.nan_to_num(numbers["revolution_von_mises"])
            ended = np.isfinite(numbers["settled_revolution"]) or not history[:, -1].all()
            row["stress_drift"] = np.array([0.0 if ended else remaining_drift(each, window_of(len(each))) for each in history])
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
    """Further runs, one look after another, as long as no requirement fails clearly; none where nothing touches.

    A run shorter than the published ones shows a beginning alone, and fails nothing clearly.
    """
    if not evidence.touches:
        return
    if blade.choice.revolutions >= PUBLISHED_REVOLUTIONS and judging.fails_clearly(requirements, evidence):
        yield from _large_changes(blade, requirements, evidence)
        return
    first, last = evidence.operating.first, evidence.operating.last
    error = np.nan_to_num(evidence.error, nan=judging.CLEARLY - 1.0)
    inside = [float(speed) for speed in evidence.speeds if first < speed < last]
    rest_runs = JudgedBlade.runs_from_rest
    follow = partial(_followed, blade, requirements, evidence)
    speeds = np.unique([*evidence.operating.ends, *inside]).tolist()
    runs = follow(rest_runs, _closer(speeds, STEP))
    while len(new := _speeds_about_peaks(runs["speed"].values, judging.nearness(requirements, evidence.replaced(runs)), error)):
        runs = overlaid(runs, follow(rest_runs, new))
    yield judging.REST, runs
    rest = evidence.replaced(runs)
    yield from _large_changes(blade, requirements, rest)
    if judging.fails_clearly(requirements, rest):
        return
    carried = _closer([first, last], CARRIED_STEP)
    for look, order in ((judging.UP, carried), (judging.DOWN, carried[::-1])):
        yield look, follow(partial(_carried, order), carried)
    for rate, revolutions in run_up_lengths(evidence.operating).items():
        for look, ends in ((judging.RUN_UP, (first, last)), (judging.RUN_DOWN, (last, first))):
            yield f"{look} at {rate:.3g} rad/s2", blade.run_up(*ends, revolutions, carried)
    close = judging.closeness(requirements, rest)
    near = sorted(_nearest(requirements, rest, judging.closeness, _speeds_near(close)))
    for look, factor in _FRICTION.items():
        if scene := blade.rising_scene.scaled_friction(factor):
            yield look, follow(partial(rest_runs, scene=scene), near)
    yield judging.HALF_STEP, follow(partial(rest_runs, time_step=0.5 * blade.long_choice.time_step), near)
    if blade.coarser:
        yield judging.COARSER_MESH, _followed(blade.coarser, requirements, evidence, rest_runs, near)


def _carried(order: Sequence[float], blade: JudgedBlade, _: Sequence[float]) -> xr.Dataset:
    """The motion carried through all speeds (rad/s) in an `order`, whichever are wanted."""
    return blade.carried(order)


def _followed(
    blade: JudgedBlade,
    requirements: Requirements,
    evidence: Evidence,
    run: Callable[[JudgedBlade, Sequence[float]], xr.Dataset],
    speeds: Sequence[float],
) -> xr.Dataset:
    """Runs at speeds (rad/s); those whose motion grows last up to FOLLOWED revolutions.

    At most MOST_NEAR of them do, those nearest to a limit. `followed`: 1 for them, 0 for others.
    """
    runs = run(blade, speeds)
    runs = runs.assign(followed=("speed", np.zeros(runs.sizes["speed"])))
    if not len(grows := judging.growing(requirements, evidence.replaced(runs))[:MOST_NEAR]):
        return runs
    longer = run(replace(blade, follows=True), np.sort(grows).tolist())
    return overlaid(runs, longer.assign(followed=("speed", np.ones(longer.sizes["speed"]))))


def _large_changes(blade: JudgedBlade, requirements: Requirements, runs: Evidence) -> Iterator[tuple[str, xr.Dataset]]:
    """LARGE_CHANGES, at the speeds in operation where `runs` fail and up to MOST_NEAR in all, those nearest to a limit.

    Of what fails clearly a change ends at the first speed that still does, but for a limit of a length. HALF_FRICTION where a
    run diverged.
    """
    soonest = soonest_divergence(runs)["speed"].values.tolist()
    if soonest and (less := blade.rising_scene.scaled_friction(0.5)):
        yield HALF_FRICTION, blade.runs_from_rest(soonest, less)
    near, scene = judging.nearness(requirements, runs)[runs.operates], blade.rising_scene
    count = max(_speeds_near(near), int(np.count_nonzero(near >= 1.0)))
    speeds, clearly = _nearest(requirements, runs, judging.nearness, count), judging.fails_clearly(requirements, runs)
    if not clearly:
        speeds = sorted({*speeds, *_beside_worst(requirements, runs)})
    changes = {judging.LOWEST_DAMPING: scene.damped("lowest"), judging.HIGHEST_DAMPING: scene.damped("highest")}
    fast = 0.1 * (scene.casing.rise_revolutions or 0.0)
    rises = {
        judging.FAST_RISE: fast,
        judging.SUDDEN_RISE: 1.0,
        judging.BRIEF_RISE: float(BRIEF),
        judging.SLOW_RISE: float(PUBLISHED_REVOLUTIONS),
    }
    if near.max(initial=0.0) < 1.0:
        # it shows more than the others, which takes nothing from what fails
        rises[judging.SLOWEST_RISE] = float(LONGEST - PUBLISHED_REVOLUTIONS)
    for look, revolutions in rises.items():
        changes[look] = replace(scene, casing=replace(scene.casing, rise_revolutions=revolutions))
    for look, changed in changes.items():
        if changed != scene and speeds:
            run = partial(JudgedBlade.runs_from_rest, scene=changed)
            tried = speeds
            if clearly and near.max() >= 1.0 and not requirements.above_yield:
                alone = (judging.nearness(requirements, runs.replaced(run(blade, [speed]))).max() for speed in speeds)
                tried = next((speeds[:count] for count, nearest in enumerate(alone, 1) if nearest >= 1.0), speeds)
            yield look, _followed(blade, requirements, runs, run, tried)


def _nearest(
    requirements: Requirements, runs: Evidence, measure: Callable[[Requirements, Evidence], np.ndarray], count: int
) -> list[float]:
    """Speeds (rad/s) in operation of so many runs that a `measure` says are nearest to a limit, the nearest first.

    With them stand the _LEAST_NEAR of each limit: what is nearest to one limit need not be worst for another.
    """
    speeds, chosen = runs.response["speed"].values[runs.operates], dict[float, None]()
    for limits, most in (
        (requirements, count),
        *((only, min(count, _LEAST_NEAR)) for only in judging.single_limits(requirements)),
    ):
        order = np.argsort(-measure(limits, runs)[runs.operates], kind="stable")
        chosen |= dict.fromkeys(speeds[order[:most]].tolist())
    return [*chosen]


def _beside_worst(requirements: Requirements, runs: Evidence) -> list[float]:
    """Speeds (rad/s) up to a STEP beside the worst one of each limit, where a change may move it: a branch ends elsewhere."""
    speeds = runs.response["speed"].values[runs.operates]
    worst = [speeds[np.argmax(judging.nearness(only, runs)[runs.operates])] for only in judging.single_limits(requirements)]
    beside = np.add.outer(worst, STEP * np.array([-1.0, -0.5, 0.5, 1.0]))
    return np.clip(beside, runs.operating.first, runs.operating.last).ravel().tolist()


def _speeds_near(near: np.ndarray) -> int:
    """How many of the runs that come nearest to a limit are run in other ways."""
    return min(max(int(np.count_nonzero(near >= NEAR)), _LEAST_NEAR), MOST_NEAR)


def joined_looks(looks: Mapping[str, xr.Dataset]) -> xr.Dataset:
    """All looks in one dataset over (look, speed); what is not run is NaN."""
    if not looks:
        return xr.Dataset(coords={"look": np.empty(0, dtype=object)})
    first, *_ = looks.values()
    parts = [runs.drop_vars(OF_ALL, errors="ignore") for runs in looks.values()]
    return xr.concat(parts, pd.Index(looks, name="look"), join="outer", coords="minimal").assign(
        {name: first[name] for name in OF_ALL if name in first}
    )


def looks_in(joined: xr.Dataset) -> dict[str, xr.Dataset]:
    """The looks of a joined dataset, each at the speeds that it was run at."""
    looks = {str(name): joined.sel(look=name, drop=True) for name in joined["look"].values}
    return {name: runs.isel(speed=np.flatnonzero(runs["status"].notnull().values)) for name, runs in looks.items()}


def _closer(speeds: Sequence[float], step: float) -> list[float]:
    """The speeds, ascending, with others evenly between them, none farther than a `step` from the next."""
    filled = [
        np.linspace(low, high, int(np.ceil((high - low) / step - 1e-9)), endpoint=False) for low, high in pairwise(speeds)
    ]
    return [*np.concatenate(filled).tolist(), speeds[-1]]


def _speeds_about_peaks(speeds: np.ndarray, near: np.ndarray, error: float) -> list[float]:
    """Middles of the intervals beside peaks from NEAR of a limit on that may be higher than known by more than an `error`."""
    reach, is_wide = peak_reach(speeds, near), np.diff(speeds) > LEAST_STEP
    can_be_closer = np.append(is_wide, False) | np.append(False, is_wide)
    peaks = np.flatnonzero((reach >= NEAR) & np.isfinite(near) & (reach > (1.0 + error) * near) & can_be_closer)
    highest = peaks[np.argsort(-near[peaks], kind="stable")[:_MOST_PEAKS]]
    beside = np.unique([*(highest - 1), *highest]).astype(int)
    wide = beside[is_wide[beside]]
    return (0.5 * (speeds[wide] + speeds[wide + 1])).tolist()
