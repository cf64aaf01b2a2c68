"""Whether contact has a limit in mesh and contact nodes, on seven blades: tables and figure of docs/accuracy.md.

Run: python benchmarks/contact_patches.py [cores] (three hours on two cores; what is made is kept, in
results/studies/contact_patches); make docs. Each model has a sweep of every scene, so that both the settled speeds and the
places where branches end are seen.
"""

import os
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.config import read_settings
from r37core.fem.matrices import assemble
from r37core.io import atomic_write
from r37core.mesh.generate import generate_mesh
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import AREA_PATCHES, PATCHES, POINTS
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import UnstableStepError
from r37core.time_integration.speed_run import run_speed

ROOT = Path(__file__).parent.parent
FOLDER = ROOT / "results/studies/contact_patches"
TIP_ELEMENTS = {5000: 21, 10000: 28, 20000: 42, 40000: 56, 80000: 84}
BLADES = ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
SCENES = ("direct", "abradable")
GRID, COARSE = np.arange(750.0, 2000.5, 5.0), np.arange(760.0, 2000.5, 20.0)
KEPT = {"spectrum_highest_order": 1, "wear_angles": 8}
KINDS = (POINTS, PATCHES, AREA_PATCHES)
FINEST_MESH, STANDARD, COUNTS, MODES = 80000, 20000, (4, 15, 29), (3, 20, 40)
STEPS = (9.6e-6, 6.4e-6, 3.2e-6, 1.6e-6, 8e-7)
LAYERED = ((20000, 2), (40000, 3))
"""Meshes with two and three layers of elements through the thickness, of two blades."""


@dataclass(frozen=True)
class Model:
    """A blade's mesh and what contact acts on; `layers` of elements through the thickness."""

    blade: str
    nodes: int = STANDARD
    contact: str = POINTS
    count: int = 8
    modes: int = 10
    layers: int = 1

    @property
    def file(self):
        """Where it is kept."""
        return FOLDER / f"{self.blade}_{self.nodes}_{self.layers}_{self.contact}_{self.count}_{self.modes}.npz"


@dataclass(frozen=True)
class Way:
    """How a model is run: scene, step (s; 0: the level's), integrator, and by how much friction is larger."""

    scene: str = "direct"
    step: float = 0.0
    integrator: str = EXACT_MODAL
    friction: float = 0.0

    @property
    def speeds(self):
        """All of the grid, or fewer where the step is short."""
        return COARSE if self.step else GRID

    def file(self, model):
        """Where a model's sweep in this way is kept."""
        return FOLDER / f"{model.file.stem}_{self.scene}_{self.step:g}_{self.integrator}_{self.friction:g}.npy"


MASS, NUDGED = Way(step=1e-7, integrator=CENTRAL_DIFFERENCE), Way(friction=1e-3)


@cache
def settings():
    """Of the checkout."""
    return read_settings(ROOT)


def models_of(blade):
    """Lots of models that share a mesh; the finest meshes, which take longest, first."""
    lots = []
    for nodes in sorted(TIP_ELEMENTS, reverse=True):
        kinds = KINDS if nodes in (5000, STANDARD, FINEST_MESH) else KINDS[:2]
        lot = [Model(blade, nodes, kind) for kind in kinds]
        if nodes == STANDARD:
            lot += [Model(blade, nodes, kind, count) for kind in KINDS[:2] for count in COUNTS]
            lot += [Model(blade, nodes, PATCHES, modes=modes) for modes in MODES]
        lots.append(lot)
    if blade in ("L100", "S100"):
        lots += [[Model(blade, nodes, kind, layers=layers) for kind in KINDS[1:]] for nodes, layers in LAYERED]
    return lots


def ways_of(model):
    """How a model is run."""
    ways = [Way(scene) for scene in SCENES]
    if model in (Model(model.blade, contact=kind) for kind in KINDS[:2]):
        ways += [NUDGED, replace(NUDGED, scene="abradable")]
    if model == Model(model.blade, contact=PATCHES):
        ways += [Way(step=step) for step in STEPS] + [MASS]
    if model.blade == "S100" and model in (Model("S100", nodes, kind) for nodes in (5000, FINEST_MESH) for kind in KINDS[:2]):
        ways += [MASS, Way(step=STEPS[-1])]
    return ways


def build(models):
    """Models of one blade and mesh, those that are not there yet."""
    missing = [model for model in models if not model.file.exists()]
    if not missing:
        return
    one = missing[0]
    chosen = settings().blades[one.blade]
    # of more layers: fewer elements along the tip for as many nodes
    along = 7 * round(TIP_ELEMENTS[one.nodes] / 7 / (1.0, 1.25, 1.5)[one.layers - 1])
    mesh = generate_mesh(chosen.definition.build(round_edges=True), one.nodes, one.layers, along)
    matrices = assemble(mesh, chosen.material)
    base = settings().reduction_choice(one.blade)
    for model in missing:
        choice = replace(
            base,
            boundary=replace(base.boundary, contact=model.contact, nodes=model.count),
            fixed_interface_modes=model.modes,
        )
        write_contact_model(contact_model(reduce_blade(mesh, matrices, choice), base.boundary.tip_line), model.file)
        print("made", model.file.name, flush=True)


def sweep(model, way):
    """rms of the leading edge (m), shape (speeds, 2): normal and tangential, of a model run in one way; kept in a file."""
    file = way.file(model)
    if not file.exists():
        contact, scene = read_contact_model(model.file), settings().scenes[way.scene].scene
        scene = replace(scene, friction=replace(scene.friction, coefficient=scene.friction.coefficient * (1.0 + way.friction)))
        found = []
        for speed in way.speeds:
            choice = settings().integration_choice(model.blade, way.scene, speed)
            choice = replace(choice, integrator=way.integrator, snapshot_revolutions=0, energy=False)
            try:
                run = run_speed(
                    contact, float(speed), scene, replace(choice, time_step=way.step or choice.time_step), (), **KEPT
                )
            except UnstableStepError:
                # central differences on fine meshes
                found.append([np.nan, np.nan])
                continue
            found.append(run["rms"][0, [0, 2]] if run["status"] == 0 else [np.nan, np.nan])
        with atomic_write(file) as partial, open(partial, "wb") as stream:
            np.save(stream, np.array(found))
        print("ran", file.name, flush=True)
    return np.load(file)


def all_of(models):
    """Make the models of a lot and their sweeps."""
    build(models)
    for model in models:
        for way in ways_of(model):
            sweep(model, way)
