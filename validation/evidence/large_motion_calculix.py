"""Large motion against CalculiX: blades that a load bends far, and one that is let go (docs/large_motion.md).

The meshes, the material and the loads are the same. CalculiX solves the full mesh with NLGEOM, ours is the reduced model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.fem.solver import lowest_modes
from r37core.mesh.blade_mesh import BladeMesh
from r37core.mesh.generate import generate_mesh
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.segments import own_increments
from r37core.time_integration.simulate import Simulation

from .blade_runs import mesh_of, reduced_model
from .calculix import displacements
from .configuration import settings_of
from .tables import write_table

BENT = (0.010, 0.015)
"""Motions (m) of the leading edge by linear theory."""

SPEED = 50.0
"""A speed (rad/s) near rest."""

PERIODS, STEPS = 2, 60
"""Periods of the blade that is let go, and steps of CalculiX in one."""

COARSE = {"nodes": 1200, "layers": 1, "tip_elements": 12}
"""Its mesh: CalculiX takes hundreds of corrections."""

EDGE = "tip_pressure_edge"


@dataclass(frozen=True)
class Bent:
    """Displacement of the leading edge (m): radial, and of all directions."""

    radial: float
    whole: float


@dataclass(frozen=True)
class Load:
    """A load of a size of one: forces (N) on all nodes, shape (nodes, 3), and on the coordinates of a reduced model.

    The latter on its stepped modes, and on the products of second order and at once on the other modes by `static` (m).
    """

    nodal: np.ndarray
    stepped: np.ndarray
    products: np.ndarray
    static: np.ndarray


class FreeBlade:
    """A blade without contact and damping: its mesh, and its reduced model in a simulation near rest."""

    def __init__(self, settings: Settings, blade: str, mesh: BladeMesh, time_step: float):
        boundary, scene = settings.boundary_choice(blade), settings.scenes["direct"].scene
        model = contact_model(reduced_model(mesh, settings, blade), boundary.tip_line)
        far = replace(scene, casing=replace(scene.casing, clearance=1.0, lobes=0), damping_ratio=0.0)
        choice = replace(settings.integration_choice(blade, "direct"), time_step=time_step, until_settled=False)
        choice = replace(choice, revolutions=1, samples_per_revolution=round(2.0 * np.pi / SPEED / 6.4e-6))
        self.simulation = Simulation(model, SPEED, far, choice)
        self._mesh, self._material = mesh, settings.blades[blade].material

    def edge_force(self) -> Load:
        """A force along the tangents of the tip's edge, equal on all of its nodes."""
        problem, nodes = self.simulation.problem, self._mesh.node_set(EDGE)
        x, y = self._mesh.points[nodes, :2].T / np.hypot(*self._mesh.points[nodes, :2].T)
        nodal = np.zeros_like(self._mesh.points)
        nodal[nodes, 0], nodal[nodes, 1] = -y / len(nodes), x / len(nodes)
        assert problem.model.edge_displacement_operator is not None
        edge = problem.model.edge_displacement_operator[1].mean(axis=0)
        frequencies, shapes = problem.blade.static_modes
        static = shapes @ (edge @ shapes / frequencies**2)
        return Load(nodal, edge @ problem.blade.modes, edge @ problem.contact.product_shapes, static)

    def inertia_of_first_mode(self) -> Load:
        """The mass times the first mode, as a vibrating blade is bent by: it does no work on other modes."""
        matrices, problem = assemble(self._mesh, self._material), self.simulation.problem
        mode = lowest_modes(matrices.stiffness(), matrices.mass(), 1)[1][:, 0]
        nodal, shape = np.zeros((2, *self._mesh.points.shape))
        nodal[matrices.free_nodes] = (matrices.mass() @ mode).reshape(-1, 3)
        shape[matrices.free_nodes] = mode.reshape(-1, 3)
        leading = int(self._mesh.node_set(EDGE)[0])
        ours = (problem.model.tip_displacement_operator[1, 0] @ problem.blade.modes)[0]
        theirs = to_cylindrical(self._mesh.points[leading]) @ shape[leading]
        stepped = np.zeros(len(problem.blade.frequencies))
        stepped[0] = np.sign(ours)
        products, modes = problem.contact.product_shapes.shape[1], len(problem.model.squared_frequencies)
        return Load(np.sign(theirs[1]) * nodal, stepped, np.zeros(products), np.zeros(modes))

    def _tip(self, displacement: np.ndarray, static: np.ndarray) -> np.ndarray:
        """Displacement of the leading edge (m), with that of the modes that are not stepped."""
        problem, contact = self.simulation.problem, self.simulation.problem.contact
        shapes = problem.blade.modes @ displacement + contact.product_shapes @ contact.quadratic.products(displacement)
        return problem.model.tip_displacement_operator[:, 0] @ (shapes + static)

    def size(self, load: Load, motion: float) -> float:
        """Size of a load at which linear theory moves the leading edge so far (m)."""
        problem = self.simulation.problem
        shapes = problem.blade.modes @ (load.stepped / problem.blade.frequencies**2) + load.static
        return motion / float(np.linalg.norm(problem.model.tip_displacement_operator[:, 0] @ shapes))

    def _residual(self, displacement: np.ndarray, load: Load, size: float) -> np.ndarray:
        """Forces (N) on the stepped modes. The load acts on the products of second order, too: their rates are exact."""
        problem, steps = self.simulation.problem, np.eye(len(displacement))
        quadratic = problem.contact.quadratic
        rates = 0.5 * (quadratic.products(displacement + steps) - quadratic.products(displacement - steps))
        outside = size * (load.stepped + rates @ load.products)
        return outside + quadratic.force(displacement) - problem.blade.frequencies**2 * displacement

    def held(self, load: Load, size: float) -> np.ndarray:
        """Displacement of the stepped modes under a load, by Newton's method. RuntimeError where it finds none."""
        problem = self.simulation.problem
        u = size * load.stepped / problem.blade.frequencies**2
        free = slice(len(u) - problem.blade.followers.shape[1])
        for _ in range(200):
            problem.contact.quadratic.follow(u, np.zeros_like(u))
            steps = 1e-9 * np.eye(len(u))
            slopes = [self._residual(u + step, load, size) - self._residual(u - step, load, size) for step in steps]
            correction = np.linalg.solve(np.array(slopes).T / -2e-9, self._residual(u, load, size))
            u = u + correction
            if np.linalg.norm(correction[free]) <= 1e-8 * np.linalg.norm(u[free]):
                return u
        raise RuntimeError(f"no equilibrium under a load of {size:g}")

    def bent(self, load: Load, size: float) -> Bent:
        """The leading edge under a load."""
        return bent_of(self._tip(self.held(load, size), size * load.static))

    def released(self, load: Load, size: float, end: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (s) up to an `end`, and radial and tangential motion of the leading edge (m), from where a load held it."""
        simulation, u = self.simulation, self.held(load, size)
        state, problem = simulation.start(), simulation.problem
        rate, stepping, quadratic = np.zeros_like(u), problem.blade.recursion, problem.contact.quadratic
        problem.contact.put_followers(u, rate)
        state.displacement[:] = u
        # forces kick at an instant, and the velocity is that in the middle of the kick
        kick = stepping.inverse * quadratic.force(u) / (1.0 + stepping.keep)
        state.increment[:] = own_increments(problem).increment(0, u, rate) - kick
        per_sample = 2.0 * np.pi / SPEED / problem.choice.samples_per_revolution
        samples = simulation.advance_samples(state, int(end / per_sample)).samples
        return per_sample * np.arange(1, len(samples) + 1), samples[:, 1:3]


def bent_of(cylindrical: np.ndarray) -> Bent:
    """The leading edge from its radial, tangential and axial displacement (m)."""
    return Bent(float(cylindrical[0]), float(np.linalg.norm(cylindrical)))


class CalculixBlade:
    """A mesh in CalculiX."""

    def __init__(self, mesh: BladeMesh, material: Material):
        self._mesh, self._material = mesh, material

    def run(self, steps: Sequence[str]) -> np.ndarray:
        """Cylindrical displacement (m) of the leading edge at each output, shape (outputs, 3)."""
        leading = int(self._mesh.node_set(EDGE)[0])
        rows = displacements(self._mesh, self._material, ["*NSET, NSET=LEADING", f"{leading + 1},", *steps])
        return rows @ to_cylindrical(self._mesh.points[leading]).T

    def bent(self, load: np.ndarray) -> Bent:
        """The leading edge under forces (N) on all nodes, shape (nodes, 3)."""
        return bent_of(self.run(list(self._static(load)))[0])

    def _static(self, load: np.ndarray) -> Iterator[str]:
        yield from ("*STEP, NLGEOM, INC=200", "*STATIC", "0.2, 1.0", "*CLOAD")
        for (node, axis), force in np.ndenumerate(load):
            if force:
                yield f"{node + 1}, {axis + 1}, {force:.12g}"
        # CalculiX steps through time only where the energy has been an output before
        yield from ("*NODE PRINT, NSET=LEADING, FREQUENCY=200", "U", "*EL FILE, FREQUENCY=200", "ENER", "*END STEP")

    def released(self, load: np.ndarray, period: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (s), and radial and tangential motion of the leading edge (m), from where forces (N) held it."""
        step = period / STEPS
        lines = [*self._static(load), f"*STEP, NLGEOM, INC={PERIODS * STEPS + 1}", "*DYNAMIC, DIRECT, ALPHA=0."]
        lines += [f"{step:.12g}, {PERIODS * period:.12g}", "*CLOAD, OP=NEW", "*NODE PRINT, NSET=LEADING, FREQUENCY=1", "U"]
        motion = self.run([*lines, "*END STEP"])[1:, :2]
        return step * np.arange(1, len(motion) + 1), motion


def to_cylindrical(point: np.ndarray) -> np.ndarray:
    """Turns a displacement at a `point` into its radial, tangential and axial parts, shape (3, 3)."""
    x, y = point[:2] / np.hypot(*point[:2])
    return np.array([[x, y, 0.0], [-y, x, 0.0], [0.0, 0.0, 1.0]])


def period_of(times: np.ndarray, motion: np.ndarray) -> float:
    """Mean time (s) between rising crossings of zero."""
    rising = np.flatnonzero((motion[:-1] < 0.0) & (motion[1:] >= 0.0))
    moments = times[rising] - motion[rising] * (times[rising + 1] - times[rising]) / (motion[rising + 1] - motion[rising])
    return float((moments[-1] - moments[0]) / (len(moments) - 1))


def static(input: Any, output: Any, params: Any) -> None:
    """Table of all blades under both loads, and the largest differences of all. Params: configuration, blades."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity="draft")
    pairs: dict[str, list[list[tuple[Bent, Bent]]]] = {}
    for blade in params.blades:
        mesh = mesh_of(settings, blade)
        ours, theirs = FreeBlade(settings, blade, mesh, 4e-7), CalculixBlade(mesh, settings.blades[blade].material)
        inertia, edge = ours.inertia_of_first_mode(), ours.edge_force()
        for load, motion in ((inertia, BENT[0]), (inertia, BENT[1]), (edge, BENT[0])):
            sizes = [sense * ours.size(load, motion) for sense in (1, -1)]
            pairs.setdefault(blade, []).append([(ours.bent(load, size), theirs.bent(size * load.nodal)) for size in sizes])
    rows = [[blade, *(cell for of_load in loads for cell in cells(of_load))] for blade, loads in pairs.items()]
    of_all = [[pair for loads in pairs.values() for pair in loads[number]] for number in range(3)]
    rows.append(["all", *(cell for of_load in of_all for cell in ("", *cells(of_load)[1:]))])
    loads = ("10 mm, inertia of 1B", "15 mm, inertia of 1B", "10 mm, force on the tip's edge")
    names = ("radial, ours / CalculiX (mm)", "largest radial difference (mm)", "difference of the motion")
    write_table(["blade", *(f"{load}: {name}" for load in loads for name in names)], rows, output.table)


def cells(pairs: Sequence[tuple[Bent, Bent]]) -> list[str]:
    """Radial motions in both programs (mm), the largest of their differences, and that of the whole motion."""
    radial = "; ".join(f"{1e3 * ours.radial:.3f} / {1e3 * theirs.radial:.3f}" for ours, theirs in pairs)
    apart = max(abs(ours.radial - theirs.radial) for ours, theirs in pairs)
    whole = max(abs(ours.whole / theirs.whole - 1.0) for ours, theirs in pairs)
    return [radial, f"{1e3 * apart:.3f}", f"{100.0 * whole:.1f}%"]


def decay(input: Any, output: Any, params: Any) -> None:
    """Table of a blade that is let go. Params: configuration, blade."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity="draft")
    mesh = generate_mesh(settings.blades[params.blade].shape.build(round_edges=True), **COARSE)
    ours = FreeBlade(settings, params.blade, mesh, 8e-7)
    load = ours.inertia_of_first_mode()
    size, period = ours.size(load, BENT[0]), 2.0 * np.pi / float(ours.simulation.problem.blade.frequencies[0])
    times, theirs = CalculixBlade(mesh, settings.blades[params.blade].material).released(size * load.nodal, period)
    our_times, samples = ours.released(load, size, PERIODS * period)
    mine = np.array([np.interp(times, our_times, column) for column in samples.T]).T
    apart = np.abs(mine - theirs).max(axis=0)
    periods = [period_of(times, motion) for motion in (mine[:, 1], theirs[:, 1])]
    numbers = [f"{1e3 * np.ptp(theirs[:, 1]):.1f}", *(f"{1e3 * value:.3f}" for value in apart[::-1])]
    numbers += [f"{1e6 * value:.1f}" for value in periods] + [f"{100.0 * abs(periods[0] / periods[1] - 1.0):.2f}%"]
    head = ["tangential, peak to peak (mm)", "tangential: largest difference (mm)", "radial: largest difference (mm)"]
    head += ["period, ours (us)", "period, CalculiX (us)", "difference of the period"]
    write_table(["blade", *head], [[params.blade, *numbers]], output.table)
