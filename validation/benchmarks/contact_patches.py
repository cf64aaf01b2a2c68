"""Whether contact has a limit in mesh and contact nodes: sweeps of seven blades, on points and on patches.

Run: python validation/benchmarks/contact_patches.py [cores] (three hours on two cores; what is made is kept, in
results/studies/contact_patches), then contact_patches_tables.py. Each model has a sweep of every scene, so that both the
settled speeds and the places where branches end are seen.
"""

import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

from r37core.fem.matrices import assemble
from r37core.io import atomic_write
from r37core.mesh.generate import generate_mesh
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model, write_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import AREA_PATCHES, PATCHES, POINTS
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import UnstableStepError
from r37core.time_integration.speed_run import run_speed
from validation.published import INTERACTIONS

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "results/studies/contact_patches"
TIP_ELEMENTS = {5000: 21, 10000: 28, 20000: 42, 40000: 56, 80000: 84}
BLADES = ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
SCENES = ("direct", "abradable")
GRIDS = {"all": np.arange(750.0, 2000.5, 5.0), "coarse": np.arange(760.0, 2000.5, 20.0), "fine": np.arange(750.0, 2000.5)}
"""Speeds (rad/s). Beside them: those about the published peaks of a blade."""

ABOUT_PEAK = (0.97, 1.05)
KEPT = {"spectrum_highest_order": 1, "wear_angles": 8}
KINDS = (POINTS, PATCHES, AREA_PATCHES)
FINEST_MESH, STANDARD, COUNTS, MODES = 80000, 20000, (4, 15, 29), (3, 20, 40)
STEPS = (9.6e-6, 6.4e-6, 3.2e-6, 1.6e-6, 8e-7)
STIFFER = (3, 10, 30, 100, 300)
"""How many times as stiff as the shipped lining."""

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
    """How a model is run: scene, step (s; 0: the level's), integrator, speeds, and what is different.

    `friction`: by how much it is larger; `stiffer`: how many times the lining's moduli; `wide`: bars as wide as the patches;
    `shorter`: how many times the step is divided.
    """

    scene: str = "direct"
    step: float = 0.0
    integrator: str = EXACT_MODAL
    friction: float = 0.0
    grid: str = "all"
    stiffer: int = 1
    wide: bool = False
    shorter: int = 1

    def speeds(self, blade):
        """Ascending (rad/s)."""
        if self.grid != "peaks":
            return GRIDS[self.grid]
        peaks = [row.peak for row in INTERACTIONS if row.blade == blade]
        return np.unique(np.concatenate([np.arange(round(ABOUT_PEAK[0] * p), ABOUT_PEAK[1] * p) for p in peaks]))

    def file(self, model):
        """Where a model's sweep in this way is kept."""
        parts = [model.file.stem, self.scene, f"{self.step:g}", self.integrator, f"{self.friction:g}"]
        parts += [self.grid] * (self.grid not in ("all", "coarse")) + [f"stiffer_{self.stiffer}"] * (self.stiffer > 1)
        parts += ["wide"] * self.wide + [f"shorter_{self.shorter}"] * (self.shorter > 1)
        return FOLDER / ("_".join(parts) + ".npy")

    def of_scene(self, model, contact):
        """The scene in which it is run."""
        scene = settings().scenes[self.scene].scene
        scene = replace(scene, friction=replace(scene.friction, coefficient=scene.friction.coefficient * (1.0 + self.friction)))
        if scene.lining is None:
            return scene
        lining = replace(
            scene.lining,
            elastic_modulus=self.stiffer * scene.lining.elastic_modulus,
            plastic_modulus=self.stiffer * scene.lining.plastic_modulus,
        )
        if self.wide:
            lining = replace(lining, bar_width=tip_length(model.blade) / len(contact.radius))
        return replace(scene, lining=lining)


MASS = Way(step=1e-7, integrator=CENTRAL_DIFFERENCE, grid="coarse")


def perturbed(way):
    """Three runs that a settled motion hardly notices: friction 0.1% larger and smaller, and half the step.

    One of them is not enough: near the end of a branch single runs leave it by chance.
    """
    return replace(way, friction=1e-3), replace(way, friction=-1e-3), replace(way, shorter=2)


@cache
def tip_length(blade):
    """Length of a blade's tip along the casing's meridian (m), from its corners."""
    corners = read_contact_model(Model(blade).file)
    return abs(float(np.ptp(corners.radius) / np.sin(corners.tip_cone_angle)))


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
        ways += [of for scene in SCENES for of in perturbed(Way(scene))]
    blade, eight = model.blade, model.count == 8 and model.layers == 1 and model.modes == 10 and model.contact in KINDS[:2]
    if model == Model(blade, contact=PATCHES):
        ways += [Way(step=step, grid="coarse") for step in STEPS] + [MASS]
    if blade == "S100" and eight and model.nodes in (5000, FINEST_MESH):
        ways += [MASS, Way(step=STEPS[-1], grid="coarse")]
    # steps of the levels on their own meshes
    if eight and model.nodes == 5000:
        ways += [Way(step=6.4e-6, grid="coarse")]
    if eight and model.nodes == 40000:
        ways += [Way(step=2.4e-6, grid="coarse"), Way("abradable", 3.2e-6, grid="coarse")]
    if eight and (model.nodes == STANDARD or (blade == "Ref" and model.nodes == FINEST_MESH)):
        ways += [Way(grid="fine")]
    if model == Model("Ref", contact=PATCHES, count=15):
        ways += [Way(grid="fine")]
    if eight and model.nodes in (STANDARD, FINEST_MESH):
        ways += [Way("abradable", grid="coarse", stiffer=stiffer) for stiffer in STIFFER]
    if eight and model.nodes == STANDARD:
        ways += [of for stiffer in STIFFER for of in perturbed(Way("abradable", grid="coarse", stiffer=stiffer))]
    if eight and model.nodes == STANDARD:
        ways += [Way("abradable", grid="peaks")]
    if model.contact == PATCHES and model.nodes == STANDARD and model.modes == 10 and model.layers == 1 and model.count < 29:
        ways += [Way("abradable", grid="peaks", wide=True)]
    return ways


def build(models):
    """Models of one blade and mesh, those that are not there yet."""
    missing = [model for model in models if not model.file.exists()]
    if not missing:
        return
    first = missing[0]
    chosen = settings().blades[first.blade]
    # of more layers: fewer elements along the tip for as many nodes
    along = 7 * round(TIP_ELEMENTS[first.nodes] / 7 / (1.0, 1.25, 1.5)[first.layers - 1])
    mesh = generate_mesh(chosen.definition.build(round_edges=True), first.nodes, first.layers, along)
    matrices = assemble(mesh, chosen.material)
    base = settings().reduction_choice(first.blade)
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
        contact, rows = read_contact_model(model.file), []
        scene = way.of_scene(model, contact)
        for speed in way.speeds(model.blade):
            choice = settings().integration_choice(model.blade, way.scene, speed)
            choice = replace(choice, integrator=way.integrator, snapshot_revolutions=0)
            choice = replace(choice, time_step=(way.step or choice.time_step) / way.shorter)
            try:
                run = run_speed(contact, float(speed), scene, choice, (), **KEPT)
            except UnstableStepError:
                # central differences on fine meshes
                rows.append([np.nan, np.nan])
                continue
            rows.append(run["rms"][0, [0, 2]] if run["status"] == 0 else [np.nan, np.nan])
        with atomic_write(file) as partial, open(partial, "wb") as stream:
            np.save(stream, np.array(rows))
        print("ran", file.name, flush=True)
    return np.load(file)


def all_of(models):
    """Make the models of a lot, those that are wanted, and their sweeps."""
    wanted = [model for model in models if not all(way.file(model).exists() for way in ways_of(model))]
    build(wanted)
    for model in wanted:
        for way in ways_of(model):
            sweep(model, way)


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    lots = sorted((lot for blade in BLADES for lot in models_of(blade)), key=lambda lot: -lot[0].nodes)
    with ProcessPoolExecutor(int(sys.argv[1]) if len(sys.argv) > 1 else 2) as pool:
        list(pool.map(all_of, lots))


if __name__ == "__main__":
    main()
