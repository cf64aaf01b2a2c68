"""Checks that the step of a run is below its limits, of the free blade and of the pressed one."""

from collections.abc import Sequence

import numpy as np

from .contact_operators import ContactOperators
from .integrators import CENTRAL_DIFFERENCE
from .step_limit import UnstableStepError, largest_pressed_ratio, ratio_of_pressed_nodes


def check_step(contact: ContactOperators) -> None:
    """Raises UnstableStepError unless the run's step is below its limits, of the free blade and of the pressed one."""
    if contact.blade.grid.choice.integrator == CENTRAL_DIFFERENCE:
        _check_free_blade(contact)
        if contact.blade.scene.lined:
            stiffest, remedy = contact.casing.lining_stiffness.max(), ", or a softer, thicker or narrower lining"
            _check(contact, predicted_ratio(contact), "this lining", f" (up to {stiffest:.4g} N/m at a contact node)", remedy)
        return
    _check(contact, pressed_ratio(contact) / largest_pressed_ratio(contact.blade.scene), "nodes pressed on the casing")


def check_rotor_step(contacts: Sequence[ContactOperators]) -> None:
    """Raises UnstableStepError unless the step is below the limit of all blades that press one elastic casing at once."""
    if len(contacts) > 1:
        ratio = pressed_ratio_of_rotor(contacts) / largest_pressed_ratio(contacts[0].blade.scene)
        _check(contacts[0], ratio, f"{len(contacts)} blades pressed on one elastic casing")


def _check_free_blade(contact: ContactOperators) -> None:
    highest, grid = contact.highest_frequency, contact.blade.grid
    limit = 2.0 / highest
    what, remedy = "this reduced model", "raise basis_tolerance to drop the highest modes"
    if highest > contact.blade.frequencies.max():
        what, remedy = "this casing", "leave its highest modes out"
    if not grid.time_step < limit:
        raise UnstableStepError(
            f"{_taken(contact)} stability limit of {what}, {limit:.6g} s (highest mode {highest / 2e3 / np.pi:.1f} kHz); "
            f"use a smaller one, {remedy}, or take the integrator exact_modal",
            limit,
        )


def _check(contact: ContactOperators, ratio: float, what: str, detail: str = "", remedy: str = "") -> None:
    """UnstableStepError unless the `ratio` of the step to its limit, which grows with its square, is below 1."""
    if not ratio < 1.0:
        limit = float(contact.blade.grid.time_step / np.sqrt(ratio))
        raise UnstableStepError(
            f"{_taken(contact)} limit for {what}, about {limit:.6g} s{detail}; use a smaller one{remedy}", limit
        )


def _taken(contact: ContactOperators) -> str:
    grid = contact.blade.grid
    return f"time_step_s: {grid.choice.time_step:g} s gives steps of {grid.time_step:.6g} s, not below the"


def predicted_ratio(contact: ContactOperators) -> float:
    """Ratio of the step to the limit of a lining whose force is that of the prediction; unstable from 1 on.

    A node pressed by x on an elastic bar follows x_{n+1} = (1 - g)(2 x_n - x_{n-1}), g = bar stiffness times c at the node;
    both roots of the recursion lie inside the unit circle for 0 < g < 4/3. Of many nodes g are the eigenvalues of
    S^1/2 C S^1/2, with the stiffnesses S and the coupling C.
    """
    root = np.sqrt(contact.casing.lining_stiffness)
    return float(np.linalg.eigvalsh(root[:, None] * contact.coupling[0] * root)[-1]) * 0.75


def pressed_ratio(contact: ContactOperators) -> float:
    """Ratio of the step to its limit while all nodes are pressed on the casing: see ratio_of_pressed_nodes."""
    return ratio_of_pressed_nodes(contact.recursion, contact.displacement_operator[0], contact.contact_flexibility[0])


def pressed_ratio_of_rotor(contacts: Sequence[ContactOperators]) -> float:
    """Upper bound of how near the limit a step is in which all blades are pressed on one elastic casing: see pressed_ratio.

    M of all modes has a block A for the blades, D for the casing and C between them. Its largest eigenvalue is at most that of
    [[a, c], [c, d]], with a and d the largest eigenvalues of A and D, and c the largest singular value of C.
    """
    blades_part, keep, casing_part, between = 0.0, 1.0, 0.0, 0.0
    for contact in contacts:
        stepped, stepping = len(contact.blade.frequencies), contact.recursion
        pressed, shares = contact.displacement_operator[0] * np.sqrt(stepping.inverse), np.split(stepping.pull, [stepped])
        blade, casing = np.split(pressed, [stepped], axis=1)
        flexibility = contact.contact_flexibility[0]
        solved = np.linalg.solve(0.5 * (flexibility + flexibility.T), pressed)
        blade_solution, casing_solution = np.split(solved, [stepped], axis=1)
        blades_part = max(blades_part, float(np.linalg.eigvalsh(np.diag(shares[0]) + blade.T @ blade_solution)[-1]))
        # the casing's own part once, not once per blade
        casing_part = casing_part + casing.T @ casing_solution + np.diag(shares[1]) / len(contacts)
        across = blade.T @ casing_solution
        between = between + across.T @ across
        keep = min(keep, float(stepping.keep.min()))
    ring_part, coupled = (float(np.linalg.eigvalsh(matrix)[-1]) for matrix in (casing_part, between))
    largest = 0.5 * (blades_part + ring_part) + np.hypot(0.5 * (blades_part - ring_part), np.sqrt(coupled))
    return float(largest) / (2.0 * (1.0 + keep))
