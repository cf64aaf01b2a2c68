"""The blades of a rotor as problems of their own: what mistuning and length change of each."""

from dataclasses import replace

import numpy as np

from r37core.contact.scene import Rotor, Scene
from r37core.rom.contact_model import ContactModel

from .integration_choice import IntegrationChoice
from .problem import Problem, stable_problem
from .step_checks import check_rotor_step
from .step_limit import UnstableStepError

NO_ROTOR = "until: revolutions; the blades of a rotor pass the casing one after another, and end together"
"""End of a run that a scene with a rotor can have."""


def refusal_of(scene: Scene) -> str | None:
    """Requirement of the blades of a scene's rotor that it does not meet, None where they can be run."""
    if scene.rotor is None or scene.lined or scene.casing.ring:
        return None
    return "a lining; in direct contact with a rigid casing nothing couples the blades: run a single blade for each"


def blade_problems(
    model: ContactModel, speed: float, scene: Scene, rotor: Rotor, choice: IntegrationChoice
) -> tuple[Problem, ...]:
    """Problems, one for each blade of the rotor, all with the steps of the one that needs the shortest.

    Equal blades have the same. In an elastic casing, which has an angle 0 of its own, each stands at its angle; in a rigid one
    all stand at that of the model. Raises what Problem raises; ValueError for a rotor that cannot be run.
    """
    refused = refusal_of(scene)
    if refused:
        raise ValueError(f"rotor: allowed: {refused}")
    if scene.casing.ring and not choice.second_order:
        raise ValueError("an elastic casing under a rotor needs the integrator exact_modal")

    angles = rotor.angles if scene.casing.ring else (0.0,) * len(rotor.angles)
    blades = list(zip(rotor.frequency_factors, rotor.longer, angles, strict=True))
    unlike = {}
    for factor, longer, angle in dict.fromkeys(blades):
        own_scene = replace(scene, rotor=None, casing=replace(scene.casing, longer=longer))
        unlike[factor, longer, angle] = stable_problem(turned(mistuned(model, factor), angle), speed, own_scene, choice)
    steps = max(own.grid.steps_per_sample for own in unlike.values())
    for blade, own in unlike.items():
        if own.grid.steps_per_sample != steps:
            unlike[blade] = Problem(own.model, speed, own.scene, replace(own.choice, steps_per_sample=steps))
    problems = tuple(unlike[blade] for blade in blades)
    if scene.casing.ring:
        try:
            check_rotor_step([problem.contact for problem in problems])
        except UnstableStepError as error:
            if not choice.shorten:
                raise
            return blade_problems(model, speed, scene, rotor, replace(choice, time_step=error.shortened))
    return problems


def turned(model: ContactModel, angle: float) -> ContactModel:
    """The model at an angle (rad) beyond its own."""
    if not angle:
        return model
    edge_theta = None if model.edge_theta is None else model.edge_theta + angle
    return replace(model, theta=model.theta + angle, edge_theta=edge_theta)


def mistuned(model: ContactModel, factor: float) -> ContactModel:
    """The model with all frequencies, at any speed, times a factor: its stiffness times the square, its modes as they are."""
    if factor == 1.0:
        return model
    square = factor**2
    return replace(
        model,
        squared_frequencies=model.squared_frequencies * square,
        stiffness_per_square=np.multiply(model.stiffness_per_square, square),
        quadratic=model.quadratic and model.quadratic.stiffened(square),
    )
