"""Whether the step of a run is below its limits, of the free blade and of the pressed one."""

from __future__ import annotations

import numpy as np

from .contact_operators import ContactOperators
from .integrators import CENTRAL_DIFFERENCE, Recursion
from .step_limit import UnstableStepError, largest_pressed_ratio, ratio_of_pressed_nodes

_OF_BLADE = "this reduced model", "raise basis_tolerance to drop the highest modes"


def check_step(contact: ContactOperators) -> None:
    """Raises UnstableStepError unless the run's step is below its limits, of the free blade and of the pressed one."""
    choice, step = contact.blade.grid.choice, contact.blade.grid.time_step
    taken = f"time_step_s: {choice.time_step:g} s gives steps of {step:.6g} s, not below the"
    if choice.integrator == CENTRAL_DIFFERENCE:
        _check_published_step(contact, taken)
        return
    ratio = pressed_ratio(contact) / largest_pressed_ratio(contact.blade.scene)
    if not ratio < 1.0:
        limit = step / np.sqrt(ratio)
        raise UnstableStepError(
            f"{taken} limit for nodes pressed on the casing, about {limit:.6g} s; use a smaller one", float(limit)
        )


def _check_published_step(contact: ContactOperators, taken: str) -> None:
    highest = contact.highest_frequency
    limit = 2.0 / highest
    of_casing = highest > contact.blade.frequencies[-1]
    what, remedy = ("this casing", "leave its highest modes out") if of_casing else _OF_BLADE
    if not contact.blade.grid.time_step < limit:
        raise UnstableStepError(
            f"{taken} stability limit of {what}, {limit:.6g} s (highest mode {highest / 2e3 / np.pi:.1f} kHz); "
            f"use a smaller one, {remedy}, or take the integrator exact_modal",
            limit,
        )
    if contact.blade.scene.lining is None:
        return
    ratio = predicted_ratio(contact)
    if not ratio < 1.0:
        limit = contact.blade.grid.time_step / np.sqrt(ratio)
        raise UnstableStepError(
            f"{taken} limit for this lining, about {limit:.6g} s (bars of {contact.casing.bar_stiffness:.4g} N/m); "
            "use a smaller one, or a softer, thicker or narrower lining",
            limit,
        )


def predicted_ratio(contact: ContactOperators) -> float:
    """How near the limit a lining is, whose force is that of the prediction; unstable from 1 on.

    A node pressed by x on an elastic bar follows x_{n+1} = (1 - g)(2 x_n - x_{n-1}), g = bar stiffness times c at the node;
    both roots of the recursion lie inside the unit circle for 0 < g < 4/3.
    """
    return contact.casing.bar_stiffness * float(np.linalg.eigvalsh(contact.coupling[0])[-1]) * 0.75


def pressed_ratio(contact: ContactOperators) -> float:
    """How near the limit a step of the run is in which all nodes are pressed on the casing: see ratio_of_pressed_nodes.

    A coupled mode counts as two, with the real and the imaginary part of its shape: the limit is where a motion changes its
    sign in every step, and there the two are not coupled.

    All B blades of a rotor press its elastic casing. Of modes x_b of the blades and y of the casing it is that of a single
    blade which moves the casing's modes by sqrt(B) times as much: sum_b (x_b, y)^T M_b (x_b, y) with a share 1/B of the
    casing's own part in each M_b is, in z_b = (x_b, y/sqrt(B)), at most the largest eigenvalue of those times
    sum_b |z_b|^2 = sum_b |x_b|^2 + |y|^2; blades that press alike reach it.
    """
    of, normal, flexibility = contact.recursion, contact.displacement_operator[0], contact.contact_flexibility[0]
    moved = np.ones(normal.shape[-1])
    if contact.blade.scene.rotor is not None:
        moved[len(contact.blade.frequencies) :] = np.sqrt(len(contact.blade.scene.rotor.numbers))
    if contact.complex_operator is not None:
        normal, moved = np.hstack([contact.complex_operator[0].real, contact.complex_operator[0].imag]), np.tile(moved, 2)
        of = Recursion(*(np.tile(part, 2) for part in (of.keep, of.pull, of.inverse, of.lost)))
    return ratio_of_pressed_nodes(of, normal * moved, flexibility)
