"""The figures of a search: what is drawn of its designs, whatever is missing of them."""

import numpy as np
import pytest
import xarray as xr

from r37core.base.units import shown_unit
from r37core.search.figures import broken_key, draw_designs, draw_slices

KEYS = ("sweep_lean.1.sweep_cm", "stagger_deg.tip")
UNITS = {"lined": "rad s-1", "stress": "Pa", "mass": "kg"}


def search_of(objectives=("lined", "stress"), constraints=("static",), variables=KEYS):
    """The start and six designs in three rounds: the first breaks the constraint, the third cannot be built."""
    number = 7
    value = np.linspace(-1.0, 1.0, number)[:, None] * np.ones(len(variables))
    lengths = np.array([[50.0, 5.0, 400.0, np.nan, 100.0, 0.0, 20.0]]).T
    of = np.hstack([lengths, 1e6 * (500.0 - lengths), 1.0 + 0.001 * lengths])[:, : len(objectives)]
    feasible = np.array([1, 0, 1, 0, 1, 1, 1], "i1")
    designs = ("design", "objective")
    rows = {"round": [-1, 0, 0, 0, 1, 1, 2], "order": [0, 0, 4, 0, 3, 1, 2], "feasible": feasible, "not_dominated": feasible}
    dataset = xr.Dataset(
        {name: ("design", values) for name, values in rows.items()}
        | {
            "value": (("design", "variable"), value),
            "refused": ("design", ["", "", "", "surfaces cross", "", "", ""]),
            "objective_value": (designs, of),
            "objective_scatter": (designs, np.where(np.isnan(of), np.nan, 0.05 * of)),
            "constraint_value": (("design", "constraint"), np.ones((number, len(constraints)))),
            "lowest": ("variable", np.full(len(variables), -1.0)),
            "highest": ("variable", np.full(len(variables), 1.0)),
        },
        {
            "design": ["start", *(f"d{place:04d}" for place in range(6))],
            "variable": list(variables),
            "objective": list(objectives),
            "constraint": list(constraints),
            "objective_unit": ("objective", [UNITS[name] for name in objectives]),
        },
    )
    along = np.tile(np.linspace(-1.0, 1.0, 5), (len(variables), 1))
    axes = ("objective", "variable")
    mean = np.nanmean(of, axis=0)[:, None, None] * np.ones((len(objectives), *along.shape))
    return dataset.assign(
        slice_value=(("variable", "point"), along),
        slice_mean=((*axes, "point"), mean),
        slice_deviation=((*axes, "point"), 0.1 * mean),
        sensitivity_total=(axes, np.full(mean.shape[:2], 0.25)),
        surrogate_q2=("objective", np.full(len(objectives), 0.75)),
    )


def without_feasible(search):
    search = search.drop_vars([name for name in search if str(name).startswith(("slice", "sensitivity", "surrogate"))])
    return search.assign({name: xr.zeros_like(search[name]) for name in ("feasible", "not_dominated", "order")})


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
    panel = draw_designs(search_of(["lined"], [])).axes[1]
    np.testing.assert_array_equal(lines(panel, "best"), [[[1, 0]]])
    np.testing.assert_array_equal(lines(panel, "start"), [[[-1, 50]]])


def test_slices_say_how_far_they_can_be_believed():
    panels = draw_slices(search_of()).axes
    assert len(panels) == 4
    assert panels[0].get_ylabel() == "lined (rad/s)\n$Q^2$ 0.75"
    assert (panels[2].get_xlabel(), broken_key("stagger_deg")) == ("sweep_lean.1.\nsweep_cm", "stagger_deg")
    assert {axes.get_title() for axes in panels} == {"total 0.25"}
    ((surrogate,), (best,)) = (lines(panels[2], label) for label in ("surrogate", "best"))
    np.testing.assert_allclose(surrogate[:, 1], np.nanmean([450, 495, 100, 400, 500, 480]))
    np.testing.assert_allclose(best[0, 1], 500)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "search",
    [
        search_of(["lined"], [], KEYS[:1]),
        search_of(["lined", "stress", "mass"]),
        without_feasible(search_of()),
        without_feasible(search_of(["lined"], [])),
        search_of().assign(value=search_of()["value"].where(search_of()["design"] != "start")),
        search_of().assign(objective_value=search_of()["objective_value"].where(search_of()["design"] != "start")),
    ],
    ids=["one", "three", "none feasible", "none built", "start of unknown values", "start of unknown objectives"],
)
def test_what_is_missing_is_left_out_and_all_has_room(search):
    """Layout warns where panels have no room."""
    for draw in (draw_designs, draw_slices):
        figure = draw(search)
        figure.draw_without_rendering()
        assert all(axes.get_position().width > 0.1 for axes in figure.axes if axes.axison)
