"""The figures of a search: what is drawn of its designs, whatever is missing of them."""

import numpy as np
import pytest

from r37core.base.units import shown_unit
from r37core.search.dataset import search_dataset
from r37core.search.figures import broken_key, draw_designs, draw_slices
from r37core.search.problem import Constraint, Design, SearchChoice, SearchVariable
from r37core.search.quantity import Quantity
from r37core.search.rounds import SearchRound

KEYS = ("sweep_lean.1.sweep_cm", "stagger_deg.tip")
OF = {"lined": Quantity("length_most_revolutions_rad_s", ("s",)), "stress": Quantity("static_stress_pa")}
OF |= {"mass": Quantity("mass_kg")}
LENGTHS = (50.0, 5.0, 400.0, np.nan, 100.0, 0.0, 20.0)


def search_of(objectives=("lined", "stress"), keys=KEYS, most=2.0, start=-1.0, **of_start):
    """The start and six designs in two rounds: the first is too heavy, the third cannot be built."""
    designs = []
    for place, (length, value) in enumerate(zip(LENGTHS, np.linspace(-1.0, 1.0, 7).tolist(), strict=True)):
        mass = 9.0 if place == 1 else 1.0 + 0.001 * length
        found = {"lined": length, "stress": 1e6 * (500.0 - length), "mass": mass, "weight": mass}
        found = {name: (number, 0.05 * number) for name, number in found.items()}
        refused = "surfaces cross" if place == 3 else None
        designs.append(Design(len(keys) * (value,), (place - 1) // 3, refused, {} if refused else found))
    tried = {f"d{place:04d}": design for place, design in enumerate(designs[1:])}
    variables = tuple(SearchVariable(key, -1.0, 1.0) for key in keys)
    constraints = {"weight": Constraint(OF["mass"], None, most, None, None)}
    wanted = {name: OF[name] for name in objectives}
    choice = SearchChoice(variables, wanted, constraints, "surrogate", 0, len(keys) * (start,))
    return search_dataset(SearchRound({}, tried, designs[0].quantities | of_start), choice)


def lines(axes, label):
    return [line.get_xydata() for line in axes.get_lines() if line.get_label() == label]


def test_the_best_counts_feasible_designs_alone():
    """5 rad/s of the first design break the constraint; the third is counted, though it cannot be built."""
    axes = draw_designs(search_of()).axes[0]
    best = max((line.get_xydata() for line in axes.get_lines()), key=len)
    np.testing.assert_array_equal(best, [[1, np.nan], [2, 400.0], [3, 400.0], [4, 100.0], [5, 0.0], [6, 0.0]])
    assert [text.get_text() for text in axes.texts] == ["0", "start 50"]
    # after three designs of the first round
    assert [3.5, 3.5] in [list(line.get_xdata()) for line in axes.get_lines()]


def test_objectives_against_each_other_are_in_their_shown_units():
    panel = draw_designs(search_of()).axes[2]
    (front,) = lines(panel, "none is better in all objectives")
    np.testing.assert_allclose(front, [[0, 500], [20, 480], [50, 450], [100, 400], [400, 100]])
    np.testing.assert_allclose(lines(panel, "breaks a constraint"), [[[5, 495]]])
    np.testing.assert_allclose(lines(panel, "start"), [[[50, 450]]])
    assert panel.get_xlabel() == "lined (rad/s)"
    assert panel.get_ylabel() == "stress (MPa)"
    shown = [("rad/s", 1.0), ("MPa", 1e-6), ("mm", 1e3), ("Hz", 1.0), ("%", 1.0), ("", 1.0)]
    assert [shown_unit(unit) for unit in ("rad s-1", "Pa", "m", "Hz", "percent", "1")] == shown


def test_a_single_objective_is_drawn_over_the_rounds():
    panel = draw_designs(search_of(["lined"])).axes[1]
    np.testing.assert_array_equal(lines(panel, "best"), [[[1, 0]]])
    np.testing.assert_array_equal(lines(panel, "start"), [[[-1, 50]]])


def test_slices_say_how_far_they_can_be_believed():
    search = search_of()
    panels = draw_slices(search).axes
    assert len(panels) == 4
    assert panels[0].get_ylabel() == f"lined (rad/s)\n$Q^2$ {search['surrogate_q2'].values[0]:.2f}"
    assert (panels[2].get_xlabel(), broken_key("stagger_deg")) == ("sweep_lean.1.\nsweep_cm", "stagger_deg")
    assert {axes.get_title()[:8] for axes in panels} == {"total 0."}
    np.testing.assert_allclose(lines(panels[2], "best")[0][0, 1], 500)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "of",
    [
        {"objectives": ["lined"], "keys": KEYS[:1]},
        {"objectives": ["lined", "stress", "mass"]},
        {"most": 0.5},
        {"objectives": ["lined"], "most": 0.5},
        {"start": None},
        {"lined": (None, None)},
    ],
    ids=["one", "three", "none feasible", "none of one feasible", "start of unknown values", "start of unknown objectives"],
)
def test_what_is_missing_is_left_out_and_all_has_room(of):
    """Layout warns where panels have no room."""
    search = search_of(**of)
    for draw in (draw_designs, draw_slices):
        figure = draw(search)
        figure.draw_without_rendering()
        assert all(axes.get_position().width > 0.1 for axes in figure.axes if axes.axison)
