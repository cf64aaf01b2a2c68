"""Speeds of a run: how many at most, and how fast."""

import math
from dataclasses import dataclass

from r37core.time_integration.integration_choice import SECONDS_PER_STEP

from .settings import Settings


@dataclass(frozen=True)
class RunLength:
    """A run at a `speed` (rad/s): of so many `revolutions` and `blades`, in steps of `time_step` (s)."""

    speed: float
    revolutions: float
    blades: int
    time_step: float

    @property
    def steps_per_revolution(self) -> float:
        """Steps in a revolution of one blade."""
        return 2.0 * math.pi / (self.speed * self.time_step)

    @property
    def steps(self) -> float:
        """Steps of all blades together."""
        return self.revolutions * self.blades * self.steps_per_revolution

    @property
    def cpu_time(self) -> float:
        """About how long it takes (s)."""
        return self.steps * SECONDS_PER_STEP

    @property
    def wording(self) -> str:
        """How many steps it has."""
        blade_text = f" of {self.blades} blades" if self.blades > 1 else ""
        return f"a run of {self.steps:.3g} steps ({self.revolutions:.6g} revolutions{blade_text})"


def length_of_run(settings: Settings, scene: str, speed: float, revolutions: float | None = None) -> RunLength:
    """Length of a run in a scene at a speed (rad/s), with the level's revolutions unless they are given."""
    steps, chosen = settings.fidelity.time_integration, settings.scenes[scene].scene
    blades = 1 if chosen.rotor is None else len(chosen.rotor.numbers)
    step = steps.largest_step(chosen)
    return RunLength(speed, steps.revolutions if revolutions is None else revolutions, blades, step)


def slowest_speeds(settings: Settings) -> dict[str, float]:
    """The lowest speed (rad/s) of each scene's simulations in the sweep."""
    slowest: dict[str, float] = {}
    for (_, scene), plan in settings.speed_plans.items():
        slowest[scene] = min(plan.certain[0], slowest.get(scene, plan.certain[0]))
    return slowest


def most_runs(settings: Settings, blade: str, scene: str) -> int:
    """Simulations of a blade and scene, at most where speeds are adaptive."""
    refinement = settings.config.refinement.scene_refinement(settings.scenes[scene].scene)
    return settings.speed_plans[blade, scene].speed_count(refinement.largest_share)


def fastest_of(settings: Settings, scene: str) -> float:
    """The highest speed (rad/s) of a scene's simulations in the sweep."""
    return max(settings.speed_plans[blade, scene].certain[-1] for blade in settings.blade_names)
