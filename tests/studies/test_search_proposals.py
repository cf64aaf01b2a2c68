"""Proposals of a search: against plain sampling on functions with known optimum, repeatable, and where little is known."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest

from r37core.base.plain import from_plain, to_plain
from r37studies.surrogate.designs import Design, SearchVariable, best_first, designs_at, not_dominated, shares
from r37studies.surrogate.proposal import NEAR, first_designs, propose

SQUARE = (SearchVariable("a", -2.0, 2.0), SearchVariable("b", 0.0, 8.0))
BEST = np.array([0.6, 5.6])
NOTHING = (math.nan,)


def bowl(values):
    """Lowest, 0, at BEST."""
    return float(100 * np.sum(((np.array(values) - BEST) / [4.0, 8.0]) ** 2))


def tried(designs, noise=0.0, start=0):
    """Each design with its noise; those with a above 1.5 cannot be built, those with b above 6.4 break the constraint."""
    generator = np.random.default_rng(start + 1)
    evaluated = []
    for number, values in enumerate(designs, start):
        length, margin, scatter = (bowl(values) + noise * generator.standard_normal(),), (6.4 - values[1],), (noise,)
        built = values[0] <= 1.5
        parts = (length, scatter, margin) if built else (NOTHING, NOTHING, NOTHING)
        evaluated.append(Design(f"d{number:02}", values, *parts))
    return evaluated


@pytest.fixture(scope="module")
def searches():
    """By their seeds: eight plain designs, then four rounds of four."""
    found = {seed: tried(first_designs(SQUARE, 8, seed), 1.0) for seed in range(3)}
    for seed, evaluated in found.items():
        for _ in range(4):
            evaluated += tried(propose(SQUARE, evaluated, 4, seed), 1.0, len(evaluated))
    return found


def with_objectives(designs, objective, margin=None):
    margins = [() if margin is None else (margin(values),) for values in designs]
    return [
        Design(f"d{number:02}", values, objective(values), (0.0,) * len(objective(values)), kept)
        for number, (values, kept) in enumerate(zip(designs, margins, strict=True))
    ]


def smallest_difference(designs):
    """Of any two, in the variable in which they differ most, as a share of its range."""
    points = shares(SQUARE, designs)
    return min(np.abs(own - other).max() for index, own in enumerate(points) for other in points[:index])


def noisy(objective, designs, start=0):
    """An objective that scatters by 1; the designs are counted from `start`."""
    generator = np.random.default_rng(start + 1)
    return [
        Design(f"d{number:02}", values, (objective(values) + generator.standard_normal(),), (1.0,), ())
        for number, values in enumerate(designs, start)
    ]


def far_off(values):
    """In four variables from 0 to 1, lowest, 0, at 0.3 each: plain designs are tens above that."""
    return float(100 * np.sum((np.array(values) - 0.3) ** 2))


@pytest.mark.parametrize("seed", range(3))
def test_a_noisy_optimum_is_better_approached_than_by_plain_sampling(seed):
    """In two variables and as much noise a few plain designs are as good in half of the cases."""
    variables = tuple(SearchVariable(key, 0.0, 1.0) for key in "abcd")
    evaluated = noisy(far_off, first_designs(variables, 10, seed))
    for _ in range(4):
        evaluated += noisy(far_off, propose(variables, evaluated, 5, seed), len(evaluated))
    plain = noisy(far_off, first_designs(variables, len(evaluated), seed))
    reached, sampled = (far_off(best_first(each)[0].values) for each in (evaluated, plain))
    assert reached < sampled


def test_proposals_are_built_and_keep_the_constraint(searches):
    """Of plain designs an eighth cannot be built and a fifth breaks the constraint."""
    proposed = [design for evaluated in searches.values() for design in evaluated[8:]]
    assert sum(not design.is_done for design in proposed) <= 2
    assert sum(design.is_feasible for design in proposed) >= len(proposed) - 4


def test_a_minimum_beyond_the_constraint_is_approached_from_the_side_that_is_allowed():
    def kept(values):
        return 4.0 - values[1]

    evaluated = with_objectives(first_designs(SQUARE, 10, 0), lambda values: (bowl(values),), kept)
    for _ in range(3):
        proposed = propose(SQUARE, evaluated, 3, 0)
        evaluated += with_objectives(proposed, lambda values: (bowl(values),), kept)
    best = best_first(evaluated)[0]
    # at (0.6, 4.0) the function is 4, inside the constraint it is more
    assert 0 <= best.margins[0] < 0.2 and best.objectives[0] == pytest.approx(4.0, abs=0.5)


def test_the_same_seed_proposes_the_same_designs_and_another_one_others(searches):
    """Also from recorded designs."""
    evaluated = searches[0]
    proposed = propose(SQUARE, evaluated, 3, 0)
    assert propose(SQUARE, evaluated[::-1], 3, 0) == proposed
    assert propose(SQUARE, evaluated, 3, 1) != proposed
    assert first_designs(SQUARE, 8, 0) == first_designs(SQUARE, 13, 0)[:8] != first_designs(SQUARE, 8, 1)
    recorded = [from_plain(Design, to_plain(design)) for design in searches[1][:16]]
    assert propose(SQUARE, recorded, 4, 1) == [design.values for design in searches[1][16:20]]


@pytest.mark.slow
def test_two_threads_propose_what_one_does(searches):
    """In a process of its own: the number of threads is read when linear algebra is loaded; the tests have one."""
    code = (
        "from test_search_proposals import SQUARE, first_designs, propose, tried;"
        "print(propose(SQUARE, tried(first_designs(SQUARE, 40, 0), 1.0), 3, 0))"
    )
    expected = propose(SQUARE, tried(first_designs(SQUARE, 40, 0), 1.0), 3, 0)
    environment = {**os.environ, "OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2"}
    run = subprocess.run([sys.executable, "-c", code], cwd=os.path.dirname(__file__), env=environment, capture_output=True)
    assert run.stdout.decode().strip() == str(expected), run.stderr.decode()


def test_no_two_designs_are_near_copies(searches):
    for evaluated in searches.values():
        assert smallest_difference([design.values for design in evaluated]) >= NEAR - 1e-4


DESIGNS = first_designs(SQUARE, 9, 0)
KNOWLEDGE = {
    "nothing": [],
    "one design": with_objectives(DESIGNS[:1], lambda values: (1.0,)),
    "all refused": [Design(f"d{n}", values, NOTHING, NOTHING, NOTHING) for n, values in enumerate(DESIGNS)],
    "all at zero": with_objectives(DESIGNS, lambda values: (0.0,)),
    "none feasible": with_objectives(DESIGNS, lambda values: (bowl(values),), lambda values: values[1] - 20.0),
    "no margin varies": with_objectives(DESIGNS, lambda values: (bowl(values),), lambda values: -1.0),
    "one design nine times": with_objectives(DESIGNS[:1] * 9, lambda values: (bowl(values),), lambda values: 1.0),
    "scatter unknown": [Design(f"d{n}", values, (bowl(values),), NOTHING, ()) for n, values in enumerate(DESIGNS)],
    "most at zero": with_objectives(DESIGNS, lambda values: (max(0.0, bowl(values) - 30.0),)),
}


@pytest.mark.parametrize("known", KNOWLEDGE.values(), ids=KNOWLEDGE)
def test_there_is_a_proposal_whatever_is_known(known):
    proposed = propose(SQUARE, known, 4, 0)
    everything = [*dict.fromkeys(design.values for design in known), *proposed]
    assert len(proposed) == 4 and smallest_difference(everything) >= NEAR - 1e-4
    assert all(each.lowest <= value <= each.highest for v in proposed for value, each in zip(v, SQUARE, strict=True))


def test_two_designs_decide_nothing_and_without_a_feasible_one_the_next_come_nearer():
    kept, broken = (with_objectives(DESIGNS[:2], lambda values: (1.0,), lambda values, of=of: of) for of in (1.0, -1.0))
    assert propose(SQUARE, kept, 4, 0) == propose(SQUARE, broken, 4, 0)
    known = with_objectives(DESIGNS, lambda values: (bowl(values),), lambda values: values[1] - 7.9)
    assert max(values[1] for values in propose(SQUARE, known, 2, 0)) > 7.9 > max(values[1] for values in DESIGNS)


def test_of_two_objectives_the_whole_front_is_proposed():
    """Its designs lie on the line from one's minimum, (-1, 2), to the other's, (1, 6)."""

    def both(values):
        return tuple(float(np.sum(((np.array(values) - end) / [4.0, 8.0]) ** 2)) for end in ([-1.0, 2.0], [1.0, 6.0]))

    evaluated = with_objectives(first_designs(SQUARE, 10, 0), both)
    for _ in range(2):
        evaluated += with_objectives(propose(SQUARE, evaluated, 5, 0), both)
    proposed = np.array([design.values for design in evaluated[10:]])
    assert np.median(np.abs(proposed[:, 1] - 4.0 - 2.0 * proposed[:, 0])) < 0.6
    assert min(proposed[:, 0]) < -0.35 and max(proposed[:, 0]) > 0.35
    front = np.array([design.objectives[0] for design in not_dominated(evaluated)])
    assert len(front) >= 6 and front.min() < 0.05 and front.max() > 0.3


def test_designs_have_few_digits_and_lie_in_the_ranges():
    variables = (SearchVariable("small", -1e-3 / 3, 1e-3 / 3), SearchVariable("large", 10_000.0, 10_020.0))
    values = designs_at(variables, np.array([[0.0, 0.123456789], [1.0, 1.0]]))
    assert values == [(-0.00033333, 10_002.469), (0.00033333, 10_020.0)]


def test_the_front_and_the_order():
    def design(name, objectives, margins):
        return Design(name, (0.0,), objectives, (0.0,) * len(objectives), margins)

    pairs = [("a", (1.0, 3.0)), ("b", (2.0, 2.0)), ("c", (2.0, 3.0)), ("d", (2.0, 2.0)), ("e", (3.0, 1.0))]
    tries = [design(name, objectives, (1.0,)) for name, objectives in pairs]
    tries += [design("f", (0.0, 0.0), (-1.0,)), design("g", (math.nan, math.nan), NOTHING)]
    assert [each.name for each in not_dominated(tries)] == ["a", "b", "d", "e"]
    assert not_dominated([]) == best_first([]) == []
    singles = [("a", 1.0, 1.0), ("b", 0.0, 1.0), ("c", 0.0, 2.0), ("d", 0.0, 1.0), ("e", 0.0, -1.0)]
    order = best_first([design(name, (value,), (margin,)) for name, value, margin in reversed(singles)])
    assert [each.name for each in order] == ["c", "b", "d", "a"]
