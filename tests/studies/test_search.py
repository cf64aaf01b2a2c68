"""A search: its section and what it refuses, rounds, quantities, designs, and its figure."""

import json
import math

import numpy as np
import pytest
import xarray as xr
from workflow_runs import overlay

from r37core.config import ConfigError
from r37core.product.extensions import read_settings
from r37studies.search import steps
from r37studies.search.dataset import search_dataset, search_table
from r37studies.search.designs import START, SearchChoice, designs_of
from r37studies.search.figures import draw_designs
from r37studies.search.quantity import contact_value, structure_value
from r37studies.search.section import ConstraintSection, QuantitySection, SearchSection
from r37studies.search.steps import next_designs
from r37studies.surrogate.proposal import first_designs

BLADES = """
Free:
  base: Ref
  sweep_lean:
    - { span_percent: 0, sweep_cm: 0, lean_deg: 0 }
    - { span_percent: 100, sweep_cm: 0, lean_deg: 0 }
"""
SEARCH = """
blades: [Free]
scenes: [abradable, direct]
fidelity: draft
speeds: [{ start: 750, stop: 1600, step: 400 }]
search:
  blade: Free
  variables: { sweep_lean.1.sweep_cm: [-1, 1], stagger_deg.tip: [-3, 3] }
  objectives: { lined: { scenes: [abradable] } }
  designs: 5
  first: 2
  batch: 2
"""


@pytest.fixture
def folder(config_copy):
    overlay(config_copy, "blades.yaml", BLADES)
    overlay(config_copy, "config.yaml", SEARCH)
    return config_copy


def test_without_stress_nothing_starts(folder):
    overlay(folder, "scenes.yaml", "abradable: { results: [spectrum] }")
    with pytest.raises(ConfigError, match=r"lined.scenes: found 'abradable', without stress"):
        read_settings(folder)


OF_START = {"lined": (40.0, 1.0), "mass": (2.0, 0.0)}
LINED, MASS = {"measure": "length_most_revolutions_rad_s", "scenes": ["s"]}, {"measure": "mass_kg"}


def choice(seed=0, start=(0.0, None), **keys):
    """Choice of a search, with other keys of its section."""
    section = {
        "blade": "Free",
        "variables": {"stagger_deg.tip": [-3.0, 3.0], "sweep_lean.1.sweep_cm": [-1.0, 1.0]},
        "objectives": {"lined": LINED},
        "constraints": {"mass": {**MASS, "at_least_percent": 95.0, "at_most_percent": 110.0}},
    }
    return SearchChoice(SearchSection(**{**section, "seed": seed, **keys}), start)


def gave(values):
    return {"lined": (10.0 + values[0] ** 2, 0.5), "mass": (2.0 + 0.2 * values[1], 0.0)}


def started(wanted, gave=OF_START):
    """The start alone is tried."""
    return {START: wanted.design(START, wanted.start, -1, gave, {})}


def searched(wanted, counts=(3, 2, 2)):
    """All designs of rounds of so many; the second is refused, and of the third nothing is known."""
    tried = {}
    for number, count in enumerate(counts):
        new = next_designs(tried, count, wanted)
        tried = tried or started(wanted)
        for name, values in new.items():
            known = {"d0001": "crossed", "d0002": {"lined": (None, None), "mass": (2.0, 0.0)}}.get(name, gave(values))
            tried[name] = wanted.design(name, values, number, known, tried)
    return tried


def test_rounds_spend_the_budget_in_batches_and_the_same_seed_gives_the_same():
    tried = searched(choice())
    assert repr(searched(choice())) == repr(tried) != repr(searched(choice(seed=1)))
    _, *designs = tried.values()
    assert [(each.name, each.round) for each in designs] == [
        (f"d000{n}", place) for n, place in enumerate([0, 0, 0, 1, 1, 2, 2])
    ]
    assert (tried["d0001"].refused, tried["d0001"].quantities, tried["d0001"].is_done) == ("crossed", {}, False)
    assert [design.values for design in designs[:3]] == first_designs([(-3.0, 3.0), (-1.0, 1.0)], 7, 0)[:3]
    # a larger budget changes no design that is there
    assert repr(list(searched(choice(), (3, 2, 2, 1)).values())[:8]) == repr(list(tried.values()))


def test_proposals_know_the_start(monkeypatch):
    """Where its values are known; it is measured anyway."""
    known = []
    monkeypatch.setattr(steps, "propose", lambda variables, evaluated, batch, seed: known.append(evaluated) or [])
    searched(choice(), (3, 2))
    searched(choice(start=(0.5, 0.0)), (3, 2))
    without, (start, *others) = known
    assert [each.name for each in without] == [each.name for each in others] == ["d0000", "d0001", "d0002"]
    assert (start.name, start.values, start.objectives, start.scatters) == ("start", (0.5, 0.0), (40.0,), (1.0,))
    assert start.margins == pytest.approx((0.1, 0.2))


def test_margins_are_of_the_start_in_percent():
    wanted = choice()
    assert wanted.margins({"mass": (2.1, 0.0)}, OF_START) == pytest.approx([2.1 - 1.9, 2.2 - 2.1])
    assert all(math.isnan(margin) for margin in wanted.margins({"mass": (math.nan, math.nan)}, OF_START))
    assert ConstraintSection(measure="mass_kg", at_least=1.0, at_most_percent=50.0).bounds(8.0) == (1.0, 4.0)
    for bounds, margin in (({"at_least": 1.5}, 0.5), ({"at_most": 3.0}, 1.0)):
        assert choice(constraints={"mass": {**MASS, **bounds}}).margins(OF_START, OF_START) == [margin]
    # percent of what is not known bound nothing
    assert wanted.margins({"mass": (2.1, 0.0)}, {"mass": (math.nan, math.nan)}) == []


STRESS = {1000.0: 5e8, 500.0: 2e8}


def campbell():
    return xr.Dataset(
        {
            "frequency": (("mode", "speed"), [[100.0, 140.0]]),
            "crossing_speed": (("mode", "engine_order"), [[900.0, math.nan]]),
            "dynamic_clearance": (("mode", "displacement"), [[0.0, -3e-4, 1e-4]]),
        },
        coords={"mode": ["1B"], "speed": [0.0, 1000.0], "engine_order": [1, 2]},
    )


@pytest.mark.parametrize(
    ("measure", "keys", "expected"),
    [
        ("mass_kg", {}, 16000.0),
        ("frequency_hz", {"mode": "1B"}, 100.0),
        ("frequency_hz", {"mode": "1B", "speed_rad_s": 500.0}, 120.0),
        ("crossing_margin_percent", {"mode": "1B", "engine_order": 1, "speed_rad_s": 1000.0}, 10.0),
        # which no speed has
        ("crossing_margin_percent", {"mode": "1B", "engine_order": 2, "speed_rad_s": 1000.0}, 100.0),
        ("clearance_loss_m", {"mode": "1B"}, 3e-4),
        ("static_stress_pa", {}, 5e8),
        ("static_stress_pa", {"speed_rad_s": 500.0}, 2e8),
    ],
)
def test_quantities_of_a_structure(measure, keys, expected):
    quantity = QuantitySection(measure=measure, **keys)
    assert structure_value(quantity, 16000.0, campbell(), STRESS, 1000.0) == pytest.approx(expected)


def of_contact(measure, *scenes):
    return QuantitySection(measure=measure, scenes=list(scenes))


def test_the_worst_of_several_scenes_counts():
    measures = {
        "a": {"length_most_revolutions_rad_s": 3.0, "length_most_revolutions_scatter_rad_s": 0.1},
        "b": {"length_most_revolutions_rad_s": 5.0, "length_most_revolutions_scatter_rad_s": 0.05},
    }
    assert contact_value(of_contact("length_most_revolutions_rad_s", "a", "b"), measures) == (5.0, 0.05)


@pytest.mark.parametrize("measure", ["largest_rms_m", "largest_median_stress_pa"])
def test_a_design_is_not_better_for_runs_that_diverged(measure):
    """They have neither motion nor stress."""
    ended, diverged = ({measure: 2.0, "diverged_runs": float(number)} for number in (0, 1))
    value, scatter = contact_value(of_contact(measure, "a", "b"), {"a": ended, "b": diverged})
    assert value == np.inf and np.isnan(scatter)


def test_the_start_has_values_of_what_its_entry_leaves_out(folder):
    variables = "{ sweep_lean.0.lean_deg: [-1, 1], chord_percent.hub: [90, 110], material.density_kg_m3: [7000, 9000] }"
    overlay(folder, "config.yaml", f"search: {{ variables: {variables} }}")
    assert designs_of(read_settings(folder)).start_values == [0.0, 0.0, 0.0, 100.0, None]


def test_a_design_without_a_number_is_neither_feasible_nor_among_the_best():
    tried = searched(choice())
    search = search_dataset(tried, choice())
    table = search_table(search).set_index("design")
    assert list(table.index) == list(tried)
    assert table.loc["start", ["round", "lined", "mass"]].tolist() == [-1, 40.0, 2.0]
    assert table.loc["d0001", "refused"] == "crossed" and not table.loc["d0001", "feasible"]
    assert not table.loc["d0002", "feasible"] and table.loc["d0002", "order"] == 0
    best = table[table["order"] > 0].sort_values("order")
    assert best["lined"].is_monotonic_increasing and best["feasible"].all() and len(best) >= 2
    # of the start's 2 kg
    np.testing.assert_allclose([search["constraint_lowest"], search["constraint_highest"]], [[0.95 * 2.0], [1.1 * 2.0]])


@pytest.mark.parametrize(
    ("start", "lengths", "order"),
    [
        (0.4, (0.1, 0.4, 0.8, 0.4), [0, 1, 2, 3]),
        # what the start does not have counts by the largest
        (0.0, (0.1, 0.4, 0.8, 0.4), [1, 2, 0, 3]),
        (0.0, (0.0, 0.0, 0.0, 0.0), [2, 1, 3, 0]),
    ],
)
def test_of_two_objectives_designs_that_none_beats_come_first_by_their_shares_of_the_start(start, lengths, order):
    """The second beats the last. Sums of shares: of 0.4 and 2 1.35, 1.6 and 2.15; of 0.8 and 2 1.225, 1.1 and 1.15."""
    wanted = choice(objectives={"lined": LINED, "mass": MASS}, constraints={})
    gave = [{"lined": (length, 0.0), "mass": (mass, 0.0)} for length, mass in zip(lengths, (2.2, 1.2, 0.3, 1.25), strict=True)]
    tried = started(wanted, {"lined": (start, 0.0), "mass": (2.0, 0.0)})
    for n, of in enumerate(gave):
        tried[f"d{n:04d}"] = wanted.design(f"d{n:04d}", (0.5 * n, 0.2 * n), 0, of, tried)
    search = search_dataset(tried, wanted)
    assert np.argsort(search["order"].values[1:]).tolist() == order


KEYS = ("sweep_lean.1.sweep_cm", "stagger_deg.tip")
OF = {"lined": LINED, "stress": {"measure": "static_stress_pa"}, "mass": MASS}
LENGTHS = (50.0, 5.0, 400.0, np.nan, 100.0, 0.0, 20.0)


def search_of(objectives=("lined", "stress"), keys=KEYS, most=2.0, start=-1.0, **of_start):
    """The start and six designs in two rounds: the first is too heavy, the third cannot be built."""
    sections = {"objectives": {name: OF[name] for name in objectives}, "constraints": {"weight": {**MASS, "at_most": most}}}
    wanted = choice(start=len(keys) * (start,), variables={key: [-1.0, 1.0] for key in keys}, **sections)
    tried = {}
    for place, (length, value) in enumerate(zip(LENGTHS, np.linspace(-1.0, 1.0, 7).tolist(), strict=True)):
        mass = 9.0 if place == 1 else 1.0 + 0.001 * length
        found = {"lined": length, "stress": 1e6 * (500.0 - length), "mass": mass, "weight": mass}
        found = {name: (number, 0.05 * number) for name, number in found.items()} | ({} if tried else of_start)
        name, values = (f"d{place - 1:04d}", len(keys) * (value,)) if tried else (START, wanted.start)
        tried[name] = wanted.design(name, values, (place - 1) // 3, "surfaces cross" if place == 3 else found, tried)
    return search_dataset(tried, wanted)


def lines(axes, label):
    return [points.lines[0].get_xydata() for points in axes.containers if points.get_label() == label]


def test_a_search_of_which_nothing_is_feasible_has_a_table():
    search = search_of(most=0.5)
    assert not search["order"].any() and not search["feasible"].any()
    json.dumps(search_table(search).to_dict("list"))


def test_the_best_counts_feasible_designs_alone():
    """5 rad/s of the first design break the constraint; the third is counted, though it cannot be built."""
    axes = draw_designs(search_of()).axes[0]
    best = max((line.get_xydata() for line in axes.get_lines()), key=len)
    np.testing.assert_array_equal(best, [[1, np.nan], [2, 400.0], [3, 400.0], [4, 100.0], [5, 0.0], [6, 0.0]])
    assert axes.get_title() == "0, start 50"
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
    figure = draw_designs(search_of(**of))
    figure.draw_without_rendering()
    assert all(axes.get_position().width > 0.1 for axes in figure.axes if axes.axison)
