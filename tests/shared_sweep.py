"""The one real sweep of a test run, with every result of the default configuration, and copies of it."""

import fcntl
import shutil

from workflow_runs import copy_finished, copy_project, snakemake


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
