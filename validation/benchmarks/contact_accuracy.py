"""What modes and steps of the contact forces at t_n cost in accuracy, on seven blades: tables of docs/accuracy_tables.md.

Run: make claims ONLY=contact_accuracy (half an hour on two cores, after the default sweep). Each blade has speeds over
the whole range and on the tops of its branches, which come from the sweep's results. Runs differ by the step, with the modes
that follow from it. In addition there are central differences, in which the contact nodes have mass, and friction 0.1% larger
and smaller.
"""

import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import reduce
from operator import and_
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import xarray as xr

from r37core.fem.matrices import assemble
from r37core.io import write_text
from r37core.mesh.generate import generate_mesh
from r37core.product.reading import read_settings
from r37core.rom.contact_model import read_contact_model
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.recovery import stress_operator
from r37core.time_integration.integrators import CENTRAL_DIFFERENCE, EXACT_MODAL
from r37core.time_integration.problem import stable_problem
from r37core.time_integration.speed_run import run_speed
from validation.studies.tables import markdown_table

ROOT = Path(__file__).parents[2]
STUDIES = ROOT / "results/studies"
SCENES = {"direct": 8e-7, "abradable": 8e-7}
"""Scenes, and the finest step (s) of forces at t_n in them."""

STEPS = (9.6e-6, 6.4e-6, 4.8e-6, 4e-6, 3.2e-6, 2.4e-6, 1.6e-6)
FINEST, MASS, COARSE_MASS = "finest", "central differences 1e-7", "central differences 2e-7"
PERTURBED = {"friction + 0.1%": 1e-3, "friction - 0.1%": -1e-3}
SPREAD = np.round(np.linspace(773.0, 1987.0, 16))
STRESS_REVOLUTIONS = 20
QUANTITIES = ("rms_normal", "rms_tangential", "stress")
KEPT = {"spectrum_highest_order": 1, "wear_angles": 8}
SECOND, SETTLED = "1.6e-06", 0.03
"""The run next to the finest, of twice its step; largest difference of it, and of those with other friction, from the finest.

In direct contact central differences differ from each other by as much, too. Elsewhere a branch ends, or two motions change
into each other. One perturbed run is not enough: near the end of a branch single runs leave it by chance.
"""


def ways(scene):
    """The runs of a scene: step (s), integrator, and by how much friction is larger."""
    ways_by_name = {f"{step:g}": (step, EXACT_MODAL, 0.0) for step in STEPS}
    ways_by_name |= {name: (SCENES[scene], EXACT_MODAL, more) for name, more in {FINEST: 0.0, **PERTURBED}.items()}
    return ways_by_name | {MASS: (1e-7, CENTRAL_DIFFERENCE, 0.0), COARSE_MASS: (2e-7, CENTRAL_DIFFERENCE, 0.0)}


def speeds_of(blade, scene, sweep):
    """Speeds over the range and, of the four steepest drops of the sweep's rms, the last one before and one 6 rad/s below."""
    curve = np.hypot(*(sweep[name].sel(blade=blade, scene=scene, tip_point="leading_edge") for name in QUANTITIES[:2]))
    curve = curve.dropna("speed")
    values, speeds = curve.values, curve.speed.values
    lost = values[:-1] - values[1:]
    tops = speeds[np.sort(np.argsort(lost)[::-1][:4])]
    return np.unique(np.concatenate([SPREAD, tops, tops - 6.0]).clip(750.0, 2000.0))


def measured(task):
    """Numbers of all ways at the speeds of a blade and scene, shape (ways, speeds, quantities); how many modes each steps."""
    blade, scene, speeds = task
    settings = read_settings(ROOT)
    tip_line = settings.scenes[scene].tip_line
    model = read_contact_model(ROOT / f"results/{blade}/contact_{tip_line}.npz")
    recovery = stress_operator(read_reduced_model(ROOT / f"results/{blade}/rom_{tip_line}.nc"), settings.blades[blade].material)
    values, modes = [], []
    for step, integrator, more in ways(scene).values():
        of = settings.scenes[scene].scene
        of = replace(of, friction=replace(of.friction, coefficient=of.friction.coefficient * (1.0 + more)))
        row = []
        for speed in speeds:
            choice = settings.integration_choice(blade, scene, speed)
            choice = replace(choice, time_step=step, integrator=integrator, snapshot_revolutions=STRESS_REVOLUTIONS)
            run = run_speed(model, float(speed), of, choice, ("stress",), **KEPT, stress=recovery)
            # the median of a run that diverged is no number
            row.append([*run["rms"][0, [0, 2]], np.median(run["revolution_von_mises"])])
        values.append(row)
        modes.append(len(stable_problem(model, float(speeds[-1]), of, choice).frequencies))
        print(blade, scene, step, integrator, more, flush=True)
    return np.array(values), np.array(modes)


def dataset(tasks, results):
    """All of it, with missing speeds as NaN."""
    longest = max(len(speeds) for *_, speeds in tasks)
    scenes, blades = list(SCENES), list(dict.fromkeys(blade for blade, *_ in tasks))
    names = list(ways(scenes[0]))
    shape = (len(scenes), len(blades), len(names), longest, len(QUANTITIES))
    values, modes, speeds_of_all = (
        np.full(shape, np.nan),
        np.zeros(shape[:3], dtype=int),
        np.full((*shape[:2], longest), np.nan),
    )
    for (blade, scene, speeds), (value, counts) in zip(tasks, results, strict=True):
        at = scenes.index(scene), blades.index(blade)
        values[at][:, : len(speeds)], modes[at], speeds_of_all[at][: len(speeds)] = value, counts, speeds
    return xr.Dataset(
        {
            "value": (("scene", "blade", "way", "number", "quantity"), values),
            "modes": (("scene", "blade", "way"), modes),
            "speed": (("scene", "blade", "number"), speeds_of_all),
        },
        {"scene": scenes, "blade": blades, "way": names, "quantity": list(QUANTITIES)},
    )


def differences(measured_runs, scene, way, of):
    """Relative difference of a way from another at each speed: of rms, normal and tangential together, and of stress."""
    ours, theirs = (measured_runs.value.sel(scene=scene, way=name) for name in (way, of))
    rms, base = (np.hypot(*(values.sel(quantity=name) for name in QUANTITIES[:2])) for values in (ours, theirs))
    return rms / base - 1.0, ours.sel(quantity="stress") / theirs.sel(quantity="stress") - 1.0


def settled(measured_runs, scene):
    """Where neither 0.1% of friction, more or less, nor the step of the finest runs changes much."""
    pairs = [*((name, FINEST) for name in PERTURBED), (SECOND, FINEST), *([(COARSE_MASS, MASS)] if scene == "direct" else [])]
    return reduce(and_, [np.abs(differences(measured_runs, scene, *pair)[0]) < SETTLED for pair in pairs])


def errors_table(measured_runs, scene, of, quantity):
    """Errors of every way against one of them, mean and largest in percent, at the settled speeds of each blade."""
    mask, rows = settled(measured_runs, scene), []
    compared = [way for way in measured_runs.way.values if way not in (of, COARSE_MASS)]
    for blade in [*measured_runs.blade.values, "all"]:
        cells = []
        for way in compared:
            error = np.abs(differences(measured_runs, scene, way, of)[quantity].where(mask))
            error = error if blade == "all" else error.sel(blade=blade)
            cells.append(f"{100 * float(error.mean()):.1f} ({100 * float(error.max()):.1f})")
        count = int((mask if blade == "all" else mask.sel(blade=blade)).sum())
        rows.append([blade, f"{count}", *cells])
    modes = measured_runs.modes.sel(scene=scene)
    heads = [f"{way} s, {int(modes.sel(way=way).max())} modes" if way[0].isdigit() else way for way in compared]
    return markdown_table(["blade", "speeds", *heads], rows)


def summary_table(measured_runs, scene):
    """Of all blades: error of every way in rms, against both yardsticks, and in stress; the blade with the worst mean."""
    mask, rows = settled(measured_runs, scene), []
    for way in measured_runs.way.values:
        if way == COARSE_MASS:
            continue
        cells, worst = [], ""
        for of, quantity in ((FINEST, 0), (MASS, 0), (FINEST, 1)):
            if of == way:
                cells.append("")
                continue
            error = 100.0 * np.abs(differences(measured_runs, scene, way, of)[quantity].where(mask))
            cells.append(f"{float(error.mean()):.1f}, {float(error.median()):.1f}, {float(error.max()):.1f}")
            worst = worst or f"{error.mean('number').idxmax('blade').item()} {float(error.mean('number').max()):.1f}"
        modes = measured_runs.modes.sel(scene=scene, way=way)
        rows.append([f"{way} s" if way[0].isdigit() else way, f"{int(modes.min())} to {int(modes.max())}", *cells, worst])
    head = ["step", "modes", "rms against the finest step", "against central differences", "stress against the finest step"]
    return markdown_table([*head, "worst blade"], rows)


def summary(measured_runs):
    """The tables of docs/accuracy.md."""
    parts = [f"`{scene}`: errors in %, mean, median and largest.\n\n{summary_table(measured_runs, scene)}" for scene in SCENES]
    counts = [int(settled(measured_runs, scene).sum()) for scene in SCENES]
    runs = [int(measured_runs.speed.sel(scene=scene).count()) for scene in SCENES]
    settled_of = " and ".join(
        f"{count} of {run} with `{scene}`" for count, run, scene in zip(counts, runs, SCENES, strict=True)
    )
    return "\n".join([*parts, f"Speeds that count, because the motion is settled: {settled_of}.\n"])


def text(measured_runs):
    """The tables of docs/accuracy_tables.md."""
    parts = []
    for scene in SCENES:
        for quantity, name in enumerate(("rms", "stress")):
            for of in (FINEST, MASS):
                against = "the finest step of forces at t_n" if of == FINEST else "central differences at 1e-7 s"
                table = errors_table(measured_runs, scene, of, quantity)
                parts.append(f"`{scene}`, error of {name} against {against}, %: mean (largest)\n\n{table}")
    return "\n".join(parts)


MESHES = {5000: 21, 20000: 42, 40000: 56}
"""Nodes, and wedges along the tip, as of the levels."""

BLADES_OF_MESHES = ("Ref", "S100")
MESH_STEPS = (6.4e-6, 3.2e-6, 1.6e-6, 8e-7)


def of_mesh(task):
    """How far forces at t_n are from central differences on a mesh of a blade: mean and median of rms, and modes, by step."""
    blade, nodes = task
    settings = read_settings(ROOT)
    chosen, scene = settings.blades[blade], settings.scenes["direct"]
    mesh = generate_mesh(chosen.definition.build(round_edges=True), nodes=nodes, layers=1, tip_elements=MESHES[nodes])
    reduced = reduce_blade(mesh, assemble(mesh, chosen.material), settings.reduction_choice(blade))
    model, choice = contact_model(reduced, scene.tip_line), settings.integration_choice(blade, "direct", 0.0)
    choice = replace(choice, snapshot_revolutions=0)

    def rms(step, integrator):
        choices = replace(choice, time_step=step, integrator=integrator)
        runs = [run_speed(model, float(speed), scene.scene, choices, (), **KEPT) for speed in SPREAD]
        return np.array([np.hypot(*run["rms"][0, [0, 2]]) for run in runs])

    mass, coarser, cells = rms(1e-7, CENTRAL_DIFFERENCE), rms(2e-7, CENTRAL_DIFFERENCE), []
    of_settled = np.abs(coarser / mass - 1.0) < SETTLED
    for step in MESH_STEPS:
        modes = len(stable_problem(model, SPREAD[0], scene.scene, replace(choice, time_step=step)).frequencies)
        error = 100.0 * np.abs(rms(step, EXACT_MODAL) / mass - 1.0)[of_settled]
        cells.append(f"{error.mean():.1f}, {np.median(error):.1f} ({modes} modes)")
    return [blade, f"{nodes}", f"{of_settled.sum()}", *cells]


def write_meshes(pool):
    """Whether the two formulations come together with more modes and finer meshes."""
    rows = list(pool.map(of_mesh, [(blade, nodes) for blade in BLADES_OF_MESHES for nodes in MESHES]))
    head = ["blade", "nodes of the mesh", "speeds", *(f"{step:g} s" for step in MESH_STEPS)]
    write_text(markdown_table(head, rows), STUDIES / "contact_meshes.md")


FAR = [
    (blade, speed, "direct", what, changes)
    for blade, speed in (("Ref", 1340.0), ("S100", 1590.0), ("CS50", 1100.0))
    for what, changes in (
        ("as shipped", {}),
        ("friction 0.5", {"friction": 0.5}),
        ("damping ratio 1e-6", {"damping": 1e-6}),
        ("damping ratio 0.05", {"damping": 0.05}),
    )
]
FAR += [
    ("Ref", speed, "abradable", f"lining {stiffer} times as stiff", {"stiffer": stiffer})
    for speed in (1300.0, 1500.0, 1690.0)
    for stiffer in (1, 50, 2500)
]
"""Blade, speed (rad/s), scene, what is extreme, and the number."""


def far_scene(scene, friction=None, damping=None, stiffer=1):
    """A scene with some numbers changed."""
    if friction is not None:
        scene = replace(scene, friction=replace(scene.friction, coefficient=friction))
    if damping is not None:
        scene = replace(scene, damping_ratio=damping)
    if scene.lining is None:
        return scene
    moduli = {name: stiffer * getattr(scene.lining, name) for name in ("elastic_modulus", "plastic_modulus")}
    return replace(scene, lining=replace(scene.lining, **moduli))


def of_extreme(task):
    """A row: rms of the leading edge's whole motion (mm) at each step, and the modes stepped."""
    blade, speed, name, what, changes = task
    settings = read_settings(ROOT)
    model, scene = (
        read_contact_model(ROOT / f"results/{blade}/contact_{settings.scenes[name].tip_line}.npz"),
        far_scene(settings.scenes[name].scene, **changes),
    )
    choice = replace(settings.integration_choice(blade, name, speed), snapshot_revolutions=0)
    cells = []
    for step, integrator in (
        *((step, EXACT_MODAL) for step in (6.4e-6, 4.8e-6, 3.2e-6, 1.6e-6, 8e-7)),
        (1e-7, CENTRAL_DIFFERENCE),
    ):
        tried = replace(choice, time_step=step, integrator=integrator)
        try:
            run = run_speed(model, speed, scene, tried, (), **KEPT)
            modes = len(stable_problem(model, speed, scene, tried).blade.frequencies)
        except ValueError:
            cells.append("refused")
            continue
        rms = 1e3 * np.hypot(*run["rms"][0, [0, 2]])
        cells.append(f"{rms:.3f} ({modes})" if run["status"] == 0 else f"diverges ({modes})")
    return [blade, f"{speed:g}", f"`{name}`", what, *cells]


def write_extremes(pool):
    """Strong friction, little damping, stiff linings."""
    head = ["blade", "rad/s", "scene", "what", *(f"{step} s" for step in ("6.4e-6", "4.8e-6", "3.2e-6", "1.6e-6", "8e-7"))]
    write_text(
        markdown_table([*head, "central differences 1e-7 s"], list(pool.map(of_extreme, FAR))), STUDIES / "contact_extremes.md"
    )


def main():
    settings = read_settings(ROOT)
    with xr.open_dataset(ROOT / "results/rms.nc") as sweep:
        tasks = [(blade, scene, speeds_of(blade, scene, sweep)) for scene in SCENES for blade in settings.blades]
    with ProcessPoolExecutor(int(sys.argv[1]) if len(sys.argv) > 1 else 2) as pool:
        STUDIES.mkdir(parents=True, exist_ok=True)
        write_extremes(pool)
        write_meshes(pool)
        measured_runs = dataset(tasks, list(pool.map(measured, tasks)))
    measured_runs.to_netcdf(STUDIES / "contact_accuracy.nc")
    write_text(text(measured_runs), STUDIES / "contact_accuracy.md")
    write_text(summary(measured_runs), STUDIES / "contact_accuracy_summary.md")


if __name__ == "__main__":
    main()
