"""Checks that no model of one file can make: each function compares values of several keys or files.

Each of `CHECKS` raises ConfigError with the place of the value to blame. All of them are run: one that needs what another has
refused meets the same refusal in `Settings`, and that is told once.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from r37core.base.rounding import rounded_up
from r37core.base.units import RPM
from r37core.base.yaml_file import KeyPath
from r37core.machine_code.alignment import padded
from r37core.results.operating_range import OperatingRange
from r37core.rom.reduction_choice import LINEAR, POINTS, QUADRATIC, ROTATING, BoundaryError, contact_positions
from r37core.time_integration.integration_choice import LARGEST_TABLE, MOST_STEPS
from r37core.time_integration.integrators import EXACT_MODAL
from r37core.time_integration.rotor_blades import NO_ROTOR

from .config_file import key_of_speeds
from .document import ConfigRefusals
from .elastic_casings import elastic_casings_have_their_waves
from .settings import RunLength, Settings, blades_of_matrices, fastest_of, length_of_run, slowest_speeds

LARGEST_NUMBER_OF_SIMULATIONS = 200_000
"""Jobs that Snakemake can still plan: about 25 kB of memory and 1 ms for each."""


def what_is_named_is_there(settings: Settings) -> None:
    """Level, blades and scenes that are named, also of speeds, are in their files."""
    refusals = ConfigRefusals()
    for name in ("fidelity_name", "blade_names", "scene_names"):
        refusals.of(getattr, settings, name)
    for number, rule in enumerate(settings.config.speeds_for):
        refusals.of(names_are_there, settings, ("speeds_for", number), rule)
    refusals.tell()


def names_are_there(settings: Settings, path: KeyPath, section: Any) -> None:
    """Blades, families and scenes that a section at `path` of config.yaml names, if not `all`, are in their files."""
    refusals = ConfigRefusals()
    for key, designs in (("blades", settings.designs), ("scenes", settings.scene_designs)):
        if getattr(section, key) not in (None, "all"):
            refusals.of(settings.document.known, (*path, key), getattr(section, key), designs.names, designs.document)
    refusals.tell()


def simulations_can_be_planned(settings: Settings) -> None:
    """Speeds go together, and there are not more simulations than Snakemake can plan."""
    number = sum(len(plan.certain) for plan in settings.speed_plans.values())
    if number > LARGEST_NUMBER_OF_SIMULATIONS:
        planned = f"{number} simulations of {len(settings.blade_names)} blades in {len(settings.scene_names)} scenes"
        allowed = f"at most {LARGEST_NUMBER_OF_SIMULATIONS} in one run; more in several, with a run.name each"
        raise settings.document.refusal(planned, allowed, "speeds")


def windows_have_crossings(settings: Settings) -> None:
    """No window lies above crossings that the Campbell diagram does not have."""
    if not any(plan.refined for plan in settings.speed_plans.values()):
        return
    refining = settings.config.refinement
    for path, windows in {("refinement",): refining.windows, ("refinement", "direct"): refining.direct.windows}.items():
        for number, window in enumerate(windows):
            place: KeyPath = (*path, "windows", number, "highest_engine_order")
            engine_order_is_known(settings, place, window.highest_engine_order)


def engine_order_is_known(settings: Settings, path: KeyPath, engine_order: int) -> None:
    """ConfigError at `path` of config.yaml for an engine order above those whose crossings the Campbell diagram has."""
    highest = settings.config.campbell.highest_engine_order
    if engine_order > highest:
        allowed = f"at most campbell.highest_engine_order ({highest})"
        raise settings.document.refusal(f"{engine_order}", allowed, *path)


def pairs_not_covered(settings: Settings, operating: OperatingRange) -> list[tuple[str, str]]:
    """Blades and scenes whose speeds do not reach over the whole operating range."""
    plans = settings.speed_plans.items()
    return [pair for pair, plan in plans if not operating.is_covered(np.array(sorted(plan.certain)))]


def slowest_speeds_can_be_run(settings: Settings) -> None:
    """Neither the slowest run of each scene nor its revolution has too many steps."""
    for scene, speed in slowest_speeds(settings).items():
        slow_run_can_be_done(length_of_run(settings, scene, speed), settings, (key_of_speeds(settings.config),))


def slow_run_can_be_done(run: RunLength, settings: Settings, path: KeyPath) -> None:
    """ConfigError for a run, whose speed stands at `path` of config.yaml, that has too many steps, or its revolution."""
    size = 8 * padded(settings.made(_most_nodes)) * run.steps_per_revolution
    excess = max(size / LARGEST_TABLE, run.steps / MOST_STEPS)
    if excess > 1.0:
        lowest = run.speed * excess
        rpm_hint = f" ({rounded_up(RPM * lowest)} rpm)" if str(path[-1]).endswith("_rpm") else ""
        raise settings.document.refusal(
            f"{run.speed:g} rad/s, a revolution of {run.steps_per_revolution:.3g} steps of {run.time_step:g} s, {run.wording}",
            f"speeds from {rounded_up(lowest)} rad/s{rpm_hint} with this step and as many revolutions: a run has at most "
            f"{MOST_STEPS:.0e} steps, and the casing's shape at every step of a revolution takes at most "
            f"{LARGEST_TABLE / 2**20:.0f} MiB",
            *path,
        )


def _most_nodes(settings: Settings) -> int:
    return max(settings.boundary_choice(name).most_nodes for name in settings.blades)


def matrices_hold_their_terms(settings: Settings) -> None:
    """No term of rotation is wanted that cannot be added to matrices of another program."""
    matrices = blades_of_matrices(settings)
    if matrices and settings.structure.spin_softening:
        value = f"true with the blade '{matrices[0]}', given by matrices"
        allowed = "false; put the term into its K_<speed>"
        raise settings.document.refusal(value, allowed, "structure", "spin_softening")


def kinematics_can_be_had(settings: Settings) -> None:
    """Large displacements are wanted of blades with a mesh, and those of second order with what carries them."""
    structure, key, document = settings.structure, ("structure", "kinematics"), settings.document
    wanted = {name: settings.kinematics_of(name) for name in settings.blades}
    matrices = [name for name in blades_of_matrices(settings) if wanted[name] != LINEAR]
    if matrices:
        origin = f"the blade '{matrices[0]}', given by matrices, which say nothing of large displacements"
        raise document.refusal(f"{wanted[matrices[0]]} with {origin}", f"{LINEAR}, or the blade's mesh", *key)
    quadratic = [name for name, kinematics in wanted.items() if kinematics == QUADRATIC]
    if not quadratic:
        return
    value = QUADRATIC
    if structure.kinematics is None:
        # the entry that says so, or that leaves it out
        document, key = settings.designs.document, (quadratic[0], "kinematics")
    integrator = settings.fidelity.time_integration.integrator
    if integrator != EXACT_MODAL:
        level = f"the level '{settings.fidelity_name}', whose integrator {integrator} does not carry it"
        raise document.refusal(f"{value} at {level}", f"{LINEAR} or {ROTATING}, or {_exact_level(settings)}", *key)


def discs_carry_one_blade(settings: Settings) -> None:
    """A sector of a disc has small displacements and one blade in contact, and its matrices are not those of a blade."""
    wanted = {name: settings.kinematics_of(name) for name, blade in settings.blades.items() if blade.cyclic}
    for name, kinematics in wanted.items():
        if kinematics != LINEAR:
            value = f"{kinematics} with the blade '{name}', on a disc"
            raise settings.document.refusal(value, f"{LINEAR}, or the blade without its disc", "structure", "kinematics")
    for name, chosen in settings.scenes.items():
        if wanted and chosen.scene.rotor is not None:
            value = f"a rotor with the blade '{next(iter(wanted))}', on a disc: blades are not coupled through it"
            allowed = "one blade in contact, or the blade without its disc"
            raise settings.scene_designs.document.refusal(value, allowed, name, "rotor")


def tips_have_room_for_patches(settings: Settings) -> None:
    """Patches are no finer than the tip's mesh, as far as it is known before it is made."""
    mesh, document = settings.fidelity.mesh, settings.document
    for name, blade in settings.blades.items():
        for tip_line in dict.fromkeys(scene.tip_line for scene in settings.scenes.values()):
            boundary = settings.boundary_choice(name, tip_line)
            if boundary.contact == POINTS or not blade.has_profiles:
                continue
            # edges of elements between two layers have nodes in their middle; edges inside a layer have none
            inside = tip_line == "camber" and mesh.layers % 2
            nodes = mesh.tip_elements + 1 if inside else 2 * mesh.tip_elements + 1
            try:
                contact_positions(boundary, np.linspace(0.0, 1.0, nodes), f"mesh nodes of the tip line '{tip_line}'")
            except BoundaryError as error:
                raise document.error(("structure", "boundary", "nodes"), f"blade '{name}': {error} (tip_elements)") from None


def _exact_level(settings: Settings) -> str:
    """A level with the integrator that carries everything, and which ones there are."""
    others = [name for name, level in settings.levels.items() if level.time_integration.integrator == EXACT_MODAL]
    return f"a level of {EXACT_MODAL}" + (f" ({', '.join(others)})" if others else "")


def rotors_can_be_run(settings: Settings) -> None:
    """All blades press an elastic casing with the integrator whose forces are those at t_n, and their runs end together."""
    integrator = settings.fidelity.time_integration.integrator
    for name, chosen in settings.scenes.items():
        if chosen.scene.rotor is not None and chosen.scene.casing.ring and integrator != EXACT_MODAL:
            value = f"a rotor in an elastic casing at the level '{settings.fidelity_name}', whose integrator is {integrator}"
            raise settings.scene_designs.document.refusal(value, _exact_level(settings), name, "rotor")
        if chosen.scene.rotor is not None and chosen.until_settled:
            path = (settings.fidelity_name, "time_integration", "until")
            raise settings.levels_document.refusal(f"settled with the rotor of '{name}'", NO_ROTOR, *path)


def clearances_reach_all_speeds(settings: Settings) -> None:
    """The growth of a casing is given up to the highest speed; the blades' own follows from their mesh."""
    document, matrices = settings.scene_designs.document, blades_of_matrices(settings)
    for name, chosen in settings.scenes.items():
        casing, path = chosen.scene.casing, (name, "casing", "clearance")
        modelled, run = settings.structure.maximum_speed_rad_s, fastest_of(settings, name)
        highest, what = (run, "the fastest of its speeds") if run > modelled else (modelled, "structure.maximum_speed_rad_s")
        if not casing.knows(highest):
            allowed = f"up to {what}, {highest:g} rad/s ({highest * RPM:.6g} rpm)"
            raise document.refusal(f"growth up to {casing.growth_speeds[-1]:g} rad/s", allowed, *path, "casing_growth")
        if casing.centrifugal and matrices:
            value = f"true, as without the key, with the blade '{matrices[0]}', given by matrices: its load is not known"
            allowed = "false, with the blade's growth taken off in casing_growth, in a scene of its own"
            raise document.refusal(value, allowed, *path, "centrifugal")


CHECKS: tuple[Callable[[Settings], None], ...] = (
    what_is_named_is_there,
    simulations_can_be_planned,
    windows_have_crossings,
    slowest_speeds_can_be_run,
    matrices_hold_their_terms,
    kinematics_can_be_had,
    discs_carry_one_blade,
    tips_have_room_for_patches,
    rotors_can_be_run,
    clearances_reach_all_speeds,
    elastic_casings_have_their_waves,
)
"""Checks in the order in which their refusals are reported."""
