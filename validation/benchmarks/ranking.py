"""How sure the ranking of the blades is: docs/which_blade.md. Run: make claims ONLY=ranking; the script takes PROCESSES.

Every 1 rad/s on points and every 5 rad/s on patches, of all seven blades: kept in results/studies/ranking, and not run again
while they are there. Reduced models are made first by
    snakemake --cores 2 results/{Ref,L50,L100,S50,S100,CS50,CS100}/{contact,stress}_pressure_edge.npz
and the same with `--configfile config/config.yaml config/patches.yaml` for those below results/runs/patches.
"""

import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import xarray as xr

from r37core.adaptive.criterion import RefinementChoice
from r37core.dataset_file import read_dataset
from r37core.io import write_text
from r37core.plain import from_plain
from r37core.plans.sweep_plan import Sweep
from r37core.product.reading import read_settings, settings_of_run
from r37core.results.exceedance import CERTAIN, POSSIBLE, exceedance_of
from r37core.results.measures import motion
from r37core.results.ranking import chance_to_be_better, ranking_table, robustness
from r37core.rom.contact_model import read_contact_model
from r37core.stress.operator import read_stress_operator
from r37core.stress.revolutions import largest_of_revolutions, stress_statistic
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_run import run_speed
from r37core.tolerances.members import members_of
from validation.studies.refinement.report import replay
from validation.studies.tables import markdown_table

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "results/studies/ranking"
BLADES = ("Ref", "L50", "L100", "S50", "S100", "CS50", "CS100")
SCENES = {"lined": "abradable", "direct": "direct"}
FIRST, LAST = 750.0, 2000.0
KEPT = {"spectrum_highest_order": 1, "wear_angles": 1}
GRIDS = (5, 10, 20)
_REPEATED = 7
RANKING = Path("config/ranking.yaml")


@dataclass(frozen=True)
class Way:
    """Runs of all blades in a scene, every `step` (rad/s), on `patches` or points.

    `friction`: factor of the coefficient; `member`: of the sample of config/ranking.yaml, by name.
    """

    scene: str
    step: float = 1.0
    friction: float = 1.0
    patches: bool = False
    member: str = ""

    @property
    def name(self):
        """Part of a file's name."""
        return f"{self.scene}_{'patches' if self.patches else 'points'}_{self.friction:g}_{self.step:g}{self.member}"


LINED, DIRECT = (Way(scene) for scene in SCENES.values())
PERTURBED, LINED_PERTURBED = (replace(way, friction=1.001) for way in (DIRECT, LINED))
PATCHED = replace(DIRECT, patches=True, step=5.0)
MEMBERS = tuple(
    Way(scene, step, patches=True, member=f"_{number}")
    for scene, step in ((SCENES["direct"], 10.0), (SCENES["lined"], 4.0))
    for number in range(8)
)
WAYS = (DIRECT, LINED, PERTURBED, LINED_PERTURBED, PATCHED, *MEMBERS)


def run(task):
    """Keep status, rms and the stress of each of the last revolutions of a blade's runs."""
    blade, way = task
    file = FOLDER / f"{blade}_{way.name}.npz"
    if file.exists():
        return
    settings = settings_of_run(ROOT, [Path("config/config.yaml"), *([RANKING] if way.member else [])], {}, {})
    of = ROOT / "results/runs/patches" if way.patches else ROOT / "results"
    model = read_contact_model(of / blade / "contact_pressure_edge.npz")
    stress = read_stress_operator(of / blade / "stress_pressure_edge.npz")
    if way.member:
        scene = members_of(settings).all[blade, way.scene][way.member.strip("_")].scene
    else:
        scene = settings.scenes[way.scene].scene
        scene = replace(scene, friction=replace(scene.friction, coefficient=way.friction * scene.friction.coefficient))
    speeds, found = np.arange(FIRST, LAST + 0.5, way.step), []
    for speed in speeds:
        choice = settings.integration_choice(blade, way.scene, float(speed))
        one = run_speed(model, float(speed), scene, choice, ["stress"], **KEPT, stress=stress)
        found.append((int(one["status"]), one["rms"][0], float(one["max_von_mises"]), one["revolution_von_mises"]))
    status, rms, last, revolutions = zip(*found, strict=True)
    file.parent.mkdir(parents=True, exist_ok=True)
    limit = settings.blades[blade].yield_stress
    np.savez(file, speed=speeds, status=status, rms=rms, last=last, rev=revolutions, y=limit)
    print(blade, way.name, flush=True)


def response(blade, way):
    """What a response has of it, over speed."""
    with np.load(FOLDER / f"{blade}_{way.name}.npz") as kept:
        limit = float(kept["y"])
        statistic = [stress_statistic(one, limit) for one in kept["rev"]]
        content = {name: ("speed", np.array([one[name] for one in statistic])) for name in statistic[0]}
        content |= {"status": ("speed", kept["status"]), "max_von_mises": ("speed", kept["last"])}
        content |= {f"rms_{name}": ("speed", kept["rms"][:, place]) for name, place in {"normal": 0, "tangential": 2}.items()}
        scalars = {"yield_stress": limit, "lined": float(way.scene == SCENES["lined"])}
        return xr.Dataset(content | scalars, {"speed": kept["speed"]})


def lengths(one):
    """Certain and possible length above yield (rad/s), with their scatter."""
    exceedance = exceedance_of(one)
    return [(exceedance.length(share), exceedance.scatter_of_length(share)) for share in (CERTAIN, POSSIBLE)]


def words(found):
    """`certain, possible` with scatter, where there is one."""
    return ", ".join(f"{value:.0f}" + (f" ± {scatter:.0f}" if np.isfinite(scatter) else "") for value, scatter in found)


def adaptive(blade, way):
    """The response at the speeds that the default sweep would run."""
    settings = read_settings(ROOT)
    at = SimpleNamespace(blade=blade, scene=way.scene)
    plan, choice = settings.speed_plans[blade, way.scene], Sweep(settings).refinement_choice(at)
    every = response(blade, way)
    rounds = replay(every, read_dataset(ROOT / f"results/{blade}/campbell.nc"), plan, from_plain(RefinementChoice, choice))
    return every.sel(speed=sorted(speed for new in rounds for speed in new))


def length_table(way, others):
    """Lengths above yield of every blade: of all speeds, of grids, of adaptive speeds, and of `others`, head -> way."""
    rows = []
    for blade in BLADES:
        every, few = response(blade, way), adaptive(blade, way)
        cells = [words(lengths(every)), *(words(lengths(response(blade, other))) for other in others.values())]
        cells += [words(lengths(every.isel(speed=slice(None, None, step)))) for step in GRIDS]
        rows.append([blade, *cells, f"{words(lengths(few))} ({few.sizes['speed']})"])
    head = ["blade", "every 1 rad/s", *others, *(f"every {step}" for step in GRIDS), "adaptive (runs)"]
    return markdown_table(head, rows)


def statistic_table():
    """Scatter of what is read off a run, in direct contact: against neighbours 1 rad/s away, and against friction + 0.1%."""
    names = {
        "last revolution": "max_von_mises",
        "median of the last 100": "max_von_mises_median",
        "90% of the last 100": "max_von_mises_high",
    }
    rows = []
    for words_, name in names.items():
        row = [words_]
        for blade in BLADES:
            one, other = (response(blade, way)[name].values for way in (DIRECT, PERTURBED))
            beside = one[1:-1] / (0.5 * (one[:-2] + one[2:])) - 1.0
            row.append(f"{spread(beside, 1.5):.1f}, {spread(other / one - 1.0, 2.0):.1f}")
        rows.append(row)
    return markdown_table(["largest stress (%)", *BLADES], rows)


def spread(differences, variances):
    """Standard deviation (%) of a value, from differences of so many times its variance; the median of many, robustly."""
    return 100.0 * 1.4826 * np.median(np.abs(differences)) / np.sqrt(variances)


def ranking(ways):
    """Markdown of the ranking: rank, lengths, first speed, largest stress, for each scene of `ways`, name -> way."""
    found = {(blade, name): robustness(response(blade, way)) for name, way in ways.items() for blade in BLADES}
    table, rows = ranking_table(found), []
    for _, one in table.iterrows():
        certain, possible = (one[f"length_{name}_rad_s"] for name in ("certain", "possible"))
        scatter = one["length_certain_scatter_rad_s"]
        first = "" if np.isnan(one["first_certain_rad_s"]) else f"{one['first_certain_rad_s']:.0f}"
        certain = f"{certain:.0f}" + ("" if np.isnan(scatter) else f" ± {max(scatter, 1.0):.0f}")
        rows.append([one["scene"], str(one["rank"]), one["blade"], certain, f"{possible:.0f}", first,
                     f"{1e-9 * one['largest_median_stress_pa']:.2f}", f"{1e3 * one['largest_rms_m']:.2f}"])  # fmt: skip
    head = [
        "scene",
        "rank",
        "blade",
        "certain (rad/s)",
        "possible (rad/s)",
        "first certain (rad/s)",
        "stress (GPa)",
        "rms (mm)",
    ]
    return markdown_table(head, rows)


def chances(scene):
    """Chance (%) that the blade of a row is better than that of a column, and the range of its certain length (rad/s)."""
    ways = [way for way in MEMBERS if way.scene == scene]
    found = {blade: {way.member: robustness(response(blade, way)) for way in ways} for blade in BLADES}
    rows = []
    for blade in BLADES:
        certain = [one["length_certain_rad_s"] for one in found[blade].values()]
        better = ["" if other == blade else f"{100 * chance_to_be_better(found[blade], found[other]):.0f}" for other in BLADES]
        rows.append([blade, f"{min(certain):.0f} to {max(certain):.0f}", *better])
    return markdown_table(["blade", "certain (rad/s)", *(f"better than {blade} (%)" for blade in BLADES)], rows)


def cost_table():
    """CPU time (ms, least of several) of a run without its stress, with that of the last revolution alone, and as it is."""
    settings, rows = read_settings(ROOT), []
    for name, scene in SCENES.items():
        for blade in ("Ref", "S100", "CS50"):
            model = read_contact_model(ROOT / f"results/{blade}/contact_pressure_edge.npz")
            stress = read_stress_operator(ROOT / f"results/{blade}/stress_pressure_edge.npz")
            spent = np.full((3, _REPEATED), np.inf)
            for repeat in range(_REPEATED):
                for place, (revolutions, operator) in enumerate(((0, None), (1, stress), (None, stress))):
                    begun = 0.0
                    for speed in (900.0, 1340.0, 1700.0):
                        choice = settings.integration_choice(blade, scene, speed)
                        if revolutions is not None:
                            choice = replace(choice, snapshot_revolutions=revolutions)
                        results = ["stress"] if operator else []
                        before = time.process_time()
                        run_speed(model, speed, settings.scenes[scene].scene, choice, results, **KEPT, stress=operator)
                        begun += time.process_time() - before
                    spent[place, repeat] = begun / 3.0
            without, last, now = 1e3 * spent.min(axis=1)
            rows.append([name, blade, f"{without:.1f}", f"{last:.1f}", f"{now:.1f}", f"{now / last:.2f}"])
    head = ["scene", "blade", "without stress", "of the last revolution", "of the last half", "ratio of the last two"]
    return markdown_table(head, rows)


def missed_table():
    """How far the largest stress of a revolution, of some nodes and instants, is from that of all, worst of seven blades."""
    settings, rows = read_settings(ROOT), []
    for name, scene in SCENES.items():
        off, medians = [], []
        for blade in BLADES:
            model = read_contact_model(ROOT / f"results/{blade}/contact_pressure_edge.npz")
            stress = read_stress_operator(ROOT / f"results/{blade}/stress_pressure_edge.npz")
            peaks = peak_of_ranges(blade, Way(scene))
            for speed in sorted({*np.linspace(760.0, 1990.0, 6).round().tolist(), *peaks}):
                choice = settings.integration_choice(blade, scene, speed)
                simulation = Simulation(model, speed, settings.scenes[scene].scene, choice)
                states = simulation.advance(simulation.start(), choice.revolutions).snapshots
                shapes, per_revolution = (
                    model.to_reduced @ simulation.problem.contact.state_shapes,
                    choice.snapshots_per_revolution,
                )
                found = largest_of_revolutions(stress, states, shapes, np.empty(0), per_revolution)
                revolutions = np.split(states, len(states) // per_revolution)
                every = np.array([stress.max_von_mises(one @ shapes.T).max() for one in revolutions])
                off.append(np.abs(found / every - 1.0))
                medians.append(abs(np.median(found) / np.median(every) - 1.0))
        several = sum((one > 1e-5).any() for one in off)
        share = np.mean(np.concatenate(off) > 1e-5)
        rows.append(
            [name, f"{len(off)}", f"{several}", f"{100 * share:.2f}%", f"{100 * np.max(off):.2f}%", f"{np.max(medians):.0e}"]
        )
    head = ["scene", "runs", "with a revolution that differs", "of all revolutions", "largest difference", "of the median"]
    return markdown_table(head, rows)


def peak_of_ranges(blade, way):
    """Speeds (rad/s) of the largest motion in every range certainly above yield, and 2 rad/s above it."""
    one = response(blade, way)
    peaks = [
        float(within["speed"][int(np.argmax(motion(within)))])
        for of in exceedance_of(one).ranges(CERTAIN)
        if (within := one.sel(speed=slice(of.begin, of.end))).sizes["speed"]
    ]
    return [min(speed + more, LAST) for speed in peaks for more in (0.0, 2.0)]


def main():
    """Run what is not there, and write the tables."""
    tasks = [(blade, way) for way in WAYS for blade in BLADES]
    with ProcessPoolExecutor(int(sys.argv[1]) if len(sys.argv) > 1 else 1) as pool:
        list(pool.map(run, tasks))
    studies = FOLDER.parent
    write_text(cost_table(), studies / "ranking_cost.md")
    write_text(missed_table(), studies / "ranking_missed.md")
    write_text(length_table(DIRECT, {"friction + 0.1%": PERTURBED, "patches, every 5": PATCHED}), studies / "ranking_direct.md")
    write_text(length_table(LINED, {"friction + 0.1%": LINED_PERTURBED}), studies / "ranking_lined.md")
    write_text(statistic_table(), studies / "ranking_statistic.md")
    scenes = {"lined": LINED, "direct, points": DIRECT, "direct, patches": PATCHED}
    write_text(ranking(scenes), studies / "ranking.md")
    for name, scene in SCENES.items():
        write_text(chances(scene), studies / f"ranking_chances_{name}.md")


if __name__ == "__main__":
    main()
