"""Which speeds the benchmarks of docs/accuracy.md count as settled, on made-up runs."""

import importlib

import numpy as np
import pytest
import xarray as xr
from conftest import CHECKOUT


@pytest.fixture
def benchmark(root, monkeypatch):
    """The module of a benchmark, by name."""
    monkeypatch.syspath_prepend(str(CHECKOUT / "validation/benchmarks"))
    return importlib.import_module


def test_a_perturbation_that_is_noticed_unsettles_a_speed_on_patches(benchmark, monkeypatch):
    """Each of the three changes the motion at a speed of its own; elsewhere by less than 3%, and one branch ends."""
    tables, runs = benchmark("contact_patches_tables"), benchmark("contact_patches")
    base = np.where(runs.GRIDS["all"] < 1300.0, 1.0, 0.5)
    unsettled = dict(zip(runs.perturbed(runs.Way()), (800.0, 900.0, 1000.0), strict=True))

    def rms(model, way):
        if way == runs.Way():
            return base
        return base * np.where(runs.GRIDS["all"] == unsettled[way], 0.9, 1.02)

    monkeypatch.setattr(tables, "rms", rms)
    found = runs.GRIDS["all"][~tables.settled(runs.Model("Ref"), runs.Way())]
    assert found.tolist() == [800.0, 900.0, 1000.0, 1295.0, 1300.0]


def test_the_perturbed_runs_are_planned_and_kept_apart(benchmark):
    runs = benchmark("contact_patches")
    model = runs.Model("Ref")
    ways = runs.ways_of(model)
    for way in (*map(runs.Way, runs.SCENES), runs.Way("abradable", grid="coarse", stiffer=10)):
        perturbed = runs.perturbed(way)
        assert set(perturbed) <= set(ways)
        assert [(one.friction, one.shorter) for one in perturbed] == [(1e-3, 1), (-1e-3, 1), (0.0, 2)]
        assert len({one.file(model) for one in (way, *perturbed)}) == 4


def test_a_perturbation_that_is_noticed_unsettles_a_speed_of_the_steps(benchmark):
    accuracy = benchmark("contact_accuracy")
    names, value = list(accuracy.ways("abradable")), np.ones((1, 1, 12, 4, 3))
    assert value.shape[2] == len(names)
    for number, name in enumerate(("friction + 0.1%", "friction - 0.1%", accuracy.SECOND)):
        value[:, :, names.index(name), number] = 1.1
    runs = xr.Dataset(
        {"value": (("scene", "blade", "way", "number", "quantity"), value)},
        {"scene": ["abradable"], "blade": ["Ref"], "way": names, "quantity": list(accuracy.QUANTITIES)},
    )
    assert accuracy.settled(runs, "abradable").values.tolist() == [[False, False, False, True]]
