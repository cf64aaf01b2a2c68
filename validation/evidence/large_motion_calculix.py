"""Large motion against CalculiX: blades that a force at the tip bends far, and one that is let go (docs/large_motion.md).

The meshes, the material and the loads are the same. CalculiX solves the full mesh with NLGEOM, ours is the reduced model.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from r37core.config import Settings
from r37core.fem.abaqus_deck import write_abaqus
from r37core.fem.material import Material
from r37core.mesh.blade_mesh import BladeMesh
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.initial_motion import InitialMotion
from r37core.time_integration.simulate import Simulation

from .blade_runs import mesh_of, reduced_model
from .configuration import settings_of
from .pages import write_table

BENT = (0.010, 0.015)
"""Motions (m) of the leading edge by linear theory."""

SPEED = 50.0
"""A speed (rad/s) near rest."""

RELEASED, PERIODS, STEPS = 0.010, 2, 80
"""The blade that is let go: motion (m), periods, and steps of CalculiX in one."""

EDGE = "tip_pressure_edge"


@dataclass(frozen=True)
class Bent:
    """Displacement of the leading edge (m): radial, and of all directions."""

    radial: float
    whole: float


class FreeBlade:
    """The reduced model of a blade without contact and damping, with a force along the tangent of the tip's edge."""

    def __init__(self, settings: Settings, blade: str, mesh: BladeMesh, time_step: float):
        boundary, scene = settings.boundary_choice(blade), settings.scenes["direct"].scene
        model = contact_model(reduced_model(mesh, settings, blade), boundary.tip_line)
        far = replace(scene, casing=replace(scene.casing, clearance=1.0, lobes=0), damping_ratio=0.0)
        choice = replace(settings.integration_choice(blade, "direct", SPEED), time_step=time_step, static_above=np.inf)
        choice = replace(choice, until_settled=False, revolutions=1, samples_per_revolution=round(2.0 * np.pi / SPEED / 6.4e-6))
        self.simulation = Simulation(model, SPEED, far, choice)
        problem = self.simulation.problem
        assert problem.model.edge_displacement_operator is not None
        edge = problem.model.edge_displacement_operator[1].mean(axis=0)
        self._unit, self._unit_of_products = edge @ problem.blade.modes, edge @ problem.contact.product_shapes
        frequencies, shapes = problem.blade.static_modes
        self._static = shapes @ (edge @ shapes / frequencies**2)

    def _tip(self, displacement: np.ndarray, force: float) -> np.ndarray:
        """Displacement of the leading edge (m), with that of the modes that are not stepped."""
        problem, contact = self.simulation.problem, self.simulation.problem.contact
        shapes = problem.blade.modes @ displacement + contact.product_shapes @ contact.quadratic.products(displacement)
        return problem.model.tip_displacement_operator[:, 0] @ (shapes + force * self._static)

    def force(self, motion: float) -> float:
        """Force (N) at which linear theory moves the leading edge so far (m)."""
        problem = self.simulation.problem
        per_newton = problem.blade.modes @ (self._unit / problem.blade.frequencies**2) + self._static
        return motion / float(np.linalg.norm(problem.model.tip_displacement_operator[:, 0] @ per_newton))

    def _residual(self, displacement: np.ndarray, force: float) -> np.ndarray:
        """Forces (N) on the stepped modes. The load acts on the products of second order, too: their rates are exact."""
        problem, steps = self.simulation.problem, np.eye(len(displacement))
        quadratic = problem.contact.quadratic
        rates = 0.5 * (quadratic.products(displacement + steps) - quadratic.products(displacement - steps))
        load = force * (self._unit + rates @ self._unit_of_products)
        return load + quadratic.force(displacement) - problem.blade.frequencies**2 * displacement

    def held(self, force: float) -> np.ndarray:
        """Displacement of the stepped modes under a force (N), by Newton's method. RuntimeError where it finds none."""
        problem = self.simulation.problem
        u = force * self._unit / problem.blade.frequencies**2
        free = slice(len(u) - problem.blade.followers.shape[1])
        for _ in range(200):
            problem.contact.quadratic.follow(u, np.zeros_like(u))
            steps = 1e-9 * np.eye(len(u))
            tangent = np.array([self._residual(u + step, force) - self._residual(u - step, force) for step in steps]) / -2e-9
            correction = np.linalg.solve(tangent.T, self._residual(u, force))
            u = u + correction
            if np.linalg.norm(correction[free]) <= 1e-8 * np.linalg.norm(u[free]):
                return u
        raise RuntimeError(f"no equilibrium at {force:g} N")

    def bent(self, force: float) -> Bent:
        """The leading edge under a force (N)."""
        return bent_of(self._tip(self.held(force), force))

    def released(self, force: float, end: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (s) up to an `end`, and motion of the leading edge (m): radial and tangential, from where a force held it."""
        simulation, u = self.simulation, self.held(force)
        state, problem = simulation.start(), simulation.problem
        InitialMotion(problem.model.to_reduced @ (problem.blade.modes @ u), None).put(problem, state)
        per_sample = 2.0 * np.pi / SPEED / problem.choice.samples_per_revolution
        samples = simulation.advance_samples(state, int(end / per_sample)).samples
        return per_sample * np.arange(1, len(samples) + 1), samples


def bent_of(cylindrical: np.ndarray) -> Bent:
    """The leading edge from its radial, tangential and axial displacement (m)."""
    return Bent(float(cylindrical[0]), float(np.linalg.norm(cylindrical)))


class CalculixBlade:
    """A mesh in CalculiX with a force along the tangents of its tip's edge. Its last lines are those of the steps."""

    def __init__(self, mesh: BladeMesh, material: Material):
        self._mesh, self._material = mesh, material

    def loads(self, force: float) -> list[str]:
        """Lines of a force (N), equal on all nodes of the edge, along the tangents where they are undeformed."""
        nodes = self._mesh.node_set(EDGE)
        x, y = self._mesh.points[nodes, :2].T / np.hypot(*self._mesh.points[nodes, :2].T)
        share = force / len(nodes)
        rows = zip(nodes + 1, -y * share, x * share, strict=True)
        return ["*CLOAD", *(line for n, fx, fy in rows for line in (f"{n}, 1, {fx:.12g}", f"{n}, 2, {fy:.12g}"))]

    def run(self, steps: Sequence[str]) -> np.ndarray:
        """Cylindrical displacement (m) of the leading edge at each output, shape (outputs, 3)."""
        if not shutil.which("ccx"):
            raise FileNotFoundError("large_motion_calculix needs CalculiX: apt-get install calculix-ccx")
        leading = int(self._mesh.node_set(EDGE)[0])
        with TemporaryDirectory() as folder:
            deck = Path(folder) / "mesh.inp"
            write_abaqus(self._mesh, deck, self._material, "large motion")
            lines = deck.read_text(encoding="ascii").splitlines()
            begun = lines[: lines.index("*STEP")]
            deck.write_text("\n".join([*begun, "*NSET, NSET=LEADING", f"{leading + 1},", *steps]) + "\n", encoding="ascii")
            subprocess.run(["ccx", "mesh"], cwd=folder, check=True, capture_output=True)
            return cylindrical_rows((Path(folder) / "mesh.dat").read_text(encoding="ascii"), self._mesh.points[leading])

    def bent(self, force: float) -> Bent:
        """The leading edge under a force (N)."""
        return bent_of(self.run(list(self._static(force)))[0])

    def _static(self, force: float) -> Iterator[str]:
        yield from ("*STEP, NLGEOM, INC=200", "*STATIC", "0.5, 1.0", *self.loads(force))
        yield from ("*NODE PRINT, NSET=LEADING, FREQUENCY=200", "U", "*END STEP")

    def released(self, force: float, period: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (s) and motion of the leading edge (m), cylindrical, from where a force (N) held it."""
        step = period / STEPS
        lines = [*self._static(force), f"*STEP, NLGEOM, INC={PERIODS * STEPS + 1}", "*DYNAMIC, DIRECT, ALPHA=0."]
        lines += [f"{step:.12g}, {PERIODS * period:.12g}", "*CLOAD, OP=NEW", "*NODE PRINT, NSET=LEADING", "U", "*END STEP"]
        motion = self.run(lines)[1:]
        return step * np.arange(1, len(motion) + 1), motion


def cylindrical_rows(printed: str, point: np.ndarray) -> np.ndarray:
    """Radial, tangential and axial displacement (m) of a node at a `point` (m), from the rows that CalculiX has printed."""
    rows = re.findall(r"^ +\d+ +(\S+) +(\S+) +(\S+) *$", printed, re.MULTILINE)
    out = point[:2] / np.hypot(*point[:2])
    turned = np.array([[out[0], out[1], 0.0], [-out[1], out[0], 0.0], [0.0, 0.0, 1.0]])
    return np.array(rows, dtype=float) @ turned.T


def period_of(times: np.ndarray, motion: np.ndarray) -> float:
    """Mean time (s) between rising crossings of zero."""
    rising = np.flatnonzero((motion[:-1] < 0.0) & (motion[1:] >= 0.0))
    moments = times[rising] - motion[rising] * (times[rising + 1] - times[rising]) / (motion[rising + 1] - motion[rising])
    return float((moments[-1] - moments[0]) / (len(moments) - 1))


def static(input: Any, output: Any, params: Any) -> None:
    """Table of all blades at BENT in both senses, and the largest differences of all. Params: configuration, blades."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity="draft")
    pairs: dict[str, list[list[tuple[Bent, Bent]]]] = {}
    for blade in params.blades:
        mesh = mesh_of(settings, blade)
        ours, theirs = FreeBlade(settings, blade, mesh, 4e-7), CalculixBlade(mesh, settings.blades[blade].material)
        for motion in BENT:
            forces = [sense * ours.force(motion) for sense in (1, -1)]
            pairs.setdefault(blade, []).append([(ours.bent(force), theirs.bent(force)) for force in forces])
    clearance = settings.scenes["direct"].scene.casing.clearance
    rows = [
        [blade, *(cell for of_motion in motions for cell in cells(of_motion, clearance))] for blade, motions in pairs.items()
    ]
    of_all = [[pair for motions in pairs.values() for pair in motions[number]] for number in range(len(BENT))]
    rows.append(["all", *(cell for of_motion in of_all for cell in ("", *cells(of_motion, clearance)[1:]))])
    names = ("radial motion, ours / CalculiX (mm)", "radial difference (% of the clearance)", "difference of the motion")
    write_table(["blade", *(f"{1e3 * motion:.0f} mm: {name}" for motion in BENT for name in names)], rows, output.table)


def cells(pairs: Sequence[tuple[Bent, Bent]], clearance: float) -> list[str]:
    """Radial motions in both programs (mm), the largest of their differences, and that of the whole motion."""
    radial = "; ".join(f"{1e3 * ours.radial:.3f} / {1e3 * theirs.radial:.3f}" for ours, theirs in pairs)
    apart = max(abs(ours.radial - theirs.radial) for ours, theirs in pairs)
    whole = max(abs(ours.whole / theirs.whole - 1.0) for ours, theirs in pairs)
    return [radial, f"{100.0 * apart / clearance:.1f}%", f"{100.0 * whole:.1f}%"]


def decay(input: Any, output: Any, params: Any) -> None:
    """Table of a blade that is let go. Params: configuration, blade."""
    settings = settings_of(Path.cwd(), **params.configuration, fidelity="draft")
    mesh = mesh_of(settings, params.blade)
    ours = FreeBlade(settings, params.blade, mesh, 8e-7)
    force = ours.force(RELEASED)
    linear = 2.0 * np.pi / float(ours.simulation.problem.blade.frequencies[0])
    theirs = CalculixBlade(mesh, settings.blades[params.blade].material).released(force, linear)
    our_times, samples = ours.released(force, PERIODS * linear)
    theirs_radial, theirs_tangential = theirs[1][:, 0], theirs[1][:, 1]
    radial, tangential = (np.interp(theirs[0], our_times, samples[:, column]) for column in (1, 2))
    rows = [[params.blade, f"{1e3 * np.ptp(theirs_tangential):.1f}"]]
    for mine, other in ((tangential, theirs_tangential), (radial, theirs_radial)):
        rows[0].append(f"{100.0 * np.abs(mine - other).max() / np.ptp(other):.1f}%")
    periods = [period_of(theirs[0], np.asarray(motion)) for motion in (tangential, theirs_tangential)]
    rows[0] += [f"{1e6 * period:.1f}" for period in periods] + [f"{100.0 * abs(periods[0] / periods[1] - 1.0):.2f}%"]
    head = ["blade", "tangential motion, peak to peak (mm)", "tangential: largest difference", "radial: largest difference"]
    write_table([*head, "period, ours (us)", "period, CalculiX (us)", "difference"], rows, output.table)
