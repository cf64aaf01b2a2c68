"""The last lines of a run on its extensions: what was found and the file to look at."""

import os

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from r37core.designs import table as designs
from r37core.plans.extension import Extension
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import EXTENSIONS
from r37core.product.remarks import line_of_extension
from r37core.rotors import dataset as rotors
from r37core.run_ups import tables as run_ups
from r37core.search import dataset as search
from r37core.signals import dataset as signals
from r37core.tolerances import table as tolerances


def extension(*files, **more):
    return Extension(name="mine", targets=lambda sweep: {f"<results>/{name}": [{}] for name in files}, **more)


@pytest.fixture
def line(settings, tmp_path):
    """What is said of an extension whose targets are all there, made at 1000 s, in a run that began then."""

    def of(extension, began=1000.0):
        for name in extension.targets(None):
            file = tmp_path / name.removeprefix("<results>/")
            file.touch()
            os.utime(file, (1000.0, 1000.0))
        return line_of_extension(extension, Sweep(settings), tmp_path, began).replace(str(tmp_path), "results")

    return of


def test_an_extension_without_a_word_names_what_a_person_opens_first(line, tmp_path):
    assert line(extension("mine.nc", "mine.csv")) == "mine: 2 files made; look at results/mine.csv"
    assert line(extension("mine.nc", "a.pdf", "a.png", "mine.csv")) == "mine: 4 files made; look at results/a.png"
    assert line(extension("mine.csv", "a.png", "mine.html")).endswith("look at results/mine.html")
    assert line(extension("mine.inp")) == "mine: 1 file made; look at results/mine.inp"
    assert line(extension("mine.inp", "mine.csv", look_at="<results>/mine")).endswith("look at results/mine")
    # of what is older, or is not there, nothing is said
    assert line(extension("mine.csv"), began=1001.0) == ""
    os.utime(tmp_path / "mine.csv", (2000.0, 2000.0))
    assert line_of_extension(extension("other.csv"), Sweep(None), tmp_path, 0.0) == ""


def test_an_extension_s_own_word(line, tmp_path):
    pd.DataFrame({"diverged_speeds": [0]}).to_csv(tmp_path / "rotors.csv", index=False)
    said = line(extension("rotor.png", closing="rotors.dataset.closing"))
    assert said == "mine: 1 rotor; look at results/rotor.png"


@pytest.mark.parametrize("extension", EXTENSIONS, ids=lambda extension: extension.name)
def test_the_words_of_the_shipped_extensions_are_there(extension):
    if extension.closing:
        module = __import__(f"r37core.{extension.closing.rpartition('.')[0]}", fromlist=["closing"])
        assert callable(module.closing)


def table(folder, name, **columns):
    pd.DataFrame(columns).to_csv(folder / name, index=False)


WHERE = {"blade": ["Ref", "NA"], "scene": ["lined", "lined"]}
STRESS = {"max_von_mises_pa": [2.314e9, np.nan]}


def test_run_ups(tmp_path):
    numbers = {"yield_stress_pa": [1.38e9] * 2, "max_von_mises_speed_rad_s": [1718.2, np.nan]}
    table(tmp_path, "run_ups.csv", **WHERE, **STRESS, **numbers, status=["completed", "diverged"])
    largest = "the largest stress 2.31 GPa, Ref in lined at 1718.2 rad/s"
    assert run_ups.closing(tmp_path) == f"2 run-ups, 1 of them above yield, 1 diverged; {largest}"
    table(tmp_path, "run_ups.csv", **WHERE, status=["completed"] * 2)
    assert run_ups.closing(tmp_path) == "2 run-ups"


def test_rotors(tmp_path):
    numbers = {"worst_speed_rad_s": [1640.0, 1650.0], "speeds": [2, 3]}
    for diverged, said in (([0, 0], ""), ([0, 3], ", 3 of 5 runs diverged")):
        table(tmp_path, "rotors.csv", **WHERE, **STRESS, **numbers, diverged_speeds=diverged)
        assert rotors.closing(tmp_path) == f"2 rotors{said}; the largest stress 2.31 GPa, Ref in lined at 1640 rad/s"


def test_designs(tmp_path):
    lengths = {"length_certain_rad_s": [40.0, 13.2, np.nan], "length_possible_rad_s": [50.0, 20.0, np.nan]}
    more = {"diverged_runs": [0, 1, 0], "largest_median_stress_pa": [1e9] * 3}
    table(tmp_path, "designs.csv", blade=["A", "B", "A"], scene=["lined", "lined", "quiet"], **lengths, **more)
    assert designs.closing(tmp_path) == "2 designs; lined: B is above yield at the fewest speeds (13 rad/s)"


def test_tolerances(tmp_path):
    ends = {"max_von_mises_pa_low": [2.02e9, np.nan], "max_von_mises_pa_high": [1.41e10, np.nan]}
    xr.Dataset({"status": (("member", "speed"), [[0, 1, 2], [0, 0, 2]])}).to_netcdf(tmp_path / "tolerances.nc")
    table(tmp_path, "tolerances.csv", **WHERE, members=[32, 32], robust=[True, False], **ends)
    count, largest = "1 of them in at least half of those; 1 of 4 runs diverged", "the largest stress 2 to 14 GPa, Ref in lined"
    assert tolerances.closing(tmp_path) == f"2 interactions in up to 32 members, {count}; {largest}"
    table(tmp_path, "tolerances.csv", **{name: [] for name in (*WHERE, "members", "robust", *ends)})
    assert tolerances.closing(tmp_path).startswith("0 interactions in up to 0 members")


def test_signals(tmp_path):
    for speeds, said in (([1725.0], "1 signal at 1725 rad/s"), ([1725.0, 1330.0], "2 signals at 1330 to 1725 rad/s")):
        xr.Dataset({"speed": ("run", speeds)}).to_netcdf(tmp_path / "signals.nc")
        assert signals.closing(tmp_path) == said
    xr.Dataset().to_netcdf(tmp_path / "signals.nc")
    assert signals.closing(tmp_path) == "no signal, for no interaction was found"


def test_search(tmp_path):
    axes = ("design", "objective")
    values = {"objective_value": (axes, [[70.6, 2.0], [13.24, 2.1], [90.0, 1.0]])}
    values |= {"objective_scatter": (axes, [[0.6, 0.0], [0.5, 0.0], [1.0, 0.0]]), "feasible": ("design", [1, 1, 0])}
    units = {"objective_unit": ("objective", ["rad s-1", "kg"])}
    names = {"design": ["start", "d0001", "d0002"], "objective": ["lined", "mass"]}
    found = xr.Dataset(values | {"order": ("design", [0, 1, 0])}, names | units)
    found.to_netcdf(tmp_path / "search.nc")
    said = search.closing(tmp_path).replace(str(tmp_path), "results")
    best = "the best, d0001: lined 13.2 rad/s (the start 70.6), mass 2.1 kg (the start 2)"
    assert said == f"2 designs, 1 of them keep all constraints; {best}; entries in results/search/best"
    found.assign(order=("design", [0, 0, 0])).to_netcdf(tmp_path / "search.nc")
    assert search.closing(tmp_path) == "2 designs, 1 of them keep all constraints"
