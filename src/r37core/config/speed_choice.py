"""Speeds of a run: how many at most, and how fast."""

from __future__ import annotations

from .settings import Settings


def most_runs(settings: Settings, blade: str, scene: str) -> int:
    """Simulations of a blade and scene, at most where speeds are adaptive."""
    refinement = settings.config.refinement.in_scene(settings.scenes[scene].scene)
    return settings.speed_plans[blade, scene].at_most(refinement.largest_share)


def fastest_of(settings: Settings, scene: str) -> float:
    """The highest speed (rad/s) of a scene's simulations in the sweep."""
    return max(plan.every_speed()[-1] for (_, name), plan in settings.speed_plans.items() if name == scene)
