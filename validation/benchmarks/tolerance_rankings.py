"""How many members rank the numbers of tolerances, and give a range: parts of a large study beside the whole of it.

Run: python validation/benchmarks/tolerance_rankings.py (a quarter of an hour on one core; what is made is kept, in
results/studies/tolerance_rankings). The reference blade at `draft`, lined, with config/tolerances.yaml, about
1B/4. The outcomes are of several seeds, so that samples beside each other are independent.
"""

import os
import time
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from r37core.results.stress_recovery import StressRecovery
from scipy import stats

from r37core.config.document import Document, read_document
from r37core.fem.matrices import assemble
from r37core.io import atomic_write, write_text
from r37core.mesh.generate import generate_mesh
from r37core.plans.member_values import together
from r37core.product.reading import read_settings
from r37core.results.measures import largest_of_run, range_above_yield
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rounding import rounded_to
from r37core.time_integration.speed_run import run_speed
from r37core.tolerances.dataset import INDEXED, QUANTILES
from r37core.tolerances.members import members_of
from r37core.tolerances.number_ranks import CONFIDENCE, ranking
from r37core.tolerances.sensitivity import sobol_indices
from validation.studies.measures import motion_of_run
from validation.studies.tables import markdown_table

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "results/studies/tolerance_rankings"
BLADE, SCENE = "Ref", "abradable"
SEEDS, MEMBERS = range(4), 64
SPEEDS = {"start": 1690, "stop": 1766, "step": 4}
"""(rad/s) From below the first member's yield to above the last member's peak."""

MEASURES = {"peak_speed": "peak speed", "width_above_yield": "width above yield", "largest_stress": "largest stress"}
COUNTS, RESAMPLES, SLICES = (8, 16, 32, 64, 128), 500, 4
"""Members of the parts; bootstrap samples; parts of a number's range that PAWN compares."""

UNKNOWN = "-"


def settings_of(seed):
    """Settings of one seed's sample."""
    study = {
        "blades": [BLADE],
        "fidelity": "draft",
        "speeds": [SPEEDS],
        "tolerances": {"members": MEMBERS, "seed": seed, "sensitivity": True},
    }
    return read_settings(ROOT, read_document(ROOT, "config/tolerances.yaml"), Document("study", study))


def model_of(settings):
    """The blade's small model, and the recovery of its stress."""
    chosen, level = settings.blades[BLADE], settings.fidelity.mesh
    shape = chosen.definition.build(round_edges=settings.structure.edges == "round")
    mesh = generate_mesh(shape, level.nodes, level.layers, level.tip_elements)
    reduced = reduce_blade(mesh, assemble(mesh, chosen.material), settings.reduction_choice(BLADE))
    return contact_model(reduced, settings.structure.boundary.tip_line), StressRecovery(reduced, chosen.material)


def outcomes(settings, model, recovery, member):
    """Of one member: peak speed (rad/s), width above yield (rad/s), largest stress (Pa), as in tolerances.nc."""
    speeds = settings.speed_plans[BLADE, SCENE].certain
    motion, stress, instants = [], [], settings.fidelity.time_integration.stress_instants
    for speed in speeds:
        choice = replace(settings.integration_choice(BLADE, SCENE, speed), snapshot_revolutions=1)
        run = run_speed(model, speed, member.scene, choice, ("stress",), spectrum_highest_order=1, wear_angles=8)
        motion.append(motion_of_run(run))
        stress.append(largest_of_run(run, recovery.max_von_mises(run["snapshots"]), instants))
    above = range_above_yield(np.array(speeds), np.nan_to_num(stress, nan=np.inf) / member.blade.material.yield_stress)
    return speeds[int(np.argmax(motion))], above.width, np.nanmax(stress)


def run_all():
    """Outcomes of every seed's members in files of their own."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    model = None
    for seed in SEEDS:
        file = FOLDER / f"seed_{seed}.npz"
        if file.exists():
            continue
        settings = settings_of(seed)
        model = model or model_of(settings)
        began, members = time.process_time(), members_of(settings).all[BLADE, SCENE]
        found = [outcomes(settings, *model, member) for member in members.values()]
        with atomic_write(file) as partial, open(partial, "wb") as stream:
            np.savez(
                stream,
                members=list(members),
                outcomes=found,
                values=[member.values for member in members.values()],
                numbers=[key for _, key in members_of(settings).numbers],
            )
        print(f"seed {seed}: {len(members)} members, {time.process_time() - began:.0f} s", flush=True)


@dataclass(frozen=True)
class Sample:
    """Values, shape (members, numbers), and one measure, shape (members,), of members drawn together."""

    values: np.ndarray
    measure: np.ndarray


@dataclass(frozen=True)
class Found:
    """What a method says of a sample: `sizes`, shape (numbers,); `above`, shape (numbers, numbers): which are told apart."""

    sizes: np.ndarray
    above: np.ndarray


@dataclass(frozen=True)
class Study:
    """All outcomes: `values` and `outcomes` by row of the samples of all seeds and by kind of member (`together`)."""

    numbers: list[str]
    values: np.ndarray
    outcomes: np.ndarray

    @staticmethod
    def read():
        """From the files of the seeds."""
        tables, numbers = [], []
        for seed in SEEDS:
            with np.load(FOLDER / f"seed_{seed}.npz") as kept:
                place = {name: row for row, name in enumerate(kept["members"])}
                numbers = [str(name) for name in kept["numbers"]]
                rows = np.array([[place[name] for name in together(row, range(len(numbers)))] for row in range(MEMBERS)])
                tables.append((kept["values"][rows], kept["outcomes"][rows]))
        return Study(numbers, *(np.concatenate(of) for of in zip(*tables, strict=True)))

    @cached_property
    def kinds(self):
        """Kinds of members that belong together: of the sample, of the second one, and one for each number."""
        return self.outcomes.shape[1]

    def parts(self, members):
        """Rows of each part of so many members: those of one seed that follow each other, or several seeds."""
        return np.arange(len(self.outcomes)).reshape(-1, members)

    def samples(self, members, measure):
        """Plain samples: the first and the second one of each part."""
        place = INDEXED.index(measure)
        return [
            Sample(self.values[rows, kind], self.outcomes[rows, kind, place]) for rows in self.parts(members) for kind in (0, 1)
        ]

    def whole(self, measure):
        """All plain samples together."""
        parts = self.samples(MEMBERS, measure)
        return Sample(np.concatenate([one.values for one in parts]), np.concatenate([one.measure for one in parts]))

    def sobol(self, rows, measure):
        """Sobol indices of some rows."""
        outcomes = self.outcomes[rows, :, INDEXED.index(measure)]
        named = {
            name: value
            for row, of in enumerate(outcomes)
            for name, value in zip(together(row, range(len(self.numbers))), of, strict=True)
        }
        return sobol_indices(named, range(len(self.numbers)), len(self.numbers))


def ranked(sample):
    """By the coefficients that r37 ranks by."""
    found = ranking(sample.values, sample.measure)
    return Found(np.abs(found.coefficient), found.above)


def correlated(sample):
    """By the size of the correlation of ranks (Spearman)."""

    def sizes(rows):
        ranks = stats.zscore(stats.rankdata(sample.values[rows], axis=0))
        return np.abs(np.mean(ranks * stats.zscore(stats.rankdata(sample.measure[rows]))[:, None], axis=0))

    return resampled(sizes, len(sample.measure))


def sliced(sample):
    """By PAWN: the median distance of the measure's distribution in each slice of a number from that of all members.

    Source: Pianosi and Wagener, Environ. Model. Softw. 67 (2015) 1-11.
    """

    def sizes(rows):
        values, measure = sample.values[rows], sample.measure[rows]
        every = np.sort(measure)

        def distance(part):
            shares = (np.searchsorted(np.sort(one), every, "right") / len(one) for one in (part, every))
            return np.abs(np.subtract(*shares)).max()

        orders = np.argsort(values, axis=0).T
        return np.array([np.median([distance(measure[part]) for part in np.array_split(order, SLICES)]) for order in orders])

    return resampled(sizes, len(sample.measure))


def resampled(sizes, members):
    """Sizes of all members and what bootstrap samples of them tell apart."""
    random = np.random.default_rng(0)
    drawn = np.array([sizes(random.integers(0, members, members)) for _ in range(RESAMPLES)]).T
    return Found(sizes(np.arange(members)), (drawn[:, None] > drawn).mean(axis=-1) >= 0.5 + 0.5 * CONFIDENCE)


def methods(study):
    """Name -> of a measure, what it says of all, and of each part of so many members; simulations that a member takes."""

    def plain(method):
        def of(measure, members):
            samples = [study.whole(measure)] if members is None else study.samples(members, measure)
            return [method(sample) for sample in samples]

        return of

    def indexed(measure, members):
        rows = [np.arange(len(study.outcomes))] if members is None else study.parts(members)
        found = [study.sobol(one, measure) for one in rows]
        return [Found(one.index[1], one.above) for one in found]

    return {
        "Sobol, total index": (indexed, study.kinds),
        "rank correlation (Spearman)": (plain(correlated), 1),
        "PAWN": (plain(sliced), 1),
        "rank coefficients (r37)": (plain(ranked), 1),
    }


def method_table(study):
    """Of each method and number of members: how far samples differ, and what they tell apart."""
    rows = []
    for name, (method, kinds) in methods(study).items():
        whole = {measure: method(measure, None)[0].sizes for measure in INDEXED}
        for members in COUNTS:
            found = {measure: method(measure, members) for measure in INDEXED}
            sizes = {measure: np.array([one.sizes for one in of]) for measure, of in found.items()}
            moved = max(float(np.ptp(of, axis=0).max()) for of in sizes.values())
            first = np.mean([of.argmax(axis=1) == whole[measure].argmax() for measure, of in sizes.items()])
            above = {measure: np.mean([one.above for one in of], axis=0) for measure, of in found.items()}
            apart = np.mean([of.sum() for of in above.values()])
            wrong = np.mean([of[whole[measure][:, None] < whole[measure]].sum() for measure, of in above.items()])
            cells = [name, str(members), str(members * kinds), str(len(next(iter(sizes.values()))))]
            said = [f"{moved:.2f}", f"{100 * first:.0f}%", f"{apart:.1f}", f"{wrong:.2f}"]
            # too few members for that method
            cells += len(said) * [UNKNOWN] if np.isnan(moved) else said
            rows.append(cells)
            print(cells, flush=True)
    pairs = len(study.numbers) * (len(study.numbers) - 1) // 2
    head = ["method", "members", "simulations at a speed", "samples", "a size moves by up to", "the first is right"]
    return markdown_table([*head, f"pairs told apart (of {pairs})", "of them wrong"], rows)


def number_table(study):
    """Of each number: coefficient and total index of each measure from all that was run."""
    rows = []
    plain = {measure: ranking(whole.values, whole.measure) for measure in INDEXED for whole in [study.whole(measure)]}
    sobol = {measure: study.sobol(np.arange(len(study.outcomes)), measure) for measure in INDEXED}
    for place, number in enumerate(study.numbers):
        row = [f"`{number}`"]
        for measure in INDEXED:
            one, index = plain[measure], sobol[measure]
            row.append(place_text(*(float(of[place]) for of in one.places)))
            row.append(ranged(one.coefficient[place], one.low[place], one.high[place]) if one.known[place] else UNKNOWN)
            row.append(ranged(*(of[1, place] for of in (index.index, index.low, index.high))))
        rows.append(row)
    explained = [cell for measure in INDEXED for cell in ("", f"{100 * plain[measure].explained:.0f}%", "")]
    rows.append(["explained by all coefficients", *explained])
    head = [f"{MEASURES[measure]}: {what}" for measure in INDEXED for what in ("place", "rank coefficient", "total index")]
    plainly, together_with = len(study.whole(INDEXED[0]).measure), study.outcomes[..., 0].size
    said = f"{plainly} members for the coefficients, {together_with} for the total indices."
    return f"{markdown_table(['number', *head], rows)}\n{said}\n"


def place_text(low, high):
    """A place of the ranking, or between which ones it is."""
    return UNKNOWN if np.isnan(low) else f"{low:.0f}" if low == high else f"{low:.0f} to {high:.0f}"


def ranged(value, low, high):
    """A value with its interval, with as many digits as that bears."""
    value, low, high = (rounded_to(float(one), float(high - low)) for one in (value, low, high))
    return f"{value} ({low} to {high})"


def range_table(study):
    """Error of the range's ends and of the median with fewer members."""
    rows = []
    for members in (4, *COUNTS[:-1]):
        row = [str(members)]
        for measure in INDEXED:
            values = np.array([one.measure for one in study.samples(members, measure)])
            whole = np.quantile(study.whole(measure).measure, QUANTILES, method="inverted_cdf")
            found = np.quantile(values, QUANTILES, axis=1, method="inverted_cdf")
            error = np.sqrt(np.mean((found - whole[:, None]) ** 2, axis=1)) / (whole[-1] - whole[0])
            row.append(" / ".join(f"{100 * value:.0f}%" for value in error))
        rows.append(row)
    return markdown_table([f"members (of {len(study.whole(INDEXED[0]).measure)})", *MEASURES.values()], rows)


def main():
    run_all()
    study, folder = Study.read(), ROOT / "results/studies"
    for name, table in (("members", range_table), ("sensitivity", number_table), ("rankings", method_table)):
        write_text(table(study), folder / f"tolerance_{name}.md")


if __name__ == "__main__":
    main()
