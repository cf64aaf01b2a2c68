"""What a run of the spine says before it starts, and at its end."""

from __future__ import annotations

from . import casing_remarks
from .settings import Settings
from .speed_choice import most_runs


def remarks_of_spine(settings: Settings) -> list[str]:
    """What a run should say before it starts."""
    lines = []
    measured = settings.fidelity.measured
    if settings.config.fidelity == "auto" and measured is not None:
        error = measured.error_of(bool(settings.direct_on_points[0]))
        if error is not None:
            share, cost = 100 * error, measured.cpu_s_per_run
            lines.append(f"fidelity auto: level {settings.fidelity_name}, measured error {share:g}%, {cost:g} CPU s per run")
    lines += remarks_on_speeds(settings)
    lines += casing_remarks.of_sweep(settings)
    lines += casing_remarks.of_left_out_modes(casing_remarks.elastic_casings(settings))
    refining = {pair: plan for pair, plan in settings.speed_plans.items() if plan.refined}
    if refining:
        certain = sum(len(plan.certain) for plan in refining.values())
        most = sum(most_runs(settings, *pair) for pair in refining)
        lines.append(
            f"adaptive speed sampling: {certain} simulations and those of the windows first, about {most} at most; "
            "they are planned round by round, so a dry run shows none of those to come"
        )
    return lines


def remarks_on_speeds(settings: Settings) -> list[str]:
    """What is to be said of speeds beyond those that models are made for: they may be rpm."""
    fastest = max(plan.every_speed()[-1] for plan in settings.speed_plans.values())
    highest = settings.structure.maximum_speed_rad_s
    if fastest <= highest:
        return []
    in_rpm = "" if settings.config.speeds_rpm else "; speeds in rpm stand under speeds_rpm"
    return [
        f"speeds: up to {fastest:g} rad/s, and structure.maximum_speed_rad_s is {highest:g}: reduced models and "
        f"Campbell diagrams are made for speeds up to that; raise it to what is run{in_rpm}"
    ]


def remarks_on_points(settings: Settings) -> list[str]:
    """What a run should say at its end of direct contact on points, which has no limit in the mesh."""
    scenes, blades = settings.direct_on_points
    if not scenes:
        return []
    of = f"{len(blades)} blades" if len(blades) > 1 else blades[0]
    return [
        f"{', '.join(scenes)}: contact of {of} acts on points, as published, and changes with every finer mesh; for "
        "numbers to decide from: structure.boundary.contact: patches (docs/accuracy.md#points-and-patches)"
    ]
