"""Libraries that could propose designs, on functions with known optimum, noise, a constraint and a region that cannot be built.

    python validation/benchmarks/search_libraries.py [SEEDS]

writes validation/benchmarks/search_libraries.md. The candidates are not in envs/lock.txt: pip install egobox smt optuna openturns pymoo.
SMT and scikit-learn are surrogates under the acquisition of r37core.search; egobox and Optuna propose by themselves. OpenTURNS
and pymoo are weighed only: the first runs the function itself, the second evolves populations over many more evaluations.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import distribution
from pathlib import Path

import numpy as np

from r37core.search import proposal
from r37core.search.problem import DONE, REFUSED, Evaluated, SearchVariable
from r37core.search.proposal import first_designs

EVALUATIONS, BATCH = 60, 6
TABLE = Path(__file__).with_suffix(".md")
Proposer = Callable[[Sequence[SearchVariable], list[Evaluated], int, int], list[tuple[float, ...]]]


@dataclass(frozen=True)
class Problem:
    """A function to be minimised where `margin` is at least 0; designs where `fails` holds have no values."""

    name: str
    variables: tuple[SearchVariable, ...]
    first: int
    noise: float
    objective: Callable[[np.ndarray], float]
    margin: Callable[[np.ndarray], float]
    fails: Callable[[np.ndarray], bool]
    lowest: float

    def evaluated(self, number: int, values: tuple[float, ...], generator: np.random.Generator) -> Evaluated:
        """One try, with its noise."""
        x, noise = np.array(values), self.noise * generator.standard_normal()
        if self.fails(x):
            return Evaluated(f"{number}", values, (np.nan,), (np.nan,), (np.nan,), REFUSED)
        return Evaluated(f"{number}", values, (self.objective(x) + noise,), (self.noise,), (self.margin(x),), DONE)


def branin(x: np.ndarray) -> float:
    """Three equal minima of 0.3979, at (-pi, 12.275), (pi, 2.275) and (9.42478, 2.475)."""
    parabola = x[1] - 5.1 * x[0] ** 2 / (4 * np.pi**2) + 5 * x[0] / np.pi - 6
    return float(parabola**2 + 10 * (1 - 1 / (8 * np.pi)) * np.cos(x[0]) + 10)


_SCALES = np.array([[10, 3, 17, 3.5, 1.7, 8], [0.05, 10, 17, 0.1, 8, 14], [3, 3.5, 1.7, 10, 17, 8], [17, 8, 0.05, 10, 0.1, 14]])
_CENTRES = 1e-4 * np.array(
    [
        [1312, 1696, 5569, 124, 8283, 5886],
        [2329, 4135, 8307, 3736, 1004, 9991],
        [2348, 1451, 3522, 2883, 3047, 6650],
        [4047, 8828, 8732, 5743, 1091, 381],
    ]
)


def hartmann(x: np.ndarray) -> float:
    """One lowest minimum of -3.32237 in the unit cube of six variables."""
    return float(-np.exp(-(_SCALES * (x - _CENTRES) ** 2).sum(1)) @ np.array([1.0, 1.2, 3.0, 3.2]))


PROBLEMS = (
    # the minimum at (9.4, 2.5) breaks the constraint, that at (-3.1, 12.3) cannot be built
    Problem(
        "Branin",
        (SearchVariable("a", -5.0, 10.0), SearchVariable("b", 0.0, 15.0)),
        12,
        2.0,
        branin,
        lambda x: float(50.0 - np.sum((x - [2.5, 7.5]) ** 2)),
        lambda x: bool(x[0] < -1.0 and x[1] > 9.0),
        0.397887,
    ),
    # its minimum at (0.20, 0.15, 0.48, 0.28, 0.31, 0.66) is allowed and can be built
    Problem(
        "Hartmann-6",
        tuple(SearchVariable(f"v{number}", 0.0, 1.0) for number in range(6)),
        18,
        0.05,
        hartmann,
        lambda x: float(1.2 - x[0] - x[3] - 0.5 * x[5]),
        lambda x: bool(x[2] > 0.75),
        -3.32237,
    ),
)


def plain(variables: Sequence[SearchVariable], evaluated: list[Evaluated], batch: int, seed: int) -> list[tuple[float, ...]]:
    """More points of the first designs' sequence."""
    return first_designs(variables, len(evaluated) + batch, seed)[len(evaluated) :]


def with_egobox(
    variables: Sequence[SearchVariable], evaluated: list[Evaluated], batch: int, seed: int
) -> list[tuple[float, ...]]:
    """Expected improvement with constraints, a batch by believing.

    Its `suggest` takes no failed designs (it panics, whatever its strategy for them): being built is a second constraint here,
    and a failed design has the worst values of all.
    """
    import egobox

    optimiser = egobox.Egor(
        [[variable.lowest, variable.highest] for variable in variables],
        cstr_specs=[egobox.CstrSpec.geq(0.0), egobox.CstrSpec.geq(0.0)],
        cstr_infill=True,
        qei_config=egobox.QEiConfig(batch=batch),
        seed=seed,
    )
    points = np.array([design.values for design in evaluated])
    numbers = np.array([(*design.objectives, *design.margins, 1.0 if design.is_done else -1.0) for design in evaluated])
    worst = np.array([np.nanmax(numbers[:, 0]), np.nanmin(numbers[:, 1]), -1.0])
    numbers = np.where(np.isnan(numbers), worst, numbers)
    return [tuple(row) for row in optimiser.suggest(points, numbers, seed=seed + len(evaluated)).tolist()]


def with_optuna(
    variables: Sequence[SearchVariable], evaluated: list[Evaluated], batch: int, seed: int
) -> list[tuple[float, ...]]:
    """Its tree of Parzen estimators; its Gaussian process would need PyTorch, which is not weighed here."""
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    sampler = optuna.samplers.TPESampler(
        seed=seed + len(evaluated),
        multivariate=True,
        constant_liar=True,
        n_startup_trials=1,
    )
    study = optuna.create_study(sampler=sampler)
    ranges = {each.key: optuna.distributions.FloatDistribution(each.lowest, each.highest) for each in variables}
    for design in evaluated:
        state = optuna.trial.TrialState.COMPLETE if design.is_done else optuna.trial.TrialState.FAIL
        study.add_trial(
            optuna.trial.create_trial(
                state=state,
                value=design.objectives[0] if design.is_done else None,
                params=dict(zip(ranges, design.values, strict=True)),
                distributions=ranges,
                constraints={"margin": -design.margins[0]} if design.is_done else None,
            )
        )
    trials = [study.ask(ranges) for _ in range(batch)]
    return [tuple(trial.params[key] for key in ranges) for trial in trials]


@dataclass(frozen=True)
class SmtFit:
    """Kriging of SMT with the scatter of each design, in the place of r37core's fit."""

    model: object
    points: np.ndarray
    numbers: np.ndarray
    scatters: np.ndarray
    seed: int
    mean: float
    scale: float

    is_constant = False

    def at(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        variances = np.maximum(self.model.predict_variances(points)[:, 0], 1e-12)
        return self.model.predict_values(points)[:, 0], np.sqrt(variances)

    def believing(self, point: np.ndarray) -> SmtFit:
        points, numbers = np.vstack([self.points, point]), np.append(self.numbers, self.at(point[None])[0])
        return smt_fit(points, numbers, np.append(self.scatters, 0.0), self.seed, theta=self.model.optimal_theta)


def smt_fit(points: np.ndarray, numbers: np.ndarray, scatters: np.ndarray, seed: int, theta: object = None) -> SmtFit:
    from smt.surrogate_models import KRG

    options = {} if theta is None else {"theta0": list(theta), "hyper_opt": "NoOp"}
    options = {"hyper_opt": "Cobyla", "n_start": 2, **options}
    # one variance for each point, of numbers that SMT divides by their standard deviation
    noise = ((np.nan_to_num(scatters) / numbers.std()) ** 2 + 1e-6).tolist()
    model = KRG(corr="matern52", noise0=noise, use_het_noise=True, print_global=False, seed=seed, **options)
    model.set_training_values(points, numbers[:, None])
    model.train()
    return SmtFit(model, points, numbers, scatters, seed, float(numbers.mean()), float(numbers.std()))


def with_smt(variables: Sequence[SearchVariable], evaluated: list[Evaluated], batch: int, seed: int) -> list[tuple[float, ...]]:
    """The acquisition of r37core on the surrogate of SMT."""
    own, proposal.fit = proposal.fit, smt_fit
    try:
        return proposal.propose(variables, evaluated, batch, seed)
    finally:
        proposal.fit = own


@dataclass(frozen=True)
class Candidate:
    """What proposes (None: only weighed), its distributions that r37 lacks, its last release and what it says it does."""

    name: str
    propose: Proposer | None
    brings: tuple[str, ...]
    released: str
    noise: str
    constraints: str
    batches: str
    failed: str
    objectives: str


OURS = ("ours",) * 4
SMT = ("smt", "scikit-learn", "jenn", "pydoe", "orjson", "jsonpointer")
PYMOO = ("pymoo", "moocore", "autograd", "cma", "alive-progress", "about-time", "graphemeu", "Deprecated", "cffi", "pycparser")
CANDIDATES = (
    Candidate("plain Sobol'", plain, (), "", "", "", "", "", ""),
    Candidate("scikit-learn", proposal.propose, ("scikit-learn",), "2026-09", "per design", *OURS),
    Candidate("SMT", with_smt, SMT, "2026-09", "per design", *OURS),
    Candidate("egobox", with_egobox, ("egobox",), "2026-10", "no", "yes", "yes", "panics", "experimental"),
    Candidate(
        "Optuna (TPE)", with_optuna, ("optuna", "alembic", "Mako", "colorlog"), "2026-09", "no", "yes", "yes", "ignored", "yes"
    ),
    Candidate("OpenTURNS", None, ("openturns", "dill"), "2026-06", "", "", "", "", ""),
    Candidate("pymoo", None, PYMOO, "2026-06", "", "", "", "", ""),
)


def regret(problem: Problem, propose: Proposer, seed: int) -> float:
    """How far the true value of the design that would be taken is above the lowest one.

    Taken is the feasible design with the lowest value as measured; where none is feasible, the worst of the function counts.
    """
    generator = np.random.default_rng([seed, 37])
    evaluated = [
        problem.evaluated(number, values, generator)
        for number, values in enumerate(first_designs(problem.variables, problem.first, seed))
    ]
    while len(evaluated) < EVALUATIONS:
        batch = propose(problem.variables, evaluated, BATCH, seed)
        evaluated += [problem.evaluated(len(evaluated) + n, values, generator) for n, values in enumerate(batch)]
    feasible = [design for design in evaluated if design.is_feasible]
    true = [problem.objective(np.array(design.values)) for design in feasible]
    return true[int(np.argmin([design.objectives[0] for design in feasible]))] - problem.lowest


def fingerprint(name: str) -> str:
    """Hash of a batch after the first designs, to be compared between numbers of threads."""
    problem, generator = PROBLEMS[1], np.random.default_rng(0)
    designs = first_designs(problem.variables, 40, 0)
    evaluated = [problem.evaluated(number, values, generator) for number, values in enumerate(designs)]
    propose = next(each.propose for each in CANDIDATES if each.name == name)
    return hashlib.sha256(repr(propose(problem.variables, evaluated, BATCH, 0)).encode()).hexdigest()


def is_deterministic(name: str) -> bool:
    """Whether 1, 2 and again 2 threads propose the same bits."""
    threads = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS")
    hashes = {
        subprocess.run(
            [sys.executable, __file__, "--fingerprint", name],
            env={**os.environ, **dict.fromkeys(threads, number)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for number in ("1", "2", "2")
    }
    return len(hashes) == 1


def megabytes(names: Sequence[str]) -> float:
    """Size on disk of distributions, without what they need in turn."""
    files = [file.locate() for name in names for file in distribution(name).files or []]
    return sum(Path(file).stat().st_size for file in files if Path(file).is_file() and file.suffix != ".pyc") / 1e6


def licence_of(name: str) -> str:
    """As its metadata says."""
    metadata = distribution(name).metadata
    classifiers = [text for text in metadata.get_all("Classifier", []) if text.startswith("License ::")]
    return metadata["License-Expression"] or " ".join(text.rpartition(" :: ")[2] for text in classifiers)


def row_of(candidate: Candidate, seeds: int) -> list[str]:
    """Its line of the table; empty cells were not measured."""
    facts = [candidate.name, *[""] * 3]
    if candidate.brings:
        name = candidate.brings[0]
        facts = [f"{candidate.name} {distribution(name).version}", candidate.released, licence_of(name)]
        facts.append(f"{megabytes(candidate.brings):.0f}")
    facts += [candidate.noise, candidate.constraints, candidate.batches, candidate.failed, candidate.objectives]
    if candidate.propose is None:
        return [*facts, *[""] * (len(PROBLEMS) + 2)]
    start = time.process_time()
    regrets = [[regret(problem, candidate.propose, seed) for seed in range(seeds)] for problem in PROBLEMS]
    seconds = (time.process_time() - start) / (seeds * sum((EVALUATIONS - each.first) // BATCH for each in PROBLEMS))
    measured = [f"{np.mean(each):.2f} ({min(each):.2f} to {max(each):.2f})" for each in regrets]
    return [*facts, "yes" if is_deterministic(candidate.name) else "no", *measured, f"{seconds:.2f}"]


def main() -> None:
    if sys.argv[1:2] == ["--fingerprint"]:
        print(fingerprint(sys.argv[2]))
        return
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    titles = [
        "library",
        "last release",
        "licence",
        "MB more",
        "noise",
        "constraints",
        "batches",
        "failed designs",
        "several objectives",
    ]
    titles += ["same bits, 1 and 2 threads", *(f"regret, {problem.name}" for problem in PROBLEMS), "CPU s a batch"]
    lines = [titles, ["---"] * len(titles)]
    for candidate in CANDIDATES:
        lines.append(row_of(candidate, seeds))
        print(" | ".join(lines[-1]), flush=True)
    TABLE.write_text("".join(f"| {' | '.join(line)} |\n" for line in lines), encoding="utf-8")


if __name__ == "__main__":
    main()
