"""The one real sweep of a test run, with every result of the default configuration, and copies of it."""

import fcntl
import shutil

from workflow_runs import copy_finished, copy_project, snakemake

from r37core.fem.matrices import assemble
from r37core.mesh.generate import generate_mesh
from r37core.product.reading import read_settings
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.time_integration.simulate import Simulation


def made_once(tmp_path_factory, name, make):
    """A folder that `make(folder)` has filled, in one process of a test run; the others wait for it."""
    together = tmp_path_factory.getbasetemp()
    if together.name.startswith("popen-"):
        # a worker's folder lies in that of all
        together = together.parent
    folder, done = together / name, together / f"{name}.made"
    with open(together / f"{name}.lock", "w") as lock:
        fcntl.lockf(lock, fcntl.LOCK_EX)
        if not done.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            make(folder)
            done.touch()
    return folder


def make_sweep(root, folder):
    """Two blades, two scenes, three speeds, on two cores."""
    copy_project(root, folder)
    snakemake(folder, "all_blades", "--cores", "2")


def copy_structure(sweep, to):
    """A copy with what was made of the blades alone: meshes, models, Campbell diagrams; no simulation and no dataset."""
    copy_finished(sweep, to)
    for entry in (to / "results").iterdir():
        of_blade = entry.is_dir() and (entry / "geometry.nc").exists()
        for file in filter(lambda inner: inner.is_dir(), entry.iterdir()) if of_blade else [entry]:
            shutil.rmtree(file) if file.is_dir() else file.unlink()
    return to


def compile_programs(root, folder):
    """Those of the small sweep, in this process."""
    copy_project(root, folder)
    settings = read_settings(folder)
    level, blade = settings.fidelity.mesh, settings.blades["Ref"]
    mesh = generate_mesh(blade.definition.build(round_edges=True), level.nodes, level.layers, level.tip_elements)
    reduced = reduce_blade(mesh, assemble(mesh, blade.material), settings.reduction_choice("Ref"), blade.material)
    model = contact_model(reduced, "pressure_edge")
    for name, scene in settings.scenes.items():
        choice = settings.integration_choice("Ref", name, 1150.0)
        Simulation(model, 1150.0, scene.scene, choice)
