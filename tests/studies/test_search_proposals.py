"""Proposals of a search: against plain sampling on functions with known optimum, repeatable, and where little is known."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest

from r37core.base.plain import from_plain, to_plain
from r37studies.surrogate.designs import Design, best_first, designs_at, not_dominated, shares
from r37studies.surrogate.proposal import NEAR, first_designs, propose

SQUARE = ((-2.0, 2.0), (0.0, 8.0))
"""Ranges of two numbers, a and b."""
BEST = np.array([0.6, 5.6])
NOTHING = (math.nan,)


def bowl(values):
    """Lowest, 0, at BEST."""
    return (float(100 * np.sum(((np.array(values) - BEST) / [4.0, 8.0]) ** 2)),)


def evaluated(designs, objectives, margins=lambda values: (), noise=0.0, start=0, built=lambda values: True):
    """Designs with objectives that scatter by `noise`; they are counted from `start`."""
    generator = np.random.default_rng(start + 1)
    made = []
    for number, values in enumerate(designs, start):
        numbers = tuple(each + noise * generator.standard_normal() for each in objectives(values))
        parts = (numbers, (noise,) * len(numbers), margins(values)) if built(values) else (NOTHING, NOTHING, NOTHING)
        made.append(Design(f"d{number:02}", values, *parts))
    return made


def tried(designs, noise=0.0, start=0):
    """Those with a above 1.5 cannot be built, those with b above 6.4 break the constraint."""
    return evaluated(designs, bowl, lambda values: (6.4 - values[1],), noise, start, lambda values: values[0] <= 1.5)


@pytest.fixture(scope="module")
def searches():
    """By their seeds: eight plain designs, then four rounds of four."""
    found = {seed: tried(first_designs(SQUARE, 8, seed), 1.0) for seed in range(3)}
    for seed, known in found.items():
        for _ in range(4):
            known += tried(propose(SQUARE, known, 4, seed), 1.0, len(known))
    return found


def smallest_difference(designs):
    """Of any two, in the variable in which they differ most, as a share of its range."""
    points = shares(SQUARE, designs)
    return min(np.abs(own - other).max() for index, own in enumerate(points) for other in points[:index])


def far_off(values):
    """In four variables from 0 to 1, lowest, 0, at 0.3 each: plain designs are tens above that."""
    return (float(100 * np.sum((np.array(values) - 0.3) ** 2)),)


@pytest.mark.parametrize("seed", range(3))
def test_a_noisy_optimum_is_better_approached_than_by_plain_sampling(seed):
    """In two variables and as much noise a few plain designs are as good in half of the cases."""
    variables = 4 * [(0.0, 1.0)]
    known = evaluated(first_designs(variables, 10, seed), far_off, noise=1.0)
    for _ in range(4):
        known += evaluated(propose(variables, known, 5, seed), far_off, noise=1.0, start=len(known))
    plain = evaluated(first_designs(variables, len(known), seed), far_off, noise=1.0)
    reached, sampled = (far_off(best_first(each)[0].values) for each in (known, plain))
    assert reached < sampled


def test_proposals_are_built_and_keep_the_constraint_and_are_no_near_copies(searches):
    """Of plain designs an eighth cannot be built and a fifth breaks the constraint."""
    proposed = [design for known in searches.values() for design in known[8:]]
    assert sum(not design.is_done for design in proposed) <= 2
    assert sum(design.is_feasible for design in proposed) >= len(proposed) - 4
    for known in searches.values():
        assert smallest_difference([design.values for design in known]) >= NEAR - 1e-4


def test_a_minimum_beyond_the_constraint_is_approached_from_the_side_that_is_allowed():
    def measured(designs):
        return evaluated(designs, bowl, lambda values: (4.0 - values[1],))

    known = measured(first_designs(SQUARE, 10, 0))
    for _ in range(3):
        known += measured(propose(SQUARE, known, 3, 0))
    best = best_first(known)[0]
    # at (0.6, 4.0) the function is 4, inside the constraint it is more
    assert 0 <= best.margins[0] < 0.2 and best.objectives[0] == pytest.approx(4.0, abs=0.5)


def test_the_same_seed_proposes_the_same_designs_and_another_one_others(searches):
    """Also from recorded designs."""
    known = searches[0]
    proposed = propose(SQUARE, known, 3, 0)
    assert propose(SQUARE, known[::-1], 3, 0) == proposed
    assert propose(SQUARE, known, 3, 1) != proposed
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


DESIGNS = first_designs(SQUARE, 9, 0)
KNOWLEDGE = {
    "nothing": [],
    "one design": evaluated(DESIGNS[:1], lambda values: (1.0,)),
    "all refused": evaluated(DESIGNS, bowl, built=lambda values: False),
    "all at zero": evaluated(DESIGNS, lambda values: (0.0,)),
    "none feasible": evaluated(DESIGNS, bowl, lambda values: (values[1] - 20.0,)),
    "no margin varies": evaluated(DESIGNS, bowl, lambda values: (-1.0,)),
    "one design nine times": evaluated(DESIGNS[:1] * 9, bowl, lambda values: (1.0,)),
    "scatter unknown": [Design(f"d{n}", values, bowl(values), NOTHING, ()) for n, values in enumerate(DESIGNS)],
    "most at zero": evaluated(DESIGNS, lambda values: (max(0.0, bowl(values)[0] - 30.0),)),
}


@pytest.mark.parametrize("known", KNOWLEDGE.values(), ids=KNOWLEDGE)
def test_there_is_a_proposal_whatever_is_known(known):
    proposed = propose(SQUARE, known, 4, 0)
    everything = [*dict.fromkeys(design.values for design in known), *proposed]
    assert len(proposed) == 4 and smallest_difference(everything) >= NEAR - 1e-4
    assert all(low <= value <= high for v in proposed for value, (low, high) in zip(v, SQUARE, strict=True))


def test_two_designs_decide_nothing_and_without_a_feasible_one_the_next_come_nearer():
    kept, broken = (evaluated(DESIGNS[:2], lambda values: (1.0,), lambda values, of=of: (of,)) for of in (1.0, -1.0))
    assert propose(SQUARE, kept, 4, 0) == propose(SQUARE, broken, 4, 0)
    known = evaluated(DESIGNS, bowl, lambda values: (values[1] - 7.9,))
    assert max(values[1] for values in propose(SQUARE, known, 2, 0)) > 7.9 > max(values[1] for values in DESIGNS)


def test_of_two_objectives_the_whole_front_is_proposed():
    """Its designs lie on the line from one's minimum, (-1, 2), to the other's, (1, 6)."""

    def both(values):
        return tuple(float(np.sum(((np.array(values) - end) / [4.0, 8.0]) ** 2)) for end in ([-1.0, 2.0], [1.0, 6.0]))

    known = evaluated(first_designs(SQUARE, 10, 0), both)
    for _ in range(2):
        known += evaluated(propose(SQUARE, known, 5, 0), both)
    proposed = np.array([design.values for design in known[10:]])
    assert np.median(np.abs(proposed[:, 1] - 4.0 - 2.0 * proposed[:, 0])) < 0.6
    assert min(proposed[:, 0]) < -0.35 and max(proposed[:, 0]) > 0.35
    front = np.array([design.objectives[0] for design in not_dominated(known)])
    assert len(front) >= 6 and front.min() < 0.05 and front.max() > 0.3


def test_designs_have_few_digits_and_lie_in_the_ranges():
    variables = ((-1e-3 / 3, 1e-3 / 3), (10_000.0, 10_020.0))
    values = designs_at(variables, np.array([[0.0, 0.123456789], [1.0, 1.0]]))
    assert values == [(-0.00033333, 10_002.469), (0.00033333, 10_020.0)]


def test_the_front_and_the_order():
    pairs = {"a": (1.0, 3.0), "b": (2.0, 2.0), "c": (2.0, 3.0), "d": (2.0, 2.0), "e": (3.0, 1.0), "f": (0.0, 0.0), "g": NOTHING}
    tries = [Design(name, (), numbers, (), (-1.0 if name == "f" else 1.0,)) for name, numbers in pairs.items()]
    assert [each.name for each in not_dominated(tries)] == ["a", "b", "d", "e"]
    assert not_dominated([]) == best_first([]) == []
    singles = [("e", 0.0, -1.0), ("d", 0.0, 1.0), ("c", 0.0, 2.0), ("b", 0.0, 1.0), ("a", 1.0, 1.0)]
    order = best_first([Design(name, (), (value,), (), (margin,)) for name, value, margin in singles])
    assert [each.name for each in order] == ["c", "b", "d", "a"]
